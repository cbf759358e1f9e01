import dataclasses
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import special

from suspension_ctrl import Iso8608Road, PowerLawRoad, TwoSlopeRoad
from suspension_ctrl.roads.coherence import Constant, Exponential, Isotropic

TWO_SLOPES = TwoSlopeRoad(roughness=20e-6, reference=0.1, lower_exponent=3.0, upper_exponent=2.25, corner=0.2)
ROADS = [PowerLawRoad(roughness=5e-6, exponent=2.5), Iso8608Road("C"), TWO_SLOPES]
FOUR = [[1.3, 0.75], [1.3, -0.75], [-1.3, 0.74], [-1.3, -0.74]]


def test_table1_spectrum():
    """Yuen and Ramli 2010, Table 1: 5e-6 V^1.5 / f^2.5, at 1 Hz and 4 Hz by hand."""
    road = PowerLawRoad(roughness=5e-6, exponent=2.5)
    np.testing.assert_allclose(
        road.psd([1.0, 4.0], speed=20.0), [5e-6 * 89.4427191, 5e-6 * 89.4427191 / 32], rtol=1e-9
    )


@given(st.floats(1e-9, 1), st.floats(1.1, 4), st.floats(1, 60), st.floats(0.01, 1), st.floats(1.1, 10))
def test_variance_between_two_wavelengths_does_not_depend_on_speed(roughness, exponent, speed, n, ratio):
    """The elevation has a variance between two wavenumbers; driving over it spreads it over f = V n."""
    road = PowerLawRoad(roughness=roughness, exponent=exponent)
    x, w = np.polynomial.legendre.leggauss(60)
    log_n = np.log(n) + np.log(ratio) * (x + 1) / 2
    f = speed * np.exp(log_n)
    variance = (road.psd(f, speed) * f * w).sum() * np.log(ratio) / 2
    by_hand = roughness * (n ** (1 - exponent) - (n * ratio) ** (1 - exponent)) / (exponent - 1)
    np.testing.assert_allclose(variance, by_hand, rtol=1e-9)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"roughness": 0.0, "exponent": 2.0}, "roughness must be finite and > 0 m^3, got 0.0"),
        ({"roughness": 1e-6, "exponent": -2.0}, "exponent must be a number from 0.01 to 20.0, got -2.0"),
        ({"roughness": 1e-6, "exponent": 2.5e6}, "exponent must be a number from 0.01 to 20.0, got 2500000.0"),
    ],
)
def test_rejects_impossible_parameters(parameters, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        PowerLawRoad(**parameters)


def test_rejects_impossible_speeds_and_frequencies():
    road = PowerLawRoad(roughness=5e-6, exponent=2.5)
    with pytest.raises(ValueError, match=r"^speed must be finite and > 0 m/s, got -1.0"):
        road.psd([1.0], speed=-1.0)
    with pytest.raises(ValueError, match=r"^f must be > 0 Hz throughout, got a least value of 0.0"):
        road.psd([1.0, 0.0], speed=20.0)


def test_iso_8608_classes():
    """Gd(n0) of ISO 8608: a factor of four from class to class, limits half and twice the mean."""
    for number, name in enumerate("ABCDEFGH"):
        assert Iso8608Road(name).psd(0.1, 1.0) == pytest.approx(16e-6 * 4**number, rel=1e-12)
        if name != "A":
            assert Iso8608Road(name, level="lower").roughness == pytest.approx(8e-6 * 4**number, rel=1e-12)
        if name != "H":
            assert Iso8608Road(name, level="upper").roughness == pytest.approx(32e-6 * 4**number, rel=1e-12)


def test_iso_8608_is_the_power_law_through_its_reference():
    f = np.array([0.3, 2.0, 17.0])
    for waviness in (1.5, 2.0, 3.0):
        law = PowerLawRoad(roughness=256e-6 * 0.1**waviness, exponent=waviness)
        road = Iso8608Road("C", waviness=waviness)
        np.testing.assert_allclose(road.psd(f, 20.0), law.psd(f, 20.0), rtol=1e-12)
        np.testing.assert_array_equal(road.isotropic_coherence(f, 1.5), law.isotropic_coherence(f, 1.5))


def test_two_slopes_are_two_power_laws_that_meet():
    for reference in (0.05, 0.2, 1.0):
        road = TwoSlopeRoad(
            roughness=20e-6, reference=reference, lower_exponent=3.0, upper_exponent=2.25, corner=0.2
        )
        assert road.psd(reference, 1.0) == pytest.approx(20e-6, rel=1e-12)
        n = np.array([0.01, 0.1, 0.2, 0.4, 2.0])
        at_corner = road.psd(0.2, 1.0)
        by_hand = at_corner * np.array([20**3, 2**3, 1, 2**-2.25, 10**-2.25])
        np.testing.assert_allclose(road.psd(25 * n, 25.0) * 25, by_hand, rtol=1e-12)
        assert road.breakpoints(25.0) == (5.0,)


def test_roads_say_which_they_are():
    assert Iso8608Road("C").describe() == (
        "ISO 8608 class C, geometric mean: Gd(0.1 cycle/m) = 256e-6 m^3, waviness 2"
    )
    assert Iso8608Road("H", level="lower").describe() == (
        "ISO 8608 class H, lower: Gd(0.1 cycle/m) = 131072e-6 m^3, waviness 2"
    )
    assert PowerLawRoad(roughness=5e-6, exponent=2.5).describe() == (
        "power law: Gd(1 cycle/m) = 5e-06 m^3, exponent 2.5"
    )
    assert TWO_SLOPES.describe() == (
        "two slopes: Gd(0.1 cycle/m) = 2e-05 m^3, exponent 3 below and 2.25 above 0.2 cycle/m"
    )


@pytest.mark.parametrize("road", ROADS)
@pytest.mark.parametrize("coherence", [Isotropic(), Isotropic(2.0), Exponential(3.0), Constant(0.5)])
def test_cross_spectra_are_hermitian_and_positive_semi_definite(road, coherence):
    """Eigenvalues are computed to rounding of the largest, four times the spectrum at most."""
    road = dataclasses.replace(road, coherence=coherence)
    f = np.geomspace(1e-4, 50, 40)
    spectra, psd = road.cross_spectrum(f, 20.0, FOUR), road.psd(f, 20.0)
    np.testing.assert_array_equal(spectra, spectra.conj().swapaxes(1, 2))
    np.testing.assert_array_equal(np.diagonal(spectra, axis1=1, axis2=2), np.repeat(psd[:, None], 4, axis=1))
    assert (np.linalg.eigvalsh(spectra) >= -1e-14 * psd[:, None]).all()


def test_rear_follows_front_on_the_same_track():
    """The rear wheel meets at t + 2.6/20 s what the front one meets at t: a pure delay, coherence one."""
    f = np.array([0.5, 3.0, 11.0])
    spectra = ROADS[0].cross_spectrum(f, 20.0, [[1.3, 0.7], [-1.3, 0.7]])
    rear_to_front = spectra[:, 1, 0] / spectra[:, 0, 0]
    np.testing.assert_allclose(rear_to_front, np.exp(-2j * np.pi * f * 2.6 / 20), rtol=1e-12)


def test_left_and_right_share_what_the_coherence_says():
    f = np.array([0.5, 3.0, 11.0])
    spectra = ROADS[0].cross_spectrum(f, 20.0, [[0.0, 0.75], [0.0, -0.75]])
    gamma = (spectra[:, 0, 1] / spectra[:, 0, 0]).real
    z = 2 * np.pi * f / 20 * 1.5
    np.testing.assert_allclose(gamma, 2**-0.25 / special.gamma(1.25) * z**1.25 * special.kv(1.25, z), rtol=1e-12)
    assert (spectra.imag == 0).all()


@given(st.floats(0.05, 30), st.floats(1, 60), st.floats(-3, 3), st.floats(-3, 3))
def test_cross_spectra_do_not_depend_on_where_the_origin_is(f, speed, x, y):
    moved = np.add(FOUR, [x, y])
    here, there = (ROADS[1].cross_spectrum([f], speed, points) for points in (FOUR, moved))
    # a shift rounds each x to 4e-16 m, a phase to 2 pi n of that, and each distance of tracks alike
    np.testing.assert_allclose(there, here, rtol=0, atol=1e-11 * abs(here).max())


@pytest.mark.parametrize(
    ("points", "f", "message"),
    [
        ([1.0, 2.0], [1.0], "contact_points must be finite and of shape"),
        ([[1.0, 2.0, 3.0]], [1.0], "contact_points must be finite and of shape"),
        ([[1.0, np.nan]], [1.0], "contact_points must be finite and of shape"),
        (FOUR, [0.0], "f must be > 0 Hz throughout"),
        (FOUR, 1.0, "f must be one-dimensional"),
    ],
)
def test_rejects_impossible_contact_points(points, f, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        ROADS[0].cross_spectrum(f, 20.0, points)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Iso8608Road("I"), "road_class must be one of A, B, C, D, E, F, G, H, got 'I'"),
        (lambda: Iso8608Road("A", level="lower"), "level must be one of geometric mean, upper, got 'lower'"),
        (lambda: Iso8608Road("H", level="upper"), "level must be one of geometric mean, lower, got 'upper'"),
        (lambda: Iso8608Road("C", waviness=0), "waviness must be a number from 0.01 to 20.0, got 0"),
        (lambda: dataclasses.replace(TWO_SLOPES, corner=0), "corner must be finite and > 0 cycle/m, got 0"),
        (
            lambda: dataclasses.replace(TWO_SLOPES, upper_exponent=-1),
            "upper_exponent must be a number from 0.01 to 20.0, got -1",
        ),
    ],
)
def test_rejects_impossible_roads(make, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        make()
