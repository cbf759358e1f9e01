"""Profiles: elevation between the points, and CSV files that come back to the last bit."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import Iso8608Road, Profile, international_roughness_index
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


HEIGHTS = [
    0, 271, 550, 902, 1858, 2139, 1318, 1601, 2877, 2498, 2474, 4444, 5638, 4812, 4644, 5139, 3624, 1348, 1088,
    1210, -62, -324, 1193, 1383, 11, -206, -209, -2297, -4341, -4211, -4211, -5285, -4721, -2763, -2523, -3244,
    -2532, -2173, -3815, -4693, -3569, -3128, -3378, -1652, 797, 1188, 1154, 2467, 2724, 1156, 870, 2102, 2139,
    1924, 3761, 5525, 5094, 4775, 5519, 4621,
]  # fmt: skip
"""In micrometres at steps of 0.25 m: a roughness index of 2.9962 mm/m by Sayers' program."""
ROWS = [f"{0.25 * i:.4f},{h * 1e-6:.6f}" for i, h in enumerate(HEIGHTS)]
SPELLINGS = {
    "commas": ["distance [m],height [m]", *ROWS],
    "blanks without names": [row.replace(",", "  ") for row in ROWS],
    "tabs": [row.replace(",", "\t") for row in ["distance [m],height [m]", *ROWS]],
    "semicolons and decimal commas": [
        "distance [m];height [m]", *(row.replace(",", ";").replace(".", ",") for row in ROWS)
    ],
    "a comma at the end": [f"{row}," for row in ["distance [m],height [m]", *ROWS]],
    "a comment by %": ["% measured in steps of 0.25 m", "distance [m],height [m]", *ROWS],
}  # fmt: skip


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_a_profile_is_read_however_it_is_spelt(tmp_path, spelling):
    profile = read_profile(written(tmp_path, "\n".join(SPELLINGS[spelling])))
    np.testing.assert_allclose(profile.height[:, 0], np.multiply(HEIGHTS, 1e-6), rtol=1e-12)
    assert profile.step == 0.25
    (index,) = international_roughness_index(profile).tracks
    assert index == pytest.approx(2.9962, abs=5e-5)  # as many digits as are known


def test_a_table_of_three_columns_without_names_is_no_profile(tmp_path):
    path = written(tmp_path, "0 1 2\n1 2 3\n")
    with pytest.raises(ValueError, match=rf"^{path}: first column must be 'distance \[m\]' .*, got \[\]$"):
        read_profile(path)


PROGRAM = """
import resource, time
import numpy, pandas, suspension_ctrl.roads.profiles as profiles
before, began = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
profile = profiles.read_profile("large.csv")
seconds, after = time.process_time() - began, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(profile.distance.size, seconds, after - before)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the unit of ru_maxrss is Linux's")
def test_a_profile_of_50_megabytes_is_read_in_3_seconds_and_300_megabytes(tmp_path):
    """Measured: 0.9 s of processor time and 175 MB."""
    rows = "".join(f"{i}.0,0.{i % 99999:05d}\n" for i in range(1_000_000, 3_800_000))
    (tmp_path / "large.csv").write_text(f"distance [m],height [m]\n{rows}")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    points, seconds, kilobytes = map(float, done.stdout.split())
    assert points == 2_800_000
    assert seconds < 3
    assert kilobytes < 300e3


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
