"""Struts in vehicle files: all kinds of elements are read and written, tables also from CSV files."""

import re
from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from spoilt import changed
from suspension_ctrl.quantities import FrozenMapping
from suspension_ctrl.vehicles.strut_files import KINDS

CAR = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
AXLES = {
    "body_mass": 650.0, "pitch_inertia": 1200.0, "front_wheel_mass": 40.0, "rear_wheel_mass": 45.0,
    "front_tyre_stiffness": 192e3, "rear_tyre_stiffness": 200e3, "cg_to_front": 1.2, "cg_to_rear": 1.5,
}  # fmt: skip
RATES = {"velocity": [-1.0, -0.05, 0.0, 1 / 3], "force": [-900.0, -400.0, 0.0, 1500.0]}
ELEMENTS = [
    sc.Spring("helper", 1 / 3),
    sc.Damper("damper", 1500.0, installation_ratio=0.9),
    sc.Inerter(),
    sc.Rubber("mount", storage=250e3, loss=25e3),
    sc.MeasuredStiffness(
        "bush", frequency=[1.0, 10.0, 20.0], storage=[240e3, 260e3, 275e3], loss=[12e3, 25e3, 0.0]
    ),
    sc.TableDamper("valve", **RATES),
    sc.TableSpring("coil", deflection=[-0.08, 0.0, 0.08], force=[-3200.0, 0.0, 2000.0]),
    sc.BumpStop(gap=0.02, stiffness=200e3),
    sc.ReboundStop("droop", gap=0.08, compression=[0.0, 0.01, 0.02], force=[0.0, 100.0, 1e4]),
    sc.Friction(force=40.0),
    sc.DigressiveDamper("main", low_speed=4000.0, high_speed=800.0, knee=0.1, rebound_over_bump=2.0),
    sc.BilinearDamper("other", bump=750.0),
    sc.PowerDamper("orifice", force=5000.0, exponent=2.0),
]
FILE = """
kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3
[strut]
layout = "spring | damper"
[strut.damper]
kind = "table-damper"
file = "damper.csv"
"""


def test_there_is_an_element_of_every_kind():
    assert {type(one) for one in ELEMENTS} == set(KINDS.values())


@pytest.mark.parametrize("element", ELEMENTS, ids=lambda one: type(one).__name__)
def test_every_element_is_written_and_read(tmp_path, element):
    strut = sc.parallel(sc.Spring(), sc.series(element, sc.Spring("top")), installation_ratio=0.95)
    half = sc.HalfCar(**AXLES, front_strut=strut)
    seat = sc.Seat(mass=70.0, strut=strut, name="driver")
    for car in (sc.QuarterCar(**CAR, strut=strut), sc.QuarterCar(**CAR, strut=element), half, seat.on(half)):
        bounds = dict.fromkeys([one.name for one in car.strut_coefficients], (0.5, 2.0))
        file = sc.VehicleFile(vehicle=car, bounds=bounds, unusual=True)
        sc.save_vehicle(tmp_path / "f.toml", file)
        assert sc.load_vehicle(tmp_path / "f.toml") == replace(file, setting=FrozenMapping({}))


def test_coefficients_of_elements_have_keys_in_tables(tmp_path):
    damper = sc.DigressiveDamper()
    car = sc.QuarterCar(**CAR, strut=sc.parallel(sc.Spring(), damper, sc.BumpStop()))
    setting = {
        "spring": 2e4, "damper.low_speed": 4e3, "damper.high_speed": 8e2, "damper.knee": 0.1,
        "bump_stop.gap": 0.02, "bump_stop.stiffness": 2e5,
    }  # fmt: skip
    file = sc.VehicleFile(vehicle=car, setting=setting, bounds={"damper.knee": (0.05, 0.3)})
    sc.save_vehicle(tmp_path / "f.toml", file)
    text = (tmp_path / "f.toml").read_text()
    assert "[struts.bump_stop]\ngap_m = 0.02" in text
    assert "[bounds.damper]\nknee_m_per_s = [0.05, 0.3]" in text
    assert sc.load_vehicle(tmp_path / "f.toml") == file


