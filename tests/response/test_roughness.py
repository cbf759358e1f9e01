"""The roughness index beside closed forms on sines, the spectrum of a random road and Runge and Kutta."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from suspension_ctrl import Iso8608Road
from suspension_ctrl.response.roughness import SPEED, golden_car, international_roughness_index
from suspension_ctrl.roads.profiles import Profile

PEAKS = [(0.0634, 1.538), (0.436, 1.677)]
"""Wavenumber [cycle/m] and gain of the golden car's two resonances, to a unit of the last digit."""


def gain(n):
    """Travel over elevation |z_s - z_u|/|z_r| by Cramer's rule on the equations of motion, per body mass."""
    s = 2j * np.pi * SPEED * np.asarray(n)
    strut = 63.3 + 6.0 * s
    determinant = (s**2 + strut) * (0.15 * s**2 + strut + 653.0) - strut**2
    return np.abs(653.0 * s**2 / determinant)


def sine(n: float, length: float, step: float) -> Profile:
    x = np.arange(round(length / step) + 1) * step
    return Profile(x, 1e-3 * np.sin(2 * np.pi * n * x)[:, None])


@pytest.mark.parametrize(("n", "peak"), PEAKS)
def test_golden_car_peaks_where_it_should(n, peak):
    assert abs(golden_car()(2j * np.pi * n * SPEED)) == pytest.approx(peak, abs=1e-3)
    assert gain(n) == pytest.approx(peak, abs=1e-3)
    assert gain(n) > max(gain(0.995 * n), gain(1.005 * n))


def test_golden_car_has_the_closed_form_at_all_wavenumbers():
    n = np.geomspace(0.005, 5, 60)
    np.testing.assert_allclose(np.abs(golden_car()(2j * np.pi * n * SPEED)), gain(n), rtol=1e-9)


@pytest.mark.parametrize("step", [0.05, 0.1, 0.25, 0.3])
@pytest.mark.parametrize("n", [0.02, 0.0634, 0.2, 0.436])
def test_index_of_a_sine(n, step):
    """Mean slope 4 n a times the gain, a sinc for the average over 250 mm and one for slopes held over a step.

    Two lengths of many waves leave out how the car begins. The magnitude is summed at the points: a mean over
    waves that n step divides unevenly is off by (pi n step)^2/3 at most, and images of the held slope by about
    n step of a gain that is small there; 4 mm of rounding in the length is 1e-5.
    """
    short, long = (sine(n, length, step) for length in (300.0, 1500.0))
    first, second = (international_roughness_index(p).mean * (p.distance.size - 1) for p in (short, long))
    found = (second - first) / (long.distance.size - short.distance.size)
    base = {0.05: 5, 0.1: 3, 0.25: 1, 0.3: 1}[step] * step
    by_hand = 4 * n * gain(n) * np.sinc(n * base) * np.sinc(n * step)
    assert found == pytest.approx(by_hand, rel=2e-3 + (np.pi * n * step) ** 2 / 3)


def test_index_of_a_fine_sine_has_the_gain_and_the_average_alone():
    """At 10 mm neither the held slope nor the points tell: the gain times sinc(n 0.25), to 3e-4."""
    n = 0.436
    short, long = (sine(n, length, 0.01) for length in (100.0, 300.0))
    first, second = (international_roughness_index(p).mean * (p.distance.size - 1) for p in (short, long))
    found = (second - first) / (long.distance.size - short.distance.size)
    assert found == pytest.approx(4 * n * gain(n) * np.sinc(n * 0.25), rel=2e-3)


def test_response_is_that_of_the_equations_of_motion():
    """Steps of 300 mm are not averaged: Runge and Kutta drive over straight pieces, to 1e-9."""
    step = 0.3
    profile = Iso8608Road("C").profile(120 * step, step, 3)
    x, h = profile.distance, profile.height[:, 0]

    def motion(t, z):
        body, body_rate, wheel, wheel_rate = z
        strut = 63.3 * (wheel - body) + 6.0 * (wheel_rate - body_rate)
        tyre = 653.0 * (np.interp(SPEED * t, x, h) - wheel)
        return [body_rate, strut, wheel_rate, (tyre - strut) / 0.15]

    slope = (h[37] - h[0]) / (37 * step)
    travelled, state = [], np.array([h[0], slope * SPEED, h[0], slope * SPEED])
    for start, end in pairwise(x):
        state = solve_ivp(motion, (start / SPEED, end / SPEED), state, rtol=1e-10, atol=1e-13).y[:, -1]
        travelled.append(abs(state[1] - state[3]) / SPEED)
    assert international_roughness_index(profile).mean == pytest.approx(1e3 * np.mean(travelled), rel=1e-6)


