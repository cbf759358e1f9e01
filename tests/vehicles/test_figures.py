"""The figure of dampers, by its data."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import suspension_ctrl as sc

TABLE = sc.TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -400.0, 0.0, 600.0, 1500.0])
DIGRESSIVE = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_curves_are_those_of_the_laws_and_rows_of_tables_are_marked():
    figure = sc.damper_figure({"measured": TABLE, "found $x$": DIGRESSIVE}, {"class C": 0.2})
    measured, rows, found, _ = figure.axes[0].lines
    v = measured.get_xdata()
    assert (v[0], v[-1]) == (-0.8, 0.8)
    np.testing.assert_allclose(
        measured.get_ydata(), np.interp(v, [-1, -0.1, 0, 0.1, 1], TABLE.force) / 1e3, atol=1e-12
    )
    np.testing.assert_array_equal(rows.get_xdata(), [-0.1, 0.0, 0.1])  # the outer ones are not shown
    np.testing.assert_array_equal(rows.get_ydata(), [-0.4, 0.0, 0.6])
    np.testing.assert_array_equal(found.get_ydata(), DIGRESSIVE.tension(v) / 1e3)
    assert found.get_label() == r"found \$x\$"


def test_a_standard_deviation_is_a_gaussian_and_a_history_a_histogram():
    history = np.random.default_rng(1).normal(0.0, 0.1, 20_000)
    below = sc.damper_figure({"measured": TABLE}, {"simulated": history, "linearised": 0.1}).axes[1]
    density = below.lines[0]
    v, p = density.get_xdata(), density.get_ydata()
    assert np.trapezoid(p, v) == pytest.approx(1.0, abs=1e-3)
    assert np.trapezoid(p * v**2, v) == pytest.approx(0.01, rel=1e-2)
    bars = below.patches
    assert sum(bar.get_height() * bar.get_width() for bar in bars) == pytest.approx(1.0)
    middle = [bar.get_x() + bar.get_width() / 2 for bar in bars]
    np.testing.assert_allclose(
        [bar.get_height() for bar in bars], np.interp(middle, v, p), atol=0.45
    )  # 4 deviations


@pytest.mark.parametrize(
    ("laws", "rates", "message"),
    [
        ({"a": sc.BumpStop(gap=0.1, stiffness=1.0)}, {"b": 0.1}, r"laws must be dampers, got BumpStop\("),
        ({"a": sc.Damper(value=1.0)}, {"b": 0.1}, r"laws must be dampers, got Damper\("),
        ({"a": TABLE}, {}, "rates must be given, one at least, got none"),
        ({"a": TABLE}, {"b": -0.1}, "rates must be finite and > 0 m/s, got -0.1"),
        (
            {"a": TABLE},
            {"b": [0.1, np.nan]},
            r"rates must be standard deviations or histories of finite values, got",
        ),
        ({"a": sc.BilinearDamper(bump=1.0)}, {"b": 0.1}, "damper.rebound must be finite and > 0 N s/m, got nan"),
    ],
)
def test_other_laws_and_rates_are_refused(laws, rates, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        sc.damper_figure(laws, rates)
