"""Batched mean squares of every vehicle against python-control's closed model, and what is worked out apart."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DRIVER, FULL, HALF, QUARTER, ROAD, SPEED, VEHICLES, from_roads, mean_squares, struts_of
from suspension_ctrl import LoadCase, RideProblem, Seat
from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.response import weightings
from suspension_ctrl.response.blocks import pairs_of
from suspension_ctrl.response.many_struts import ManyStruts
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.one_strut import OneStrut
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.roads.coherence import Constant, Exponential
from suspension_ctrl.vehicles.vehicle import Vehicle

BAND = (0.1, 20.0)
"""Towards frequency 0 wheels move as one and h S h^H is the rounding of their differences."""

BOXES = {
    "spring": (18e3, 26e3), "damper": (1.2e3, 2.2e3),
    "front.spring": (16e3, 24e3), "front.damper": (1.2e3, 2e3),
    "rear.spring": (18e3, 28e3), "rear.damper": (1.3e3, 2.2e3),
    "front_antiroll": (0.0, 3e4), "rear_antiroll": (0.0, 2e4),
    "driver.spring": (9e3, 15e3), "driver.damper": (500.0, 900.0),
}  # fmt: skip


def problem(vehicle: Vehicle, varied: tuple[str, ...], measures: tuple[str, ...], **changes) -> RideProblem:
    """Return a problem over the box of these coefficients, the others being those of `struts_of`."""
    fixed = {name: value for name, value in vehicle.coefficients(struts_of(vehicle)).items() if name not in varied}
    bounds = {name: BOXES[name] for name in varied}
    settings = {"road": ROAD, "speed": SPEED, "band": BAND, "bounds": bounds, "struts": fixed, "nodes": 256}
    return RideProblem(vehicle, measures=measures, **settings | changes)


def draws(p: RideProblem, n: int) -> np.ndarray:
    return np.random.default_rng(5).uniform(p.lower, p.upper, (n, len(p.lower)))


def assert_is_the_closed_model(p: RideProblem, terms: list, kinks: tuple = (), rtol: float = 1e-9) -> None:
    """Each measure of the problem is one response with its weighting."""
    designs = draws(p, 2)
    for design, found in zip(designs, p.evaluate(designs), strict=True):
        struts = {**p.struts, **dict(zip(p.variables, design.tolist(), strict=True))}
        expected = mean_squares(p.vehicle, struts, terms, p.band, p.nodes, kinks, p.road, p.speed)
        np.testing.assert_allclose(found, np.sqrt(expected), rtol=rtol)
        np.testing.assert_array_equal(call_compiled(p.kernel, design), found)


@pytest.mark.parametrize("name", VEHICLES)
def test_every_response_of_every_vehicle_is_that_of_the_closed_model(name):
    """At the same nodes, so that only rounding is between them.

    Weightings are evaluated alike on both sides; Wb-table makes kinks.
    """
    vehicle = VEHICLES[name]
    varied = tuple(p.name for p in vehicle.strut_coefficients if p.name in BOXES and not p.name.startswith("rear"))
    terms = [*((response, None) for response in vehicle.responses), ("body_acceleration", "Wk")]
    p = problem(vehicle, varied, tuple(" ".join(filter(None, (w, r))) for r, w in terms))
    assert_is_the_closed_model(p, terms)


def test_every_coefficient_of_a_full_car_with_a_seat_may_vary():
    car = DRIVER.on(FULL)
    weighting, point = "Wb-table", ("acceleration", 1.2, -0.4)
    terms = [("driver_acceleration", weighting), (point, None), ("driver_suspension_travel", None)]
    p = problem(
        car, tuple(p.name for p in car.strut_coefficients),
        ("Wb-table driver_acceleration", "acceleration (1.2, -0.4)", "SWS driver"), nodes=320,
    )  # fmt: skip
    assert_is_the_closed_model(p, terms, weightings.by_name(weighting).breakpoints)


@pytest.mark.parametrize("varied", [("front_antiroll",), ("rear.damper",), ("damper", "spring"), ("spring",)])
def test_any_choice_of_coefficients_may_vary(varied):
    """A bar alone has nothing to do with the halves in phase; a damper may stand before its spring."""
    vehicle = FULL if "." in varied[0] or "_" in varied[0] else QUARTER
    terms = [(response, None) for response in vehicle.responses]
    assert_is_the_closed_model(problem(vehicle, varied, vehicle.responses), terms)


@pytest.mark.parametrize("coherence", [Constant(0.0), Constant(0.7), Exponential(3.0)])
@pytest.mark.parametrize("speed", [3.0, 50.0])
def test_any_road_at_any_speed(coherence, speed):
    terms = [("body_acceleration", None), ("roll_acceleration", None), ("rear_left_tyre_load", None)]
    road = replace(ROAD, coherence=coherence)
    names = tuple(response for response, _ in terms)
    p = problem(DRIVER.on(FULL), ("front.spring", "rear.damper"), names, road=road, speed=speed, nodes=512)
    assert_is_the_closed_model(p, terms)


def test_a_road_shaped_like_a_cylinder_rolls_nothing():
    """Tracks that are all alike: no roll at all, which is resolved whatever the nodes; the rest as ever."""
    road = replace(ROAD, coherence=Constant(1.0))
    names = ("body_acceleration", "roll_acceleration", "front_left_tyre_load")
    p = problem(FULL, ("front.spring", "rear.damper"), names, road=road)
    design = draws(p, 1)
    found = p.evaluate(design)[0]
    struts = {**p.struts, **dict(zip(p.variables, design[0].tolist(), strict=True))}
    expected = mean_squares(FULL, struts, [(name, None) for name in names], BAND, 256, (), road)
    np.testing.assert_allclose(found[[0, 2]], np.sqrt(expected[[0, 2]]), rtol=1e-9)
    assert found[1] == 0


def test_a_half_car_is_a_full_car_on_a_road_shaped_like_a_cylinder():
    road = replace(ROAD, coherence=Constant(1.0))
    half = replace(HALF, body_mass=FULL.body_mass / 2, pitch_inertia=FULL.pitch_inertia / 2)
    varied = ("front.spring", "front.damper", "rear.spring", "rear.damper")
    one, other = (problem(car, varied, ("ACC (1, 0)", "SWS", "DTL rear"), road=road) for car in (half, FULL))
    designs = draws(one, 3)
    np.testing.assert_allclose(one.evaluate(designs), other.evaluate(designs), rtol=1e-9)


@pytest.mark.parametrize("speed", [5.0, 20.0])
def test_the_rear_wheel_meets_what_the_front_wheel_met(speed):
    """One profile, met a/V early in front and b/V late behind: |H_front e^(jwa/V) + H_rear e^(-jwb/V)|^2 S."""
    names = ("body_acceleration", "pitch_acceleration", "rear_tyre_load")
    p = problem(HALF, ("front.spring", "rear.damper"), names, speed=speed, nodes=400)
    design = draws(p, 1)[0]
    f, w = frequency_nodes(BAND, 400)
    h = from_roads(HALF, {**p.struts, **dict(zip(p.variables, design.tolist(), strict=True))}, names, f)
    lags = np.exp(2j * np.pi * f / speed * np.array([[1.2], [-1.5]]))
    squares = (np.abs(np.einsum("nmr,rn->mn", h, lags)) ** 2 * ROAD.psd(f, speed) * w).sum(axis=1)
    np.testing.assert_allclose(p.evaluate([design])[0], np.sqrt(squares), rtol=1e-9)


@pytest.mark.parametrize("vehicle", [HALF, FULL, DRIVER.on(FULL)])
def test_the_band_may_begin_at_zero(vehicle):
    """Below 1e-6 Hz lies f^2.5 of the integrals, nothing; many nodes crowd there, where rounding is worst."""
    measures = ("ACC", "ACC (1.2, 0.3)", "SWS", "DTL", "pitch_acceleration")
    varied = ("front.spring", "rear.damper")
    one, other = (problem(vehicle, varied, measures, band=(low, 20.0), nodes=512) for low in (0.0, 1e-6))
    designs = draws(one, 3)
    np.testing.assert_allclose(one.evaluate(designs), other.evaluate(designs), rtol=1e-8)
    np.testing.assert_allclose(one.replace(nodes=4000).evaluate(designs), one.evaluate(designs), rtol=1e-9)


def test_rows_are_independent_to_the_last_bit():
    p = problem(FULL, ("front.spring", "rear.damper", "rear_antiroll"), ("ACC", "SWS", "DTL"))
    designs = draws(p, 7)
    together = p.evaluate(designs)
    np.testing.assert_array_equal(together, np.vstack([p.evaluate(row[None]) for row in designs]))
    many = np.tile(designs, (70, 1))  # work for more than one thread
    np.testing.assert_array_equal(p.evaluate(many, threads=3), np.tile(together, (70, 1)))


def test_one_strut_is_worked_out_the_same_as_many():
    """A quarter car by its polynomials and, with coefficients in another order, by a block of one strut."""
    terms = ("ACC", "SWS", "DTL")
    loop, block = (problem(QUARTER, varied, terms) for varied in (("spring", "damper"), ("damper", "spring")))
    assert [type(ready(p)) for p in (loop, block)] == [OneStrut, ManyStruts]
    designs = draws(loop, 5)
    np.testing.assert_allclose(block.evaluate(designs[:, ::-1]), loop.evaluate(designs), rtol=1e-10)


STRUTS = ("front.spring", "front.damper", "rear.spring", "rear.damper", "front_antiroll")


def ready(p: RideProblem) -> OneStrut | ManyStruts:
    (case,) = p.scores.kernel(p.nodes).cases
    return case


def sizes(p: RideProblem) -> list[int]:
    """Return the number of struts in each block."""
    return sorted(ready(p).sizes[:, 0].tolist())


def test_left_and_right_alike_make_two_blocks_of_two_struts():
    measures = ("ACC", "SWS", "DTL")
    middle = Seat(mass=80.0, spring=12e3, damper=700.0, position=(0.3, 0.0), name="driver")
    assert sizes(problem(FULL, STRUTS, measures)) == [2, 2]
    assert sizes(problem(middle.on(FULL), STRUTS, measures)) == [2, 2]
    assert sizes(problem(middle.on(FULL), (*STRUTS, "driver.spring"), measures)) == [2, 3]
    assert sizes(problem(DRIVER.on(FULL), STRUTS, measures)) == [4]
    assert sizes(problem(DRIVER.on(FULL), (*STRUTS, "driver.damper"), measures)) == [5]
    assert sizes(problem(HALF, STRUTS[:4], measures)) == [2]
    uncoupled = replace(HALF, pitch_inertia=HALF.body_mass * HALF.cg_to_front * HALF.cg_to_rear)
    assert sizes(problem(uncoupled, STRUTS[:4], measures)) == [2]  # the road couples front and rear


def test_only_blocks_that_are_heard_are_kept():
    assert sizes(problem(FULL, STRUTS, ("body_acceleration", "pitch_acceleration"))) == [2]
    assert sizes(problem(FULL, STRUTS, ("body_acceleration", "roll_acceleration"))) == [2, 2]


def test_responses_alike_left_and_right_are_worked_out_once():
    measures = tuple(f"{end}_{side}_tyre_load" for end in ("front", "rear") for side in ("left", "right"))
    assert ready(problem(FULL, STRUTS, measures)).channel.tolist() == [0, 0, 1, 1]
    assert ready(problem(DRIVER.on(FULL), STRUTS, measures)).channel.tolist() == [0, 1, 2, 3]


def unpaired(struts: list[str], contact_points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.eye(len(struts)), np.eye(len(contact_points))


@pytest.mark.parametrize("vehicle", [FULL, DRIVER.on(FULL)])
def test_pairing_changes_no_value(vehicle):
    p = problem(vehicle, STRUTS, ("ACC", "SWS", "DTL", "roll_acceleration", "ACC (1, 0.5)"))
    (case,), designs = p.cases, draws(p, 4)
    terms = [term for measure in p.measures for term in measure.in_case(case, "Wk").terms]
    setting = vehicle.coefficients({**p.struts, **dict(zip(p.variables, designs[0].tolist(), strict=True))})
    paired, plain = (
        case_of(case, terms, setting, p.variables, p.band, p.nodes, pairs) for pairs in (pairs_of, unpaired)
    )
    assert plain.sizes[:, 0].tolist() == [4]
    np.testing.assert_allclose(plain(designs), paired(designs), rtol=1e-9)


NAMES = st.sampled_from(["left", "right", "a_left", "a_right", "left_right", "right_left", "right_right", "x"])
PLACES = st.tuples(st.sampled_from([-1, 0, 1]), st.sampled_from([-1, 0, 1]))


@given(st.lists(NAMES, unique=True), st.lists(PLACES))
def test_sums_and_differences_are_orthogonal_whatever_the_names(struts, points):
    for matrix in pairs_of(struts, np.reshape(points, (len(points), 2))):
        np.testing.assert_allclose(matrix @ matrix.T, np.eye(len(matrix)), atol=1e-15)


@settings(max_examples=10)
@given(st.floats(-1, 1), st.floats(0.05, 0.6))
def test_left_and_right_swapped_swaps_the_responses(x, y):
    seats = [Seat(mass=80.0, spring=12e3, damper=700.0, position=(x, side * y)) for side in (1, -1)]
    measures = ("ACC seat", "ACC (1, 0.3)", "SWS front_left", "DTL rear_left", "ACC", "DTL", "roll_acceleration")
    mirrored = tuple(text.replace("left", "right").replace("0.3", "-0.3") for text in measures)
    varied = ("front.spring", "rear_antiroll")
    one, other = (
        problem(seat.on(FULL), varied, texts) for seat, texts in zip(seats, (measures, mirrored), strict=True)
    )
    designs = draws(one, 2)
    np.testing.assert_allclose(one.evaluate(designs), other.evaluate(designs), rtol=1e-9)


def test_any_mix_of_load_cases_has_a_kernel():
    light, heavy = DRIVER.on(FULL), DRIVER.on(replace(FULL, body_mass=1600.0))
    fixed = {"rear": (23e3, 1700.0), "front.damper": 1500.0}
    settings = {"bounds": {"front.spring": BOXES["front.spring"]}, "struts": fixed, "band": BAND, "nodes": 256}
    settings["measures"] = ("ACC", "SWS")
    driven = [LoadCase(vehicle=car, road=ROAD, speed=speed) for car, speed in ((light, 15.0), (heavy, 25.0))]
    same = RideProblem(cases=driven, **settings)
    design = np.array([2e4])
    np.testing.assert_array_equal(call_compiled(same.kernel, design), same.evaluate([design])[0])
    empty = LoadCase(vehicle=FULL, road=ROAD, speed=20.0)
    mixed = RideProblem(cases=[driven[0], empty], **settings)
    np.testing.assert_array_equal(call_compiled(mixed.kernel, design), mixed.evaluate([design])[0])