def test_index_of_a_random_road_is_that_of_its_spectrum():
    """The slope of travel is Gaussian, so that its mean magnitude is sqrt(2/pi) of its deviation.

    Over 8 km of waves of 0.02 to 1 cycle/m the estimate scatters by some 1 %; held to 4 %. With the realised
    periodogram in place of the expectation only the Gaussian mean magnitude is left to chance.
    """
    step = 0.1
    profile = Iso8608Road("B").profile(8000.0, step, 1)
    n = np.fft.rfftfreq(profile.distance.size, step)
    periodogram = 2 * step**2 / 8000 * np.abs(np.fft.rfft(profile.height[:, 0])) ** 2
    base = 3 * step
    travel = (gain(n) * 2 * np.pi * n * np.sinc(n * base) * np.sinc(n * step)) ** 2 * periodogram
    by_spectrum = 1e3 * np.sqrt(2 / np.pi * travel.sum() / 8000)
    assert international_roughness_index(profile).mean == pytest.approx(by_spectrum, rel=0.04)


def test_index_is_linear_and_by_track():
    profile = Iso8608Road("C").profile(200.0, 0.25, 3, (0.75, -0.75))
    left, right = international_roughness_index(profile).tracks
    swapped = Profile(profile.distance, profile.height[:, ::-1] * [3.0, -1.0] + [5.0, 0.0], profile.tracks)
    np.testing.assert_allclose(international_roughness_index(swapped).tracks, [3 * right, left], rtol=1e-9)
    assert international_roughness_index(profile).mean == pytest.approx((left + right) / 2)


def test_a_steady_slope_is_no_roughness():
    x = np.arange(400) * 0.1
    assert international_roughness_index(Profile(x, 0.05 * x[:, None])).mean < 1e-9


@pytest.mark.parametrize(
    ("profile", "message"),
    [
        (sine(0.1, 100.0, 0.31), "must have steps of at most 0.3048 m, got 0.31 m"),
        (sine(0.1, 11.0, 0.1), "must be at least 11.25 m long, got 11 m"),
    ],
)
def test_rejects_profiles_that_do_not_carry_an_index(profile, message):
    with pytest.raises(ValueError, match=f"^a profile for the roughness index {message}$"):
        international_roughness_index(profile)


@pytest.mark.parametrize(
    ("step", "intervals"), [(0.1, 3), (0.02, 13), (0.05, 5), (1 / 6, 2), (0.17, 1), (0.25, 1)]
)
def test_the_base_length_is_rounded_half_up(step, intervals):
    """As in Sayers' program: 2.5 steps of 0.1 m are 3. A short wave is averaged over so many steps."""
    n = 0.8
    found = international_roughness_index(sine(n, 400.0, step)).mean
    by_hand = 4 * n * gain(n) * abs(np.sinc(n * intervals * step) * np.sinc(n * step))
    other = 4 * n * gain(n) * abs(np.sinc(n * (intervals - 1) * step) * np.sinc(n * step))
    assert abs(found / by_hand - 1) < abs(found / other - 1) / 4


