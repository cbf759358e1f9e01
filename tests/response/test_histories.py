"""Measures of exposure beside closed forms of sines and bursts, and the filters beside the analogue ones."""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from suspension_ctrl import Iso8608Road, QuarterCar, simulate, weighting
from suspension_ctrl.response.histories import exposure, running_rms, weighted
from suspension_ctrl.response.weightings import filters

DT = 1e-3


def sine(f: float, seconds: float, dt: float = DT) -> np.ndarray:
    return np.sin(2 * np.pi * f * dt * np.arange(round(seconds / dt)))


@pytest.mark.parametrize("f", [1.0, 5.0, 10.0])
def test_sine(f):
    """r.m.s. 1/sqrt 2, crest factor sqrt 2, every second alike, VDV (3 T/8)^(1/4); whole waves, sampled finely."""
    found = exposure(sine(f, 20.0), DT)
    assert found.rms == pytest.approx(np.sqrt(0.5), rel=1e-12)
    assert found.crest_factor == pytest.approx(np.sqrt(2), rel=1e-12)
    assert found.mtvv_ratio == pytest.approx(1.0, rel=1e-9)
    assert found.vdv == pytest.approx((3 / 8 * 20.0) ** 0.25, rel=1e-12)
    assert found.vdv_ratio == pytest.approx(1.5**0.25, rel=1e-12)
    assert found.duration == pytest.approx(20.0)


@pytest.mark.parametrize("burst", [0.5, 2.0])
def test_burst_of_a_sine(burst):
    """A burst of b s in T s: r.m.s. sqrt(b/2T), MTVV sqrt(min(b, 1)/2), VDV (3 b/8)^(1/4)."""
    history = np.concatenate([np.zeros(5000), sine(5.0, burst), np.zeros(15000 - round(burst / DT))])
    found = exposure(history, DT, keep_offset=True)
    assert found.rms == pytest.approx(np.sqrt(burst / 40), rel=1e-12)
    assert found.mtvv == pytest.approx(np.sqrt(min(burst, 1.0) / 2), rel=1e-9)
    assert found.vdv == pytest.approx((3 / 8 * burst) ** 0.25, rel=1e-12)
    assert found.crest_factor == pytest.approx(np.sqrt(40 / burst), rel=1e-9)
    assert found.mtvv_ratio > 1.5
    assert found.vdv_ratio == pytest.approx((1.5 * 20 / burst) ** 0.25, rel=1e-12)


@pytest.mark.parametrize("decay", [0.1, 0.5, 2.0])
def test_mtvv_of_a_decaying_burst(decay):
    """exp(-t/T): linear, the first second, T/2 (1 - exp(-2/T)). Exponential: the largest of
    (e^(-t) - e^(-2t/T))/(2/T - 1). A sample for each step is off by half a step of the first value.
    """
    t = DT * np.arange(8000)
    history = np.exp(-t / decay)
    linear = decay / 2 * (1 - np.exp(-2 / decay))
    assert exposure(history, DT, keep_offset=True).mtvv ** 2 == pytest.approx(linear, abs=DT)
    rate = 2 / decay
    courses = t * np.exp(-t) if rate == 1 else (np.exp(-t) - np.exp(-rate * t)) / (rate - 1)
    found = exposure(history, DT, integration="exponential", keep_offset=True)
    assert found.mtvv**2 == pytest.approx(courses.max(), abs=DT)


@pytest.mark.parametrize("integration", ["linear", "exponential"])
@pytest.mark.parametrize("t0", [0.4, 1.0, 1.7, 3.3])
def test_running_rms_of_a_sine(integration, t0):
    """The integrals of clause 6.3.1 by quadrature, back to where the sine begins; sums are off by half a step."""
    f = 0.7

    def square(t):
        weight = np.exp(t - t0) if integration == "exponential" else 1.0
        return np.sin(2 * np.pi * f * t) ** 2 * weight

    start = max(0.0, t0 - 1.0) if integration == "linear" else 0.0
    found = running_rms(sine(f, 4.0), DT, integration=integration)[round(t0 / DT)]
    assert found**2 == pytest.approx(quad(square, start, t0)[0], abs=DT)


