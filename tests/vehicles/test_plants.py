"""Vehicles by measured frequency responses: tables of exact plants give what the plants themselves give."""

from pathlib import Path

import control
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from suspension_ctrl import FullCar, HalfCar, LoadCase, MeasuredPlant, PowerLawRoad, QuarterCar, RideProblem, Seat
from suspension_ctrl.quantities import signal_unit
from suspension_ctrl.vehicles.plants import FREQUENCY
from suspension_ctrl.vehicles.vehicle import Vehicle

QUARTER = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, tyre_damping=400.0)
HALF = HalfCar(
    body_mass=690.0,
    pitch_inertia=1222.0,
    front_wheel_mass=40.0,
    rear_wheel_mass=45.0,
    front_tyre_stiffness=200e3,
    rear_tyre_stiffness=200e3,
    cg_to_front=1.3,
    cg_to_rear=1.5,
    front_tyre_damping=430.0,
    rear_tyre_damping=430.0,
)
FULL = FullCar(
    body_mass=1040.0,
    roll_inertia=1180.0,
    pitch_inertia=1580.0,
    front_wheel_mass=53.0,
    rear_wheel_mass=76.0,
    front_tyre_stiffness=200e3,
    rear_tyre_stiffness=200e3,
    cg_to_front=1.5,
    cg_to_rear=1.5,
    front_track=1.8,
    rear_track=1.8,
)
SETTINGS = {"front": (18e3, 1200.0), "rear": (22e3, 1500.0)}
ROAD = PowerLawRoad(roughness=5e-6, exponent=2.5)


def transfer(car: Vehicle, f: np.ndarray) -> dict[tuple[str, str], np.ndarray]:
    """Responses of the plant, in which a damped tyre follows the road's rate too, without travels."""
    h = car.plant().frequency_response(2 * np.pi * f)
    values = {}
    for output in h.output_labels:
        if not output.endswith(("travel", "rate")):
            for name in h.input_labels:
                if name.endswith(("road", "strut")):
                    values[output, name] = h[output, name].frdata[0, 0]
                else:
                    values[output, name.removesuffix("_rate")] += 2j * np.pi * f * h[output, name].frdata[0, 0]
    return values


def contacts(car: Vehicle) -> dict[str, tuple[float, float]]:
    return dict(car.assembly().contacts)


def measured(car: Vehicle, f: np.ndarray) -> MeasuredPlant:
    return MeasuredPlant(frequency=f, transfer=transfer(car, f), contacts=contacts(car))


def table(car: Vehicle, f: np.ndarray) -> str:
    """The CSV file of a plant."""
    values = transfer(car, f)
    units = {"road": "m", "strut": "N"}
    names, columns = [FREQUENCY], [f]
    for (output, name), h in values.items():
        unit = f"{signal_unit(output)}/{units[name.rsplit('_', 1)[-1]]}"
        names += [f"{output}/{name} real [{unit}]", f"{output}/{name} imag [{unit}]"]
        columns += [h.real, h.imag]
    rows = np.column_stack(columns).tolist()
    return "\n".join(["# Source: none", ",".join(names), *(",".join(map(repr, row)) for row in rows)])


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "plant.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


LINES = np.arange(0.3, 21.0, 0.1)


def test_what_is_read_is_what_was_written(tmp_path):
    plant = MeasuredPlant.from_csv(written(tmp_path, table(HALF, LINES)), contacts(HALF))
    there = measured(HALF, LINES)
    np.testing.assert_array_equal(plant.frequency, LINES)
    assert plant.transfer.keys() == there.transfer.keys()
    for pair, h in plant.transfer.items():
        np.testing.assert_array_equal(h, there.transfer[pair])


