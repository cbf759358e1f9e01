"""Slips of units: each is named, real spread is not; a warning in programs, an error in files and flags."""

import warnings
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from suspension_ctrl.datafiles import named, stems
from suspension_ctrl.vehicles.unit_slips import slip_of

ROAD = sc.Iso8608Road("C")
SETTING = {"spring": 22e3, "damper": 1500.0}
MASSES = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
CAR = sc.QuarterCar(**MASSES)


def slipped(file, kind, factor):
    """Vehicle and setting with all parameters and coefficients of a kind, ``wheel_mass`` or ``spring``, scaled."""
    car, setting = file.vehicle, dict(file.vehicle.coefficients(file.setting))
    names = [name for name in vars(car) if name.endswith(kind) and isinstance(getattr(car, name), int | float)]
    car = replace(car, **{name: getattr(car, name) * factor for name in names})
    changed = [name for name in setting if name.rpartition(".")[2] == kind]
    return car, {name: v * factor if name in changed else v for name, v in setting.items()}, [*names, *changed]


KINDS = {
    "body_mass": ("t", 1e-3), "wheel_mass": ("t", 1e-3), "pitch_inertia": ("t m^2", 1e-3), "track": ("mm", 1e3),
    "tyre_stiffness": ("N/mm", 1e-3), "cg_to_front": ("mm", 1e3), "cg_to_rear": ("mm", 1e3),
    "roll_inertia": ("t m^2", 1e-3), "tyre_damping": ("N s/mm", 1e-3), "spring": ("N/mm", 1e-3),
    "damper": ("N s/mm", 1e-3),
}  # fmt: skip
"""Parameters and coefficients, and the units that they may be taken in."""


@pytest.mark.parametrize("stem", stems("vehicles"))
@pytest.mark.parametrize("kind", KINDS)
def test_every_slip_of_every_vehicle_is_named(stem, kind):
    file = sc.load_vehicle(stem)
    unit, factor = KINDS[kind]
    car, setting, names = slipped(file, kind, factor)
    if not names or not any({**vars(car), **setting}.get(name) for name in names):
        return
    line = slip_of(car, setting)
    assert line.startswith(f"{', '.join(names)} must be in " if len(names) <= 4 else names[0])
    assert f" as if in {unit}: " in line
    assert "\n" not in line


@given(st.sampled_from(stems("vehicles")), st.sampled_from(sorted(KINDS)), st.floats(0.6, 1.6))
@settings(deadline=None, max_examples=60)
def test_half_as_much_again_is_real_spread(stem, kind, factor):
    car, setting, _ = slipped(sc.load_vehicle(stem), kind, factor)
    assert slip_of(car, setting) is None


@given(st.floats(1e-6, 1e6))
@settings(deadline=None, max_examples=20)
def test_size_is_not_judged(size):
    """A model by unit of mass is sound: forces and masses in any unit that fits."""
    car = sc.QuarterCar(**{name: value * size for name, value in MASSES.items()})
    assert slip_of(car, {name: value * size for name, value in SETTING.items()}) is None


def test_several_slips_of_one_kind_are_one():
    """A setting in N/mm and N s/mm, a vehicle in tonnes: their ratios alone would not tell."""
    line = slip_of(CAR, {"spring": 22.0, "damper": 1.5})
    assert line.startswith("spring, damper must be in N/m and N s/m, got 22, 1.5 as if in N/mm and N s/mm: ")
    tonnes = replace(CAR, body_mass=0.3175, wheel_mass=0.0454)
    assert slip_of(tonnes, SETTING).startswith(
        "body_mass, wheel_mass must be in kg, got 0.3175, 0.0454 as if in t: "
    )


def test_pounds_per_inch_are_told_from_newtons_per_millimetre():
    assert " as if in lbf/in: " in slip_of(CAR, {"spring": 125.0, "damper": 1500.0})
    assert " as if in N/mm: " in slip_of(CAR, {"spring": 22.0, "damper": 1500.0})


def test_what_no_unit_explains_is_told_without_one():
    line = slip_of(
        sc.QuarterCar(body_mass=1.0, wheel_mass=1e9, tyre_stiffness=1e-3), {"spring": 1e-9, "damper": 1.0}
    )
    assert line.startswith("units of the vehicle must be of one kind, got ")