def test_running_rms_of_what_is_steady():
    for integration in ("linear", "exponential"):
        found = running_rms(np.full(20000, 3.0), DT, integration=integration, time_constant=0.5)
        assert found[-1] == pytest.approx(3.0, rel=1e-9)
        assert (np.diff(found) >= -1e-12).all()
    assert running_rms(np.full(2000, 3.0), DT, integration="exponential")[999] == pytest.approx(
        3.0 * np.sqrt(1 - np.exp(-1.0)), rel=1e-9
    )


@pytest.mark.parametrize("name", filters())
def test_weighted_sine_has_the_filters_magnitude(name):
    """At the frequency that the bilinear transform gives; the start is over after 40 s (Wf: 400 s, Wh: 10 s)."""
    dt, f, seconds = {"Wf": (0.02, 0.25, 800.0), "Wh": (0.0005, 16.0, 20.0)}.get(name, (0.002, 4.0, 60.0))
    t = dt * np.arange(round(seconds / dt))
    late = weighted(np.sin(2 * np.pi * f * t), dt, name)[t.size // 2 :]
    moved = np.tan(np.pi * f * dt) / (np.pi * dt)
    found = np.sqrt(2 * np.mean(late**2))
    assert found == pytest.approx(abs(weighting(name)(2j * np.pi * moved)), rel=1e-9)
    assert found == pytest.approx(abs(weighting(name)(2j * np.pi * f)), rel=1e-3)


@pytest.mark.parametrize(("step", "ten", "twenty"), [(0.005, 3e-3, 3.1e-2), (0.002, 5e-4, 5e-3)])
def test_error_of_the_digital_filter_is_as_documented(step, ten, twenty):
    """From its answer to an impulse, which the transform over 40 s takes to 1e-9: all of it is over by then."""
    impulse = np.zeros(round(40 / step))
    impulse[0] = 1.0
    f = np.fft.rfftfreq(impulse.size, step)
    quotient = np.abs(np.fft.rfft(weighted(impulse, step, "Wk"))[1:]) / np.abs(weighting("Wk")(2j * np.pi * f[1:]))
    assert np.abs(quotient - 1)[f[1:] <= 10].max() < ten
    assert np.abs(quotient - 1)[f[1:] <= 20].max() < twenty
    assert np.abs(quotient - 1)[f[1:] <= 20].max() > 0.9 * twenty


def test_digital_filter_beside_the_filter_behind_the_vehicle():
    """Simulated together they make no error; on a road the digital filter, phase and all, makes below 0.5 %."""
    closed = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3).closed(22e3, 1500.0)
    profile = Iso8608Road("C").profile(409.6, 0.05, 1)
    both = control.ss(weighting("Wk")) * closed["body_acceleration", "road"]
    expected = simulate(both, profile, 20.0, periodic=True).iloc[:, 2].to_numpy()
    plain = simulate(closed, profile, 20.0, periodic=True)["body_acceleration [m/s^2]"].to_numpy()
    found = weighted(np.tile(plain, 2), 0.0025, "Wk")[plain.size :]
    assert np.sqrt(np.mean((found - expected) ** 2) / np.mean(expected**2)) < 5e-3
    ours, theirs = exposure(found, 0.0025), exposure(expected, 0.0025)
    for name in ("rms", "mtvv", "vdv"):
        assert getattr(ours, name) == pytest.approx(getattr(theirs, name), rel=2e-3)
    assert ours.mtvv_ratio < 1.5  # a road without pot-holes
    assert ours.vdv_ratio == pytest.approx(3**0.25, rel=0.05)  # a normal process: E a^4 = 3 (E a^2)^2
    assert 2.5 < ours.crest_factor < 5.5


