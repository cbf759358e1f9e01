"""Shapes along the road: areas, energies and spectra in closed form, the contact of a tyre, places of wheels."""

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


def test_energies_and_spectra_are_those_of_the_closed_forms():
    bump = SHAPES["speed bump"]
    assert integral(lambda x: bump.height_at(x) ** 2, bump) == pytest.approx(3 / 8 * 0.05**2 * 2.0, rel=1e-9)
    n = 0.3  # cycle/m; of h sin^2(pi x/l): h l/2 sinc(n l)/(1 - (n l)^2)
    spectrum = abs(
        integral(lambda x: bump.height_at(x) * np.cos(2 * np.pi * n * x), bump)
        + 1j * integral(lambda x: bump.height_at(x) * np.sin(2 * np.pi * n * x), bump)
    )
    assert spectrum == pytest.approx(0.05 * 1.0 * np.sinc(0.6) / (1 - 0.6**2), rel=1e-9)
    table = SHAPES["table"]  # a rectangle averaged over a flank
    spectrum = abs(
        integral(lambda x: table.height_at(x) * np.cos(2 * np.pi * n * x), table)
        + 1j * integral(lambda x: table.height_at(x) * np.sin(2 * np.pi * n * x), table)
    )
    assert spectrum == pytest.approx(0.08 * 2.1 * abs(np.sinc(n * 2.1) * np.sinc(n * 0.9)), rel=1e-9)


def test_a_contact_makes_a_table_of_a_plank_and_lifts_over_a_cleat_by_its_share():
    x = np.linspace(-0.1, 0.6, 701)
    table = sc.TrapezoidalBump(height=0.03, length=0.4, ramp=0.1)
    np.testing.assert_allclose(SHAPES["plank"].height_at(x), table.height_at(x), rtol=0, atol=1e-15)
    assert SHAPES["cleat"].height_at(x).max() == pytest.approx(0.02 * 0.025 / 0.11, rel=1e-12)


def test_steps_and_ramps_stay_at_their_level():
    step, ramp = sc.Step(height=0.05, contact_length=0.2), sc.Ramp(height=0.05, length=0.2)
    x = np.linspace(-1.0, 3.0, 401)
    np.testing.assert_allclose(step.height_at(x), ramp.height_at(x), rtol=0, atol=1e-15)
    rounded = sc.Ramp(height=0.05, length=0.2, contact_length=0.1).height_at([0.15, 0.3, 9.0])
    np.testing.assert_allclose(rounded, [0.025, 0.05, 0.05], rtol=1e-12)


def test_waves_have_their_amplitude_and_end_at_zero():
    sine = sc.Sine(height=0.01, length=2.0, waves=1.5)
    np.testing.assert_allclose(sine.height_at([0.5, 1.5, 2.5, 3.5]), [0.01, -0.01, 0.01, 0.0], atol=1e-15)
    chirp = sc.Chirp(height=0.01, longest=4.0, shortest=1.0, waves=10.0)
    x = np.linspace(0.0, chirp.places[-1], 100_001)
    height = chirp.height_at(x)
    assert chirp.places[-1] == 16.0
    crossings = x[:-1][np.diff(np.sign(height[:-1]), append=0) != 0]
    local = 2 * np.diff(crossings)  # the wave around the middle of two crossings
    middle = (crossings[1:] + crossings[:-1]) / 2
    np.testing.assert_allclose(1 / local, 0.25 + 0.75 * middle / 16.0, rtol=0.01)  # of neighbouring crossings


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
