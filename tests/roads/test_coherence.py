"""Models of coherence, the isotropic one beside integrals over its surface's spectrum."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import j1, jn_zeros

from suspension_ctrl import PowerLawRoad, TwoSlopeRoad
from suspension_ctrl.roads.coherence import Constant, Exponential, Isotropic, Tabulated, coherence_matrix

WAVENUMBERS = np.array([0.001, 0.02, 0.1, 0.3, 1.5])
ROAD = PowerLawRoad(roughness=1e-6, exponent=2.0)


def isotropic_by_quadrature(road, n: float, distance: float) -> float:
    """Coherence 1 - 2 pi d/G(n) int_0^inf G(sqrt(n^2 + m^2)) J_1(2 pi d m) dm (Dodds and Robson 1973).

    The partial sums between the zeros of J_1 alternate about the integral; averaging 40 of them repeatedly
    leaves less than the 1e-12 to which each is integrated.
    """

    def integrand(m: float) -> float:
        return road.psd(np.hypot(n, m), 1.0) * j1(2 * np.pi * distance * m)

    edges = np.concatenate([[0], jn_zeros(1, 60)]) / (2 * np.pi * distance)
    corner = getattr(road, "corner", 0.0)
    kinks = [n, 3 * n, 10 * n, 100 * n, np.sqrt(max(corner**2 - n**2, 0))]
    points = np.unique([*edges, *(kink for kink in kinks if kink < edges[-1])])
    panels = [quad(integrand, a, b, epsabs=0, epsrel=1e-12)[0] for a, b in pairwise(points)]
    sums = np.cumsum(panels)[np.searchsorted(points, edges[21:]) - 1]
    while sums.size > 1:
        sums = (sums[1:] + sums[:-1]) / 2
    return 1 - 2 * np.pi * distance * sums[0] / road.psd(n, 1.0)


@pytest.mark.parametrize(
    "road",
    [
        ROAD,
        PowerLawRoad(roughness=5e-6, exponent=2.5),
        TwoSlopeRoad(roughness=1e-6, reference=0.2, lower_exponent=1.5, upper_exponent=2.8, corner=0.2),
        TwoSlopeRoad(roughness=1e-6, reference=0.2, lower_exponent=3.0, upper_exponent=2.0, corner=0.15),
    ],
)
def test_isotropic_coherence_equals_the_integral_over_the_surface(road):
    """Both to 1e-11 or better, the trapezoidal rule of the two slopes exp(-pi^2/0.3) and rounding."""
    by_quadrature = [isotropic_by_quadrature(road, n, 1.5) for n in WAVENUMBERS]
    np.testing.assert_allclose(road.isotropic_coherence(WAVENUMBERS, 1.5), by_quadrature, rtol=0, atol=1e-10)


def test_isotropic_coherence_of_exponents_with_elementary_bessel_functions():
    """K_1/2(z) = sqrt(pi/2z) exp(-z), so that exponent 1 gives exp(-z) and exponent 3 (1 + z) exp(-z)."""
    z = 2 * np.pi * WAVENUMBERS * 1.6
    for exponent, by_hand in ((1.0, np.exp(-z)), (3.0, (1 + z) * np.exp(-z))):
        np.testing.assert_allclose(Isotropic(exponent).between(WAVENUMBERS, 1.6), by_hand, rtol=1e-12)


def test_isotropic_coherence_is_that_of_a_two_dimensional_surface():
    """Phi ~ (n^2 + m^2)^-3/2 for exponent 2: int Phi cos(2 pi m d) dm over int Phi dm with u = m/n, to 1e-8."""
    for n in WAVENUMBERS:
        cross, _ = quad(lambda u: (1 + u**2) ** -1.5, 0, np.inf, weight="cos", wvar=2 * np.pi * n * 1.5)
        assert abs(ROAD.isotropic_coherence(np.array([n]), 1.5)[0] - cross) < 1e-8  # int (1 + u^2)^-3/2 du = 1


@given(st.floats(1e-12, 1e3), st.floats(1e-6, 1e3), st.floats(0.1, 8), st.floats(0.1, 8), st.floats(1e-4, 10))
def test_coherence_stays_from_zero_to_one(n, distance, lower, upper, corner):
    road = TwoSlopeRoad(
        roughness=1e-6, reference=corner, lower_exponent=lower, upper_exponent=upper, corner=corner
    )
    gamma = road.isotropic_coherence(np.array([n]), distance)
    assert 0 <= gamma[0] <= 1
    if n * distance < 1e-12 and lower >= 1:
        assert gamma[0] > 1 - 1e-9


def test_alike_slopes_are_one_power_law():
    same = TwoSlopeRoad(roughness=1e-6, reference=0.1, lower_exponent=2, upper_exponent=2, corner=0.2)
    near = TwoSlopeRoad(roughness=1e-6, reference=0.1, lower_exponent=2, upper_exponent=2 + 1e-9, corner=0.2)
    law = ROAD.isotropic_coherence(WAVENUMBERS, 1.5)
    np.testing.assert_array_equal(same.isotropic_coherence(WAVENUMBERS, 1.5), law)
    np.testing.assert_allclose(near.isotropic_coherence(WAVENUMBERS, 1.5), law, rtol=1e-7)


def test_simple_models():
    np.testing.assert_allclose(Exponential(3.0).between(WAVENUMBERS, 1.5), np.exp(-4.5 * WAVENUMBERS), rtol=1e-15)
    np.testing.assert_array_equal(
        Exponential(0.0).between(WAVENUMBERS, 1.5), Constant(1).between(WAVENUMBERS, 1.5)
    )
    table = Tabulated((0.1, 0.3), (0.8, 0.2), 1.5)
    np.testing.assert_allclose(table.between(np.array([0.05, 0.1, 0.2, 0.3, 9.0]), 1.5), [0.9, 0.8, 0.5, 0.2, 0.2])
    np.testing.assert_allclose(table.between(np.array([0.1, 0.3]), 3.0), [0.8**2, 0.2**2], rtol=1e-12)
    exponential, knots = Exponential(3.0), np.linspace(0.05, 1.0, 20)
    measured = Tabulated(tuple(knots), tuple(exponential.between(knots, 1.5)), 1.5)
    np.testing.assert_allclose(measured.between(knots, 0.4), exponential.between(knots, 0.4), rtol=1e-12)


@given(
    st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3),
    st.lists(st.floats(0.6, 1.1), min_size=2, max_size=3, unique=True),
)
def test_a_measured_coherence_is_of_a_road_under_axles_of_any_track(values, halves):
    """However it scatters: a power of the distance is positive definite, as of a Markov process across."""
    model, y = Tabulated((0.1, 0.2, 0.3), tuple(values), 1.5), np.array([*halves, *(-half for half in halves)])
    matrix = coherence_matrix(model.between, np.linspace(0.0, 0.4, 9), y)
    assert np.linalg.eigvalsh(matrix).min() > -1e-12


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Isotropic(0.0), "exponent must be a number from 0.01 to 20.0, got 0.0"),
        (lambda: Exponential(-1.0), "decay must be a number from 0.0 to 1000000.0, got -1.0"),
        (lambda: Exponential(np.inf), "decay must be a number from 0.0 to 1000000.0, got inf"),
        (lambda: Constant(1.1), "value must be a number from 0.0 to 1.0, got 1.1"),
        (lambda: Tabulated((0.1,), (0.5,), 0.0), "distance must be finite and > 0 m, got 0.0"),
        (
            lambda: Tabulated((0.1,), (0.5, 0.4), 1.0),
            r"wavenumber and coherence must be of one length, got \(1,\)",
        ),
        (
            lambda: Tabulated((0.2, 0.1), (0.5, 0.4), 1.0),
            "wavenumber must be finite, above zero and ascend, got 0.1 in row 2",
        ),
        (lambda: Tabulated((0.1, 0.2), (0.5, 1.4), 1.0), "coherence must be from 0 to 1, got 0.5 to 1.4"),
    ],
)
def test_rejects_impossible_models(make, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        make()


@pytest.mark.parametrize(
    "make",
    [
        lambda n, d: np.full(n.shape, 1.2),
        lambda n, d: np.full(n.shape, -0.1),
        lambda n, d: np.full(n.shape, np.nan),
        lambda n, d: np.full(n.shape, 0.5j),
        lambda n, d: 0.5,
    ],
)
def test_rejects_what_is_no_coherence(make):
    with pytest.raises(ValueError, match=r"^coherence must be real, from 0 to 1 and of shape \(5,\), got [^\n]*$"):
        coherence_matrix(make, WAVENUMBERS, np.array([0.0, 1.5]))


def test_rejects_coherences_of_no_road():
    """Neighbours all alike and the outer two strangers: an eigenvalue of 1 - sqrt(2)."""
    with pytest.raises(ValueError, match=r"^coherence must make a positive semi-definite matrix, got [^\n]*$"):
        coherence_matrix(lambda n, d: np.full(n.shape, float(d < 1)), WAVENUMBERS, np.array([0.0, 0.8, 1.6]))