@given(st.lists(st.floats(-50, 50), min_size=100, max_size=300), st.floats(0.01, 100))
def test_measures_scale_and_are_ordered(history, factor):
    """r.m.s. <= peak, MTVV <= peak, VDV between those of Jensen and of the peak; all are of the first degree."""
    history = np.append(history, 1.0)
    one, other = (exposure(k * history, 0.02, keep_offset=True) for k in (1, factor))
    for name in ("rms", "peak", "mtvv", "vdv"):
        assert getattr(other, name) == pytest.approx(factor * getattr(one, name), rel=1e-9)
    assert one.rms <= one.peak * (1 + 1e-12)
    assert one.mtvv <= one.peak * (1 + 1e-12)
    assert 1 - 1e-12 <= one.vdv_ratio <= np.sqrt(one.crest_factor) * (1 + 1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: weighted([0.0], 0.0, "Wk"), "time_step must be finite and > 0 s, got 0.0"),
        (lambda: weighted([0.0], 0.011, "Wk"), "time_step must be at most 0.01 s for Wk, got 0.011"),
        (lambda: weighted([0.0], 0.001, "Wx"), "weighting must be one of Wk, "),
        (lambda: weighted([[0.0]], 0.001, "Wk"), r"acceleration must be finite and of shape \(n,\)"),
        (lambda: running_rms([], 0.001), r"acceleration must be finite and of shape \(n,\)"),
        (lambda: running_rms([np.nan], 0.001), r"acceleration must be finite and of shape \(n,\)"),
        (
            lambda: running_rms([1.0], 0.1, integration="slow"),
            "integration must be one of linear, exponential, got",
        ),
        (lambda: running_rms([1.0], 0.1, time_constant=0.0), "time_constant must be finite and > 0 s, got 0.0"),
        (
            lambda: running_rms([1.0], 0.1, time_constant=0.05),
            "time_constant must be at least a time step of 0.1 s",
        ),
        (
            lambda: exposure([1.0], 0.1),
            "acceleration must last 1 s at least and not be constant throughout, got 0.1 s",
        ),
        (lambda: exposure(np.full(99, 9.81), 0.1), "acceleration must last 1 s at least and not be constant"),
        (
            lambda: exposure(np.full(999, 9.81), 0.01, "Wk"),
            "acceleration must last 1 s at least and not be constant",
        ),
        (lambda: exposure(sine(5.0, 3.0), DT, settling=2.5), "acceleration must last 1 s .*, got 0.5 s, peak"),
        (lambda: exposure(sine(5.0, 3.0), DT, settling=1e9), "acceleration must last 1 s .*, got 0 s, peak 0"),
        (lambda: exposure(sine(5.0, 3.0), DT, settling=-1.0), "settling must be finite and >= 0 s, got -1.0"),
        (lambda: exposure(["a", "b"], 0.1), r"acceleration must be an array of real numbers, got \['a', 'b'\]"),
        (
            lambda: exposure(np.zeros(99), 0.1),
            "acceleration must last 1 s at least and not be constant throughout",
        ),
    ],
)
def test_rejects_impossible_histories(make, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        make()


def test_exposure_weights_in_one_step():
    history = np.random.default_rng(4).normal(size=2000)
    kept = [exposure(history, 0.005, "Wk", keep_offset=True)]
    kept.append(exposure(weighted(history, 0.005, "Wk"), 0.005, keep_offset=True))
    assert kept[0] == kept[1]
    repr_of_ones = repr(exposure(np.ones(400), 0.005, keep_offset=True))
    assert repr_of_ones.startswith("Exposure(rms=1 m/s^2, peak=1 m/s^2, ")
    with pytest.raises(ValueError, match=r"^weighting must be one of Wk, Wd, .*, got 'Wz'$"):
        exposure(history, 0.005, "Wz")


@pytest.mark.parametrize("weighting_name", [None, "Wk", "Wd"])
def test_gravity_and_offsets_do_not_count(weighting_name):
    history = np.random.default_rng(5).normal(size=6000)
    plain = exposure(history, 0.005, weighting_name)
    shifted = exposure(history + 9.80665, 0.005, weighting_name)
    assert shifted.offset == pytest.approx(plain.offset + 9.80665, rel=1e-12)
    for name in ("rms", "peak", "mtvv", "vdv"):
        assert getattr(shifted, name) == pytest.approx(getattr(plain, name), rel=1e-9)
    assert exposure(history + 9.80665, 0.005, weighting_name, keep_offset=True).rms > 1.2 * plain.rms


def test_settling_takes_the_start_of_the_filter_out():
    """A sine of whole waves behind the filter has the filter's factor once its start is over."""
    history = sine(1.0, 40.0, 0.005)
    digital = np.tan(np.pi * 0.005) / (np.pi * 0.005)
    expected = abs(weighting("Wk")(2j * np.pi * digital)) / np.sqrt(2)
    found = exposure(history, 0.005, "Wk", settling=20.0)
    assert found.rms == pytest.approx(expected, rel=1e-9)
    assert found.duration == pytest.approx(20.0)
    assert exposure(history, 0.005, "Wk").rms != pytest.approx(expected, rel=1e-4)