@pytest.mark.parametrize("car", [QUARTER, HALF, FULL, Seat(mass=60.0, spring=8e3, damper=500.0).on(HALF)])
def test_signals_are_those_of_the_vehicle(car):
    plant = measured(car, LINES)
    accelerations_loads = [name for name in car.responses if not name.endswith("travel")]
    assert set(plant.responses) == set(car.responses)
    assert [name for name in plant.responses if not name.endswith("travel")] == accelerations_loads
    assert {name: meaning.kind for name, meaning in plant.meanings.items()} == {
        name: meaning.kind for name, meaning in car.meanings.items()
    }
    assert (plant.struts, plant.tyres) == (car.struts, car.tyres)
    np.testing.assert_array_equal(plant.contact_points, car.contact_points)
    here, there = plant.plant(car.responses), car.plant(car.responses)
    assert isinstance(here, control.FrequencyResponseData)
    assert here.output_labels == there.output_labels
    assert here.input_labels == [name for name in there.input_labels if not name.endswith("rate")]
    assert [p.name.rsplit(".", 1)[-1] for p in plant.parameters] == ["spring", "damper"] * len(car.struts)


def test_at_the_lines_the_closed_loop_is_that_of_the_vehicle():
    """To rounding: the loop of the half car has condition numbers up to some thousand."""
    here, there = measured(HALF, LINES).closed(SETTINGS), HALF.closed(SETTINGS)
    omega = 2 * np.pi * LINES
    h, g = here(1j * omega), there(1j * omega)
    expected = g[:, :2] + 1j * omega * g[:, 2:]  # the tyres' damping
    order = [here.output_labels.index(name) for name in there.output_labels]
    assert here.input_labels == there.input_labels[:2]
    assert np.abs(h[order] / expected - 1).max() < 1e-10


def test_full_car_by_strut():
    """Without bars coefficients by strut are those by axle; to rounding as above."""
    pair = {"front": (10e3, 2000.0), "rear": (13e3, 2000.0)}
    each = {f"{axle}_{side}": pair[axle] for axle in pair for side in ("left", "right")}
    here, there = measured(FULL, LINES).closed(each, FULL.responses), FULL.closed(pair)
    omega = 2 * np.pi * LINES
    np.testing.assert_allclose(here(1j * omega), there(1j * omega), rtol=0, atol=1e-9 * np.abs(here.frdata).max())


def test_points_of_the_body_are_columns_of_their_own():
    at_line = HALF.plant([("acceleration", 0.5, -0.4)])
    h = at_line.frequency_response(2 * np.pi * LINES)
    values = transfer(HALF, LINES)
    for name in ("front_road", "rear_road", "front_strut", "rear_strut"):
        values["acceleration_at_500_-400_mm", name] = h["acceleration_at_500_-400_mm", name].frdata[0, 0]
    plant = MeasuredPlant(frequency=LINES, transfer=values, contacts=contacts(HALF))
    problem = RideProblem(
        plant,
        ROAD,
        speed=20.0,
        band=(0.5, 20.0),
        lower=(15e3, 1e3) * 2,
        upper=(25e3, 2e3) * 2,
        measures=("ACC (0.5, -0.4)", "SWS front"),
    )
    assert problem.units["ACC (0.5, -0.4)"] == "m/s^2"
    with pytest.raises(
        ValueError, match=r"^response must be one of body_acceleration, .*_mm, got 'acc.*_100_0_mm'$"
    ):
        plant.plant([("acceleration", 0.1, 0.0)])


def problem(car: Vehicle | None, **changes) -> RideProblem:
    return RideProblem(
        **{
            "vehicle": car,
            "road": ROAD,
            "speed": 20.0,
            "band": (0.5, 20.0),
            "bounds": {"front.spring": (15e3, 25e3), "rear.damper": (1e3, 2e3)},
            "struts": {"front.damper": 1200.0, "rear.spring": 22e3},
            "measures": ("ACC", "SWS", "DTL"),
        }
        | changes,
    )


def exact_and_table(step: float) -> tuple[np.ndarray, np.ndarray, MeasuredPlant]:
    """Responses of the closed loop in the middle of the box halfway between lines: exact, and by a table."""
    f = np.arange(0.3, 21.0, step)
    plant, s = measured(HALF, f), 2j * np.pi * (f[:-1] + step / 2)[(f[:-1] > 0.45) & (f[:-1] < 20.05)]
    closed = {"front": (20e3, 1200.0), "rear": (22e3, 1500.0)}
    g = HALF.closed(closed, plant.responses)(s)
    return g[:, :2] + s * g[:, 2:], plant.closed(closed)(s), plant


