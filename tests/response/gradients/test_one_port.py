"""Derivatives around one strut with force laws beside complex steps through the working point."""

import pytest

import suspension_ctrl as sc
from one_strut_car import check

DIGRESSIVE = sc.DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1, rebound_over_bump=1.7)
STOP = sc.BumpStop(gap=0.02, stiffness=60e3)
MOUNT = sc.Spring("mount", 200e3)
LAWS = {
    "a digressive damper": (DIGRESSIVE,),
    "friction and a power": (sc.PowerDamper(force=5e3, exponent=1.6), sc.Friction(force=40.0)),
    "a stop": (sc.Damper("own", 1500.0), STOP),
    "a damper that pulls the car down on a stop": (sc.BilinearDamper(bump=750.0, rebound=2250.0), STOP),
    "a law on a mount": (sc.series(DIGRESSIVE, MOUNT, installation_ratio=0.9), STOP),
    "a stop on a spring": (
        DIGRESSIVE,
        sc.series(sc.Spring("top", 1.5e5), sc.parallel(sc.Spring("aux", 3e4), STOP)),
    ),
}


@pytest.mark.parametrize("name", LAWS)
def test_laws_as_near_as_the_working_point(name):
    """The iteration ends where deviations change by less than 1e-8; a further step is taken from there."""
    check(LAWS[name], 1e-7)
