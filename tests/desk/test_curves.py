"""Tables of force: of linear dampers and of force laws, at the element."""

import numpy as np

from suspension_ctrl import DigressiveDamper, QuarterCar, ReboundStop, Spring, parallel
from suspension_ctrl.desk.curves import DEFLECTIONS, RATES, curves_of, force_of
from suspension_ctrl.desk.parts import parts_of

LAW = DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1, rebound_over_bump=2.0)
STOP = ReboundStop(gap=0.05, stiffness=1e5)


def car(*elements):
    one = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=parallel(Spring(), *elements))
    return one, parts_of(
        one,
        one.coefficients({"spring": 20e3, "damper.low_speed": 2000.0} if LAW in elements else {"spring": 20e3}),
    )


def test_a_force_law_has_the_values_of_the_setting():
    _, parts = car(LAW, STOP)
    damper, stop = curves_of(parts)
    assert (damper.part, damper.of_rate, stop.part, stop.of_rate) == ("damper", True, "rebound_stop", False)
    np.testing.assert_array_equal(damper.x[len(RATES) :], RATES)
    np.testing.assert_allclose(damper.force, LAW.tension(damper.x, low_speed=2000.0), rtol=1e-12)
    np.testing.assert_allclose(stop.force[-len(DEFLECTIONS) :], [0, 0, 1e3, 3e3, 5e3], atol=1e-9)


def test_a_linear_damper_is_a_straight_line_and_a_linear_spring_has_none():
    one = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5)
    parts = parts_of(one, one.coefficients((20e3, 1500.0)))
    (curve,) = curves_of(parts)
    np.testing.assert_allclose(curve.force, 1500.0 * curve.x)
    np.testing.assert_allclose(force_of(parts[1], np.array([-2.0])), [-3000.0])
