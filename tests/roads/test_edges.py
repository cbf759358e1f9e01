"""Vertical edges under a tyre with a contact length."""

import numpy as np
import pytest

import suspension_ctrl as sc


def test_a_contact_makes_a_table_of_a_plank_and_lifts_over_a_cleat_by_its_share():
    x = np.linspace(-0.1, 0.6, 701)
    plank, cleat = sc.Plank(height=0.03, length=0.3), sc.Cleat(height=0.02, length=0.025, contact_length=0.11)
    table = sc.TrapezoidalBump(height=0.03, length=0.4, ramp=0.1)
    np.testing.assert_allclose(plank.height_at(x), table.height_at(x), rtol=0, atol=1e-15)
    assert cleat.height_at(x).max() == pytest.approx(0.02 * 0.025 / 0.11, rel=1e-12)


def test_steps_and_ramps_stay_at_their_level():
    step, ramp = sc.Step(height=0.05, contact_length=0.2), sc.Ramp(height=0.05, length=0.2)
    x = np.linspace(-1.0, 3.0, 401)
    np.testing.assert_allclose(step.height_at(x), ramp.height_at(x), rtol=0, atol=1e-15)
    rounded = sc.Ramp(height=0.05, length=0.2, contact_length=0.1).height_at([0.15, 0.3, 9.0])
    np.testing.assert_allclose(rounded, [0.025, 0.05, 0.05], rtol=1e-12)
