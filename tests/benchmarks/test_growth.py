"""How cost grows: exponents, the end of a line, and the page; the script itself compiles for minutes."""

import numpy as np
import pandas as pd
import pytest

import growth as script
from sections import growth


def timings(curve: str, line: str, exponent: float) -> pd.DataFrame:
    sizes = [1, 10, 100, 1000]
    return pd.DataFrame(
        {"curve": curve, "line": line, "size": sizes, "repeat": 1, "seconds": 1e-6 * np.power(sizes, exponent)}
    )


def test_exponents_are_those_of_the_timings():
    found = growth.exponents(pd.concat([timings("nodes", "a", 1.0), timings("cases", "b", 0.5)]))
    assert found["nodes", "a"] == pytest.approx(1.0)
    assert found["cases", "b"] == pytest.approx(0.5)


def test_a_line_ends_where_it_would_take_too_long():
    line = {size: (lambda: None, 1) for size in (1, 10, 10**12)}
    found = growth.measure({"quick": line}, "nodes", 2, limit=60.0)
    assert sorted(found["size"].unique()) == [1, 10]


def test_functions_of_one_design_and_of_many_are_the_same():
    designs = np.random.default_rng(0).random((5, 4))
    every = growth.all_on_sphere.py_func(designs)
    np.testing.assert_allclose(np.linalg.norm(every, axis=1), 1 + ((designs[:, 2:] - 0.5) ** 2).sum(axis=1))


def test_the_page_tells_growth_and_what_a_cluster_would_take():
    table = pd.concat([timings("designs", "quarter car", 0.0), timings("cases", "full car", 1.0)])
    memory = pd.DataFrame([(script.CALL, 1000, 280.0)], columns=["of", "size", "MB"])
    page = script.page(table, memory, 1e-3, {"processor": "one", "python": "3.11"}, script.QUICK)
    cells = [
        [cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("|")
    ]
    assert ["load cases, per design", "full car", "1 to 1,000", "1,000 µs", "1.00"] in cells
    assert ["2", "8.3 min", "8.3 min"] in cells  # 10^9 designs of a microsecond on two cores
    *plots, legend = script.picture(table).axes
    assert len(plots) == len(growth.CURVES)
    assert legend.get_legend()
