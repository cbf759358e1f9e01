"""Events with a level road behind them as periods: levels return to zero, rates at kinks."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.padded_event import PaddedEvent

WHEELS = np.array([(1.3, 0.75), (-1.4, -0.75)])


def test_a_bump_is_followed_by_level_road_and_recurs():
    road = PaddedEvent.of(sc.SpeedBump(height=0.05, length=2.0), WHEELS, 10.0, 3.0)
    assert road.period == road.end == pytest.approx(3.47)
    time = road.times(400)
    assert time[0] == 0
    assert time[-1] < road.period
    np.testing.assert_allclose(road.height(time + road.period), road.height(time), rtol=0, atol=1e-14)
    assert not road.height(time[time > 0.47]).any()


def test_a_step_is_followed_by_its_opposite():
    road = PaddedEvent.of(sc.Step(height=0.05, side="left"), WHEELS, 10.0, 3.0)
    assert road.period == 2 * road.end
    time = np.array([0.005, 1.0, 0.005 + road.end, 1.0 + road.end])
    np.testing.assert_allclose(road.height(time), [[0.025, 0], [0.05, 0], [0.025, 0], [0, 0]], atol=1e-12)


def test_a_rate_is_the_slope_at_a_kink_the_mean():
    road = PaddedEvent.of(sc.Ramp(height=0.1, length=2.0), WHEELS, 10.0, 3.0)
    np.testing.assert_allclose(road.rate(np.array([0.0, 0.1, 0.2, 0.3]))[:, 0], [0.25, 0.5, 0.25, 0.0], atol=1e-9)
