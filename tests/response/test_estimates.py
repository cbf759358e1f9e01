"""Spectra by Welch's method: of white noise that of its variance, within the interval in 95 % of the bands."""

import re

import numpy as np
import pytest
from scipy import stats

from suspension_ctrl.response.estimates import Estimate, intervals, mean_squares, third_octaves, welch

STEP = 0.01


def test_third_octaves_are_those_of_the_standard():
    """IEC 61260-1: middles 10^(n/10), edges at 10^(+-1/20) of them; 0.5 to 20 Hz are 17 bands."""
    edges = third_octaves((0.5, 20.0))
    np.testing.assert_allclose(edges[1:] / edges[:-1], 10**0.1, rtol=1e-12)
    assert len(edges) == 18
    np.testing.assert_allclose(np.sqrt(edges[:-1] * edges[1:])[[0, 3, 16]], [0.501187, 1.0, 19.952623], rtol=1e-6)
    for band, message in (
        ((0.0, 20.0), "lower end of band must be finite and > 0 Hz, got 0.0"),
        ((1.05, 1.1), "band must hold the middle of a third octave, got (1.05, 1.1)"),
        ((3.0, 1.0), "band must be finite with 0 <= lower < upper [Hz], got (3.0, 1.0)"),
    ):
        with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
            third_octaves(band)


def test_mean_squares_of_straight_spectra():
    """Of S = f from a to b it is (b^2 - a^2)/2, also between lines."""
    f = np.array([0.0, 1.0, 2.5, 9.0])
    found = mean_squares(f, np.column_stack([f, 2 * f]), [0.5, 1.2, 7.0])
    np.testing.assert_allclose(found[:, 0], [(1.44 - 0.25) / 2, (49 - 1.44) / 2], rtol=1e-12)
    np.testing.assert_allclose(found[:, 1], 2 * found[:, 0], rtol=1e-12)
    with pytest.raises(ValueError, match=r"^spectra must reach from 0.5 to 12 Hz, got 0 to 9 Hz$"):
        mean_squares(f, f[:, None], [0.5, 12.0])


def test_the_interval_of_white_noise_holds_its_variance_in_nineteen_of_twenty_bands():
    """Two-sided 95 % in 600 bands: 570 +- 3 sqrt(28.5), neighbours being all but independent."""
    edges = third_octaves((0.5, 20.0))[-13:]
    noise = np.random.default_rng(3).standard_normal((20_000, 50))
    estimate = welch(noise, STEP, edges)
    measured, limits = mean_squares(estimate.f, estimate.psd, edges), intervals(estimate, edges)
    true = 2 * STEP * np.diff(edges)[:, None]
    inside = (measured * limits[0] <= true) & (true <= measured * limits[1])
    assert measured.shape == (12, 50)
    assert abs(inside.sum() - 570) < 3 * 28.5**0.5 + 600 * 0.01


def test_a_mean_does_not_count():
    noise = np.random.default_rng(3).standard_normal((20_000, 1))
    one, other = (welch(noise + offset, STEP, np.array([1.0, 20.0])).psd for offset in (0.0, 9.81))
    np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)


def test_spectra_that_are_given_have_no_interval():
    f = np.arange(1.0, 30.0)
    assert np.isnan(intervals(Estimate(f, f[:, None]), np.array([2.0, 4.0]))).all()


@pytest.mark.parametrize(
    ("count", "edges", "segment", "message"),
    [
        (5_000, [1.0, 60.0], None, "time must have steps of 0.008333 s at most, got 0.01 s"),
        (5_000, [1.0, 1.1], None, "time must last 120 s for a band of 0.1 Hz, got 50 s"),
        (5_000, [1.0, 20.0], 60.0, "segment must be a number from 0.08 to 50"),
    ],
)
def test_histories_too_short_or_coarse(count, edges, segment, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        welch(np.zeros((count, 1)), STEP, np.array(edges), segment)


def test_periodograms_of_segments_that_overlap_count_less_than_independent_ones():
    """The variance of the spectrum of white noise is its square over `averages`: of 60 000 values to 2 %, where
    the overlap makes 5 %."""
    estimate = welch(np.random.default_rng(4).standard_normal((1600, 600)), STEP, np.array([1.0, 20.0]), 2.0)
    inner = estimate.psd[1:-1]
    variance = inner.var(axis=1).mean() / inner.mean() ** 2
    assert variance * estimate.averages == pytest.approx(1.0, rel=0.02)


def test_a_flat_band_has_two_degrees_of_freedom_for_each_hertz_and_second():
    """The interval is that of 2 T B on average, over 50 histories to 1 % where the mean of S^2 makes 3 %."""
    noise = np.random.default_rng(3).standard_normal((20_000, 50))
    low, high = intervals(welch(noise, STEP, np.array([1.0, 20.0]), 25.0), np.array([1.0, 20.0]))
    free = 2 * 200.0 * 19.0
    expected = free / stats.chi2.ppf(0.025, free) - free / stats.chi2.ppf(0.975, free)
    assert (high - low).mean() == pytest.approx(expected, rel=0.01)


def test_a_band_within_a_line_has_the_degrees_of_freedom_of_one_line():
    f = np.arange(1.0, 30.0)
    found = intervals(Estimate(f, np.ones((29, 1)), 10.0, 8.0), np.array([2.0, 2.1]))[:, 0, 0]
    np.testing.assert_allclose(found, 16 / stats.chi2.ppf([0.975, 0.025], 16), rtol=1e-12)