def by_sayers(height, step: float, average: bool = True) -> np.ndarray:
    """Magnitudes [mm/m] by the rules of Sayers' paper (1995), written out: state transition over each step.

    The base length is the nearest whole number of steps, half up (as in Fortran's NINT). The car begins on the
    mean slope of 11 m. States: slopes of body and wheel, and their rates.
    """
    k_tyre, k, c, mu = 653.0, 63.3, 6.0, 0.15
    a = np.array(
        [[0, 1, 0, 0], [-k, -c, k, c], [0, 0, 0, 1], [k / mu, c / mu, -(k_tyre + k) / mu, -c / mu]]
    )  # fmt: skip
    transition = expm(a * step / (80 / 3.6))
    partial = np.linalg.solve(a, (transition - np.eye(4)) @ [0, 0, 0, k_tyre / mu])
    base = {0.02: 13, 0.1: 3, 0.125: 2, 0.25: 1, 0.3048: 1}[step] if average else 1
    lead = {0.02: 550, 0.1: 110, 0.125: 88, 0.25: 44, 0.3048: 36}[step]
    steady = (height[lead] - height[0]) / (lead * step)
    state, found = np.array([steady, 0, steady, 0]), []
    for i in range(len(height) - base):
        state = transition @ state + partial * (height[i + base] - height[i]) / (base * step)
        found.append(1e3 * abs(state[0] - state[2]))
    return np.array(found)


@pytest.mark.parametrize("average", [True, False])
@pytest.mark.parametrize("step", [0.02, 0.1, 0.125, 0.25, 0.3048])
def test_index_is_that_of_sayers_rules(step, average):
    profile = Iso8608Road("C").profile(1500 * step, step, 1)
    by_rules = by_sayers(profile.height[:, 0], step, average)
    found = international_roughness_index(profile, average=average)
    np.testing.assert_allclose(found.tracks, by_rules.mean(), rtol=1e-9)
    np.testing.assert_allclose(found.travel[:, 0], by_rules, rtol=1e-9, atol=1e-9)


def segments_case() -> np.ndarray:
    """Read heights [m] at 0.25 m of a road with known indices of its segments of 20 m."""
    return np.loadtxt(Path(__file__).with_name("iri_by_segments.csv"), comments="#", skiprows=4)


def test_the_car_drives_on_from_segment_to_segment():
    """112 m at 0.25 m, indices of five segments of 20 m by the program of github michalsorel/iri @dcd1e58d."""
    height = segments_case()
    index = international_roughness_index(Profile(0.25 * np.arange(height.size), height[:, None]))
    table = index.by_segment(20.0)
    np.testing.assert_allclose(table["IRI [mm/m]"], [1.0224, 3.6102, 3.7065, 3.6562, 3.5118], atol=5e-5)
    assert table["start [m]"].tolist() == [0, 20, 40, 60, 80]
    assert table["end [m]"].tolist() == [20, 40, 60, 80, 100]
    assert index.mean == pytest.approx(3.1568, abs=5e-5)


def test_segments_of_any_length_hold_the_points_that_lie_in_them():
    """By hand: points at 100, 200, ... mm to segments of 7.77 m; two tracks; from a distance of 500 m on."""
    profile = Iso8608Road("C").profile(200.0, 0.1, 3, (0.75, -0.75))
    moved = Profile(profile.distance + 500, profile.height, profile.tracks)
    index = international_roughness_index(moved)
    table = index.by_segment(7.77)
    place = ((index.distance - 500 - 0.05) // 7.77).astype(int)
    ends = np.arange(1, len(table) + 1) * 7.77
    near = np.abs((index.distance - 500)[:, None] - ends).min(axis=1) < 0.11  # of the step across an edge
    for k in range(len(table)):
        inside = (place == k) & ~near
        wanted = index.travel[inside].mean(axis=0)
        np.testing.assert_allclose(table.loc[k].iloc[2:], wanted, rtol=0.06)
    np.testing.assert_allclose(table["start [m]"], 500 + ends - 7.77)
    assert list(table.columns[2:]) == ["IRI of track 1 [mm/m]", "IRI of track 2 [mm/m]"]
    whole = international_roughness_index(profile).by_segment(200.0)
    np.testing.assert_allclose(whole.iloc[0, 2:], index.tracks, rtol=1e-12)


@pytest.mark.parametrize("length", [0.0, 0.49, 200.1, np.nan, "20"])
def test_a_segment_longer_than_the_road_is_refused(length):
    index = international_roughness_index(Iso8608Road("C").profile(200.0, 0.1, 3))
    with pytest.raises(ValueError, match=r"^segment must be [^\n]*$"):
        index.by_segment(length)
