"""Equilibrium of a vehicle: laws on the segments that carry it."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import QUARTER

STANDS = sc.parallel(
    sc.TableSpring(deflection=[-0.1, -0.02, 0.0, 0.1], force=[-9e3, -500.0, 0.0, 1e3]), sc.Damper(value=1500.0)
)


def test_a_payload_rests_on_the_segment_that_carries_it():
    """1 kN is beyond the knot at -20 mm: 500 N there, then 8.5 kN over 80 mm."""
    laden = sc.Payload(mass=1e3 / 9.80665).on(replace(QUARTER, strut=STANDS))
    level = sc.Profile([0.0, 1.0, 2.0], np.zeros((3, 1)))
    travel = sc.simulate(laden, {}, level, 1.0)["suspension_travel [m]"].to_numpy()
    assert travel == pytest.approx(-0.02 - 500.0 * 0.08 / 8.5e3, rel=1e-9)
