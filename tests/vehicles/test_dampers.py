"""Dampers with force laws: power laws, and values that are not allowed."""

import re

import numpy as np
import pytest

import suspension_ctrl as sc

NAN = float("nan")


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (
            lambda: sc.TableDamper(velocity=[0, 1], force=[5, 9]),
            "force must be 0 N at velocity 0, got 5 N",
        ),
        (lambda: sc.TableDamper(velocity=[-1, 0, 1], force=[-1, 0, -1]), "force must not fall over velocity"),
        (lambda: sc.TableDamper(velocity=[0, 1, 1], force=[0, 1, 2]), "velocity must ascend, got 1, then 1"),
        (lambda: sc.TableDamper(velocity=[0, 1], force=[0, NAN]), "velocity and force must be finite"),
        (lambda: sc.DigressiveDamper(knee=0.0), "knee must be finite and > 0 m/s, got 0.0"),
    ],
)
def test_bad_dampers_are_one_line(make, error):
    with pytest.raises(ValueError, match=re.escape(error)):
        make()


def test_the_tension_of_a_fluid_damper_is_its_power_law():
    found = sc.PowerDamper(force=5000.0, exponent=2.0).tension([-0.5, 0.0, 0.1], exponent=1.5)
    np.testing.assert_allclose(found, [-5000 * 0.5**1.5, 0.0, 5000 * 0.1**1.5], rtol=1e-15)
