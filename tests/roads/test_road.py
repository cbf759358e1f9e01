"""What all roads can do: realisations beside their spectrum and coherence, cross-spectra, own roads."""

import pickle
from dataclasses import dataclass

import numpy as np
import pytest
from scipy import stats

from suspension_ctrl import (
    Constant,
    Exponential,
    Iso8608Road,
    Isotropic,
    MeasuredRoad,
    PowerLawRoad,
    Tabulated,
    TwoSlopeRoad,
)
from suspension_ctrl.roads.coherence import power_law_coherence
from suspension_ctrl.roads.road import Road

ROAD = Iso8608Road("C")
TWO_SLOPES = TwoSlopeRoad(roughness=20e-6, reference=0.1, lower_exponent=3.0, upper_exponent=2.25, corner=0.2)


def periodograms(road, realisations: int, length: float, step: float, tracks) -> tuple[np.ndarray, np.ndarray]:
    """Wavenumbers (k,) below the highest and cross-periodograms (k, t, t), means over realisations [m^3]."""
    rng = np.random.default_rng(5)
    points = round(length / step)
    n = np.arange(1, (points + 1) // 2) / length
    total = np.zeros((n.size, len(tracks), len(tracks)), dtype=complex)
    for _ in range(realisations):
        waves = np.fft.rfft(road.profile(length, step, rng, tracks).height, axis=0)[1 : n.size + 1]
        total += waves[:, :, None] * waves[:, None, :].conj()
    return n, total * 2 * step**2 / length / realisations


@pytest.mark.parametrize("road", [ROAD, TWO_SLOPES, PowerLawRoad(roughness=5e-6, exponent=2.5)])
@pytest.mark.parametrize("points", [256, 257])
def test_periodograms_scatter_about_the_spectrum_as_chi_square(road, points):
    """The mean of R periodograms is the spectrum times chi-square of 2R degrees of freedom over 2R.

    None of the k values leaves the interval of probability 1 - 1e-4/k each, and their scatter has the whole
    distribution (Kolmogorov and Smirnov, p > 1e-3).
    """
    realisations = 60
    n, mean = periodograms(road, realisations, 0.25 * points, 0.25, [0.0])
    quotient = 2 * realisations * mean[:, 0, 0].real / road.psd(n, 1.0)
    chi = stats.chi2(2 * realisations)
    assert (quotient > chi.ppf(0.5e-4 / n.size)).all()
    assert (quotient < chi.isf(0.5e-4 / n.size)).all()
    assert stats.kstest(quotient, chi.cdf).pvalue > 1e-3


def test_variance_equals_the_integral_over_the_band():
    """Beyond the tenth wave the sum over waves is the integral to (1/10)^2/24; with 60 realisations of 118 waves
    the scatter is that of their weighted sum, sqrt(sum S^2 / 60) / sum S, held to four of it.
    """
    length, step, first = 64.0, 0.25, 10
    n, mean = periodograms(ROAD, 60, length, step, [0.0])
    found = mean[first - 1 :, 0, 0].real.sum() / length
    low, high = (first - 0.5) / length, (n.size + 0.5) / length
    integral = 256e-6 * 0.1**2 * (1 / low - 1 / high)
    spectrum = ROAD.psd(n[first - 1 :], 1.0)
    scatter = np.sqrt((spectrum**2).sum() / 60) / spectrum.sum()
    assert abs(found / integral - 1) < 4 * scatter + 1e-3
    assert scatter < 0.05


def test_variance_is_that_of_the_waves():
    """Parseval: the mean square of a profile is the sum of its periodogram over the band, to rounding."""
    profile = ROAD.profile(64.0, 0.25, 1)
    waves = np.abs(np.fft.rfft(profile.height[:, 0])) ** 2 * 2 * 0.25**2 / 64
    assert profile.height.var() == pytest.approx(waves[1:-1].sum() / 64, rel=1e-12)
    assert waves[-1] < 1e-20  # nothing at 1/(2 step), where a wave has no phase
    assert abs(profile.height.mean()) < 1e-15


@pytest.mark.parametrize("coherence", [None, Exponential(2.0), Constant(0.0), Constant(1.0)])
def test_tracks_have_the_coherence_of_the_road(coherence):
    """The mean cross-periodogram over both spectra is gamma with a variance of at most (1 + gamma^2)/2R per part
    (complex Wishart), so that the mean over all k waves is off by at most 5 sqrt(1/(R k)).
    """
    road = ROAD if coherence is None else Iso8608Road("C", coherence=coherence)
    realisations, tracks = 60, (0.75, -0.75, 0.75)
    n, mean = periodograms(road, realisations, 64.0, 0.25, tracks)
    found = mean / road.psd(n, 1.0)[:, None, None]
    expected = road.isotropic_coherence(n, 1.5) if coherence is None else coherence.between(n, 1.5)
    error = found[:, 0, 1] - expected
    assert abs(error.real.mean()) < 5 / np.sqrt(realisations * n.size)
    assert abs(error.imag.mean()) < 5 / np.sqrt(realisations * n.size)
    assert np.abs(error).max() < 6 / np.sqrt(realisations)
    np.testing.assert_allclose(found[:, 0, 2], found[:, 0, 0], rtol=1e-6)  # one track, twice


def test_seeds():
    one, same, other = (ROAD.profile(32.0, 0.25, seed, (0.7, -0.7)) for seed in (1, np.random.default_rng(1), 2))
    np.testing.assert_array_equal(one.height, same.height)
    assert np.abs(one.height - other.height).max() > 1e-4
    np.testing.assert_array_equal(one.distance, np.arange(128) * 0.25)
    assert one.tracks == (0.7, -0.7)
    assert one.step == 0.25


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ROAD.profile(10.1, 0.25, 1), "length must be a whole number of steps of 0.25 m, four at least"),
        (lambda: ROAD.profile(0.75, 0.25, 1), "length must be a whole number of steps of 0.25 m, four at least"),
        (lambda: ROAD.profile(-1.0, 0.25, 1), "length must be finite and > 0 m"),
        (lambda: ROAD.profile(10.0, 0.0, 1), "step must be finite and > 0 m"),
        (lambda: ROAD.profile(10.0, 0.25, 1, ()), "tracks must be finite and one-dimensional"),
        (lambda: ROAD.profile(10.0, 0.25, 1, (np.inf,)), "tracks must be finite and one-dimensional"),
        (lambda: ROAD.profile(10.0, 0.25, -1), "seed must be a whole number >= 0, got -1"),
        (lambda: ROAD.profile(10.0, 0.25, None), "seed must be a whole number >= 0, got None"),
        (lambda: ROAD.profile(10.0, 0.25, "1"), "seed must be a whole number >= 0, got '1'"),
    ],
)
def test_rejects_impossible_profiles(make, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        make()


@pytest.mark.parametrize("points", [[], np.zeros((0, 2)), [1.0, 2.0], [[1.0]], [[np.nan, 0.0]]])
def test_a_cross_spectrum_needs_wheels(points):
    with pytest.raises(
        ValueError, match=r"^contact_points must be finite and of shape \(r, 2\), r > 0 \[m\], got "
    ):
        ROAD.cross_spectrum([1.0], 20.0, points)


@pytest.mark.parametrize("coherence", [0.5, None, "isotropic", Exponential])
def test_a_coherence_is_a_model(coherence):
    for make in (
        lambda **more: Iso8608Road("C", **more),
        lambda **more: PowerLawRoad(roughness=1e-6, exponent=2.0, **more),
        lambda **more: MeasuredRoad([0.1, 1.0], [1e-5, 1e-7], **more),
    ):
        with pytest.raises(ValueError, match=r"^coherence must be a model such as Exponential\(decay=3.0\), got "):
            make(coherence=coherence)


class Falling:
    """A coherence of a user's own."""

    def between(self, n, distance):
        return 1 / (1 + n * distance)


def test_any_object_with_the_method_between_is_a_coherence():
    f, points = np.array([1.0, 5.0]), [(0.0, 0.75), (0.0, -0.75)]
    found = Iso8608Road("C", coherence=Falling()).cross_spectrum(f, 20.0, points)
    np.testing.assert_allclose(found[:, 0, 1] / found[:, 0, 0], 1 / (1 + f / 20 * 1.5), rtol=1e-14)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Cobbles(Road):
    """A road of a user's own: white velocity."""

    level: float

    def describe(self) -> str:
        return f"cobbles of level {self.level}"

    def isotropic_coherence(self, n, distance):
        return power_law_coherence(n, distance, 2.0)

    def _psd(self, f, speed):
        return self.level * speed / f**2


def test_a_road_is_its_spectrum_and_a_coherence():
    """A user's own road has cross-spectra and profiles as any: here those of a power law."""
    mine, there = Cobbles(level=1e-6), PowerLawRoad(roughness=1e-6, exponent=2.0)
    points = [(1.2, 0.7), (-1.3, -0.7)]
    np.testing.assert_allclose(
        mine.cross_spectrum([1.0, 9.0], 20.0, points), there.cross_spectrum([1.0, 9.0], 20.0, points), rtol=1e-14
    )
    np.testing.assert_allclose(mine.profile(32, 0.5, 1).height, there.profile(32, 0.5, 1).height, rtol=1e-12)
    assert mine.breakpoints(20.0) == ()


RECORDS = [
    PowerLawRoad(roughness=5e-6, exponent=2.5, coherence=Exponential(3.0)),
    TWO_SLOPES,
    Iso8608Road("C", level="upper", coherence=Constant(0.5)),
    MeasuredRoad.from_profile(ROAD.profile(409.6, 0.1, 1, (0.75, -0.75)), source="a realisation"),
    ROAD.profile(32.0, 0.25, 1, (0.7, -0.7)),
    Isotropic(2.5),
    Tabulated((0.1, 0.2), (0.5, 0.25), 1.5),
]


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: type(record).__name__)
def test_roads_and_their_parts_are_equal_by_value_hashable_picklable_and_shown_in_a_few_lines(record):
    again = pickle.loads(pickle.dumps(record))
    assert again == record
    assert hash(again) == hash(record)
    lines = repr(record).splitlines()
    assert 1 <= len(lines) <= 6
    assert max(map(len, lines)) <= 88


