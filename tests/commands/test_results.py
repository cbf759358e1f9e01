import sys
from pathlib import Path

import pytest

from suspension_ctrl.commands import results


def test_new_folders_are_made_and_empty_ones_taken(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert results.results_folder(tmp_path / "a" / "b").is_dir()
    (tmp_path / "empty").mkdir()
    assert results.results_folder(tmp_path / "empty") == tmp_path / "empty"
    names = {results.results_folder(None) for _ in range(3)}  # within one second
    assert len(names) == 3
    assert all(path.parent.name == "results" for path in names)


def test_a_folder_that_can_serve_is_not_made_by_the_check(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    for out in (None, Path("empty"), Path("a/b/c")):
        results.check(out)
    assert [path.name for path in tmp_path.iterdir()] == ["empty"]
    (tmp_path / "empty" / "file").touch()
    with pytest.raises(ValueError, match=r"^out must be a folder that is absent or empty, got 'empty'"):
        results.check(Path("empty"))


def test_folders_that_cannot_serve_are_named(tmp_path):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("kept")
    with pytest.raises(
        ValueError, match=r"^out must be a folder that is absent or empty, got '.*full', which is not"
    ):
        results.results_folder(tmp_path / "full")
    with pytest.raises(
        ValueError, match=r"^out must be a folder that can be written, got '.*mine.txt.*': Not a dir"
    ):
        results.results_folder(tmp_path / "full" / "mine.txt" / "deeper")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="/proc is Linux's")
def test_folders_that_cannot_be_written_are_named():
    """No one may create a folder in /proc, not even root."""
    from pathlib import Path

    with pytest.raises(ValueError, match=r"^out must be a folder that can be written, got '/proc/results'"):
        results.results_folder(Path("/proc/results"))
