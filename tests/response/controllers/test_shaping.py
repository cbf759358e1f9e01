"""Shaping filters against the spectra to which they were fitted."""

import numpy as np
import pytest

from suspension_ctrl import Iso8608Road, MeasuredRoad, PowerLawRoad, TwoSlopeRoad
from suspension_ctrl.response.controllers.shaping import NEAR, frequencies, shaping

ROADS = {
    "power": PowerLawRoad(roughness=5e-6, exponent=2.5),
    "steep": PowerLawRoad(roughness=5e-6, exponent=3.2),
    "slopes": TwoSlopeRoad(roughness=64e-6, reference=0.1, lower_exponent=2.0, upper_exponent=3.0, corner=0.2),
    "contact": Iso8608Road("C", contact_length=0.2),
}


def _density(road, f, speed=20.0):
    return (2 * np.pi * f) ** 2 * road.psd(f, speed)


@pytest.mark.parametrize("name", ROADS)
@pytest.mark.parametrize("falloff", [None, 200.0])
def test_the_spectrum_is_met_with_the_stated_error(name, falloff):
    f = frequencies((0.0, 20.0))
    density = _density(ROADS[name], f)
    found = shaping(f, density, falloff)
    off = abs(found.filter.response(2j * np.pi * f)) ** 2 / density - 1
    assert found.rms == pytest.approx(np.sqrt((off**2).mean()), rel=1e-6)
    assert found.largest == pytest.approx(abs(off).max(), rel=1e-6)
    assert found.rms <= NEAR + 0.002 * bool(falloff)  # a tenth of which the low pass takes at 20 Hz
    assert np.linalg.eigvals(found.filter.a).real.max() < 0
    # Between the frequencies of the fit the spectrum is smooth.
    middle = np.sqrt(f[1:] * f[:-1])
    between = abs(found.filter.response(2j * np.pi * middle)) ** 2 / _density(ROADS[name], middle) - 1
    assert abs(between).max() <= 1.2 * found.largest
    high = 2j * np.pi * np.array([1e6])  # Hz: constant without a falloff, first order with one
    slope = abs(found.filter.response(10 * high) / found.filter.response(high))[0]
    assert slope == pytest.approx(0.1 if falloff else 1.0, rel=0.01)


def test_white_velocity_is_a_constant():
    f = frequencies((0.0, 20.0))
    found = shaping(f, _density(Iso8608Road("C"), f))
    assert len(found.filter.a) == 0
    # 4 pi^2 Gd(n0) n0^2 V
    assert found.filter.d**2 == pytest.approx(4 * np.pi**2 * 256e-6 * 0.01 * 20.0, rel=1e-12)
    assert found.largest < 1e-12


def test_a_measured_spectrum_scatters_about_its_filter():
    road = MeasuredRoad.from_profile(Iso8608Road("C").profile(4000.0, 0.1, seed=1))
    f = frequencies((road.band[0] * 20.0, 20.0))
    found = shaping(f, _density(road, f))
    assert NEAR < found.rms < 0.2  # of an estimate with few segments
    assert found.largest < 0.6


def test_frequencies_of_a_fit_span_the_band():
    np.testing.assert_allclose(frequencies((0.3, 20.0))[[0, -1]], [0.3, 20.0])
    np.testing.assert_allclose(frequencies((0.0, 20.0))[[0, -1]], [0.01, 20.0])
