"""Runs on disk: whole or not at all, of one plan, and the very numbers that went in."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import tables
from suspension_ctrl.study.store import FolderStore, StoredRun

RUN = StoredRun(
    pd.DataFrame({"evaluations": [20, 40], "igd_plus": [np.inf, 0.1 + 0.2]}),
    pd.DataFrame({"spring [N/m]": [22e3, 1 / 3], "violation": [0.0, 1e-300]}),
)


def test_a_run_comes_back_to_the_last_bit(tmp_path):
    FolderStore(tmp_path, {})["one"] = RUN
    again = FolderStore(tmp_path, {})["one"]
    pd.testing.assert_frame_equal(again.course, RUN.course, check_exact=True)
    pd.testing.assert_frame_equal(again.final, RUN.final, check_exact=True)


def test_a_folder_belongs_to_one_plan(tmp_path):
    FolderStore(tmp_path, {"seeds": 3, "numpy": "2.4"})
    with pytest.raises(ValueError, match=r"^seeds must be 3 as in '.*plan.json' to go on there, got 4$"):
        FolderStore(tmp_path, {"seeds": 4, "numpy": "2.4"})


def test_what_a_killed_process_left_half_written_is_no_run(tmp_path):
    store = FolderStore(tmp_path, {})
    (tmp_path / "runs" / ".half.csv").write_text("a,b\n1")
    assert list(FolderStore(tmp_path, {})) == list(store) == []
    assert list((tmp_path / "runs").iterdir()) == []


def test_a_run_of_which_only_half_could_be_written_is_no_run(tmp_path, monkeypatch):
    store = FolderStore(tmp_path, {})
    written = []

    def once(path, frame):
        if written:
            raise OSError(28, "No space left on device")
        written.append(path)
        frame.to_csv(path, index=False)

    with monkeypatch.context() as patch:
        patch.setattr(tables, "write_csv", once)
        with pytest.raises(OSError, match="No space left on device"):
            store["one"] = RUN
    assert len(written) == 1
    assert list(FolderStore(tmp_path, {})) == []


def test_a_store_forgets_what_is_deleted(tmp_path):
    store = FolderStore(tmp_path, {})
    store["one"] = RUN
    assert len(store) == 1
    del store["one"]
    assert "one" not in store
    with pytest.raises(KeyError):
        store["one"]
