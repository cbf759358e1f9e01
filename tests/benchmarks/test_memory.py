"""Peaks of memory of readers, in a short form."""

import sys

import numpy as np
import pytest

import memory
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.profile_files import load_profile


@pytest.mark.filterwarnings("ignore::suspension_ctrl.ProfileWarning")
@pytest.mark.parametrize("name", memory.kinds())
def test_files_of_the_asked_size_are_read(name, tmp_path):
    kind = memory.kinds()[name]
    path = tmp_path / f"file{kind.ending}"
    kind.write(path, 0.2)
    assert sum(one.stat().st_size for one in tmp_path.iterdir()) == pytest.approx(0.2e6, rel=0.2)
    if kind.reader == "profile":
        assert np.ptp(load_profile(path).height) > 0.019
    else:
        histories, step = read_accelerations(path)
        assert step == pytest.approx(0.005)
        assert all(np.ptp(one) > 0.019 for one in histories.values())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="VmHWM is of Linux")
def test_a_peak_is_at_least_what_is_returned():
    """Distance and height of 1.3 million points, 8 bytes each."""
    peak = memory.measured(memory.kinds()["profile, CSV"], 20.0)
    assert peak.size == pytest.approx(20.0, rel=0.01)
    assert 2 * 8 * 1.3 < peak.memory < 10 * 20
    assert memory.table({"a": peak}).splitlines()[2].startswith("| a | 20 |")
