"""The measure `Peak`: texts, sides, places, load cases, and what it refuses."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, QUARTER, ROAD, struts_of
from suspension_ctrl.response.measures.peak import responses_at
from suspension_ctrl.response.peaks import peaks

BUMP = sc.SpeedBump(height=0.05, length=2.0)
EVENTS = {"bump": (BUMP, 8.0), "plank": sc.Plank(height=0.03, length=0.3)}
BOUNDS = {"spring": (15e3, 30e3), "damper": (800.0, 4e3)}
DESIGNS = np.array([[22e3, 1500.0], [16e3, 3000.0]])


def problem(**changes) -> sc.RideProblem:
    given = {"measures": ["ACC", "peak travel bump"], "events": EVENTS, "bounds": BOUNDS}
    return sc.RideProblem(QUARTER, ROAD, speed=20.0, **{**given, **changes})


@pytest.mark.parametrize(
    ("measure", "text", "unit"),
    [
        (sc.Peak("front_travel", "bump"), "peak front_travel bump", "m"),
        (sc.Peak("body_acceleration", "kerb", "max"), "peak max body_acceleration kerb", "m/s^2"),
        (sc.Peak("tyre_load", "bump", "min", maximise=True), "-peak min tyre_load bump", "N"),
        (sc.Peak("body_jerk", "bump", name="harshness"), "harshness = peak body_jerk bump", "m/s^3"),
        (sc.Peak("driver_travel_rate", "bump"), "peak driver_travel_rate bump", "m/s"),
    ],
)
def test_a_text_is_its_measure(measure, text, unit):
    assert str(measure) == text
    assert sc.Measure.parse(text) == measure == pickle.loads(pickle.dumps(measure))
    assert measure.unit == unit


def test_sides_are_positive_and_both_is_the_larger():
    measures = ["peak travel bump", "peak max travel bump", "peak min travel bump"]
    both, extension, compression = problem(measures=measures).evaluate(DESIGNS).T
    highest, lowest = peaks(QUARTER, DESIGNS, BUMP, 8.0, ["suspension_travel"])
    np.testing.assert_array_equal(extension, highest[:, 0])
    np.testing.assert_array_equal(compression, -lowest[:, 0])
    np.testing.assert_array_equal(both, np.maximum(extension, compression))
    assert (compression > 0).all()


def test_an_event_without_a_speed_is_driven_at_that_of_the_load_case():
    measures = ["ACC", "peak travel plank"]
    found = [
        problem(measures=measures, events={"plank": one}) for one in (EVENTS["plank"], (EVENTS["plank"], 20.0))
    ]
    np.testing.assert_array_equal(*(one.evaluate(DESIGNS) for one in found))
    assert found[0].replace(speed=12.0).evaluate(DESIGNS)[0, 1] != found[0].evaluate(DESIGNS)[0, 1]
    assert found[0].events["plank"].speed is None


def test_a_limit_on_a_peak_holds_in_every_load_case():
    heavy = sc.Payload(mass=150.0).on(QUARTER)
    cases = [sc.LoadCase(vehicle=one, road=ROAD, speed=20.0) for one in (QUARTER, heavy)]
    limit = sc.Limit(sc.Peak("tyre_load", "bump", "max"), 2e3)
    found = sc.RideProblem(cases=cases, events=EVENTS, constraints=[limit], bounds=BOUNDS).evaluate(DESIGNS)[:, -1]
    each = [peaks(one, DESIGNS, BUMP, 8.0, ["tyre_load"])[0][:, 0] for one in (QUARTER, heavy)]
    np.testing.assert_allclose(found, np.max(each, axis=0) / 2e3 - 1, rtol=1e-12)


def test_an_axle_and_all_wheels_take_the_largest():
    assert responses_at(FULL, "front_travel") == ["front_left_suspension_travel", "front_right_suspension_travel"]
    assert responses_at(FULL, "tyre_load") == [f"{corner}_tyre_load" for corner in FULL.tyres]
    assert responses_at(FULL, "rear_wheel_acceleration") == [
        "rear_left_wheel_acceleration", "rear_right_wheel_acceleration",
    ]  # fmt: skip
    assert responses_at(FULL, "rear_left_strut_force") == ["rear_left_strut_force"]
    hole = {"hole": sc.Pothole(depth=0.05, length=0.4, side="right")}
    table = sc.ride(FULL, struts_of(FULL), ROAD, 15.0, measures=["peak tyre_load hole", "ACC"], events=hole)
    x = np.array([list(FULL.coefficients(struts_of(FULL)).values())])
    each = [np.abs(one).max() for one in peaks(FULL, x, hole["hole"], 15.0, responses_at(FULL, "tyre_load"))]
    assert table.value["peak tyre_load hole"] == max(each)
    assert table.unit["peak tyre_load hole"] == "N"


def test_a_search_minimises_peaks():
    run = sc.minimise(
        problem(measures=["peak body_acceleration bump", "peak min travel bump"]),
        sc.Nsga2(population=20), iterations=4, seed=1,
    )  # fmt: skip
    front = run.front()
    assert list(front.columns[-2:]) == ["peak body_acceleration bump [m/s^2]", "peak min travel bump [m]"]
    assert len(front) > 3


KNEE = replace(QUARTER, strut=sc.parallel(sc.Spring(), sc.DigressiveDamper(high_speed=900.0)))
LAWS = {"spring": (15e3, 30e3), "damper.low_speed": (1e3, 6e3), "damper.knee": (0.05, 0.3)}


def test_force_laws_have_peaks_in_every_load_case_and_limit():
    """The peak of a column is that of the vehicle; the mass beside it is laden."""
    cases = [sc.LoadCase(vehicle=one, road=ROAD, speed=20.0) for one in (KNEE, sc.Payload(mass=150.0).on(KNEE))]
    found = sc.RideProblem(
        cases=cases, events=EVENTS, bounds=LAWS, worst_case=True,
        measures=["ACC", "peak body_acceleration bump"], constraints=["peak min travel bump <= 0.03"],
    )  # fmt: skip
    design = np.array([[22e3, 3e3, 0.1]])
    x = np.array([list(KNEE.coefficients(dict(zip(LAWS, design[0], strict=True))).values())])
    acceleration, travel = (
        np.array([peaks(case.vehicle, x, BUMP, 8.0, [name]) for case in cases])[..., 0, 0]  # case, side
        for name in ("body_acceleration", "suspension_travel")
    )
    _, peak, limit = found.evaluate(design)[0]
    assert peak == np.abs(acceleration).max()
    assert limit == pytest.approx(-travel[:, 1].min() / 0.03 - 1, rel=1e-12)
    table = sc.ride(KNEE, {"spring": 22e3, "damper.low_speed": 3e3, "damper.knee": 0.1}, ROAD, 20.0,
                    measures=["ACC", "peak body_acceleration bump"], events=EVENTS)  # fmt: skip
    assert table.value["peak body_acceleration bump"] == np.abs(acceleration[0]).max()


@pytest.mark.parametrize("optimiser", [sc.Nsga2(population=12), sc.MoeadDra(population=12)])
def test_searches_minimise_peaks_of_force_laws(optimiser):
    given = {"measures": ["peak body_acceleration bump", "DTL"], "constraints": ["peak travel bump <= 0.05"]}
    searched = sc.RideProblem(KNEE, ROAD, speed=20.0, events=EVENTS, bounds=LAWS, **given)
    run = sc.minimise(searched, optimiser, iterations=3, seed=1)
    assert run.feasible.any()
    best = run.designs[run.feasible]
    np.testing.assert_array_equal(searched.evaluate(best)[:, 0], run.objectives[run.feasible, 0])


@pytest.mark.parametrize(
    ("changes", "key", "got"),
    [
        ({"measures": ["ACC", "peak travel kerb"]}, "event", "kerb"),
        ({"measures": ["ACC", "peak lift bump"]}, "response", "lift"),
        ({"measures": ["ACC", "peak travel"]}, "peak", "travel"),
        ({"measures": ["ACC", "peak"]}, "peak", "''"),
        ({"events": [BUMP]}, "events", "SpeedBump"),
        ({"events": {"a bump": BUMP}}, "events", "a bump"),
        ({"events": {"bump": 3.0}}, "event bump", "3.0"),
        ({"events": {"bump": (BUMP, -1.0)}}, "speed of event bump", "-1.0"),
        ({"events": {"bump": sc.RigSine(motion="roll", amplitude=0.01, frequency=1.0)}}, "motion", "roll"),
    ],
)
def test_what_is_wrong_is_named(changes, key, got):
    with pytest.raises(ValueError, match=rf"^{key} .*got .*{got}"):
        problem(**changes).evaluate(DESIGNS)


def test_a_side_is_one_of_three():
    with pytest.raises(ValueError, match=r"^side .*got 'up'"):
        sc.Peak("travel", "bump", "up")
