"""Curves of a design: what they hold beside python-control is tested with the command that writes them."""

import numpy as np
import pytest

from suspension_ctrl.response.curves import curve_table, design_curves, frequencies


@pytest.mark.parametrize(("band", "low"), [((0.01, 0.05), 0.01), ((0.0, 0.05), 0.005), ((0.0, 20.0), 0.1)])
def test_frequencies_ascend_in_any_band(band, low):
    """Although a logarithmic axis does not begin at 0."""
    f = frequencies(band, 20)
    assert (np.diff(f) > 0).all()
    np.testing.assert_allclose(f[[0, -1]], [low, band[1]], rtol=1e-12)


def test_spectra_give_the_root_mean_squares_of_the_problem(table1_problem):
    """The trapezoidal rule over 4,000 logarithmic frequencies; below 0.1 Hz lie some 1e-4 of the mean squares."""
    names = ["suspension_travel", "body_acceleration", "tyre_load"]
    curves = design_curves(table1_problem, "reference", (22e3, 1500.0), names, 4000)
    rms = {name: np.sqrt(np.trapezoid(density, curves.f)) for name, density in curves.densities.items()}
    acc, sws, dtl = table1_problem.evaluate([[22e3, 1500.0]])[0]
    assert rms["weighted_acceleration"] == pytest.approx(acc, rel=1e-3)
    assert rms["suspension_travel"] == pytest.approx(sws, rel=1e-3)
    assert rms["tyre_load"] == pytest.approx(dtl, rel=1e-3)


def test_an_unweighted_problem_has_no_weighted_curve(table1_problem):
    curves = design_curves(
        table1_problem.replace(weighting=None), "reference", (22e3, 1500.0), ["body_acceleration"], 10
    )
    assert set(curves.densities) == {"body_acceleration"}
    assert "weighted_acceleration PSD [(m/s^2)^2/Hz]" not in curve_table(curves)