def test_a_problem_holds_struts(tmp_path):
    strut = sc.parallel(sc.Spring(), sc.Damper(), sc.Inerter(value=20.0))
    case = sc.LoadCase(vehicle=sc.HalfCar(**AXLES, rear_strut=strut), road=sc.Iso8608Road("C"), speed=20.0)
    struts = {"front": (2e4, 1500.0), "rear": (2e4, 1500.0)}
    problem = sc.RideProblem(
        cases=[case], struts=struts, bounds={"rear.inerter": (1.0, 50.0)}, measures=["ACC", "DTL"]
    )
    sc.save_problem(tmp_path / "f.toml", problem)
    assert 'layout = "spring | damper | inerter"' in (tmp_path / "f.toml").read_text()
    assert sc.load_problem(tmp_path / "f.toml") == problem.replace(
        struts=sc.load_problem(tmp_path / "f.toml").struts
    )


def read(folder, csv: str | bytes, text: str = FILE) -> sc.VehicleFile:
    (folder / "damper.csv").write_bytes(csv if isinstance(csv, bytes) else csv.encode())
    (folder / "f.toml").write_text(text)
    return sc.load_vehicle(folder / "f.toml")


@pytest.mark.parametrize(
    "csv",
    [
        "velocity [m/s],force [N]\n-0.528,-744\n0,0\n0.051,227\n",
        "force [kN],velocity [mm/s]\n-0.744,-528\n0,0\n0.227,51\n",
        "# Source: a test\nvelocity [km/h];force [kN];at [K]\n-1,9008;-0,744;300\n0;0;300\n0,1836;0,227;300\n",
        b"\xef\xbb\xbfvelocity[m/s]\tforce [N]\r\n-0.528\t-744\r\n0\t0\r\n0.051\t227\r\n",
    ],
)
def test_columns_of_a_csv_file_are_converted_from_the_units_of_its_header(tmp_path, csv):
    damper = sc.TableDamper(velocity=[-0.528, 0.0, 0.051], force=[-744.0, 0.0, 227.0])
    assert read(tmp_path, csv).vehicle.strut == sc.parallel(sc.Spring(), damper)


def test_a_stop_and_a_measured_stiffness_have_tables_in_files(tmp_path):
    text = changed(FILE, "spring | damper", "spring | stop")
    text = (
        text[: text.index("[strut.damper]")]
        + """
[strut.stop]
kind = "rebound-stop"
gap = "8 cm"
file = "damper.csv"
"""
    )
    stop = read(tmp_path, "compression [mm],force [N]\n0,0\n10,100\n20,1000\n", text).vehicle.strut.elements[1]
    assert stop == sc.ReboundStop("stop", gap=0.08, compression=[0.0, 0.01, 0.02], force=[0.0, 100.0, 1000.0])
    text = changed(changed(text, "rebound-stop", "measured-stiffness"), 'gap = "8 cm"\n', "")
    rows = "frequency [Hz],storage [N/mm],loss [N/mm]\n1,240,12\n20,275,40\n"
    bush = read(tmp_path, rows, text).vehicle.strut.elements[1]
    np.testing.assert_array_equal(bush.storage, [240e3, 275e3])


IN_HEADER = "{csv}: columns must include velocity with its unit in the header, as in 'velocity [m/s]', got "


