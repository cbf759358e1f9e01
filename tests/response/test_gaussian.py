"""Force laws under a Gaussian: against quadrature, and closed forms."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import norm

from suspension_ctrl.response.gaussian import normal, of_lines, of_power


def curve_of(knots, slopes, jumps):
    found = np.zeros((1, 3, len(slopes)))
    found[0, 0, : len(knots)], found[0, 1], found[0, 2, : len(jumps)] = knots, slopes, jumps
    return found


def force(x, knots, slopes, jumps):
    """The curve as an integral of its slopes from the origin."""
    edges = np.concatenate([[-np.inf], knots, [np.inf]])
    total = 0.0
    for slope, low, high in zip(slopes, edges[:-1], edges[1:], strict=True):
        total += slope * (np.clip(x, low, high) - np.clip(0.0, low, high))
    for knot, jump in zip(knots, jumps, strict=True):
        total += jump * (np.heaviside(x - knot, 0.5) - np.heaviside(-knot, 0.5))
    return total


def test_the_normal_distribution_is_that_of_scipy():
    """Absolute errors of two roundings; in the tail the terms of Taylor's series are larger than their sum."""
    z = np.linspace(-10.0, 10.0, 4001)
    above, density = np.transpose([normal(one) for one in z])
    np.testing.assert_allclose(above, norm.sf(z), rtol=0, atol=4e-16)
    np.testing.assert_allclose(density, norm.pdf(z), rtol=0, atol=4e-16)
    tail = (z > 0) & (z < 8.9)
    np.testing.assert_allclose(above[tail], norm.sf(z[tail]), rtol=1e-12)
    assert np.isnan(normal(np.nan)[0])


@settings(max_examples=60, deadline=None)
@given(
    knots=st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=4, unique=True).map(sorted),
    slopes=st.lists(st.floats(0.0, 5e3), min_size=5, max_size=5),
    jumps=st.lists(st.sampled_from([0.0, 100.0]), min_size=4, max_size=4),
    mean=st.floats(-0.5, 0.5),
    s=st.floats(0.05, 2.0),
)
def test_moments_of_lines_are_integrals(knots, slopes, jumps, mean, s):
    """E[F] and E[(x - m) F]/s^2 by adaptive quadrature between the knots, to 1e-10 of the largest force."""
    k = len(knots)
    law = (np.array(knots), slopes[: k + 1], jumps[:k])
    f, slope, _ = of_lines(curve_of(*law), 0, k, mean, s)
    density = norm(mean, s)
    edges = np.unique(np.clip([mean - 12 * s, *knots, 0.0, mean + 12 * s], mean - 12 * s, mean + 12 * s))

    def integral(weight):
        parts = pairwise(edges)
        return sum(
            quad(lambda x: weight(x) * force(x, *law) * density.pdf(x), a, b, epsabs=1e-12, epsrel=1e-12)[0]
            for a, b in parts
        )

    scale = 5e3 * (abs(mean) + 12 * s) + 400.0
    assert f == pytest.approx(integral(lambda _: 1.0), abs=1e-10 * scale)
    assert slope == pytest.approx(integral(lambda x: (x - mean) / s**2), abs=1e-10 * scale / s)


@settings(max_examples=40, deadline=None)
@given(knot=st.floats(0.01, 1.0), slopes=st.tuples(*[st.floats(1.0, 5e3)] * 3), s=st.floats(0.05, 2.0))
def test_the_change_of_the_slope_is_its_derivative(knot, slopes, s):
    """Central differences over ln s: their error is of the order of 1e-4 squared."""
    law = curve_of([-knot, knot], slopes, [50.0, 50.0])
    low, high = (of_lines(law, 0, 2, 0.0, s * np.exp(h))[1] for h in (-1e-4, 1e-4))
    assert of_lines(law, 0, 2, 0.0, s)[2] == pytest.approx(
        (high - low) / 2e-4, rel=1e-6, abs=1e-5 * (max(slopes) + 50 / s)
    )


@pytest.mark.parametrize("s", [0.05, 0.4, 2.0])
def test_closed_forms(s):
    """Coulomb sqrt(2/pi) F/s; bilinear (c+ + c-)/2 and (c+ - c-) s/sqrt(2 pi); quadratic, cubic."""
    root = np.sqrt(2 / np.pi)
    assert of_lines(curve_of([0.0], [0.0, 0.0], [2 * 40.0]), 0, 1, 0.0, s)[:2] == pytest.approx((0, root * 40 / s))
    bilinear = of_lines(curve_of([0.0], [750.0, 2250.0], [0.0]), 0, 1, 0.0, s)
    assert bilinear[:2] == pytest.approx((1500 * s / np.sqrt(2 * np.pi), 1500.0))
    assert of_power(3e3, 2.0, s) == pytest.approx((2 * root * 3e3 * s, 2 * root * 3e3 * s), rel=1e-14)
    assert of_power(3e3, 3.0, s) == pytest.approx((3 * 3e3 * s**2, 6 * 3e3 * s**2), rel=1e-14)
    assert of_power(3e3, 1.0, s) == pytest.approx((3e3, 0.0), rel=1e-14)


def test_ever_finer_tables_of_a_quadratic_damper_converge_to_its_closed_form():
    """A straight line between points h apart is off by h^2/8 of the second derivative: four times less each."""
    errors = []
    for n in (20, 40, 80, 160):
        v = np.linspace(-4.0, 4.0, 2 * n + 1)
        slopes = np.diff(2e3 * v * np.abs(v)) / np.diff(v)
        found = of_lines(curve_of(v[1:-1], slopes, np.zeros(2 * n - 1)), 0, 2 * n - 1, 0.0, 0.4)[1]
        errors.append(abs(found - of_power(2e3, 2.0, 0.4)[0]))
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2.0, atol=0.1)
