"""Profiles: elevation between the points, and CSV files that come back to the last bit."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import Iso8608Road, Profile
from suspension_ctrl.roads.profiles import read_profile, write_profile

ROAD = Iso8608Road("C")


def written(folder: Path, text: str) -> Path:
    path = folder / "p.csv"
    path.write_text(text, encoding="utf-8")
    return path


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


@pytest.mark.parametrize("tracks", [(0.0,), (0.75, -0.75), (1.0, 0.125, -1e-5), (0.3,)])
def test_profiles_come_back_to_the_last_bit(tmp_path, tracks):
    profile = Iso8608Road("C").profile(32.0, 0.1, 1, tracks)
    write_profile(tmp_path / "p.csv", profile)
    back = read_profile(tmp_path / "p.csv")
    np.testing.assert_array_equal(back.distance, profile.distance)
    np.testing.assert_array_equal(back.height, profile.height)
    assert back.tracks == tracks


def test_left_and_right_are_half_the_width_from_the_middle(tmp_path):
    text = "# Source: none\ndistance [m],left [m],right [m]\n\n0,1,2\n0.1,3,4\n0.2,5,6\n"
    profile = read_profile(written(tmp_path, text), track_width=1.5)
    assert profile.tracks == (0.75, -0.75)
    np.testing.assert_array_equal(profile.height, [[1, 2], [3, 4], [5, 6]])


def test_a_profile_that_cannot_be_written_leaves_the_one_before(tmp_path, monkeypatch):
    """The disk is full half way: the file is the old one, and no other file is left behind."""
    path = tmp_path / "p.csv"
    write_profile(path, Profile([0, 1, 2], np.zeros((3, 1))))
    before = path.read_bytes()

    def full(frame, target, **options):
        Path(target).write_text("distance [m],hei", encoding="utf-8")
        raise OSError("No space left on device")

    monkeypatch.setattr(pd.DataFrame, "to_csv", full)
    with pytest.raises(OSError, match="No space left"):
        write_profile(path, Profile([0, 1, 2], np.ones((3, 1))))
    assert path.read_bytes() == before
    assert [one.name for one in tmp_path.iterdir()] == ["p.csv"]