def test_a_table_gives_the_root_mean_squares_of_its_vehicle():
    """A root mean square is a norm of the response's row by roads: off by no more than the norm of its error.

    In the middle of the box, around which the loop is closed at the lines, that is the error of the splines, about
    as large all over as halfway between lines; e^H G e <= 2 S |e|^2 for two roads of spectrum S. At other designs
    the loop may make more of it, by less than 10: what is added to struts is below what they have already.
    """
    exact, tabled, plant = exact_and_table(0.05)
    f = np.arange(0.475, 20.05, 0.05)
    responses = ("body_acceleration", "pitch_acceleration", "front_suspension_travel", "rear_tyre_load")
    here, there = (problem(car, measures=responses) for car in (plant, HALF))
    assert (here.objectives, here.units) == (there.objectives, there.units)
    middle = there.evaluate([[20e3, 1500.0]])[0]
    row = [plant.responses.index(name) for name in responses]
    squares = (np.abs(tabled - exact)[row] ** 2).sum(axis=1) @ (2 * ROAD.psd(f, 20.0)) * 0.05
    bound = np.sqrt(squares) / middle
    assert bound.max() < 2e-4
    assert (np.abs(here.evaluate([[20e3, 1500.0]])[0] / middle - 1) < bound).all()
    corners = [[15e3, 1e3], [15e3, 2e3], [25e3, 1e3], [25e3, 2e3], [21e3, 1900.0]]
    assert (np.abs(here.evaluate(corners) / there.evaluate(corners) - 1) < 10 * bound).all()


def test_all_that_is_judged_of_a_ride_is_judged_of_a_table():
    """Measures, weightings and limits; to what the step of the lines gives by the test before, in the middle."""
    changes = {
        "measures": ("ACC", "SWS", "SWS rear", "DTL", "pitch = We body_acceleration + 0.4 We pitch_acceleration"),
        "constraints": ("SWS front <= 0.02", "DTL rear <= 800"),
    }
    here, there = (problem(car, **changes) for car in (measured(HALF, np.arange(0.3, 21.0, 0.05)), HALF))
    assert (here.objectives, here.units) == (there.objectives, there.units)
    np.testing.assert_allclose(here.evaluate([[20e3, 1500.0]]), there.evaluate([[20e3, 1500.0]]), rtol=2e-4)


def test_one_response_with_two_weightings():
    """Each is what it is alone, whatever else is judged."""
    alone = [problem(HALF, measures=(f"a = {w} body_acceleration", "SWS")) for w in ("Wk", "We")]
    texts = ("a = Wk body_acceleration", "SWS", "b = We body_acceleration", "ACC (0.0, 0.0)")
    both = problem(HALF, measures=texts).evaluate([[20e3, 1500.0]])[0]
    each = [one.evaluate([[20e3, 1500.0]])[0] for one in alone]
    np.testing.assert_allclose(both[[0, 2]], [one[0] for one in each], rtol=1e-12)
    np.testing.assert_allclose(both[1:2], each[0][1], rtol=1e-12)
    np.testing.assert_allclose(both[3], each[0][0], rtol=1e-12)  # the point is the centre of gravity


def test_the_spline_is_off_by_the_fourth_power_of_the_step():
    """With half the step a sixteenth of the error, within a factor of two for terms of higher order."""
    coarse, fine = (np.abs(tabled - exact).max() for exact, tabled, _ in map(exact_and_table, (0.2, 0.1)))
    assert 8 < coarse / fine < 32