@pytest.mark.parametrize(
    ("header", "rows", "message"),
    [
        ("velocity,force [N]", "0,0 1,2", f"{IN_HEADER}'velocity'"),
        ("velocity [ ],force [N]", "0,0 1,2", f"{IN_HEADER}'velocity [ ]'"),
        ("rate [m/s],force [N]", "0,0 1,2", f"{IN_HEADER}['rate [m/s]', 'force [N]']"),
        ("0,0", "1,2 3,4", f"{IN_HEADER}[]"),
        (
            "velocity [m],force [N]", "0,0 1,2",
            "{csv}: velocity must be in m/s or a unit like it, got '0.0 m' in m",
        ),
        (
            "velocity [m/s],force [N]", "0,0 1,nan",
            "{csv}: 'force [N]' must be a number up to 1e+09, got 'nan' in row 2",
        ),
        ("velocity [m/s],force [N]", "-1,-1 0,5 1,7", "force must be 0 N at velocity 0, got 5 N"),
        ("velocity [m/s],force [N]", "0,0 0,7", "velocity must ascend, got 0, then 0"),
        ("velocity [m/s],force [N]", "0,0 1,9 2,7", "force must not fall over velocity, got 9 N, then 7 N"),
        ("velocity [m/s],force [N]", "0,0", "{csv}: rows of numbers must be 2 or more, got 1"),
        ("velocity [m/s],force [N]", "0,0 " * 1001, "{csv}: rows of numbers must be 1000 or less, got 1001"),
    ],
)  # fmt: skip
def test_a_bad_csv_file_is_one_line_with_both_places(tmp_path, header, rows, message):
    message = message.replace("{csv}", str(tmp_path / "damper.csv"))
    with pytest.raises(ValueError, match="damper") as error:
        read(tmp_path, "\n".join([header, *rows.split()]) + "\n")
    assert str(error.value) == f"{tmp_path / 'f.toml'}:10: strut.damper.file: {message}"


def test_a_file_elsewhere_is_read_where_that_is_allowed(tmp_path):
    (tmp_path / "cars").mkdir()
    text = changed(FILE, "damper.csv", "../damper.csv")
    (tmp_path / "cars" / "f.toml").write_text(text)
    (tmp_path / "damper.csv").write_text("velocity [m/s],force [N]\n0,0\n1,900\n")
    with pytest.raises(ValueError, match=r"strut\.damper\.file must be beside this file or below it, unless"):
        sc.load_vehicle(tmp_path / "cars" / "f.toml")
    assert (
        sc.load_vehicle(tmp_path / "cars" / "f.toml", allow_outside=True).vehicle.strut.elements[1].force[-1]
        == 900
    )
    (tmp_path / "damper.csv").unlink()
    with pytest.raises(FileNotFoundError, match=re.escape("damper.csv")):
        sc.load_vehicle(tmp_path / "cars" / "f.toml", allow_outside=True)


def test_mistakes_of_a_strut_hide_no_others(tmp_path):
    """Coefficients of its own are unknown then and no mistakes."""
    sc.save_vehicle(tmp_path / "f.toml", sc.VehicleFile(vehicle=sc.HalfCar(**AXLES)))
    text = (
        (tmp_path / "f.toml").read_text()
        + """
[front_strut]
layout = "coil | damper"
[front_strut.damper]
kind = "table-damper"
force_N = [0, 1]
velocity_m_per_s = [1, 0]
[struts]
front.coil_N_per_m = 1e4
rear.spring_N_per_m = -1e4
[bounds]
rear.damper_N_s_per_m = [2, 1]
"""
    )
    (tmp_path / "f.toml").write_text(changed(text, "body_mass_kg = 650.0", "body_mass_kg = -1"))
    with pytest.raises(ValueError, match=r"f\.toml") as error:
        sc.load_vehicle(tmp_path / "f.toml")
    assert [line.partition(": ")[2].partition(" must")[0] for line in str(error.value).split("\n")] == [
        "body_mass_kg",
        "front_strut.coil.kind",
        "front_strut.damper.velocity_m_per_s",
        "struts.rear.spring_N_per_m",
        "struts.rear.damper_N_s_per_m",
        "bounds.rear.damper_N_s_per_m",
    ]


def test_an_own_element_cannot_be_written(tmp_path):
    class Own(sc.Damper):
        """Of a user."""

    car = sc.QuarterCar(**CAR, strut=sc.parallel(sc.Spring(), Own()))
    with pytest.raises(ValueError, match=r"^a file must hold one of spring, damper, .*, got Own\(\)$"):
        sc.save_vehicle(tmp_path / "f.toml", sc.VehicleFile(vehicle=car))
