"""Vehicles as one system: exact plants fed back give the vehicle, their frequency responses that to the spline."""

import pickle
import re
from dataclasses import replace

import control
import numpy as np
import pytest

from garage import DAMPED_HALF, FULL, QUARTER, ROAD, VEHICLES, struts_of
from suspension_ctrl import LoadCase, Plant, RideProblem, Seat
from suspension_ctrl.vehicles.vehicle import Vehicle

CAR = replace(DAMPED_HALF, front_tyre_damping=430.0, rear_tyre_damping=430.0)
ONE_WHEEL = replace(QUARTER, tyre_damping=400.0)
SETTING = {"front": (18e3, 1200.0), "rear": (22e3, 1500.0)}
LINES = np.arange(0.3, 21.0, 0.1)


def contacts(car: Vehicle) -> dict[str, tuple[float, float]]:
    return dict(zip(car.tyres, map(tuple, car.contact_points.tolist()), strict=True))


def measured(car: Vehicle, f: np.ndarray) -> Plant:
    """The plant by its frequency response alone, as python-control gives it."""
    h = car.plant().frequency_response(2 * np.pi * f)
    system = control.frd(h.frdata, h.omega, inputs=h.input_labels, outputs=h.output_labels)
    return Plant(system, contacts(car))


def by_strut(car: Vehicle) -> dict[str, tuple[float, float]]:
    """A setting of each strut of a vehicle by the name of the strut, where axles share theirs in the vehicle."""
    values = car.coefficients(struts_of(car))
    found = {}
    for strut in car.struts:
        name = next(n for n in (strut, strut.split("_")[0]) if (f"{n}.spring" if n else "spring") in values)
        prefix = f"{name}." if name else ""
        found[strut] = (values[f"{prefix}spring"], values[f"{prefix}damper"])
    return found


@pytest.mark.parametrize("name", VEHICLES)
def test_a_plant_fed_back_is_the_vehicle(name):
    """The same matrices, and the same coefficients by strut, but for rounding."""
    car = VEHICLES[name]
    plant = Plant(car.plant(), contacts(car))
    here, there = plant.closed(by_strut(car)), car.closed(struts_of(car))
    assert (here.input_labels, here.output_labels) == (there.input_labels, there.output_labels)
    for one, other in zip((here.A, here.B, here.C, here.D), (there.A, there.B, there.C, there.D), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12 * np.abs(other).max())


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


def test_a_plant_fed_back_gives_the_mean_squares_of_the_vehicle():
    designs = [[20e3, 1500.0], [15e3, 1e3], [25e3, 2e3]]
    here, there = (problem(car).evaluate(designs) for car in (Plant(CAR.plant(), contacts(CAR)), CAR))
    np.testing.assert_allclose(here, there, rtol=1e-12)
    box = {"speed": 20.0, "band": (0.5, 20.0), "bounds": {"spring": (10e3, 30e3), "damper": (1e3, 3e3)}}
    here, there = (RideProblem(car, ROAD, **box) for car in (Plant(ONE_WHEEL.plant()), ONE_WHEEL))
    designs = [[10e3, 1e3], [22e3, 1500.0], [30e3, 3e3]]
    np.testing.assert_allclose(here.evaluate(designs), there.evaluate(designs), rtol=1e-12)


@pytest.mark.parametrize("car", [ONE_WHEEL, CAR])
def test_rates_that_a_system_lacks_are_derived(car):
    """The rate of a deflection C x is C A x + C B u, and j w times it on a frequency response."""
    kept = [name for name in car.plant().output_labels if not name.endswith(("_rate", "_travel"))]
    whole = Plant(car.plant(), contacts(car))
    lacking = Plant(car.plant()[kept, car.plant().input_labels], contacts(car))
    assert set(lacking.responses) == set(car.responses)
    here, there = (plant.closed(by_strut(car), responses=car.responses) for plant in (lacking, whole))
    np.testing.assert_allclose(here.A, there.A, rtol=1e-12, atol=1e-12 * np.abs(there.A).max())
    h = car.plant().frequency_response(2 * np.pi * LINES)
    system = control.frd(h[kept, :].frdata, h.omega, inputs=h.input_labels, outputs=kept)
    table, s = Plant(system, contacts(car)), 2j * np.pi * LINES
    here = table.closed(by_strut(car), responses=car.responses)
    np.testing.assert_allclose(here(s), there(s), rtol=1e-9, atol=1e-11 * np.abs(there(s)).max())
    for plant in (lacking, table):
        np.testing.assert_allclose(plant.plant(car.responses)(s), h.frdata, rtol=1e-9, atol=1e-12)


