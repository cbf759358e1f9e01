"""Shapes along the road: areas under a tyre with any contact length, and places of wheels."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import suspension_ctrl as sc

CONTACTS = np.array([(1.3, 0.75), (1.3, -0.75), (-1.4, 0.75), (-1.4, -0.75)])
SHAPES = {
    "speed bump": sc.SpeedBump(height=0.05, length=2.0),
    "averaged speed bump": sc.SpeedBump(height=0.05, length=2.0, contact_length=0.15),
    "table": sc.TrapezoidalBump(height=0.08, length=3.0, ramp=0.9),
    "triangle": sc.TrapezoidalBump(height=0.08, length=1.0, ramp=0.5, contact_length=0.1),
    "plank": sc.Plank(height=0.03, length=0.3),
    "cleat": sc.Cleat(height=0.02, length=0.025, contact_length=0.11),
    "pothole": sc.Pothole(depth=0.06, length=0.5),
}
AREAS = {
    "speed bump": 0.05 * 2.0 / 2, "averaged speed bump": 0.05 * 2.0 / 2, "table": 0.08 * (3.0 - 0.9),
    "triangle": 0.08 / 2, "plank": 0.03 * 0.3, "cleat": 0.02 * 0.025, "pothole": -0.06 * 0.5,
}  # fmt: skip


def integral(f, shape) -> float:
    """Return the integral over a shape, by pieces between its places."""
    return sum(quad(f, *piece, epsabs=1e-12)[0] for piece in pairwise(shape.places))


@pytest.mark.parametrize("name", SHAPES)
def test_a_contact_of_any_length_keeps_the_area(name):
    assert integral(SHAPES[name].height_at, SHAPES[name]) == pytest.approx(AREAS[name], rel=1e-9)


@pytest.mark.parametrize("name", SHAPES)
def test_the_area_is_the_integral_of_the_point_height(name):
    shape = SHAPES[name]
    for x in (0.02, 0.31, 0.97, 2.5):
        pieces = [*(c for c in shape.corners if c < x), x]
        found = sum(quad(shape.point_height, *p)[0] for p in pairwise(pieces))
        assert shape.area(np.array(x)) == pytest.approx(found, rel=1e-9)


@pytest.mark.parametrize("name", SHAPES)
def test_the_road_is_level_before_and_after_a_bump(name):
    shape = SHAPES[name]
    assert not shape.height_at([-5.0, -1e-9, shape.places[-1] + 1e-9, 50.0]).any()


def test_rear_wheels_follow_by_the_wheelbase_and_sides_meet_their_own_obstacles():
    bump = sc.SpeedBump(height=0.05, length=2.0)
    time = np.linspace(-0.1, 0.6, 57)
    z = bump.elevation(time, CONTACTS, 10.0)
    np.testing.assert_array_equal(z[:, 0], bump.height_at(10.0 * time))
    np.testing.assert_allclose(z[:, 2], bump.height_at(10.0 * (time - 0.27)), atol=1e-15)
    np.testing.assert_allclose(bump.knots(CONTACTS, 10.0), [0.0, 0.2, 0.27, 0.47], rtol=1e-12)
    hole = sc.Pothole(depth=0.06, length=0.5, side="left").elevation(time, CONTACTS, 10.0)
    assert hole[:, 0].min() == hole[:, 2].min() == pytest.approx(-0.06)
    assert not hole[:, [1, 3]].any()
    assert sc.Plank(height=0.02, length=0.3, side="right").elevation(time, np.zeros((1, 2)), 10.0).any()


@pytest.mark.parametrize(
    ("make", "values", "key", "got"),
    [
        (sc.SpeedBump, {"height": 0.05, "length": -1.0}, "length", "-1"),
        (sc.SpeedBump, {"height": float("nan"), "length": 1.0}, "height", "nan"),
        (sc.SpeedBump, {"height": 0.05, "length": 1.0, "side": "middle"}, "side", "middle"),
        (sc.TrapezoidalBump, {"height": 0.05, "length": 1.0, "ramp": 0.6}, "ramp", "0.6"),
        (sc.Plank, {"height": 0.05, "length": 1.0, "contact_length": 0.0}, "contact_length", "0.0"),
        (sc.Sine, {"height": 0.05, "length": 1.0, "waves": 1.2}, "waves", "1.2"),
        (sc.Sine, {"height": 0.05, "length": 1.0, "waves": 0.0}, "waves", "0.0"),
        (sc.Chirp, {"height": 0.05, "longest": 1.0, "shortest": 2.0, "waves": 5.0}, "shortest", "2"),
    ],
)
def test_a_wrong_number_is_named(make, values, key, got):
    with pytest.raises(ValueError, match=rf"^{key} .*got .*{got}"):
        make(**values)
