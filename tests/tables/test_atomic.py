"""Files of which a reader never sees a part, flushed before they have their names."""

import os

import pandas as pd
import pytest

from suspension_ctrl import tables
from suspension_ctrl.tables import atomic


def half(temporary):
    temporary.write_text("half", encoding="utf-8")
    raise OSError(28, "No space left on device")


def whole(temporary):
    temporary.write_text("whole", encoding="utf-8")


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    target = tmp_path / "table.csv"
    target.write_text("before", encoding="utf-8")
    with pytest.raises(OSError, match=r"No space left on device: '.*table\.csv'$"):
        atomic.write_whole(target, half)
    assert target.read_text(encoding="utf-8") == "before"
    assert os.listdir(tmp_path) == ["table.csv"]
    tables.write_csv(target, pd.DataFrame({"a [m]": [1.5]}))
    assert target.read_text(encoding="utf-8") == "a [m]\n1.5\n"
    assert os.listdir(tmp_path) == ["table.csv"]


def test_of_files_written_together_none_appears_if_one_cannot_be_written(tmp_path):
    with pytest.raises(OSError, match=r"No space left on device: '.*b\.txt'$"):
        atomic.write_together({tmp_path / "a.txt": whole, tmp_path / "b.txt": half})
    assert os.listdir(tmp_path) == []


def test_contents_are_flushed_before_files_have_their_names_and_each_folder_once(tmp_path, monkeypatch):
    events = []
    fsync, replace = os.fsync, os.replace
    monkeypatch.setattr(os, "fsync", lambda number: (events.append("flush"), fsync(number)))
    monkeypatch.setattr(os, "replace", lambda old, new: (events.append(new.name), replace(old, new)))
    atomic.write_together(dict.fromkeys([tmp_path / "a", tmp_path / "b"], whole))
    folders = ["flush"] * (os.name == "posix")
    assert events == ["flush", "flush", "a", "b", *folders]
    events.clear()
    atomic.write_together({tmp_path / "c": whole}, flushed=False)
    assert events == ["c"]
    assert (tmp_path / "c").read_text(encoding="utf-8") == "whole"
