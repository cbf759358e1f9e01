"""Courses beside the profiles and events that they are taken from."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL
from suspension_ctrl.response.motion.courses import Passage, distance_at, road_at, time_at

SPEEDS = {
    "constant": np.array([[0.0, 12.0]]),
    "faster": np.array([[0.0, 5.0], [6.0, 15.0]]),
    "from a stand, to a slow stretch": np.array([[0.0, 0.0], [2.0, 8.0], [3.0, 8.0], [5.0, 1.0]]),
}


def elevations(passage: Passage, time: np.ndarray) -> np.ndarray:
    knots, pieces = passage.course
    i = np.clip(np.searchsorted(knots, time, side="right") - 1, 0, len(pieces) - 1)
    return np.einsum("krp,kp->kr", pieces[i], (time - knots[i])[:, None] ** np.arange(4))


@pytest.mark.parametrize("name", SPEEDS)
def test_wheels_follow_the_profile_at_any_speed(name):
    speed, contacts = SPEEDS[name], FULL.contact_points
    tracks = tuple(np.unique(contacts[:, 1]).tolist())
    profile = sc.Iso8608Road("C").profile(40.0, 0.1, 1, tracks)
    passage = Passage.over_profile(profile, contacts, speed, periodic=False)
    time = np.random.default_rng(1).uniform(0.0, passage.time[-1], 500)
    at = profile.distance[0] - contacts[:, 0].min() + distance_at(speed, time)
    expected = [profile.at(at + x)[:, tracks.index(y)] for x, y in contacts.tolist()]
    np.testing.assert_allclose(elevations(passage, time), np.transpose(expected), rtol=0, atol=1e-12)
    height, _ = road_at(passage.course, passage.time)
    np.testing.assert_allclose(height, elevations(passage, passage.time), atol=1e-12)
    assert passage.distance[-1] + contacts[:, 0].max() <= profile.distance[-1] + 1e-9


@pytest.mark.parametrize("name", SPEEDS)
def test_times_are_the_inverse_of_distances(name):
    distance = np.linspace(0.0, 50.0, 101)
    np.testing.assert_allclose(distance_at(SPEEDS[name], time_at(SPEEDS[name], distance)), distance, atol=1e-9)


@pytest.mark.parametrize("name", SPEEDS)
def test_a_raised_cosine_is_met_to_1e_6(name):
    """A cubic through four points of a 64th of a wave is within (2 pi/64)^4/1944 = 4.8e-8 of its amplitude."""
    bump, speed, contacts = sc.SpeedBump(height=0.05, length=2.0), SPEEDS[name], FULL.contact_points
    passage = Passage.over_event(bump, contacts, speed)
    time = np.random.default_rng(2).uniform(0.0, passage.course.knots[-1], 2000)
    place = distance_at(speed, time)[:, None] - (contacts[:, 0].max() - contacts[:, 0])
    np.testing.assert_allclose(elevations(passage, time), bump.height_at(place), rtol=0, atol=2e-9)


def test_on_a_kink_the_rate_is_the_mean_of_both_sides():
    profile = sc.Profile([0.0, 1.0, 2.0, 3.0], np.array([[0.0], [0.0], [0.2], [0.2]]))
    passage = Passage.over_profile(profile, np.zeros((1, 2)), np.array([[0.0, 100.0]]), periodic=False)
    kinks = np.isclose(passage.time, 0.01) | np.isclose(passage.time, 0.02)
    _, rate = road_at(passage.course, passage.time)
    np.testing.assert_allclose(rate[kinks, 0], 10.0)