def test_error_of_the_spline_at_a_resonance_is_below_what_the_docstring_says():
    """1/(k - m w^2 + jwc) of a wheel on its tyre, half width c/(4 pi m) Hz."""
    m, k, c, step = 40.0, 200e3, 800.0, 0.4
    f = np.arange(1.0, 30.0, step)
    half_width = c / (4 * np.pi * m)

    def h(f: np.ndarray) -> np.ndarray:
        return 1 / (k - m * (2 * np.pi * f) ** 2 + 2j * np.pi * f * c)

    values = {("deflection", "road"): h(f), ("deflection", "strut"): h(f)}
    plant = MeasuredPlant(frequency=f, transfer=values, contacts={"road": (0.0, 0.0)}).plant()
    fine = np.linspace(6.0, 20.0, 2000)
    off = np.abs(plant(2j * np.pi * fine)[0, 1] - h(fine)).max() / np.abs(h(fine)).max()
    bound = (step / half_width) ** 4 / 3
    assert bound / 30 < off < bound


def test_one_strut_on_one_wheel():
    """As a quarter car, by the way of one strut; its loop makes the error up to 10 times as large."""
    f = np.arange(0.3, 21.0, 0.025)
    box = {"speed": 20.0, "band": (0.5, 20.0), "lower": (10e3, 1e3), "upper": (30e3, 3e3)}
    plant, s = measured(QUARTER, f), 2j * np.pi * np.arange(0.4875, 20.0, 0.025)
    exact, tabled = QUARTER.plant(["tyre_load"])(s), plant.plant(["tyre_load"])(s)
    error = max(
        np.abs(tabled[:2, 0] / (exact[:2, 0] + s * exact[:2, 1]) - 1).max(),
        np.abs(tabled[:2, 1] / exact[:2, 2] - 1).max(),
    )
    assert error < 1e-5
    designs = [[10e3, 1e3], [22e3, 1500.0], [30e3, 3e3]]
    here, there = (RideProblem(car, ROAD, **box) for car in (plant, QUARTER))
    assert here.variables == there.variables == ("spring", "damper")
    np.testing.assert_allclose(here.evaluate(designs), there.evaluate(designs), rtol=10 * error)
    assert plant.closed({"spring": 22e3, "damper": 1500.0}).input_labels == ["road"]


def test_a_plant_in_load_cases():
    """The mean over two speeds is the root mean square of those at each."""
    plant, design = measured(HALF, LINES), [[20e3, 1500.0]]
    cases = [LoadCase(vehicle=plant, road=ROAD, speed=speed) for speed in (10.0, 20.0)]
    both = problem(None, road=None, speed=None, cases=cases).evaluate(design)
    each = [problem(plant, speed=speed).evaluate(design) for speed in (10.0, 20.0)]
    np.testing.assert_allclose(both, np.sqrt(np.mean(np.square(each), axis=0)), rtol=1e-6)  # other nodes


def test_frequencies_that_were_not_measured():
    plant = measured(HALF, LINES)
    message = r"^band must lie within what was measured, 0.3 to 20.9 Hz, got frequencies from {} to {} Hz$"
    for one in (plant.plant(), plant.closed(SETTINGS)):
        with pytest.raises(ValueError, match=message.format("0.2", "5")):
            one(2j * np.pi * np.array([5.0, 0.2]))
        with pytest.raises(ValueError, match=message.format("22", "22")):
            one(2j * np.pi * 22.0)
    with pytest.raises(ValueError, match=message.format(r"\S*e-09", r"19.\d*")):
        problem(plant, band=(0.0, 20.0))


@pytest.mark.parametrize("text", ["DLC", "DLC rear", "roll_gradient", "- roll_damping", "front_load_transfer"])
def test_what_takes_masses_is_not_known(text):
    message = r"^vehicle must be one of masses and links for static loads, .* got a measured plant$"
    with pytest.raises(ValueError, match=message):
        problem(measured(HALF, LINES), measures=("ACC", text))
    with pytest.raises(ValueError, match=message):
        problem(measured(HALF, LINES), constraints=(f"{text.removeprefix('- ')} <= 1",))


def test_neither_modes_nor_seats():
    message = r"^vehicle must be one of masses and links .*$"
    with pytest.raises(ValueError, match=message):
        measured(HALF, LINES).modes(SETTINGS)
    with pytest.raises(ValueError, match=message):
        Seat(mass=60.0, spring=8e3, damper=500.0).on(measured(HALF, LINES))


