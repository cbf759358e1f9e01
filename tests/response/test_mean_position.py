"""Mean positions: a stop in series, a progressive spring and payload, against equations solved by scipy."""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.stats import norm

import suspension_ctrl as sc

CAR = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
ROAD = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)


def mean_of_stop(mean, s, gap, stiffness):
    """E[F] of a stop that is touched at a compression by the gap."""
    z = (gap + mean) / s
    return -stiffness * (s * norm.pdf(z) - (gap + mean) * norm.cdf(-z))


@pytest.mark.parametrize("payload", [0.0, 120.0])
def test_payload_lowers_a_car_onto_its_stop(payload):
    strut = sc.parallel(sc.Spring(), sc.Damper(), sc.BumpStop(gap=0.04, stiffness=150e3))
    car = sc.QuarterCar(**CAR, strut=strut)
    vehicle = sc.Payload(mass=payload).on(car) if payload else car
    linear = sc.linearised(vehicle, {"spring": 22e3, "damper": 1500.0}, ROAD, 20.0, band=(0.1, 20.0))
    stop = linear.laws["bump_stop"]
    balance = brentq(
        lambda m: 22e3 * m + mean_of_stop(m, stop.deviation, 0.04, 150e3) + 9.80665 * payload,
        -0.2,
        0.1,
        xtol=1e-14,
    )
    assert linear.mean_travel[""] == pytest.approx(balance, rel=1e-6, abs=1e-9)
    assert stop.mean == pytest.approx(balance, rel=1e-6, abs=1e-9)


def test_a_stop_in_series_with_a_mount():
    """The force of the stop is that of the mount; the deflections add up to the travel."""
    strut = sc.parallel(
        sc.Spring(), sc.Damper(), sc.series(sc.BumpStop(gap=0.02, stiffness=300e3), sc.Spring("mount", 400e3))
    )
    linear = sc.linearised(
        sc.QuarterCar(**CAR, strut=strut), {"spring": 22e3, "damper": 1500.0}, ROAD, 20.0, band=(0.1, 20.0)
    )
    stop, travel = linear.laws["bump_stop"], linear.mean_travel[""]
    assert stop.force == pytest.approx(mean_of_stop(stop.mean, stop.deviation, 0.02, 300e3), rel=1e-6)
    assert stop.force == pytest.approx(400e3 * (travel - stop.mean), rel=1e-5)
    assert 22e3 * travel + stop.force == pytest.approx(0.0, abs=1e-5 * abs(stop.force))


def test_dampers_in_series_that_are_not_odd_have_no_mean_travel():
    """Beside an inerter their mean force is 0; an odd law has none."""

    def travel(law, other):
        strut = sc.parallel(sc.Spring(), sc.series(law, other))
        car, setting = sc.QuarterCar(**CAR, strut=strut), {"spring": 22e3}
        return sc.linearised(car, setting, ROAD, 20.0, band=(0.1, 20.0)).mean_travel[""]

    odd, skew = sc.BilinearDamper(bump=900.0, rebound=900.0), sc.BilinearDamper(bump=500.0, rebound=1300.0)
    assert np.isnan(travel(skew, sc.Damper("other", 3e3)))
    assert travel(odd, sc.Damper("other", 3e3)) == pytest.approx(0.0, abs=1e-12)
    assert travel(skew, sc.Inerter(value=100.0)) == pytest.approx(0.0, abs=1e-12)


def test_a_spring_that_is_a_table_carries_the_payload():
    """A table of one slope is a spring: it sinks by the weight over the stiffness."""
    spring = sc.TableSpring(deflection=[-0.2, 0.0, 0.2], force=[-4400.0, 0.0, 4400.0])
    car = sc.QuarterCar(**CAR, strut=sc.parallel(spring, sc.Damper()))
    laden = sc.Payload(mass=80.0).on(car)
    linear = sc.linearised(laden, {"damper": 1500.0}, ROAD, 20.0, band=(0.1, 20.0))
    assert linear.mean_travel[""] == pytest.approx(-80.0 * 9.80665 / 22e3, rel=1e-9)
    np.testing.assert_allclose(
        sc.ride(laden, {"damper": 1500.0}, ROAD, 20.0, band=(0.1, 20.0))["value"][:3],
        sc.ride(sc.Payload(mass=80.0).on(sc.QuarterCar(**CAR)), (22e3, 1500.0), ROAD, 20.0, band=(0.1, 20.0))[
            "value"
        ][:3],
        rtol=1e-9,
    )
