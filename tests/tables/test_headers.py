"""Headers of columns: name and unit in square or round brackets, and long headers in a moment."""

import time

import pytest

from suspension_ctrl.response.channels import channels_of
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.columns import column
from suspension_ctrl.tables.headers import name_and_unit


@pytest.mark.parametrize(
    ("header", "name", "unit"),
    [
        ("z [m/s^2]", "z", "m/s^2"),
        (" seat z ( m/s² ) ", "seat z", "m/s^2"),
        ("z[m/s**2]", "z", "m/s^2"),
        ("a [(m/s^2)^2/Hz]", "a", "(m/s^2)^2/Hz"),
        ("left (LWP) [in]", "left (LWP)", "in"),
        ("z [kN  s/m]", "z", "kN s/m"),
        ("z []", "z", ""),
        ("z", "z", ""),
        ("z]", "z]", ""),
        ("[m", "[m", ""),
        ("[m]", "", "m"),
        ("", "", ""),
    ],
)
def test_a_header_is_a_name_and_a_unit(header, name, unit):
    assert name_and_unit(header) == (name, unit)


HEADERS = ["z" + " " * 60_000 + "x", *("z " * 30_000 + end for end in "[x"), "z [" * 20_000 + "]", "z_" * 30_000]


@pytest.mark.parametrize("header", HEADERS, ids=range(len(HEADERS)))
def test_the_longest_header_takes_a_moment(tmp_path, header):
    """The time of a search that goes back over the blanks is hours; that of the reader of tables is some ms."""
    began = time.process_time()
    column(header)
    path = tmp_path / "long.csv"
    path.write_text(f"time [s],{header}\n0,1\n1,2\n", encoding="utf-8")
    for read in (read_accelerations, lambda path: channels_of(path, None)):
        with pytest.raises(ValueError, match=r"long.csv: [^\n]{1,500}$"):
            read(path)
    assert time.process_time() - began < 2
