"""Headers of columns: name and unit in square or round brackets, and long headers in a moment."""

import time

import pandas as pd
import pytest

from suspension_ctrl.response.channels import channels_of
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.roads.columns import column
from suspension_ctrl.tables.headers import name_and_unit, readable


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


def test_travel_and_forces_are_read_in_mm_and_kn():
    table = pd.DataFrame({
        "design": ["a"], "spring [N/m]": [22e3], "damper [N s/m]": [1500.0], "SWS [m]": [0.0287],
        "DTL [N]": [1365.0], "ACC [m/s^2]": [2.5], "bar [N m/rad]": [2e4],
    })  # fmt: skip
    assert readable(table).to_dict("records") == [{
        "design": "a", "spring [kN/m]": 22.0, "damper [kN s/m]": 1.5, "SWS [mm]": 28.7, "DTL [kN]": 1.365,
        "ACC [m/s^2]": 2.5, "bar [kN m/rad]": 20.0,
    }]  # fmt: skip


def test_numbers_beside_a_column_of_units_are_scaled_by_it():
    table = pd.DataFrame(
        {"name": ["x", "y"], "Volvo (m)": 1.0, "low": 0.5, "n": [3, 4], "unit": ["m", ""], "share [%]": 1.0}
    )
    assert readable(table).to_dict("list") == {
        "name": ["x", "y"], "Volvo (m)": [1e3, 1.0], "low": [500.0, 0.5], "n": [3, 4], "unit": ["mm", ""],
        "share [%]": [1.0, 1.0],
    }  # fmt: skip
    assert table["low"].tolist() == [0.5, 0.5]