def test_a_seat_in_other_units_is_named():
    seat = sc.Seat(mass=75.0, spring=15.7, damper=650.0, name="driver").on(CAR)
    assert slip_of(seat, seat.coefficients(SETTING)).startswith(
        "driver.spring must be in N/m, got 15.7 as if in N/mm"
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda setting: sc.ride(CAR, setting, ROAD, speed=20.0),
        lambda setting: sc.simulate(CAR, setting, ROAD.profile(20.0, 0.1, seed=1), 10.0),
    ],
)
def test_ride_and_simulate_warn_their_caller(call):
    with pytest.warns(sc.UnitSlipWarning, match=r"^spring must be in N/m, got 22 as if in N/mm") as told:
        call({"spring": 22.0, "damper": 1500.0})
    assert {one.filename for one in told} == {__file__}


def test_a_problem_warns_of_its_bounds():
    bounds = {"spring": (10.0, 30.0), "damper": (1e3, 2e3)}
    with pytest.warns(sc.UnitSlipWarning, match=r"^spring must be in N/m, got 20 as if in N/mm"):
        sc.RideProblem(CAR, ROAD, speed=20.0, band=(0.5, 20.0), bounds=bounds, nodes=1024)


FILE = """kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3
[struts]
spring_N_per_m = 22e3
damper_N_s_per_m = 1500
[bounds]
spring_N_per_m = [10e3, 30e3]
damper_N_s_per_m = [1e3, 5e3]
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("317.5", "0.3175", "body_mass must be in kg, got 0.3175 as if in t: "),
        ("= 22e3", "= 22", "spring must be in N/m, got 22 as if in N/mm: "),
        ("[10e3, 30e3]", "[10, 30]", "spring must be in N/m, got 20 as if in N/mm: "),
        ("192e3", "192", "tyre_stiffness must be in N/m, got 192 as if in N/mm: "),
    ],
)
def test_a_file_is_refused_unless_it_is_unusual(tmp_path, old, new, message):
    path, text = tmp_path / "car.toml", FILE.replace(old, new)
    path.write_text(text)
    with pytest.raises(ValueError, match=r"; unusual = true allows it$") as error:
        sc.load_vehicle(path)
    assert message in str(error.value)
    assert "\n" not in str(error.value)
    path.write_text(f"unusual = true\n{text}")
    file = sc.load_vehicle(path)
    assert file.unusual
    sc.save_vehicle(tmp_path / "again.toml", file)
    assert sc.load_vehicle(tmp_path / "again.toml") == file


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("mass_kg = 20e3", "mass_kg = 20", "bodies.trailer.mass must be in kg, got 20 as if in t: "),
        (
            "mass_kg = 728.01",
            "mass_kg = 0.72801",
            "bodies.trailer_front_axle.mass, bodies.trailer_middle_axle.mass, bodies.trailer_rear_axle.mass must "
            "be in kg, got 0.72801, 0.72801, 0.72801 as if in t: ",
        ),
        ("= 1225025", "= 1225", ".tyre_stiffness must be in N/m, got 1225, 1225, 1225 ... 1225 as if in N/mm: "),
    ],
)
def test_slips_of_a_trailer_and_its_axles_are_named(tmp_path, old, new, message):
    path, text = tmp_path / "truck.toml", named("vehicle", "vehicles", "kraz_semitrailer").read_text("utf-8")
    path.write_text(text.replace(old, new))
    with pytest.raises(ValueError, match=r"; unusual = true allows it$") as error:
        sc.load_vehicle(path)
    assert message in str(error.value)


@pytest.mark.parametrize("place", ["bounds", "vehicle"])
def test_a_problem_file_is_refused(tmp_path, place):
    path = tmp_path / "problem.toml"
    text = 'measures = ["ACC", "DTL"]\nband_Hz = [0.5, 20]\n{}[[cases]]\nroad = "C"\nspeed_m_per_s = 20\n'
    bounds = "[bounds]\nspring_N_per_m = [10, 30]\ndamper_N_s_per_m = [1e3, 5e3]\n" if place == "bounds" else ""
    car = FILE if place == "bounds" else FILE.replace("317.5", "0.3175")
    Path(tmp_path / "car.toml").write_text(car)
    path.write_text(f'{text.format(bounds)}vehicle = "car.toml"\n')
    with pytest.raises(ValueError, match=r" as if in ") as error:
        sc.load_problem(path)
    assert "\n" not in str(error.value)


def test_a_problem_of_an_unusual_vehicle_is_written_and_read(tmp_path):
    car = replace(CAR, body_mass=20e3)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", sc.UnitSlipWarning)
        bounds = {"spring": (20e3, 30e3), "damper": (1e3, 5e3)}
        problem = sc.RideProblem(car, ROAD, speed=20.0, band=(0.5, 20.0), bounds=bounds)
        sc.save_problem(tmp_path / "problem.toml", problem)
    assert sc.load_problem(tmp_path / "problem.toml") == problem
