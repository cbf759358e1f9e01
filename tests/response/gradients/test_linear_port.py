"""Derivatives around one strut without force laws beside complex steps."""

import pytest

import suspension_ctrl as sc
from one_strut_car import check

MOUNT = sc.Spring("mount", 200e3)
MEASURED = sc.MeasuredStiffness("bush", frequency=[0.1, 5.0, 30.0], storage=[1e5, 2e5, 3e5], loss=[1e4, 3e4, 3e4])
NETWORKS = {
    "a damper on rubber": sc.series(sc.Damper("own", 1500.0), sc.Rubber("mount", storage=250e3, loss=25e3)),
    "a nested network": sc.series(
        sc.Damper("own", 1500.0),
        sc.parallel(MOUNT, sc.Inerter("mass", 50.0), sc.series(sc.Damper("inner", 400.0), sc.Spring("last", 1e5))),
        installation_ratio=0.8,
    ),
    "measured": sc.series(sc.Damper("own", 1500.0), sc.parallel(MEASURED, sc.Damper("beside", 100.0))),
}


@pytest.mark.parametrize("name", NETWORKS)
def test_networks_to_rounding(name):
    check((NETWORKS[name],), 1e-10)
