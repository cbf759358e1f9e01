"""Data files are found in a checkout; `test_packaging` finds them in a wheel."""

from pathlib import Path

import pytest

from suspension_ctrl import datafiles


def test_files_are_found_and_read():
    assert datafiles.path("paper/table1_vehicle.csv").is_file()
    assert "jian_2022_full" in datafiles.stems("vehicles")
    rows = datafiles.rows("standards/iso8041_wk_wb_table.csv")
    assert not any(name.startswith("#") for name in rows[0])
    assert len({len(row) for row in rows}) == 1


@pytest.mark.parametrize(("find", "kind"), [(datafiles.path, "file"), (datafiles.stems, "folder")])
def test_a_name_that_is_none_is_told(find, kind):
    with pytest.raises(FileNotFoundError, match=f"^data {kind} 'nowhere' is neither in the package nor in the"):
        find("nowhere")


def test_a_file_by_its_name_or_its_path(tmp_path):
    known = datafiles.path("vehicles/jian_2022_full.toml")
    assert datafiles.named("vehicle", "vehicles", "jian_2022_full") == known
    assert datafiles.named("vehicle", "vehicles", Path("jian_2022_full")) == known
    assert datafiles.named("vehicle", "vehicles", tmp_path / "mine.toml") == tmp_path / "mine.toml"
    with pytest.raises(
        ValueError, match=r"^vehicle must be one of .*_half, .* or the path of a .toml file, got 'x'$"
    ):
        datafiles.named("vehicle", "vehicles", "x")