def test_settings_are_checked_as_those_of_any_vehicle():
    plant = measured(HALF, LINES)
    with pytest.raises(
        ValueError, match=r"^struts must have front.spring, .* got none for rear.spring, rear.damper$"
    ):
        plant.closed({"front": (18e3, 1200.0)})
    with pytest.raises(ValueError, match=r"^front.spring must be finite and > 0 N/m, got 0$"):
        plant.closed(SETTINGS | {"front": (0, 1200.0)})


F = "frequency [Hz]"
PAIRS = [
    f"{output}/{given} {part} [m/{unit}]"
    for output in ("deflection",)
    for given, unit in (("road", "m"), ("strut", "N"))
    for part in ("real", "imag")
]
GOOD = [[str(i + 1), "1", "0", "-0.001", "0"] for i in range(5)]


def rows(header: list[str], body: list[list[str]]) -> str:
    return "\n".join(",".join(row) for row in [header, *body])


def exchanged(name: str, *by: str) -> list[str]:
    return [F, *(new for old in PAIRS for new in (by if old == name else (old,)))]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "must begin with the names of its columns, got nothing"),
        (b"\xff\xfe", "must be a CSV file in UTF-8"),
        (rows([F, *PAIRS], GOOD[:1]), "there must be two rows of numbers at least, got 1"),
        (rows([F, *PAIRS], GOOD[:3]), "frequency must be 4 finite values or more, got 3"),
        (rows([F, *PAIRS], GOOD[::-1]), "frequency must ascend from 0 Hz in steps >= 1e-06 Hz, got -1 Hz"),
        (rows([F, *PAIRS], [["0", *GOOD[0][1:]], *GOOD]), "frequency must ascend from 0 Hz in .* got 0 Hz"),
        (
            rows([F, *PAIRS], [*GOOD, ["9", "nan", "1", "1", "1"]]),
            r"'deflection/road real \[m/m\]' must be a number",
        ),
        (rows([F, *PAIRS], [*GOOD, ["9"]]), "row 6 must have 5 cells"),
        (rows(["frequency [rad/s]", *PAIRS], GOOD), r"first column must be 'frequency \[Hz\]', got 'freq"),
        (
            rows(exchanged(PAIRS[0], "x"), GOOD),
            "column must be like 'body_acceleration/front_road real .* got 'x'",
        ),
        (
            rows(exchanged(PAIRS[0], PAIRS[1]), GOOD),
            "column must be there once, got 'deflection/road imag .* twice",
        ),
        (
            rows(exchanged(PAIRS[0], "deflection/road real [mm/m]"), GOOD),
            "column deflection/road real must be in m/m, got 'mm/m'",
        ),
        (
            rows(exchanged(PAIRS[0], "pitch_acceleration/road real [m/s^2/m]"), GOOD),
            r"column pitch_acceleration/road real must be in rad/s\^2/m, got 'm/s\^2/m'",
        ),
        (
            rows(exchanged(PAIRS[0], "deflection/rad real [m/m]"), GOOD),
            "input must be like 'front_road' or 'front_strut', got 'rad'",
        ),
        (
            rows(exchanged(PAIRS[0], "acceleration/road real [m/s^2/m]"), GOOD),
            "output must be like 'body_acceleration', .* got 'acceleration'",
        ),
        (
            rows(exchanged(PAIRS[0], "suspension_travel/road real [m/m]"), GOOD),
            "output must be like .* 'front_deflection', got 'suspension_travel'",
        ),
        (
            rows([F, *PAIRS[1:]], [row[:4] for row in GOOD]),
            "column deflection/road imag must have one beside it called real, got none",
        ),
        (
            rows([F, *PAIRS[2:]], [row[:3] for row in GOOD]),
            "transfer must have roads, struts and the deflection of each strut, got strut and deflections of none",
        ),
        (
            rows([F], [["1"], ["2"], ["3"], ["4"]]),
            "transfer must have roads, struts .* got no inputs and deflecti",
        ),
        (
            rows(
                [F, *PAIRS, "a_tyre_load/road real [N/m]", "a_tyre_load/road imag [N/m]"],
                [r + ["0"] * 2 for r in GOOD],
            ),
            "transfer must have each output by each input, got no a_tyre_load/strut",
        ),
    ],
)
def test_bad_tables_are_one_line(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=rf"^{path}: {message}[^\n]*$"):
        MeasuredPlant.from_csv(path, {"road": (0.0, 0.0)})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"contacts": {}}, "contacts must be of road, got none"),
        ({"contacts": {"front_road": (0, 0)}}, "contacts must be of road, got front_road"),
        ({"contacts": {"road": (0, float("nan"))}}, "contact of road must be two finite numbers"),
        ({"frequency": [1.0, 2.0]}, "frequency must be 4 finite values or more, got 2"),
        ({"frequency": [1.0, 2.0, 3.0, float("nan")]}, "frequency must be 4 finite values or more, got 4"),
        ({"frequency": [1.0, 2.0, 3.0, 3.0 + 1e-7]}, "frequency must ascend from 0 Hz in .* got 1e-07"),
        ({"frequency": [1.0, 2.0, 3.0, 4.0, 5.0]}, "transfer must be 5 finite values, got others for defl.*/road"),
        ({"transfer": {("deflection", "road"): [np.inf] * 4}}, "transfer must be 4 finite values, got others"),
        ({"transfer": {("deflection", "x"): [1j] * 4}}, "input must be like"),
    ],
)  # fmt: skip
def test_bad_plants_are_one_line(changes, message):
    h = [1.0, 1j, 1.0, 0.0]
    good = {
        "frequency": [1.0, 2.0, 3.0, 4.0],
        "transfer": {("deflection", "road"): h, ("deflection", "strut"): h},
        "contacts": {"road": (0.0, 0.0)},
    }
    assert MeasuredPlant(**good).responses == ("suspension_travel",)
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        MeasuredPlant(**good | changes)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(OSError, match="No such file"):
        MeasuredPlant.from_csv(tmp_path / "no.csv", {})