def test_struts_of_an_axle_share_their_coefficients():
    """As in the full car, whose two loops of two equations they keep; `FULL` without bars."""
    pair = {"front": (10e3, 2000.0), "rear": (13e3, 2000.0)}
    plant = Plant(FULL.plant(), contacts(FULL), axles=("front", "rear"))
    assert [one.name for one in plant.strut_coefficients] == [
        "front.spring", "front.damper", "rear.spring", "rear.damper",
    ]  # fmt: skip
    here, there = plant.closed(pair), FULL.closed(pair)
    np.testing.assert_allclose(here.A, there.A, rtol=1e-12, atol=1e-12 * np.abs(there.A).max())
    assert pickle.loads(pickle.dumps(plant)) == plant != Plant(FULL.plant(), contacts(FULL))
    one = Plant(FULL.plant(), contacts(FULL), axles=("rear",))
    assert list(one.coefficients({"front_left": (1, 2), "front_right": (3, 4), "rear": (5, 6)})) == [
        "front_left.spring", "front_left.damper", "front_right.spring", "front_right.damper", "rear.spring",
        "rear.damper",
    ]  # fmt: skip
    with pytest.raises(ValueError, match=r"^axles must have two struts like 'middle_left', got front_left, .*$"):
        Plant(FULL.plant(), contacts(FULL), axles=("middle",))


def test_a_deflection_with_feedthrough_is_the_travel_if_its_rate_is_given():
    names = {"inputs": ["road", "strut"], "outputs": ["deflection", "deflection_rate"]}
    system = control.ss([[-2.0]], [[1.0, 3.0]], [[1.0], [-2.0]], [[0.5, 0.1], [1.0, 3.0]], **names)
    plant = Plant(system)
    assert plant.responses == ("suspension_travel",)
    np.testing.assert_allclose(plant.plant()(5j)[[0, 1]], system(5j)[[0, 0]], rtol=1e-14)


def test_a_derived_rate_jumps_with_its_input():
    """The rate of x' = -2 x + u + 3 F is itself, u and F included."""
    system = control.ss(
        [[-2.0]], [[1.0, 3.0]], [[1.0]], [[0, 0]], inputs=["road", "strut"], outputs=["deflection"]
    )
    np.testing.assert_allclose(Plant(system).plant()(5j)[2], 5j * system(5j)[0], rtol=1e-14)


@pytest.mark.parametrize("car", [ONE_WHEEL, CAR, FULL, Seat(mass=60.0, spring=8e3, damper=500.0).on(CAR)])
def test_signals_are_those_of_the_vehicle(car):
    plant = measured(car, LINES)
    assert plant.responses == car.responses
    assert all(plant.meanings[name].kind == car.meanings[name].kind for name in plant.meanings)
    unknown = {name for name in car.meanings if name.endswith(("displacement", "velocity", "tyre_deflection"))}
    further = {
        name for name in car.meanings if name.endswith(("wheel_acceleration", "floor_acceleration", "floor_jerk"))
    }
    assert car.meanings.keys() - plant.meanings.keys() == unknown | further
    assert (plant.struts, plant.tyres) == (car.struts, car.tyres)
    np.testing.assert_array_equal(plant.contact_points, car.contact_points)
    here, there = plant.plant(car.responses), car.plant(car.responses)
    assert isinstance(here, control.FrequencyResponseData)
    assert (here.output_labels, here.input_labels) == (there.output_labels, there.input_labels)
    assert [p.name.rsplit(".", 1)[-1] for p in plant.strut_coefficients] == ["spring", "damper"] * len(car.struts)


def test_at_the_lines_the_closed_loop_is_that_of_the_vehicle():
    """To rounding: the loop of the half car has condition numbers up to some thousand."""
    s = 2j * np.pi * LINES
    here, there = measured(CAR, LINES).closed(SETTING), CAR.closed(SETTING)
    assert here.input_labels == there.input_labels
    np.testing.assert_allclose(here(s), there(s), rtol=1e-10, atol=1e-12 * np.abs(there(s)).max())


def test_full_car_by_strut():
    """Without bars coefficients by strut are those by axle; to rounding as above."""
    pair = {"front": (10e3, 2000.0), "rear": (13e3, 2000.0)}
    each = {f"{axle}_{side}": pair[axle] for axle in pair for side in ("left", "right")}
    here, there = measured(FULL, LINES).closed(each), FULL.closed(pair)
    s = 2j * np.pi * LINES
    np.testing.assert_allclose(here(s), there(s), rtol=0, atol=1e-9 * np.abs(here.frdata).max())


