"""Data files are found in a checkout; `test_packaging` finds them in a wheel."""

import pytest

from suspension_ctrl import datafiles


def test_files_are_found_and_read():
    assert datafiles.path("paper/table1_vehicle.csv").is_file()
    assert "jian_2022_full" in datafiles.stems("vehicles")
    rows = datafiles.rows("standards/iso8041_wk_wb_table.csv")
    assert not any(name.startswith("#") for name in rows[0])
    assert len({len(row) for row in rows}) == 1


def test_a_file_that_is_none_is_told():
    with pytest.raises(FileNotFoundError, match=r"^data file 'nowhere' must be in '.*data'$"):
        datafiles.path("nowhere")
