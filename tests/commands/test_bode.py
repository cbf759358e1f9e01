"""Bode plots and spectra: files against python-control's model of the closed vehicle."""

import numpy as np
import pandas as pd
import pytest

import garage
from suspension_ctrl import Iso8608Road
from suspension_ctrl.commands.bode import shown_responses
from suspension_ctrl.commands.studies import chosen_study
from suspension_ctrl.quantities import column_headers
from suspension_ctrl.response import weightings
from suspension_ctrl.roads.files import load_road
from suspension_ctrl.tables import write_csv
from suspension_ctrl.vehicles.files import load_vehicle

MEASURED = "wavenumber [cycle/m],psd [m^3]\n0.02,1e-3\n0.1,1e-4\n1,1e-6\n2,2e-7\n"
VARIABLES = [
    "front.spring [N/m]", "front.damper [N s/m]", "rear.spring [N/m]", "rear.damper [N s/m]",
    "front_antiroll [N m/rad]", "rear_antiroll [N m/rad]",
]  # fmt: skip


def test_bode_draws_the_papers_two_cars(script, tmp_path):
    done = script("bode", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    names = {path.name for path in (tmp_path / "out").iterdir()}
    figures = {"figure6.png", "figure6.pdf", "figure7.png", "figure7.pdf"}
    assert names == figures | {"curves.csv", "designs.csv", "natural_frequencies.csv", "study.toml"}
    natural = pd.read_csv(tmp_path / "out" / "natural_frequencies.csv")["natural frequency [Hz]"]
    # The product of the undamped frequencies is det(M^-1 K)^(1/2) = (k k_t / (m_b m_w))^(1/2).
    product = (22e3 * 192e3 / (317.5 * 45.4)) ** 0.5 / (2 * np.pi) ** 2
    assert natural[0] * natural[1] == pytest.approx(product, rel=1e-9)
    assert natural[2] < natural[0]  # the published optimum is softer


def test_bode_draws_any_designs(called, tmp_path):
    """Two from the command line, three from a file as compare.py writes it; the last one overdamped."""
    table = tmp_path / "designs.csv"
    table.write_text("spring [N/m],damper [N s/m],ACC [m/s^2]\n5000,1000,0\n10000,1500,0\n2000,5000,0\n")
    done = called(
        "bode", "--design", "22000,1500", "--design", "8000,2500", "--designs", table, "--out", tmp_path / "out"
    )
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert curves.design.nunique() == 5
    assert {"suspension_travel magnitude [m/m]", "tyre_load phase [deg]"} <= set(curves.columns)


@pytest.mark.drawn
def test_bode_draws_many_designs_and_frequencies_beyond_the_band(called, tmp_path):
    """Eight of them drawn, and without marks where there is no curve; labels alike are told apart."""
    table = tmp_path / "designs.csv"
    rows = "".join(f"{k},{c}\n" for k in range(2000, 12000, 2000) for c in (500, 1500))
    table.write_text("spring [N/m],damper [N s/m]\n" + rows + "1e6,100\n1e6,100.0001\n")
    done = called("bode", "--designs", table, "--points", 50, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(tmp_path / "out" / "curves.csv").design.nunique() == 12
    assert pd.read_csv(tmp_path / "out" / "designs.csv").design.tolist()[-2:] == [
        "1000 kN/m, 0.1 kN s/m",
        "1000 kN/m, 0.1 kN s/m (12)",
    ]
    assert "Figures and tables show 8 of 12 designs, the files have all." in done.stdout


def test_bode_of_a_half_car(called, tmp_path):
    """Spectra by python-control's closed model, natural frequencies by the vehicle's modes."""
    done = called(
        "bode", "--vehicle", "minaker_half", "--road", "C", "--speed", 15, "--band", "0.5,20",
        "--response", "pitch_acceleration", "--response", "rear_tyre_load", "--points", 50, "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert list(curves.columns) == [
        "design",
        "frequency [Hz]",
        "pitch_acceleration magnitude [rad/s^2/m]",
        "pitch_acceleration phase [deg]",
        "pitch_acceleration PSD [(rad/s^2)^2/Hz]",
        "weighted_pitch_acceleration PSD [(rad/s^2)^2/Hz]",
        "rear_tyre_load magnitude [N/m]",
        "rear_tyre_load phase [deg]",
        "rear_tyre_load PSD [(N)^2/Hz]",
    ]
    f = curves["frequency [Hz]"].to_numpy()
    np.testing.assert_allclose(f[[0, -1]], [0.5, 20.0], rtol=1e-12)
    file = load_vehicle("minaker_half")
    h = garage.from_roads(file.vehicle, file.setting, ["pitch_acceleration"], f)[:, 0]
    lag = np.exp(-2j * np.pi * f * (1.189 + 1.696) / 15)  # of the rear wheel on the same track
    met = np.abs(h[:, 0] + h[:, 1] * lag)
    density = Iso8608Road("C").psd(f, 15.0) * met**2
    np.testing.assert_allclose(curves["pitch_acceleration magnitude [rad/s^2/m]"], met, rtol=1e-8)
    np.testing.assert_allclose(curves["pitch_acceleration PSD [(rad/s^2)^2/Hz]"], density, rtol=1e-8)
    np.testing.assert_allclose(
        curves["weighted_pitch_acceleration PSD [(rad/s^2)^2/Hz]"],
        density * weightings.by_name("Wk").factor(f) ** 2,
        rtol=1e-8,
    )
    assert_natural(tmp_path / "out", file.vehicle.modes(file.setting))


def assert_natural(out, modes):
    natural = pd.read_csv(out / "natural_frequencies.csv")
    assert natural["mode"].tolist() == modes["name"].tolist()
    np.testing.assert_allclose(natural["natural frequency [Hz]"], modes["frequency [Hz]"], rtol=1e-12)
    for column in ("damped frequency [Hz]", "damping ratio [-]"):
        np.testing.assert_allclose(natural[column], modes[column], rtol=1e-12)


def test_bode_of_a_vehicle_with_force_laws(called, tmp_path):
    """Its modes are those of the vehicle linearised on the road of the command, class C at 20 m/s."""
    done = called("bode", "--vehicle", "volvo_xc90_full", "--road", "C", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    natural = pd.read_csv(tmp_path / "out" / "natural_frequencies.csv")
    file = load_vehicle("volvo_xc90_full")
    modes = file.vehicle.linearised(file.setting, Iso8608Road("C"), 20.0).modes()
    np.testing.assert_allclose(natural["natural frequency [Hz]"], modes["frequency [Hz]"], rtol=1e-12)


def test_bode_of_designs_of_six_variables(called, tmp_path):
    """Columns in any order, others beside them."""
    design = [9e3, 1500.0, 12e3, 1800.0, 1e4, 2e4]
    table = pd.DataFrame([[0.7, *design]], columns=["ACC [m/s^2]", *VARIABLES])
    table[table.columns[::-1]].to_csv(tmp_path / "designs.csv", index=False)
    done = called(
        "bode", "--vehicle", "jian_2022_full", "--designs", "designs.csv", "--points", 20, "--out", "out"
    )
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert set(curves.design) == {"design 1"}
    told = pd.read_csv(tmp_path / "out" / "designs.csv").set_index("design")
    assert told.loc["design 1", VARIABLES].tolist() == design
    problem = chosen_study(vehicle="jian_2022_full").problem
    assert column_headers(problem.variables, problem.units) == VARIABLES
    modes = load_vehicle("jian_2022_full").vehicle.modes(dict(zip(problem.variables, design, strict=True)))
    assert_natural(tmp_path / "out", modes)


def test_bode_on_a_measured_road_within_its_band(called, tmp_path):
    (tmp_path / "road.csv").write_text(MEASURED)
    command = ("bode", "--road", "road.csv", "--speed", 10, "--points", 20, "--out", "out")
    done = called(*command, "--band", "0.2,20")
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    f = curves["frequency [Hz]"].to_numpy()
    np.testing.assert_allclose(f[[0, 19]], [0.2, 20.0], rtol=1e-12)
    road = load_road(str(tmp_path / "road.csv")).psd(f, 10.0)
    np.testing.assert_allclose(
        curves["tyre_load PSD [(N)^2/Hz]"], road * curves["tyre_load magnitude [N/m]"] ** 2, rtol=1e-9
    )


def test_designs_of_a_file_bear_its_names_and_their_root_mean_squares(called, tmp_path, table1_problem):
    table = pd.DataFrame(
        {"design": ["knee", "=soft"], "spring [N/m]": [22e3, 8e3], "damper [N s/m]": [1500.0, 1e3]}
    )
    write_csv(tmp_path / "candidates.csv", table)
    done = called("bode", "--designs", "candidates.csv", "--points", 20, "--out", "out")
    assert done.returncode == 0, done.stderr
    told = pd.read_csv(tmp_path / "out" / "designs.csv")
    assert told.design.tolist() == ["knee: 22 kN/m, 1.5 kN s/m", "'=soft: 8 kN/m, 1 kN s/m"]
    expected = table1_problem.evaluate([[22e3, 1500.0], [8e3, 1e3]])
    columns = ["weighted_acceleration [m/s^2]", "suspension_travel [m]", "tyre_load [N]"]
    np.testing.assert_allclose(told[columns], expected, rtol=1e-9)


def test_a_vehicle_without_the_papers_responses_shows_its_first():
    assert shown_responses(["a", "b", "c", "d"]) == ["a", "b", "c"]
    assert shown_responses(["x_tyre_load", "y_tyre_load", "z"]) == ["x_tyre_load"]
