"""Vehicle files: what is read is what the sources print, and whatever is wrong with a file is one line."""

import re
import tomllib
from copy import deepcopy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.linalg import eigh

from spoilt import VALUES, changed, spelt
from suspension_ctrl import FlexibleBody, FullCar, HalfCar, QuarterCar, RollGeometry, Seat
from suspension_ctrl.datafiles import stems
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.quantities import key_of
from suspension_ctrl.vehicles.files import VehicleFile, load_vehicle

QUARTER = """
kind = "quarter-car"
name = "a"
source = "b"
body_mass_kg = 300
wheel_mass_kg = 40.0
tyre_stiffness_N_per_m = 2e5
[struts]
spring_N_per_m = 2e4
damper_N_s_per_m = 1e3
"""
HALF = """
kind = "half-car"
name = "a"
source = "b"
body_mass_kg = 700
pitch_inertia_kg_m2 = 1200
front_wheel_mass_kg = 40
rear_wheel_mass_kg = 45
front_tyre_stiffness_N_per_m = 2e5
rear_tyre_stiffness_N_per_m = 2.1e5
cg_to_front_m = 1.2
cg_to_rear_m = 1.5
[flexible_body]
frequencies_Hz = [18, 25.5]
damping_ratios = [0.02, 0.03]
[[flexible_body.shapes]]
position_m = [1.2, 0]
shape_per_sqrt_kg = [0.06, 0.05]
[[flexible_body.shapes]]
position_m = [-1.5, 0.0]
shape_per_sqrt_kg = [0.06, -0.05]
[[flexible_body.shapes]]
position_m = [0.1, 0]
shape_per_sqrt_kg = [-0.03, 0.01]
[[seats]]
name = "driver"
mass_kg = 60
spring_N_per_m = 8000
damper_N_s_per_m = 500
position_m = [0.1, 0]
[struts.front]
spring_N_per_m = 2e4
damper_N_s_per_m = 1e3
[struts.rear]
spring_N_per_m = 2.2e4
damper_N_s_per_m = 1.1e3
[bounds.rear]
spring_N_per_m = [1e4, 4e4]
[bounds.driver]
damper_N_s_per_m = [100, 1000]
"""
STRUTS = """
kind = "half-car"
body_mass_kg = 700
pitch_inertia_kg_m2 = 1200
front_wheel_mass_kg = 40
rear_wheel_mass_kg = 45
front_tyre_stiffness_N_per_m = 2e5
rear_tyre_stiffness_N_per_m = 2.1e5
cg_to_front_m = 1.2
cg_to_rear_m = 1.5
[front_strut]
layout = "spring | 0.9*(damper - mount) | inerter"
[front_strut.mount]
kind = "spring"
value_N_per_m = 2e5
[rear_strut]
layout = "spring - inerter"
[rear_strut.spring]
installation_ratio = 0.8
[struts.front]
spring_N_per_m = 2e4
damper_N_s_per_m = 1e3
inerter_kg = 10
[struts.rear]
spring_N_per_m = 2.2e4
inerter_kg = 15
[bounds.front]
mount_N_per_m = [1e5, 4e5]
"""


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "v.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def matrices(file: VehicleFile) -> tuple[np.ndarray, np.ndarray]:
    """Masses and stiffnesses of the package's own assembly."""
    mechanics = file.vehicle.statics
    coefficients = file.vehicle.coefficients(file.setting)
    return file.vehicle.assembly.mass_matrix, mechanics.stiffness_of(np.array([list(coefficients.values())]))[0]


