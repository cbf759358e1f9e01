"""Weighted root mean squares of given spectra beside closed forms, histories and the ride of a car."""

import control
import numpy as np
import pytest
from scipy import signal
from scipy.integrate import quad

import suspension_ctrl as sc
from suspension_ctrl import weighted_rms


def test_a_flat_spectrum_without_weighting_has_the_root_of_its_area():
    assert weighted_rms([0.0, 10.0], [4.0, 4.0], None) == pytest.approx(np.sqrt(40.0), rel=1e-14)
    assert weighted_rms([0.0, 10.0], [0.0, 4.0], None, band=(5.0, 10.0)) == pytest.approx(np.sqrt(15.0), rel=1e-14)


@pytest.mark.parametrize("name", ["Wk", "Wd", "Wf", "Wh", "Wm"])
def test_a_sloped_spectrum_is_integrated_with_the_factor(name):
    """By quadrature; trapezoids of 5 mHz are off by some 1e-6."""
    from suspension_ctrl.response.weightings import by_name

    f = np.linspace(0.0, 50.0, 10001)
    area = quad(lambda x: float(by_name(name).factor(np.array([x]))[0]) ** 2 * (1 + x), 1e-9, 50.0, limit=500)[0]
    assert weighted_rms(f, 1 + f, name) == pytest.approx(np.sqrt(area), rel=1e-5)


def test_the_spectrum_of_a_history_gives_the_value_of_the_history():
    """Welch's estimate of 200 s of white noise beside the filtered noise: windows differ by below 1 %."""
    step = 0.001
    noise = np.random.default_rng(3).normal(size=200_000)
    f, psd = signal.welch(noise, 1 / step, nperseg=8192)
    assert weighted_rms(f, psd, "Wk") == pytest.approx(sc.exposure(noise, step, "Wk").rms, rel=0.01)
    assert weighted_rms(f, psd, "Wk-table") == pytest.approx(weighted_rms(f, psd, "Wk"), rel=0.01)


def test_the_spectrum_of_a_car_gives_its_discomfort():
    file, road, f = sc.load_vehicle("yuen_ramli_2010"), sc.Iso8608Road("C"), np.linspace(0.1, 20.0, 4000)
    psd = sc.response_psds(file.vehicle.closed(file.setting), f, road.psd(f, 20.0))["body_acceleration"]
    table = sc.ride(file.vehicle, file.setting, road, 20.0, band=(0.1, 20.0), measures=["ACC"])
    assert weighted_rms(f, psd) == pytest.approx(table["value"]["ACC"], rel=1e-5)
    assert weighted_rms(f, psd, control.tf([1], [1])) == pytest.approx(weighted_rms(f, psd, None), rel=1e-14)


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (([1.0], [1.0]), {}, "frequency and psd must be of one length >= 2, got \\(1,\\) and \\(1,\\)"),
        (([1.0, 2.0], [1.0, 2.0, 3.0]), {}, "frequency and psd must be of one length >= 2"),
        (([2.0, 1.0], [1.0, 1.0]), {}, "frequency must be finite, >= 0 Hz and ascend, got \\[2.0, 1.0\\]"),
        (([-1.0, 1.0], [1.0, 1.0]), {}, "frequency must be finite, >= 0 Hz and ascend"),
        (([1.0, 2.0], [1.0, -1.0]), {}, "psd must be finite and >= 0 throughout, got a least value of -1.0"),
        (("ab", [1.0, 1.0]), {}, "frequency must be an array of real numbers, got 'ab'"),
        (([1.0, 2.0], [1.0, 1.0], "Wz"), {}, "weighting must be one of Wk, .*, got 'Wz'"),
        (([1.0, 2.0], [1.0, 1.0]), {"band": (0.5, 2.0)}, "band must lie within 1 to 2 Hz, got \\(0.5, 2.0\\)"),
        (([1.0, 2.0], [1.0, 1.0]), {"band": 3}, "band must be finite with 0 <= lower < upper \\[Hz\\], got 3"),
    ],
)
def test_other_spectra_are_refused_in_one_line(arguments, options, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        weighted_rms(*arguments, **options)
