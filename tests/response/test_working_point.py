"""The working point is reached, whatever the laws and their coefficients."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from suspension_ctrl.response.linearisation import working_points
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.measures.terms import Term

LAWS = ["digressive", "friction", "stop", "cubic", "rebound"]
POSITIVE = st.floats(0.1, 10.0)


@settings(max_examples=40, deadline=None)
@given(
    laws=st.lists(
        st.sampled_from(["digressive", "friction", "stop", "cubic", "rebound"]), min_size=1, unique=True
    ),
    factors=st.lists(POSITIVE, min_size=6, max_size=6),
    roughness=st.sampled_from("ACEG"),
    mounted=st.booleans(),
)
def test_a_working_point_is_found(laws, factors, roughness, mounted):
    known = {
        "digressive": sc.DigressiveDamper(low_speed=3e3 * factors[0], high_speed=800 * factors[1], knee=0.1),
        "friction": sc.Friction(force=50.0 * factors[2]),
        "stop": sc.BumpStop(gap=0.03 * factors[3], stiffness=1e5 * factors[4]),
        "cubic": sc.PowerDamper("cubic", force=3e3 * factors[5], exponent=3.0),
        "rebound": sc.ReboundStop(gap=0.05 * factors[3], stiffness=1e5),
    }
    parts = [known[name] for name in laws]
    if mounted:
        parts[0] = sc.series(parts[0], sc.Spring("mount", 2e5))
    strut = sc.parallel(sc.Spring(), sc.Damper("base", 200.0), *parts)
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    case = sc.LoadCase(vehicle=car, road=sc.Iso8608Road(roughness), speed=20.0)
    values = car.coefficients({"spring": 22e3})
    squares = case_of(case, [Term("body_acceleration")], values, ["spring"], (0.1, 20.0), 256)
    points = working_points(squares, np.array([[22e3]]))
    assert 0 < points.iterations[0] < 400


def test_a_cubic_damper_does_not_swing_for_ever():
    """The plain iteration has slope -1 there; the elasticity makes it a step or two."""
    strut = sc.parallel(sc.Spring(), sc.PowerDamper(force=6e3, exponent=3.0))
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    linear = sc.linearised(car, {"spring": 22e3}, sc.Iso8608Road("C"), 20.0, band=(0.1, 20.0))
    assert linear.iterations <= 8
    one = linear.laws["damper"]
    assert one.equivalent == pytest.approx(3 * 6e3 * one.deviation**2, rel=1e-7)
