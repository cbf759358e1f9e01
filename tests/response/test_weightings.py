import csv
import pickle
import re
from pathlib import Path

import control
import numpy as np
import pytest

from suspension_ctrl import datafiles, weighting
from suspension_ctrl.response import weightings

# ISO 8041-1, Table 1: factor at the reference angular frequency [rad/s]
REFERENCE = {
    "Wb": (100, 0.8126), "Wc": (100, 0.5145), "Wd": (100, 0.1261), "We": (100, 0.06287),
    "Wf": (2.5, 0.3888), "Wh": (500, 0.2020), "Wj": (100, 1.019), "Wk": (100, 0.7718), "Wm": (100, 0.3362),
}  # fmt: skip


def printed(value: float) -> float:
    """A factor to the four significant digits in which the standard prints it."""
    return float(f"{value:.4g}")


@pytest.mark.parametrize("name", weightings.filters())
def test_filters_equal_the_standard_at_its_reference_frequency(name):
    omega, factor = REFERENCE[name]
    assert printed(abs(weighting(name)(1j * omega))) == factor


def annex_b(name: str) -> list[tuple[int, float]]:
    """Bands and design-goal factors of a weighting in Tables B.1 to B.9."""
    lines = (Path(__file__).parent / "iso8041_annex_b.csv").read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return [(int(row["band"]), float(row[name])) for row in rows if row[name]]


@pytest.mark.parametrize("name", weightings.filters())
def test_filters_equal_annex_b_of_the_standard_to_its_digits(name):
    goals = annex_b(name)
    assert len(goals) == {"Wf": 21, "Wh": 38}.get(name, 37)
    for band, factor in goals:
        assert printed(abs(weighting(name)(2j * np.pi * 10 ** (band / 10)))) == factor, band


@pytest.mark.parametrize("name", ["Wk", "Wb"])
def test_filters_equal_the_standards_table_to_its_digits(name):
    for row in datafiles.rows("standards/iso8041_wk_wb_table.csv"):
        f = 10 ** (int(row["band"]) / 10)
        assert printed(abs(weighting(name)(2j * np.pi * f))) == float(row[name.lower()]), row


@pytest.mark.parametrize("name", ["Wk", "Wb"])
def test_table_and_filter_agree_between_the_bands(name):
    """Straight lines in log-log between third octaves miss the curve by up to h^2/8 times its curvature."""
    f = np.geomspace(0.1, 100, 3001)
    table, filter_ = (weightings.by_name(n).factor(f) for n in (f"{name}-table", name))
    log_filter, step = np.log(filter_), np.log(f[1] / f[0])
    curvature = np.abs(np.diff(log_filter, 2)).max() / step**2
    bound = curvature * (np.log(10) / 10) ** 2 / 8 + 0.5e-3  # and half a unit of the last printed digit
    assert np.abs(np.log(table) - log_filter).max() < bound


def test_table_goes_on_beyond_its_ends():
    inside, outside = (
        weightings.by_name("Wk-table").factor([0.1, 10**-0.9]),
        weightings.by_name("Wk-table").factor([0.05]),
    )
    slope = np.log(inside[1] / inside[0]) / np.log(10**0.1)
    np.testing.assert_allclose(outside, inside[0] * 0.5**slope, rtol=1e-12)


def test_unknown_weightings_are_named():
    for call in (weighting, weightings.by_name):
        with pytest.raises(ValueError, match=r"^weighting must be one of Wk, Wd, .*got 'Wx'"):
            call("Wx")
    with pytest.raises(ValueError, match="got 'Wk-table'"):
        weighting("Wk-table")


def test_a_returned_filter_can_be_changed_without_harm():
    weighting("Wk").num[0][0][:] = 0
    assert abs(weighting("Wk")(2j * np.pi)) > 0.4


def test_weightings_of_any_system_are_equal_by_its_numbers_and_picklable():
    """A transfer function, its state space and its response at lines: the same factor, three values."""
    filter_, lines = weighting("Wk"), 2 * np.pi * np.geomspace(0.05, 100, 2000)
    measured = control.frd(filter_(1j * lines), lines)
    f = np.geomspace(0.1, 50, 40)
    kinds = [weightings.SystemWeighting.of(system) for system in (filter_, control.ss(filter_), measured)]
    for kind, rtol in zip(kinds, (1e-14, 1e-9, 1e-6), strict=True):
        again = pickle.loads(pickle.dumps(kind))
        assert (again, hash(again)) == (kind, hash(kind))
        for one in (kind, again):
            np.testing.assert_allclose(one.factor(f), np.abs(filter_(2j * np.pi * f)), rtol=rtol)
    assert len(set(kinds)) == 3


def test_any_system_is_a_weighting_by_its_magnitude():
    """Equal where the numbers are, whatever it is called; measured ones between their lines."""
    filter_, f = weightings.weighting("Wk"), np.geomspace(0.5, 20.0, 50)
    lines = 2 * np.pi * np.linspace(0.4, 21.0, 2000)
    for system in (filter_, control.ss(filter_), control.frd(filter_(1j * lines), lines)):
        one, other = (weightings.checked(system.copy(name=name)) for name in ("a", "b"))
        assert one == other
        assert hash(one) == hash(other)
        assert (str(one), one.breakpoints) == ("a", ())
        np.testing.assert_allclose(one.factor(f), weightings.by_name("Wk").factor(f), rtol=1e-7)
    assert weightings.checked(filter_) != weightings.checked(2 * filter_)
    assert filter_.name == "Wk"


@pytest.mark.parametrize(
    ("system", "message"),
    [
        (control.rss(2, 2, 1), "weighting must have one input and one output in continuous time, got 1 and 2"),
        (
            control.tf([1], [1, 1], 0.1),
            "weighting must have one input and one output in continuous time, got 1 and 1",
        ),
        (3.0, "weighting must be one of Wk, Wd, Wf, Wc, We, Wj, Wb, Wm, Wh, Wk-table, Wb-table, got 3.0"),
    ],
)
def test_what_is_no_weighting(system, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        weightings.checked(system)