def test_points_of_the_body_and_other_signals_are_outputs_of_their_own():
    names = ["body_acceleration", ("acceleration", 0.5, -0.4), "front_suspension_travel"]
    system = CAR.plant(names)
    system.update_names(outputs=["noise", *system.output_labels[1:]])
    plant = Plant(system, contacts(CAR))
    assert plant.responses == (
        "noise",
        "acceleration_at_500_-400_mm",
        "front_suspension_travel",
        "rear_suspension_travel",
    )
    assert plant.meanings["acceleration_at_500_-400_mm"] == ("acceleration", (0.5, -0.4))
    assert plant.meanings["noise"] == ("signal", "noise")
    assert problem(plant, measures=("ACC (0.5, -0.4)", "SWS front")).units["ACC (0.5, -0.4)"] == "m/s^2"
    with pytest.raises(ValueError, match=r"^response must be one of noise, .*_mm, .*, got 'acc.*_100_0_mm'$"):
        plant.plant([("acceleration", 0.1, 0.0)])


def exact_and_table(step: float) -> tuple[np.ndarray, np.ndarray, Plant]:
    """Responses of the closed loop in the middle of the box halfway between lines: exact, and by a table."""
    f = np.arange(0.3, 21.0, step)
    plant, s = measured(CAR, f), 2j * np.pi * (f[:-1] + step / 2)[(f[:-1] > 0.45) & (f[:-1] < 20.05)]
    closed = {"front": (20e3, 1200.0), "rear": (22e3, 1500.0)}
    g, h = CAR.closed(closed, responses=plant.responses)(s), plant.closed(closed)(s)
    return g[:, :2] + s * g[:, 2:], h[:, :2] + s * h[:, 2:], plant


def test_a_table_gives_the_root_mean_squares_of_its_vehicle():
    """A root mean square is a norm of the response's row by roads: off by no more than the norm of its error.

    In the middle of the box, around which the loop is closed at the lines, that is the error of the splines, about
    as large all over as halfway between lines; e^H G e <= 2 S |e|^2 for two roads of spectrum S. At other designs
    the loop may make more of it, by less than 10: what is added to struts is below what they have already.
    """
    exact, tabled, plant = exact_and_table(0.05)
    f = np.arange(0.475, 20.05, 0.05)
    responses = ("body_acceleration", "pitch_acceleration", "front_suspension_travel", "rear_tyre_load")
    here, there = (problem(car, measures=responses) for car in (plant, CAR))
    assert (here.objectives, here.units) == (there.objectives, there.units)
    middle = there.evaluate([[20e3, 1500.0]])[0]
    row = [plant.responses.index(name) for name in responses]
    squares = (np.abs(tabled - exact)[row] ** 2).sum(axis=1) @ (2 * ROAD.psd(f, 20.0)) * 0.05
    bound = np.sqrt(squares) / middle
    assert bound.max() < 3e-4
    assert (np.abs(here.evaluate([[20e3, 1500.0]])[0] / middle - 1) < bound).all()
    corners = [[15e3, 1e3], [15e3, 2e3], [25e3, 1e3], [25e3, 2e3], [21e3, 1900.0]]
    assert (np.abs(here.evaluate(corners) / there.evaluate(corners) - 1) < 10 * bound).all()


def test_all_that_is_judged_of_a_ride_is_judged_of_a_table():
    """Measures, weightings and limits; to what the step of the lines gives by the test before, in the middle."""
    changes = {
        "measures": ("ACC", "SWS", "SWS rear", "DTL", "pitch = We body_acceleration + 0.4 We pitch_acceleration"),
        "constraints": ("SWS front <= 0.02", "DTL rear <= 800"),
    }
    here, there = (problem(car, **changes) for car in (measured(CAR, np.arange(0.3, 21.0, 0.05)), CAR))
    assert (here.objectives, here.units) == (there.objectives, there.units)
    np.testing.assert_allclose(here.evaluate([[20e3, 1500.0]]), there.evaluate([[20e3, 1500.0]]), rtol=3e-4)


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

    system = control.frd([[h(f), h(f)]], 2 * np.pi * f, inputs=["road", "strut"], outputs=["deflection"])
    plant = Plant(system).plant()
    fine = np.linspace(6.0, 20.0, 2000)
    off = np.abs(plant(2j * np.pi * fine)[0, 1] - h(fine)).max() / np.abs(h(fine)).max()
    bound = (step / half_width) ** 4 / 3
    assert bound / 30 < off < bound


