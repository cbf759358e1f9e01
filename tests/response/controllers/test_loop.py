"""Closed loops: struts in place of a controller give back the vehicle; points that no strut force moves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import FULL, HALF, QUARTER, from_roads, struts_of
from suspension_ctrl import Iso8608Road, LoadCase, PowerLawRoad, Term
from suspension_ctrl.response.controllers.actuated import Actuated, dynamics_of
from suspension_ctrl.response.controllers.loop import Loop
from suspension_ctrl.response.controllers.regulator import regulator
from suspension_ctrl.response.controllers.road_model import RoadModel

F = np.array([0.3, 1.1, 4.0, 12.0, 19.0])
TERMS = {
    "quarter": (QUARTER, QUARTER.responses),
    "half": (HALF, HALF.responses),
    "full": (FULL, FULL.responses),
}
INVARIANT = np.sqrt([192e3 / 45.4, 192e3 / (317.5 + 45.4)]) / (2 * np.pi)


def _made(vehicle, names, road, f, weighting=None):
    values = vehicle.coefficients(struts_of(vehicle))
    plant = Actuated.of(vehicle, values, [Term(names[0], weighting), *map(Term, names[1:])])
    sizes = [{"acceleration": 1.0, "travel": 1e4, "load": 1e-6}[vehicle.meanings[name].kind] for name in names]
    case = LoadCase(vehicle=vehicle, road=road, speed=20.0)
    roads = RoadModel.of(case, (0.3, 20.0), falls=plant.load_by_rate, displaced=plant.by_road)
    base = regulator(plant, roads, np.array(sizes), np.full(len(vehicle.struts), 1e-8)).feedback
    return plant, roads, Loop.around(plant, roads, f, base)


@pytest.mark.parametrize("name", TERMS)
def test_struts_in_place_of_a_controller_give_the_closed_vehicle(name):
    vehicle, names = TERMS[name]
    _, _, loop = _made(vehicle, names, Iso8608Road("C"), F)
    values = vehicle.coefficients(struts_of(vehicle))
    struts = dynamics_of(vehicle, values, range(len(vehicle.struts))).stiffness(loop.s)
    found, forces = loop.with_struts(struts)
    expected = from_roads(vehicle, struts_of(vehicle), names, F)
    size = abs(expected).max(axis=(0, 2))[:, None]
    np.testing.assert_allclose(found / size, expected / size, atol=1e-9)
    tensions = from_roads(
        vehicle, struts_of(vehicle), [f"{one}_strut_force".lstrip("_") for one in vehicle.struts], F
    )
    np.testing.assert_allclose(forces, tensions, rtol=1e-7, atol=1e-9 * abs(tensions).max())


@given(st.tuples(*[st.floats(-2.0, 2.0)] * 3), st.sampled_from([2.0, 2.5]), st.sampled_from([None, "Wk"]))
@settings(max_examples=15)
def test_no_controller_moves_the_invariant_points(exponents, exponent, weighting):
    """At (K_t/M_w)^0.5 the acceleration is K_t/M_b, at (K_t/(M_b + M_w))^0.5 the travel -(M_b + M_w)/M_b."""
    vehicle, names = TERMS["quarter"]
    road = PowerLawRoad(roughness=5e-6, exponent=exponent)
    plant, roads, loop = _made(vehicle, names, road, INVARIANT, weighting)
    squares = np.array([1.0, 1e4, 1e-6]) * 10.0 ** np.array(exponents)
    h, _ = loop.regulated(regulator(plant, roads, squares, np.full(1, 1e-9)))
    assert h[0, 0, 0] == pytest.approx(192e3 / 317.5, rel=1e-6)
    assert h[1, 1, 0] == pytest.approx(-(317.5 + 45.4) / 317.5, rel=1e-6)


def test_the_loop_around_other_gains_is_the_same():
    vehicle, names = TERMS["half"]
    plant, roads, loop = _made(vehicle, names, PowerLawRoad(roughness=5e-6, exponent=2.5), F)
    other = Loop.around(plant, roads, F, np.zeros_like(loop.base))
    found = regulator(plant, roads, np.array([2.0, 0.1, 1e4, 2e4, 1e-5, 1e-6]), np.full(2, 1e-8))
    for first, second in zip(loop.regulated(found), other.regulated(found), strict=True):
        np.testing.assert_allclose(first, second, rtol=1e-7, atol=1e-10 * abs(first).max())
