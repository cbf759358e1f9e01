"""Problems with sky dampers: their bounds, and vehicles without."""

import pytest

import suspension_ctrl as sc
from garage import HALF, QUARTER, ROAD
from suspension_ctrl.desk.skyhook_problems import takes_sky, with_sky

PROBLEM = sc.RideProblem(QUARTER, ROAD, speed=20.0, bounds={"spring": (1e4, 3e4), "damper": (1e3, 5e3)})


def test_sky_dampers_reach_the_largest_bound_of_a_damper():
    assert takes_sky(PROBLEM)
    sky = with_sky(PROBLEM)
    (added,) = set(sky.variables) - set(PROBLEM.variables)
    assert sky.bounds[added] == (0.0, 5e3)
    bounds = {
        f"{axle}.{one}": (1e3, most) for axle, most in (("front", 3e3), ("rear", 4e3)) for one in PROBLEM.bounds
    }
    half = with_sky(PROBLEM.replace(vehicle=HALF, bounds=bounds, band=(0.3, 20.0)))
    assert half.bounds["front.sky"] == half.bounds["rear.sky"] == (0.0, 4e3)
    with pytest.raises(ValueError, match=r"^variables must hold a damper for skyhook, got spring$"):
        with_sky(PROBLEM.replace(bounds={"spring": (1e4, 3e4)}, struts={"damper": 1500.0}))


def test_a_network_takes_none():
    strut = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount", 2e5)))
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    assert not takes_sky(PROBLEM.replace(vehicle=car))
