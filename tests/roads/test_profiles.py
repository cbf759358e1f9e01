"""Profiles: elevation between the points, even and uneven."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import Iso8608Road, Profile

ROAD = Iso8608Road("C")


@given(st.floats(0, 31.75))
def test_elevation_between_the_points(distance):
    profile = Profile(np.arange(128) * 0.25, np.stack([np.arange(128.0), -np.arange(128.0)], axis=1), (0.7, -0.7))
    np.testing.assert_allclose(profile.at([distance, 0.0]), [[4 * distance, -4 * distance], [0, 0]], atol=1e-12)


def test_profiles_cannot_be_changed():
    profile = ROAD.profile(32.0, 0.25, 1)
    with pytest.raises(ValueError, match="read-only"):
        profile.height[0] = 1.0


def test_profiles_keep_the_numbers_they_were_given_and_are_equal_by_value():
    height = np.arange(3.0)[:, None]
    profile = Profile([0, 1, 2], height)
    height[:] = 7
    assert profile == Profile([0, 1, 2], [[0], [1], [2]])
    assert hash(profile) == hash(Profile([0, 1, 2], [[0], [1], [2]]))
    assert profile != Profile([0, 1, 2], [[0], [1], [3]])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: Profile([0, 1, 3], [[0], [0], [0]]),
            "distance must be even, each step within 1% of the mean 1.5 m",
        ),
        (lambda: Profile([0, 2, 1], [[0], [0], [0]]), "distance must ascend, got 1.0 out of order"),
        (lambda: Profile([0, 1e-7, 2e-7], [[0], [0], [0]]), "distance must have steps of 1e-06 m at least"),
        (lambda: Profile([0, 1, 2], [[0], [np.nan], [0]]), "height must be finite, got nan"),
        (lambda: Profile([0, 1, 2], [[0, 0], [0, 0], [0, 0]]), "height must have the shape"),
        (lambda: Profile([0], [[0]]), "a profile must have two points and a track"),
        (lambda: ROAD.profile(32.0, 0.25, 1).at(31.8), "distance must lie from 0 to 31.75 m, got 31.8"),
    ],
)
def test_rejects_impossible_profiles(make, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        make()


def test_uneven_points_are_joined_by_straight_lines():
    """The even step divides the mean step until it is no longer than the shortest."""
    distance = np.array([0.0, 1.0, 1.5, 3.0])
    profile = Profile.from_uneven(distance, np.stack([distance**2, -distance], axis=1), (0.5, -0.5))
    assert profile.step == 0.5
    np.testing.assert_allclose(
        profile.height[:, 0], np.interp(np.arange(7) / 2, distance, distance**2), rtol=1e-12
    )
    np.testing.assert_allclose(profile.height[:, 1], -np.arange(7) / 2, rtol=1e-12)
    with pytest.raises(ValueError, match=r"^distance must ascend, got 1.0 out of order$"):
        Profile.from_uneven([0, 2, 1], [[0], [0], [0]])
    with pytest.raises(ValueError, match=r"^height must have the shape \(distances, tracks\), got [^\n]*$"):
        Profile.from_uneven([0, 2, 3], [[0], [0], [0]], (1.0, -1.0))
    tiny = Profile.from_uneven([0, 1e-9, 1.0], [[0], [1], [1]])  # no more than four points for one
    assert tiny.distance.size == 9


def test_a_tyre_averages_over_its_contact():
    """A ramp stays, a sine shrinks by sinc; straight lines between points are averaged exactly."""
    x = np.arange(2000) * 0.01
    profile = Profile(x, np.stack([0.1 * x, np.sin(2 * np.pi * x / 0.5)], axis=1), (0.5, -0.5))
    smooth = profile.averaged(0.125)
    inside = np.round(smooth.distance / 0.01).astype(int)
    assert inside[[0, -1]].tolist() == [7, 1992]
    np.testing.assert_allclose(smooth.height[:, 0], 0.1 * smooth.distance, rtol=1e-9)
    wave = np.sinc(0.125 / 0.5) * np.sinc(0.01 / 0.5) ** 2  # of the contact, and of straight lines between points
    np.testing.assert_allclose(smooth.height[:, 1], wave * profile.height[inside, 1], atol=2e-3)
    spike = Profile([0, 1, 2, 3, 4], [[0], [0], [1], [0], [0]]).averaged(1.0)
    np.testing.assert_allclose(spike.height[:, 0], [1 / 8, 3 / 4, 1 / 8], rtol=1e-12)
    for length in (0.0, 4.0, "1"):
        with pytest.raises(ValueError, match=r"^contact_length must be [^\n]*$"):
            Profile([0, 1, 2, 3, 4], np.zeros((5, 1))).averaged(length)