def test_a_strut_that_meets_a_spring_without_a_mass_between_closes_too():
    """Series spring K under a strut of k and c: the seat of the spring has no mass, and the loop feedthrough.

    Deflection d = z - F/K and rate z' - F'/K of the strut over the mass z: with F = k d + c d' the mass has the
    force 1/(1/K + 1/(k + c s)). The rate of F is no proper output, which is why a frequency response is given.
    """
    m, stiff, k, c = 300.0, 60e3, 20e3, 1500.0
    f = np.linspace(0.2, 20.0, 400)
    s = 2j * np.pi * f
    z = [1 / (m * s**2) * 1e5, -1 / (m * s**2)]
    h = [[z[0], z[1]], [z[0], z[1] - 1 / stiff]]
    system = control.frd(h, 2 * np.pi * f, inputs=["road", "strut"], outputs=["body_displacement", "deflection"])
    closed = Plant(system).closed((k, c), responses=["body_displacement"])
    force = 1 / (1 / stiff + 1 / (k + c * s))
    np.testing.assert_allclose(closed(s), 1e5 / (m * s**2 + force), rtol=1e-9)


def test_a_plant_in_load_cases():
    """The mean over two speeds is the root mean square of those at each."""
    plant, design = measured(CAR, LINES), [[20e3, 1500.0]]
    cases = [LoadCase(vehicle=plant, road=ROAD, speed=speed) for speed in (10.0, 20.0)]
    both = problem(None, road=None, speed=None, cases=cases).evaluate(design)
    each = [problem(plant, speed=speed).evaluate(design) for speed in (10.0, 20.0)]
    np.testing.assert_allclose(both, np.sqrt(np.mean(np.square(each), axis=0)), rtol=1e-6)  # other nodes


def test_frequencies_that_were_not_measured():
    plant = measured(CAR, LINES)
    message = r"^band must lie within what was measured, 0.3 to 20.9 Hz, got frequencies from {} to {} Hz$"
    for one in (plant.plant(), plant.closed(SETTING)):
        with pytest.raises(ValueError, match=message.format("0.2", "5")):
            one(2j * np.pi * np.array([5.0, 0.2]))
        with pytest.raises(ValueError, match=message.format("22", "22")):
            one(2j * np.pi * 22.0)
    with pytest.raises(ValueError, match=message.format(r"\S*e-09", r"19.\d*")):
        problem(plant, band=(0.0, 20.0))


@pytest.mark.parametrize("text", ["DLC", "DLC rear", "roll_gradient", "- roll_damping", "front_load_transfer"])
def test_measures_that_need_masses_are_refused(text):
    message = r"^vehicle must be one of masses and links for static loads, .* got a Plant$"
    with pytest.raises(ValueError, match=message):
        problem(measured(CAR, LINES), measures=("ACC", text))
    with pytest.raises(ValueError, match=message):
        problem(measured(CAR, LINES), constraints=(f"{text.removeprefix('- ')} <= 1",))


def test_a_plant_has_no_modes():
    for plant in (Plant(CAR.plant(), contacts(CAR)), measured(CAR, LINES)):
        with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links for .*, got a Plant$"):
            plant.modes(SETTING)


def test_a_seat_cannot_be_put_on_a_plant():
    with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links .*$"):
        Seat(mass=60.0, spring=8e3, damper=500.0).on(measured(CAR, LINES))


@pytest.mark.parametrize("plant", [Plant(CAR.plant(), contacts(CAR)), measured(CAR, LINES)])
def test_plants_are_copies_equal_by_value_read_only_and_picklable(plant):
    again = pickle.loads(pickle.dumps(plant))
    assert (again, hash(again)) == (plant, hash(plant))
    assert plant != replace(plant, contacts=contacts(CAR) | {"front": (1.0, 0.0)})
    assert len(repr(plant).splitlines()) <= 6
    array = plant.system.B if isinstance(plant.system, control.StateSpace) else plant.system.frdata
    with pytest.raises(ValueError, match="read-only"):
        array[:] = 0
    with pytest.raises(TypeError, match="item assignment"):
        plant.contacts["front"] = (0.0, 0.0)


def test_a_plant_keeps_the_numbers_it_was_given():
    system = CAR.plant()
    plant, there = Plant(system, contacts(CAR)), Plant(CAR.plant(), contacts(CAR))
    system.A[:] = 0
    assert plant == there


