"""Runs on disk: whole or not at all, of one plan and one process, and the very numbers that went in."""

import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl.study.store import FolderStore, NotStoredError, Remembered, SpoiltRunWarning, StoredRun

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
    with pytest.raises(ValueError, match=r"^seeds must be 3 as in '.*plan.json' to resume there, got 4$"):
        FolderStore(tmp_path, {"seeds": 4, "numpy": "2.4"})


@pytest.mark.parametrize(
    ("file", "spoil", "said"),
    [
        (
            "runs/one.csv",
            lambda path: path.write_bytes(path.read_bytes()[:-4]),
            "must be as it was stored, got oth",
        ),
        ("final/one.csv", lambda path: path.unlink(), "must be a regular file"),
        ("records/one.json", lambda path: path.write_text("[]"), "must hold numbers of rows and digests"),
        (
            "records/one.json",
            lambda path: path.write_text(path.read_text().replace("2", "3", 1)),
            "must have 3 rows, got 2",
        ),
    ],
)
def test_a_spoilt_run_is_named_and_absent(tmp_path, file, spoil, said):
    store = FolderStore(tmp_path, {})
    store["one"], store["two"] = RUN, RUN
    spoil(tmp_path / file)
    with pytest.warns(SpoiltRunWarning) as caught:
        again = FolderStore(tmp_path, {})
    (text,) = (str(warning.message) for warning in caught)
    assert "one." in text
    assert said in text
    assert text.endswith("; the run is repeated")
    assert list(again) == ["two"]
    again["one"] = RUN
    assert list(FolderStore(tmp_path, {})) == ["one", "two"]  # without a further warning
    assert (tmp_path / "records" / "one.json.spoilt").exists()


def test_a_run_of_which_only_half_is_there_is_named(tmp_path):
    FolderStore(tmp_path, {})["one"] = RUN
    (tmp_path / "records" / "one.json").unlink()
    with pytest.warns(SpoiltRunWarning, match=r"one.csv: a part of the run is missing; the run is repeated$"):
        assert list(FolderStore(tmp_path, {})) == []


def test_a_run_spoilt_while_the_folder_is_open_is_an_error_when_it_is_read(tmp_path):
    store = FolderStore(tmp_path, {})
    store["one"] = RUN
    (tmp_path / "runs" / "one.csv").write_text("evaluations\n1\n")
    with pytest.raises(ValueError, match=r"one.csv: must be as it was stored, got other 14 bytes$"):
        store["one"]


def test_what_cannot_be_written_is_named_and_what_was_finished_is_kept(tmp_path, monkeypatch):
    store = FolderStore(tmp_path, {})
    store["one"] = RUN
    renamed, replace = [], os.replace

    def once(temporary, path):
        if renamed:
            raise OSError(28, "No space left on device")
        renamed.append(path)
        replace(temporary, path)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", once)
        with pytest.raises(
            NotStoredError, match=r"^\[Errno 28\] .*two.csv'; finished runs are kept: start again wi"
        ):
            store["two"] = RUN
    assert [path.name for path in renamed] == ["two.csv"]
    with pytest.warns(SpoiltRunWarning, match="a part of the run is missing"):
        assert list(FolderStore(tmp_path, {})) == ["one"]


def test_of_many_short_runs_one_a_second_is_flushed_to_the_disk(tmp_path, monkeypatch):
    store, flushed, now = FolderStore(tmp_path, {}), [], [100.0]
    monkeypatch.setattr(os, "fsync", flushed.append)
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    counts = []
    for i, moment in enumerate((100.0, 100.9, 101.0, 101.5, 102.0)):
        now[0] = moment
        store[f"run {i}"] = RUN
        counts.append(len(flushed))
    files = 3 + 3 * (os.name == "posix")  # and their folders
    assert counts == [files, files, 2 * files, 2 * files, 3 * files]
    assert len(FolderStore(tmp_path, {})) == 5


def test_a_store_forgets_what_is_deleted(tmp_path):
    store = FolderStore(tmp_path, {})
    store["one"] = RUN
    assert len(store) == 1
    del store["one"]
    assert "one" not in store
    with pytest.raises(KeyError):
        store["one"]


def test_another_process_is_refused_until_the_store_is_gone(tmp_path):
    program = f"from pathlib import Path; from {FolderStore.__module__} import *; FolderStore(Path('.'), {{}})"
    command = [sys.executable, "-c", program]
    store = FolderStore(tmp_path, {})
    assert list(FolderStore(tmp_path / ".." / tmp_path.name, {})) == []  # by another path, in this process
    refused = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert f"is in use by process {os.getpid()} on " in refused.stderr.splitlines()[-1]
    del store
    assert subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).returncode == 0


def test_what_is_remembered_is_read_once(tmp_path):
    """A run that was made here is not read at all: its file may be spoilt."""
    FolderStore(tmp_path, {})["one"] = RUN
    store = Remembered(FolderStore(tmp_path, {}))
    store["two"] = RUN
    assert store["one"].final.equals(RUN.final)
    for path in (tmp_path / "final").iterdir():
        path.write_text("spoilt")
    assert [store[name].final.equals(RUN.final) for name in store] == [True, True]
    del store["one"]
    assert (list(store), len(store), "one" in store) == (["two"], 1, False)
    with pytest.raises(KeyError):
        store["one"]
