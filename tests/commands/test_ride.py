"""The ride of one vehicle from the command line: the numbers of `ride` and `modes`, of a file and of flags."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Iso8608Road, QuarterCar, RideProblem, certify, load_vehicle, ride, save_system

QUARTER = ("--body-mass", 400, "--wheel-mass", 45, "--tyre-stiffness", "220e3")


def written(folder) -> tuple[pd.DataFrame, pd.DataFrame]:
    return tuple(pd.read_csv(folder / "out" / f"{name}.csv").set_index("name") for name in ("ride", "modes"))


def test_ride_of_a_file_with_a_coefficient_changed(called, tmp_path):
    done = called(
        "ride", "--vehicle", "jian_2022_full", "--road", "C", "--speed", 25, "--band", "0.5,20",
        "--weighting", "Wb", "--setting", "front.damper=1500, rear.damper=1800", "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    table, modes = written(tmp_path)
    file = load_vehicle("jian_2022_full")
    setting = {**file.setting, "front.damper": 1500.0, "rear.damper": 1800.0}
    wanted = ride(file.vehicle, setting, Iso8608Road("C"), 25.0, weighting="Wb", band=(0.5, 20.0))
    np.testing.assert_allclose(table.value, wanted.value, rtol=1e-12)
    assert table.index.tolist() == wanted.index.tolist()
    assert table.unit.tolist() == wanted.unit.tolist()
    of_vehicle = file.vehicle.modes(setting)
    assert modes.index.tolist() == of_vehicle["name"].tolist()
    np.testing.assert_allclose(modes["frequency [Hz]"], of_vehicle["frequency [Hz]"], rtol=1e-12)
    np.testing.assert_allclose(modes["damping ratio [-]"], of_vehicle["damping ratio [-]"], rtol=1e-12)
    said = done.stdout
    assert "front.damper 1.5 kN s/m" in said
    assert "Road: ISO 8608 class C, geometric mean" in said
    assert "25 m/s; 0.5 to 20 Hz." in said
    assert "ACC weighted with Wb" in said
    assert said.splitlines()[-1] == "out"


def test_commands_take_a_plant_of_another_program(called, tmp_path):
    """Whose modes are unknown: its ride alone, and a Bode plot without natural frequencies."""
    save_system(tmp_path / "car.mat", load_vehicle("yuen_ramli_2010").vehicle.plant())
    (tmp_path / "car.toml").write_text(
        'kind = "plant"\nfile = "car.mat"\n[struts]\nspring_N_per_m = 22e3\ndamper_N_s_per_m = 1500\n'
        "[bounds]\nspring_N_per_m = [1e4, 3e4]\ndamper_N_s_per_m = [500, 4000]\n"
    )
    done = called("ride", "--vehicle", "car.toml", "--road", "C", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["ride.csv"]
    found = pd.read_csv(tmp_path / "out" / "ride.csv").set_index("name").value
    wanted = ride(load_vehicle("yuen_ramli_2010").vehicle, (22e3, 1500.0), Iso8608Road("C"), 20.0).value
    np.testing.assert_allclose(found, wanted[found.index], rtol=1e-12)
    done = called("bode", "--vehicle", "car.toml", "--road", "C", "--out", "bode")
    assert done.returncode == 0, done.stderr
    assert len(pd.read_csv(tmp_path / "bode" / "natural_frequencies.csv")) == 0


def test_ride_of_a_quarter_car_by_flags(called, tmp_path):
    done = called("ride", *QUARTER, "--spring", "25e3", "--damper", "2e3", "--road", "D", "--out", "out")
    assert done.returncode == 0, done.stderr
    table, _ = written(tmp_path)
    car = QuarterCar(body_mass=400.0, wheel_mass=45.0, tyre_stiffness=220e3)
    wanted = ride(car, (25e3, 2e3), Iso8608Road("D"), 20.0)
    np.testing.assert_allclose(table.value, wanted.value, rtol=1e-12)


def test_a_hostile_name_of_a_vehicle_is_printed_as_text(called, tmp_path, checkout):
    text = (checkout / "data/vehicles/yuen_ramli_2010.toml").read_text(encoding="utf-8")
    name = text.partition('name = "')[2].partition('"')[0]
    (tmp_path / "car.toml").write_text(text.replace(f'"{name}"', r'"\u001b[31m[bold]\u202e"'), encoding="utf-8")
    done = called("ride", "--vehicle", "car.toml", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(r"\x1b[31m[bold]\u202e: spring ")
    assert "\x1b" not in done.stdout


def test_without_flags_it_is_the_papers_reference_car(called, tmp_path, table1_problem):
    """As a new folder below results, with the folder last."""
    done = called("ride")
    assert done.returncode == 0, done.stderr
    folder = tmp_path / done.stdout.splitlines()[-1]
    assert folder.parent == tmp_path / "results"
    table = pd.read_csv(folder / "ride.csv").set_index("name")
    reference = table1_problem.evaluate([[22e3, 1500.0]])[0]
    np.testing.assert_allclose(table.value[["ACC", "SWS", "DTL"]], reference, rtol=1e-9)


def test_spring_alone_changes_the_car_of_a_file(called, tmp_path):
    done = called(
        "ride", "--spring", "12389.2", "--damper", "1616.3", "--weighting", "Wb-table", "--band", "0.1,20"
    )
    assert done.returncode == 0, done.stderr
    assert "spring 12.3892 kN/m, damper 1.6163 kN s/m" in done.stdout  # the published optimum
    assert " 2.066" in done.stdout


def test_a_vehicle_names_files_elsewhere_only_where_that_is_allowed(called, tmp_path):
    (tmp_path / "car.toml").write_text("""
kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3
strut.layout = "spring | damper"
strut.damper.file = "../front.dpr"
""")
    done = called("ride", "--vehicle", "car.toml")
    assert done.returncode == 2
    assert "strut.damper.file must be beside this file or below it, unless outside is allowed" in done.stderr
    done = called("ride", "--vehicle", "car.toml", "--allow-outside")
    assert (done.returncode, "No such file or directory: " in done.stderr) == (1, True)


def test_springs_laws_and_mean_travel_are_tables_of_80_columns(called, tmp_path):
    done = called("ride", "--vehicle", "volvo_xc90_full", "--road", "C", "--band", "0.1,20", "--out", "out")
    assert done.returncode == 0, done.stderr
    shown = done.stdout.partition("Ride: ")[2]
    assert max(map(len, shown.splitlines())) <= 80
    for title in ("Springs at the working point", "Static loads", "Force laws", "Mean travel"):
        assert f"\n{title}" in shown
    springs = pd.read_csv(tmp_path / "out" / "springs.csv").set_index("name")
    laws = pd.read_csv(tmp_path / "out" / "laws.csv").set_index("law")
    assert springs["spring rate [N/m]"]["front.spring"] == laws.equivalent["front.spring"]
    file, static = load_vehicle("volvo_xc90_full"), pd.read_csv(tmp_path / "out" / "static.csv").set_index("name")
    wanted = file.vehicle.static(file.setting)  # of the laws, not of their mean slopes
    np.testing.assert_allclose(static["value"], wanted["value"], rtol=1e-12)
    assert static["unit"].equals(wanted["unit"])


def test_roads_driven_in_time_stand_beside_the_ride(called, tmp_path):
    """The certificate of a problem whose one design is the vehicle with its struts; a bar of 0 does not vary."""
    done = called("ride", "--vehicle", "minaker_half", "--road", "C", "--certify", "0.4km", "--out", "out")
    assert done.returncode == 0, done.stderr
    file = load_vehicle("minaker_half")
    bounds = {name: (0.9 * value, 1.1 * value) for name, value in file.setting.items()}
    problem = RideProblem(file.vehicle, Iso8608Road("C"), speed=20.0, bounds=bounds)
    wanted = certify(problem, list(file.setting.values()), length=400.0)
    found = pd.read_csv(tmp_path / "out" / "certificate.csv").set_index("measure")
    for column in ("linearised", "simulated", "low", "high"):
        np.testing.assert_allclose(found[column], wanted.to_frame()[column], rtol=1e-6)
    printed = done.stdout.partition("\nCertificate\n")[2]
    assert max(map(len, printed.splitlines())) <= 80
    for row in wanted.rows:
        (line,) = [line for line in printed.splitlines() if line.startswith(f"{row.measure} ")]
        assert ("*" in line) == row.outside
        shown = float(line.split()[2]) * {"kN": 1e3, "mm": 1e-3}.get(line.split()[1], 1.0)
        assert shown == pytest.approx(row.linearised, rel=5e-4)


def test_a_road_too_short_to_drive_is_refused_in_one_line(called):
    done = called("ride", "--certify", 100)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "error: length must be 400 m or more at 20 m/s, got 100 m\n"


def test_notes_have_80_columns_outside_of_a_terminal(called):
    done = called("ride", "--vehicle", "jian_2022_full")
    assert max(map(len, done.stdout.partition("Ride: ")[0].splitlines())) <= 80


def test_a_vehicle_that_no_spring_carries_rides_without_static_loads(called, tmp_path):
    text = 'kind = "quarter-car"\nbody_mass_kg = 300\nwheel_mass_kg = 40\ntyre_stiffness_N_per_m = 2e5\n'
    (tmp_path / "car.toml").write_text(f'{text}strut.layout = "damper"\nstruts.damper_N_s_per_m = 1500\n')
    done = called("ride", "--vehicle", "car.toml", "--road", "C", "--band", "0.5,20", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "Static loads" not in done.stdout
    assert not (tmp_path / "out" / "static.csv").exists()
