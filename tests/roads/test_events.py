"""What every event keeps to: smooth between its knots, level before the first, constant after the last."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import suspension_ctrl as sc

CONTACTS = np.array([(1.3, 0.75), (1.3, -0.75), (-1.4, 0.75), (-1.4, -0.75)])
EVENTS = [
    sc.SpeedBump(height=0.05, length=2.0),
    sc.SpeedBump(height=0.05, length=2.0, contact_length=0.15),
    sc.TrapezoidalBump(height=0.08, length=3.0, ramp=0.9),
    sc.TrapezoidalBump(height=0.08, length=1.0, ramp=0.5, contact_length=0.1),
    sc.Plank(height=0.03, length=0.3),
    sc.Cleat(height=0.02, length=0.025, contact_length=0.11),
    sc.Pothole(depth=0.06, length=0.5, side="left"),
    sc.Step(height=0.05),
    sc.Ramp(height=0.06, length=1.5),
    sc.Sine(height=0.02, length=3.0, waves=2.5),
    sc.Chirp(height=0.02, longest=5.0, shortest=1.0, waves=4.0),
    sc.RigSine(motion="warp", amplitude=0.02, frequency=2.0, waves=3.0),
    sc.RigChirp(motion="pitch", amplitude=0.02, lowest=0.5, highest=5.0, waves=4.0),
]


@given(st.sampled_from(EVENTS), st.floats(1.0, 40.0))
def test_an_event_is_smooth_between_its_knots_and_level_outside(event, speed):
    knots = event.knots(CONTACTS, speed)
    assert knots[0] == 0
    assert (np.diff(knots) > 0).all()
    assert not event.elevation(np.array([-1.0, 0.0]), CONTACTS, speed).any()
    late = event.elevation(knots[-1] * np.array([1 + 1e-9, 2.0, 9.0]), CONTACTS, speed)
    np.testing.assert_allclose(late, np.broadcast_to(late[0], late.shape), rtol=0, atol=1e-12)  # rounding
    for start, end in pairwise(knots):  # of a wave of the finest length: h (2 pi dt / T)^2, h at most 0.08 m
        parts = int(np.ceil(20 * (end - start) / event.finest(speed)))
        height = event.elevation(np.linspace(start, end, parts + 1), CONTACTS, speed)
        assert np.abs(np.diff(height, 2, axis=0)).max(initial=0.0) <= 0.08 * (2 * np.pi / 20) ** 2


def test_a_steady_event_has_the_ends_of_its_period():
    time = np.linspace(-3.0, 5.0, 33)
    for event in (
        sc.Sine(height=0.02, length=3.0),
        sc.RigSine(motion="roll", amplitude=0.02, frequency=2.0),
    ):
        first, period = event.knots(CONTACTS, 7.0)
        assert event.steady
        assert first == 0
        later = event.elevation(time + period, CONTACTS, 7.0)
        np.testing.assert_allclose(event.elevation(time, CONTACTS, 7.0), later, rtol=0, atol=1e-14)


def test_an_obstacle_has_a_speed():
    for ask in (lambda: EVENTS[0].knots(CONTACTS, 0.0), lambda: EVENTS[0].finest(0.0)):
        with pytest.raises(ValueError, match=r"^speed .*got 0"):
            ask()
