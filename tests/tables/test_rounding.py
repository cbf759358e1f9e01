"""Rounded columns: significant digits, alike in a column of like sizes, blank without a value."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.tables.rounding import rounded


@pytest.mark.parametrize(
    ("cells", "texts"),
    [
        ([0.12345, 1.5], ["0.1235", "1.5"]),
        ([0.62345, 1.5], ["0.623", "1.500"]),
        ([2.9999, 155.0], ["3.000", "155"]),
        ([12389.2, 22000.0], ["12389", "22000"]),
        ([22000.0, 1.5, 0.0287], ["22000", "1.5", "0.0287"]),
        ([1.0, 2.0], ["1", "2"]),
        ([float("nan"), 2.25, None, "x", 3], ["", "2.25", "", "x", "3"]),
        ([1e-12, 0.5], ["1.000e-12", "0.5"]),
        ([float("inf"), -3.21], ["inf", "-3.21"]),
        ([True, "text"], ["True", "text"]),
        ([], []),
        ([0.0, 0.0], ["0", "0"]),
    ],
)
def test_cells_of_a_column(cells, texts):
    assert rounded(cells) == texts


def test_decimals_may_be_given():
    assert rounded([1.0, float("nan"), 2.345], decimals=2) == ["1.00", "", "2.35"]
    assert rounded([123.456], digits=2) == ["123"]
    assert rounded([-0.04, -1.0], decimals=1) == ["0.0", "-1.0"]


@given(st.lists(st.floats(-1e12, 1e12), min_size=1, max_size=6))
def test_a_rounded_number_is_the_number(cells):
    """Within half a unit of its last significant digit, of the largest in a column of like sizes."""
    largest = max(map(abs, cells))
    for cell, text in zip(cells, rounded(cells), strict=True):
        assert abs(float(text) - cell) <= 5.01e-4 * max(abs(cell), min(largest, 10 * abs(cell)))