def test_a_road_is_shown_with_its_units():
    assert repr(TWO_SLOPES) == (
        "TwoSlopeRoad(roughness=2e-05 m^3, reference=0.1 cycle/m, lower_exponent=3,\n"
        "    upper_exponent=2.25, corner=0.2 cycle/m)"
    )
    assert repr(Iso8608Road("C")) == "Iso8608Road(road_class='C')"
    assert repr(Iso8608Road("C")) != repr(Iso8608Road("C", coherence=Constant(1.0)))


@pytest.mark.parametrize("length", [0.1, 0.3])
def test_contact_averages_the_spectrum_as_the_profile(length):
    """Waves of realisations of one seed differ by the magnitude of sinc, the mean of a wave over the contact."""
    road = Iso8608Road("C")
    averaging = Iso8608Road("C", contact_length=length)
    assert averaging.describe() == f"{road.describe()}; averaged over {length} m of contact"
    n = np.array([0.01, 0.5, 2.0, 1 / length])
    np.testing.assert_allclose(averaging.psd(n, 1.0), road.psd(n, 1.0) * np.sinc(n * length) ** 2, rtol=1e-12)
    points = [(1.0, 0.7), (1.0, -0.7)]
    ratio = averaging.cross_spectrum(20 * n, 20.0, points) / road.cross_spectrum(20 * n, 20.0, points)
    np.testing.assert_allclose(ratio[:, 0, 1], np.sinc(n * length) ** 2, rtol=1e-9, atol=1e-12)
    profile, smooth = (np.fft.rfft(one.profile(200.0, 0.02, 1).height[:, 0]) for one in (road, averaging))
    n = np.fft.rfftfreq(10_000, 0.02)
    wanted = np.abs(np.sinc(n * length) * profile)
    np.testing.assert_allclose(np.abs(smooth), wanted, atol=1e-9 * np.abs(profile).max())


def test_a_negative_contact_is_refused():
    with pytest.raises(ValueError, match=r"^contact_length must be finite and >= 0 m, got -0.1$"):
        Iso8608Road("C", contact_length=-0.1)