NAMES = st.sampled_from(
    [F, *PAIRS, "body_acceleration/road real [m/s^2/m]", "body_acceleration/road imag [m/s^2/m]",
     "rear_deflection/rear_strut real [m/N]", "acceleration_at_1_-2_mm/road real [m/s^2/m]", "/ real []", '"', "#"]
)  # fmt: skip
CELLS = st.one_of(
    st.floats().map(repr), st.floats(-1e3, 1e3).map(repr), st.integers(-9, 9).map(str), st.text(max_size=2)
)
TABLES = st.builds(rows, st.lists(NAMES, max_size=6), st.lists(st.lists(CELLS, max_size=6), max_size=5))


@st.composite
def nearly_good(draw: st.DrawFn) -> str:
    """A good table with a few cells or names exchanged."""
    header, body = [F, *PAIRS], [list(row) for row in GOOD]
    for _ in range(draw(st.integers(1, 3))):
        if draw(st.integers(0, 3)):
            body[draw(st.integers(0, 4))][draw(st.integers(0, 4))] = draw(CELLS)
        else:
            header[draw(st.integers(0, 4))] = draw(NAMES)
    return rows(header, body)


@given(st.one_of(nearly_good(), TABLES, st.text(), st.binary()))
@example(rows([F, *PAIRS], [[repr(i * 1e-310), "1e9", "-1e9", "1", "1"] for i in range(1, 6)]))
@example(rows([F, *PAIRS], [[repr(i * 1e-6), repr((-1) ** i * 1e9), "-1e9", "1", "1"] for i in range(2, 7)]))
@settings(max_examples=150)
def test_whatever_the_text_of_a_table_it_is_read_or_refused(tmp_path_factory, text):
    content = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
    path = written(tmp_path_factory.getbasetemp(), content)
    try:
        MeasuredPlant.from_csv(path, {"road": (0.0, 0.0)}).plant()
        refusal = f"{path}: "
    except ValueError as error:
        refusal = str(error)
    assert refusal.startswith(f"{path}: ")
    assert len(refusal.splitlines()) == 1