def frequencies(mass: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Undamped natural frequencies [Hz]."""
    return np.sqrt(eigh(stiffness, mass, eigvals_only=True)) / (2 * np.pi)


def by_energy(masses: list[float], springs: list[tuple[float, list[float]]]) -> tuple[np.ndarray, np.ndarray]:
    """M and K from energies: each spring k with its elongation by unit of each coordinate."""
    return np.diag(masses), sum(k * np.outer(row, row) for k, row in springs)


def test_the_papers_car():
    file, problem = load_vehicle("yuen_ramli_2010"), paper.ride_problem()
    assert file == load_vehicle(Path("yuen_ramli_2010"))
    assert file.vehicle == problem.vehicle
    assert (file.setting["spring"], file.setting["damper"]) == paper.reference_design()
    assert file.bounds == dict(zip(problem.variables, zip(problem.lower, problem.upper, strict=True), strict=True))
    assert file.roll_geometry is None


def test_half_car_with_printed_frequencies():
    """Cantero 2022 prints these from another program, to within half a unit of the last digit."""
    found = frequencies(*matrices(load_vehicle("cantero_2022_half")))
    printed = [("1.4010", 5e-5), ("4.8321", 5e-5), ("12.351", 5e-4), ("12.661", 5e-4)]
    for one, (text, half_unit) in zip(found, printed, strict=True):
        assert abs(one - float(text)) <= half_unit


def test_passenger_half_car():
    """M and K written out, coordinates heave, pitch, front and rear wheel; equal to rounding."""
    k = [(35e3, [1, -1.189, -1, 0]), (38e3, [1, 1.696, 0, -1]), (3e5, [0, 0, 1, 0]), (3e5, [0, 0, 0, 1])]
    mine = frequencies(*by_energy([1730.377, 3267, 50, 50], k))
    np.testing.assert_allclose(frequencies(*matrices(load_vehicle("minaker_half"))), mine, rtol=1e-12)
    assert abs(1730.377 - 16975 / 9.81) < 5e-4


@pytest.mark.parametrize(
    ("bar", "computed"),
    [
        (0.0, [0.86906, 1.00614, 1.26930, 8.42730, 8.43146, 10.01908, 10.02116]),
        (25e3, [1.00614, 1.09887, 1.26930, 8.42731, 8.43146, 10.02116, 10.38469]),
    ],
)
def test_full_car_has_the_frequencies_of_its_matrices(bar, computed):
    """The source prints none: `computed` are from M and K of another program, and here is a third road.

    Energies of springs between heave z, roll p and pitch t of the body and wheels FL, FR, RL, RR; the bar's is
    k/2 ((travel left - travel right) / track)^2. Five decimals of `computed`; the third road to rounding.
    """
    file = load_vehicle("jian_2022_full")
    file = replace(file, setting={**file.setting, "front_antiroll": bar})
    corners = [(1.5, 0.9), (1.5, -0.9), (-1.5, 0.9), (-1.5, -0.9)]
    travel = [[1, y, -x, *(-np.eye(4)[i])] for i, (x, y) in enumerate(corners)]
    springs = list(zip([10e3, 10e3, 13e3, 13e3], travel, strict=True))
    springs += [(200e3, [0, 0, 0, *np.eye(4)[i]]) for i in range(4)]
    springs += [(bar / 1.8**2, list(np.subtract(travel[0], travel[1])))]
    found = frequencies(*matrices(file))
    np.testing.assert_allclose(found, frequencies(*by_energy([1040, 1180, 1580, 53, 53, 76, 76], springs)), 1e-12)
    np.testing.assert_allclose(found, computed, rtol=0, atol=5.1e-6)


def test_saloon_with_published_parameters():
    """Of stiffness and mass alone: the four decimals of another program, and energies written out, to rounding."""
    file = load_vehicle("bmw_320i_full")
    a, b, front, rear, tyre = 1.156196, 1.422717, 1.38684 / 2, 1.36398 / 2, 158240.08
    travel = [
        [1, y, -x, *(-np.eye(4)[i])] for i, (x, y) in enumerate([(a, front), (a, -front), (-b, rear), (-b, -rear)])
    ]
    springs = list(zip([24444.787, 24444.787, 19628.799, 19628.799], travel, strict=True))
    springs += [(tyre, [0, 0, 0, *np.eye(4)[i]]) for i in range(4)]
    springs += [(6914.882 / (2 * front) ** 2, list(np.subtract(travel[0], travel[1])))]
    springs += [(2643.601 / (2 * rear) ** 2, list(np.subtract(travel[2], travel[3])))]
    mine = frequencies(*by_energy([965.711, 207.265, 1565.818, *4 * [31.8961]], springs))
    np.testing.assert_allclose(frequencies(*matrices(file)), mine, rtol=1e-12)
    np.testing.assert_allclose(
        mine, [1.4201, 1.4357, 2.3023, 11.8960, 11.9922, 12.0581, 12.3069], rtol=0, atol=5.1e-5
    )


def test_pounds_and_feet_of_the_saloon():
    """What the source prints in pounds of force, feet and seconds; to the last digit of the file."""
    car, pound, foot = load_vehicle("bmw_320i_full"), 4.4482216152605, 0.3048
    assert car.vehicle.body_mass == pytest.approx(66.17221 * pound / foot, abs=5e-4)
    assert car.vehicle.pitch_inertia == pytest.approx(1154.888 * pound * foot, abs=5e-4)
    assert car.vehicle.front_tyre_stiffness == pytest.approx(10842.89 * pound / foot, abs=5e-3)
    assert car.setting["front.spring"] == pytest.approx(1675 * pound / foot, abs=5e-4)
    assert car.setting["rear.damper"] == pytest.approx(112.9981 * pound / foot, abs=5e-5)
    assert car.setting["front_antiroll"] == pytest.approx(5100.155 * pound * foot, abs=5e-4)


def test_full_car_in_full():
    file = load_vehicle("jian_2022_full")
    assert file.vehicle == FullCar(
        body_mass=1040.0,
        roll_inertia=1180.0,
        pitch_inertia=1580.0,
        front_wheel_mass=53.0,
        rear_wheel_mass=76.0,
        front_tyre_stiffness=200e3,
        rear_tyre_stiffness=200e3,
        front_tyre_damping=430.0,
        rear_tyre_damping=430.0,
        cg_to_front=1.5,
        cg_to_rear=1.5,
        front_track=1.8,
        rear_track=1.8,
    )
    assert file.setting["front_antiroll"] == 25e3
    assert file.bounds["rear_antiroll"] == (0.0, 50e3)
    assert isinstance(file.roll_geometry, RollGeometry)


def test_tables_of_the_suv_are_those_of_the_source():
    """Forces in compression there; the front spring carries what the mass on it weighs, within 0.1 %."""
    car = load_vehicle("volvo_xc90_full").vehicle
    front = {one.name: one for one in car.front_strut.elements}
    rear = {one.name: one for one in car.rear_strut.elements}
    compression = np.array([-0.0697, 0.0, 0.0646])
    np.testing.assert_allclose(4972 - front["spring"].tension(-compression), [1289, 4972, 8944], rtol=1e-12)
    compression = np.array([-0.0745, 0.0, 0.0905])
    np.testing.assert_allclose(4756 - rear["spring"].tension(-compression), [1898, 4756, 9323], rtol=1e-12)
    compression = np.array([0.0243, 0.0348, 0.0638, 0.0646])
    np.testing.assert_allclose(-front["bump_stop"].tension(-compression), [0, 500, 30000, 35000], atol=1e-6)
    np.testing.assert_allclose(-rear["bump_stop"].tension([-0.017, -0.0805]), [0, 8500], atol=1e-6)
    np.testing.assert_allclose(front["rebound_stop"].tension([0.0681, 0.0697]), [0, 25000], atol=1e-6)
    np.testing.assert_allclose(rear["damper"].tension([-0.832, 0.04, 0.832]), [-1751, 276, 2652], rtol=1e-12)
    static = car.body_mass * 9.81 * car.cg_to_rear / (car.cg_to_front + car.cg_to_rear) / 2
    assert static == pytest.approx(4972, rel=1e-3)


def test_files_of_the_package_say_where_they_are_from(checkout):
    names = stems("vehicles")
    assert len(names) >= 4
    for name in names:
        assert re.fullmatch("[a-z][a-z0-9_]+", name)  # a file name on every system
        path = checkout / "data/vehicles" / f"{name}.toml"
        assert path.read_text().startswith("# Source: ")
        file = load_vehicle(str(path))
        assert file.source
        assert file == load_vehicle(name)
        assert set(file.bounds) <= set(file.vehicle.coefficients(file.setting))
        assert all(
            low <= file.vehicle.coefficients(file.setting)[key] <= b for key, (low, b) in file.bounds.items()
        )


def test_seats_and_bending(tmp_path):
    file = load_vehicle(str(written(tmp_path, HALF)))
    car = HalfCar(
        body_mass=700.0,
        pitch_inertia=1200.0,
        front_wheel_mass=40.0,
        rear_wheel_mass=45.0,
        front_tyre_stiffness=2e5,
        rear_tyre_stiffness=2.1e5,
        cg_to_front=1.2,
        cg_to_rear=1.5,
    )
    shapes = {(1.2, 0.0): (0.06, 0.05), (-1.5, 0.0): (0.06, -0.05), (0.1, 0.0): (-0.03, 0.01)}
    bends = FlexibleBody(frequencies=(18.0, 25.5), damping_ratios=(0.02, 0.03), shapes=shapes).on(car)
    seat = Seat(name="driver", mass=60.0, spring=8000.0, damper=500.0, position=(0.1, 0.0))
    assert file.vehicle == seat.on(bends)
    assert file.setting == {"front.spring": 2e4, "front.damper": 1e3, "rear.spring": 2.2e4, "rear.damper": 1.1e3}
    assert file.bounds == {"rear.spring": (1e4, 4e4), "driver.damper": (100.0, 1000.0)}


def test_a_seat_needs_neither_name_nor_place(tmp_path):
    text = QUARTER + "[[seats]]\nmass_kg = 60\nspring_N_per_m = 8000\ndamper_N_s_per_m = 500"
    car = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5)
    assert load_vehicle(str(written(tmp_path, text))).vehicle == Seat(mass=60.0, spring=8e3, damper=500.0).on(car)


@pytest.mark.parametrize(
    ("unit", "key"),
    [("kg", "x_kg"), ("kg m^2", "x_kg_m2"), ("N/m", "x_N_per_m"), ("N s/m", "x_N_s_per_m"), ("", "x"),
     ("N m/rad", "x_N_m_per_rad")],
)  # fmt: skip
def test_keys_end_in_their_units(unit, key):
    assert key_of("x", unit) == key


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            changed(QUARTER, "body_mass_kg", "body_mass_t"),
            r"body_mass_t must be a known key, got 300: did you mean body_mass_kg\?$",
        ),
        (
            changed(QUARTER, "body_mass_kg", "body_mass"),
            "body_mass must be a text with a unit like '1 kg', or body_mass_kg a number, got 300$",
        ),
        (
            changed(QUARTER, "damper_N_s_per_m", "damper_Ns_per_mm"),
            r"struts.damper_Ns_per_mm must be a known key, got 1000.0: did you mean damper_N_s_per_m\?$",
        ),
        (changed(QUARTER, "body_mass_kg = 300\n", ""), "body_mass_kg must be given, got none$"),
        (changed(QUARTER, "damper_N_s_per_m = 1e3", ""), "struts.damper_N_s_per_m must be given, got none"),
        (
            changed(QUARTER, "300", "300\nmass_kg = 3"),
            r"mass_kg must be a known key, got 3: did you mean body_mass_kg\?$",
        ),
        (changed(QUARTER, "300", "nan"), "body_mass_kg must be a number from 1e-12 to .* got nan"),
        (changed(QUARTER, "300", "1e-300"), "body_mass_kg must be a number from 1e-12 to .* got 1e-300"),
        (changed(QUARTER, "300", "1e400"), "body_mass_kg must be a number .* got inf"),
        (changed(QUARTER, "300", "true"), "body_mass_kg must be a number .* got True"),
        (changed(QUARTER, "300", '"300"'), "body_mass_kg must be a number .* got '300'"),
        (changed(QUARTER, "300", "-300"), "body_mass_kg must be finite and > 0 kg, got -300.0"),
        (changed(QUARTER, "2e4", "0"), r"struts.spring_N_per_m must be finite and > 0 N/m, got 0.0"),
        (
            changed(QUARTER, "quarter", "third"),
            "kind must be one of quarter-car, half-car, full-car, plant, rigid-bodies, got 'third-car'",
        ),
        (changed(QUARTER, '"quarter-car"', "[1]"), r"kind must be one of .* got \[1\]"),
        (changed(QUARTER, '"b"', '" "'), "source must be a text, got ' '"),
        (changed(QUARTER, '"a"', "3"), "name must be a text, got 3"),
        (
            changed(QUARTER, "[struts]", "[strutts]"),
            r"strutts must be a known key, got \{.*: did you mean struts\?$",
        ),
        (changed(QUARTER, "[struts]", "[[struts]]"), r"struts must be a table, got \[\{"),
        (QUARTER + "x = \ny = 1", r"the file must be TOML in UTF-8, got Invalid value \(at line 11, column 5\)"),
        (QUARTER.encode() + b"\xff", "the file must be TOML in UTF-8, got another encoding"),
        (b"\xff\xfe\x00", "the file must be TOML in UTF-8, got another encoding"),
        ("", "kind must be one of quarter-car, half-car, full-car, plant, rigid-bodies, got None"),
        (
            QUARTER + "[bounds]\nspring_N_per_m = 3",
            "bounds.spring_N_per_m must be an array of two numbers, got 3",
        ),
        (
            QUARTER + "[bounds]\nspring_N_per_m = [1]",
            r"bounds.spring_N_per_m must be an array of two .* got \[1\]",
        ),
        (
            QUARTER + "[bounds]\nspring_N_per_m = [3, 1]",
            r"bounds.spring_N_per_m must be finite with 0 <= lower <= upper \[N/m\], got \(3.0, 1.0\)",
        ),
        (
            QUARTER + "[bounds]\nspring_N_per_m = [0, 1]",
            r"bounds.spring_N_per_m must be finite and > 0 N/m, got 0.0",
        ),
        (
            QUARTER + "[bounds]\ndamper_N_per_m = [0, 1]",
            r"bounds.damper_N_per_m must be a known key, got \[0, 1\]: did you mean damper_N_s_per_m\?$",
        ),
        (QUARTER + "[roll_geometry]", "roll_geometry.roll_arm_m must be given, got none"),
        (
            QUARTER + "[roll_geometry]\nroll_arm_m = 0\nfront_roll_centre_m = 0\nrear_roll_centre_m = 0\n"
            "wheel_centre_m = 0.3",
            "roll_geometry.roll_arm_m must be finite and > 0 m, got 0.0",
        ),
        (QUARTER + "[seats]", r"seats must be an array of up to 50 tables, got \{\}"),
        (changed(QUARTER, "300", "300\nseats = [3]"), r"seats\[1\] must be a table, got 3"),
        (QUARTER + "[[seats]]", r"seats\[1\].mass_kg must be given, got none"),
        (
            changed(HALF, "mass_kg = 60", "mass_kg = -60"),
            r"seats\[1\].mass_kg must be finite and > 0 kg, got -60.0",
        ),
        (
            changed(HALF, "mass_kg = 60", "mass_lb = 60"),
            r"seats\[1\].mass_lb must be a known key, got 60: did you mean mass_kg\?$",
        ),
        (
            changed(HALF, '"driver"', '"a b"'),
            r"seats\[1\].name must be of letters, digits and underscores, got 'a b'",
        ),
        (changed(HALF, '"driver"', '"body"'), r"seats\[1\].name must be one that the vehicle does not have yet"),
        (
            changed(HALF, "500\nposition_m = [0.1, 0]", "500\nposition_m = [0.2, 0]"),
            r"seats\[1\].position_m must be one with known mode shapes",
        ),
        (
            changed(HALF, "[struts.front]", "[struts.forward]"),
            "struts.forward.spring_N_per_m must be one of the keys rear.spring_N_per_m, front.spring_N_per_m, ",
        ),
        (
            changed(HALF, "[struts.front]", "[struts.x]\n[struts.front]"),
            r"struts.x must be one of the keys .* got \{\}",
        ),
        (
            changed(HALF, "[0.02, 0.03]", "[0]"),
            "flexible_body.frequencies_Hz and damping_ratios must be of one length",
        ),
        (
            changed(HALF, "[18, 25.5]", "[18, 0]"),
            "flexible_body.frequencies_Hz must be finite and > 0 Hz, got 0.0",
        ),
        (changed(HALF, "0.02,", "2,"), "flexible_body.damping_ratios must be a number from 0 to 1, got 2.0"),
        (changed(HALF, "[0.06, 0.05]", "[0.06]"), "flexible_body.shapes must be 2 finite numbers at each point"),
        (changed(HALF, "[0.06, 0.05]", "[]"), r"flexible_body.shapes\[1\].shape_per_sqrt_kg must be an array"),
        (
            changed(HALF, "position_m = [1.2", "position_m = [1.3"),
            "flexible_body: position must be one with",
        ),
        (
            changed(HALF, "position_m = [1.2", "position_mm = [1"),
            r"flexible_body.shapes\[1\].position_mm must be a known key, .* did you mean position_m\?$",
        ),
        (
            changed(HALF, "position_m = [1.2, 0]", "position_m = [-1.5, 0]"),
            "flexible_body.shapes must be an array of tables, one at least, each for a place of its own, got ",
        ),
        (
            changed(
                QUARTER, "[struts]", "[flexible_body]\nfrequencies_Hz=[1]\ndamping_ratios=[0]\nshapes=[]\n[struts]"
            ),
            r"flexible_body.shapes must be an array of tables, one at least, .* got \[\]",
        ),
    ],
)
def test_bad_files_are_one_line(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}(:\d+)?: {message}"):
        load_vehicle(path)


@pytest.mark.parametrize("text", ["", "no_such_car", "yuen_ramli_2010.csv", "../paper/table1_vehicle", "a\x00"])
def test_other_names_are_no_vehicles(text):
    with pytest.raises(ValueError, match=r"^vehicle must be one of bmw_320i_full, [^\n]* file, got [^\n]*$"):
        load_vehicle(text)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(OSError, match="No such file"):
        load_vehicle(str(tmp_path / "no.toml"))


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """A good file with a few of its values, at any depth, exchanged, left out or put under another key."""
    content = tomllib.loads(draw(st.sampled_from([QUARTER, HALF, STRUTS])))
    for _ in range(draw(st.integers(1, 3))):
        place: object = content
        while True:
            keys = list(place) if isinstance(place, dict) else list(range(len(place)))
            if not keys:
                break
            key = draw(st.sampled_from(keys))
            if isinstance(place[key], dict | list) and draw(st.integers(0, 3)):
                place = place[key]
                continue
            what = draw(st.integers(0, 3))
            if what and isinstance(place, dict) and what < 3:
                value = place.pop(key)
                if what == 2:
                    place[draw(st.sampled_from(["x", "name", "mass_t", "front", f"{key}_m", "a\nb"]))] = value
            else:
                place[key] = deepcopy(draw(VALUES))  # the next mutation may be in it
            break
    return "\n".join(f"{spelt(key)} = {spelt(value)}" for key, value in content.items())


@given(st.one_of(st.text(), st.binary(), mutated()))
@example(f"x = {'[' * 5000}")
@example(f"kind = 0x{'f' * 5000}")
@example(f"{'a.' * 5000}b = 1")
@example('"a\\nb" = 3\nkind = "quarter-car"\nname = "a"\nsource = "b"')
@example(changed(QUARTER, "300", "1e-300"))
@example(changed(QUARTER, "300", "0x" + "f" * 5000))
@example(changed(HALF, "position_m = [1.2, 0]", "position_m = [1e308, 1e308]"))
def test_whatever_the_text_of_a_file_it_is_read_or_refused(tmp_path_factory, text):
    content = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
    path = written(tmp_path_factory.getbasetemp(), content)
    try:
        load_vehicle(path).vehicle.plant()
        refusal = f"{path}: "
    except ValueError as error:
        refusal = str(error)
    lines = refusal.split("\n")
    assert all(re.match(rf"{re.escape(str(path))}(:\d+)?: ", line) and line.isprintable() for line in lines)
    assert len(lines) <= 21
    assert max(map(len, lines)) < 1000


def test_good_files_are_mutated_from(tmp_path):
    for text in (QUARTER, HALF, STRUTS):
        content = tomllib.loads(text)
        again = "\n".join(f"{spelt(key)} = {spelt(value)}" for key, value in content.items())
        assert load_vehicle(str(written(tmp_path, again))) == load_vehicle(str(written(tmp_path, text)))
