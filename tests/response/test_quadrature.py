import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.response.quadrature import frequency_nodes, in_lanes


@given(st.floats(0, 5), st.floats(0.1, 100), st.integers(0, 12))
def test_half_integer_powers_are_integrated_exactly(low, width, half_power):
    """With u = sqrt(f) the integrand f^(p/2) df is 2 u^(p+1) du, a polynomial that 10 nodes integrate exactly."""
    high, p = low + width, half_power / 2
    f, w = frequency_nodes((low, high), 10)
    np.testing.assert_allclose((f**p * w).sum(), (high ** (p + 1) - low ** (p + 1)) / (p + 1), rtol=1e-12)


def test_error_falls_geometrically_with_the_nodes():
    """A resonance 1/(a^2 + (f-1)^2): the logarithm of the error falls in proportion to the nodes."""
    a = 0.15

    def error(nodes):
        f, w = frequency_nodes((0.0, 20.0), nodes)
        exact = (np.arctan(19 / a) + np.arctan(1 / a)) / a
        return abs((w / (a**2 + (f - 1) ** 2)).sum() / exact - 1)

    assert error(100) < 0.05
    assert error(200) < error(100) ** 1.6
    assert error(400) < max(error(200) ** 1.6, 1e-13)


def test_kinks_at_panel_edges_do_no_harm():
    f, w = frequency_nodes((0.0, 10.0), 52, breakpoints=(3.0, 7.0, 12.0))
    assert f.size == 54
    assert (np.diff(f) > 0).all()
    np.testing.assert_allclose((np.abs(f - 3) * w).sum(), (9 + 49) / 2, rtol=1e-12)


@pytest.mark.parametrize("band", [(20.0, 0.1), (-1.0, 20.0), (1.0, 1.0), (0.0, float("inf"))])
def test_rejects_impossible_bands(band):
    with pytest.raises(ValueError, match=r"^band must be finite with 0 <= lower < upper \[Hz\], got"):
        frequency_nodes(band, 100)


@pytest.mark.parametrize(("n", "filled"), [(1, 8), (8, 8), (9, 24), (200, 200), (256, 264)])
def test_nodes_fill_an_odd_number_of_eights_without_weight(n, filled):
    f, w = frequency_nodes((0.1, 20.0), max(n, 2))
    f, w = f[:n], w[:n]
    found, weights, densities = in_lanes(f, w, np.array([w, 2 * w]))
    assert found.shape == weights.shape == (filled,)
    assert (np.diff(found) >= 0).all()
    np.testing.assert_array_equal(densities, [weights, 2 * weights])
    assert weights.sum() == pytest.approx(w.sum(), rel=1e-15)
