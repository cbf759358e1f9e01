"""Springs and stops with force laws: stiffness, and values that are not allowed."""

import re

import numpy as np
import pytest

import suspension_ctrl as sc


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: sc.TableSpring(deflection=[0, 1, 2], force=[0, 1]), "deflection and force must be of one length"),
        (lambda: sc.TableSpring(deflection=[0.1, 1], force=[0.1, 1]), "got deflection from 0.1 to 1"),
        (lambda: sc.BumpStop(gap=-0.1), "gap must be finite and > 0 m, got -0.1"),
        (lambda: sc.BumpStop(gap=0.1, compression=[0, 1]), "stop must have a stiffness, or compression and force"),
        (lambda: sc.BumpStop(compression=[1, 2], force=[0, 1]), "must begin with 0 m and 0 N, got 1 m and 0 N"),
    ],
)
def test_bad_springs_and_stops_are_one_line(make, error):
    with pytest.raises(ValueError, match=re.escape(error)):
        make()


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        (sc.TableSpring(deflection=[-0.1, 0.0, 0.1], force=[-3000.0, 0.0, 1000.0]), [20e3, 40e3]),
        (sc.TableSpring(deflection=[-0.1, -0.05, 0.1], force=[-2000.0, -500.0, 1000.0]), [10e3, 20e3]),
        (sc.BumpStop(gap=0.02, stiffness=1e5), [0.0, 0.0]),
    ],
)
def test_the_static_stiffness_of_a_spring_or_a_stop_is_its_slope_at_the_origin(law, expected):
    values = {one.name: np.array([1.0, 2.0]) * (one.default or 1.0) for one in law.coefficients}
    np.testing.assert_allclose(np.broadcast_to(law.static_stiffness(values), 2), expected, rtol=1e-12)