def test_struts_are_those_asked_for():
    """Others have no effect: a car that hangs on its rear strut alone."""
    plant = Plant(CAR.plant(), contacts(CAR), struts=["rear"])
    assert plant.struts == ("rear",)
    assert plant.plant().input_labels[-1] == "rear_strut"
    assert [p.name for p in plant.strut_coefficients] == ["rear.spring", "rear.damper"]
    weak = CAR.closed(front=(1e-9, 1e-9), rear=(22e3, 1500.0))
    s = 2j * np.pi * LINES
    alone = plant.closed(rear=(22e3, 1500.0), responses=CAR.responses)
    np.testing.assert_allclose(alone(s), weak(s), rtol=1e-9, atol=1e-9 * np.abs(weak(s)).max())


SYSTEM = ONE_WHEEL.plant(["body_acceleration"])
H = [1.0, 1j, 1.0, 0.0]


def renamed(**names: list[str]) -> control.StateSpace:
    system = SYSTEM.copy()
    system.update_names(**names)
    return system


def frd(f: list[float], h: list[complex] = H) -> control.FrequencyResponseData:
    return control.frd([[h, h]], 2 * np.pi * np.array(f), inputs=["road", "strut"], outputs=["deflection"])


DISCRETE = control.ss(
    [[0.5]], [[1.0, 1.0]], [[1.0]], [[0, 0]], 0.01, inputs=["road", "strut"], outputs=["deflection"]
)
DIRECT = control.ss([[-1]], [[1, 1]], [[1]], [[0, 2]], inputs=["road", "strut"], outputs=["deflection"])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3,), "system must be a control.StateSpace or FrequencyResponseData, got int"),
        ((control.tf([1], [1, 1]),),
         "system must be a control.StateSpace or FrequencyResponseData, got TransferFunction"),
        ((SYSTEM, {1: (0, 0)}), "contacts must be a mapping of wheels to points, got {1: (0, 0)}"),
        ((SYSTEM, {"": (0, 0)}, "front"), "struts must be a list, got 'front'"),
        ((DISCRETE,), "system must be in continuous time, got a time step of 0.01"),
        ((SYSTEM, {}), "contacts must be a mapping of wheels to points, got {}"),
        ((SYSTEM, [(0, 0)]), "contacts must be a mapping of wheels to points, got [(0, 0)]"),
        ((SYSTEM, {"front": (0, 0)}), "system must have the input 'front_road', got road, road_rate, strut"),
        ((SYSTEM, {"": (0, float("nan"))}),
         "contact of the wheel must be two finite numbers, x and y [m], got (0, nan)"),
        ((SYSTEM, {"": (0, 0)}, ["rear"]), "system must have the input 'rear_strut', got road, road_rate, strut"),
        ((CAR.plant(), {"front": (0, 0)}),
         "input must be front_road, its rate, or like 'front_strut', got 'rear_road'"),
        ((renamed(inputs=["road", "wind", "strut"]),),
         "input must be road, its rate, or like 'front_strut', got 'wind'"),
        ((renamed(inputs=["road", "road_rate", "force"]),),
         "system must have an input like 'front_strut', got road, road_rate, force"),
        ((renamed(outputs=["a", "extension", "rate"]),),
         "system must have the output 'deflection', got a, extension, rate"),
        ((renamed(inputs=["road", "road_rate", "speed_strut"]),),
         "struts must not be called responses, road, speed, got 'speed'"),
        ((DIRECT,), "system must have the output 'deflection_rate' where an input acts on deflection, got strut"),
        ((frd([1.0, 2.0], [1.0, 2.0]),), "frequency must be 4 finite values or more, got 2"),
        ((frd([1.0, 2.0, 3.0, float("nan")]),), "frequency must be 4 finite values or more, got 4"),
        ((frd([1.0, 2.0, 3.0, 3.0 + 1e-7]),),
         "frequency must ascend from 0 Hz in steps >= 1e-06 Hz, got 1e-07 Hz"),
        ((frd([0.0, 2.0, 3.0, 4.0]),), "frequency must ascend from 0 Hz in steps >= 1e-06 Hz, got 0 Hz"),
        ((frd([1.0, 2.0, 3.0, 4.0], [np.inf] * 4),), "system must hold finite values throughout, got others"),
    ],
)  # fmt: skip
def test_bad_plants_are_one_line(arguments, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Plant(*arguments)
