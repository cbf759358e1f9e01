import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import PowerLawRoad


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
    "parameters", [{"roughness": 0.0, "exponent": 2.0}, {"roughness": 1e-6, "exponent": -2.0}]
)
def test_rejects_impossible_parameters(parameters):
    with pytest.raises(ValueError, match=r"^(roughness|exponent) must be finite and > 0, got"):
        PowerLawRoad(**parameters)


def test_rejects_impossible_speeds_and_frequencies():
    road = PowerLawRoad(roughness=5e-6, exponent=2.5)
    with pytest.raises(ValueError, match=r"^speed must be finite and > 0 m/s, got -1.0"):
        road.psd([1.0], speed=-1.0)
    with pytest.raises(ValueError, match=r"^f must be > 0 Hz throughout, got a least value of 0.0"):
        road.psd([1.0, 0.0], speed=20.0)
