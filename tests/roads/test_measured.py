"""Roads from profiles and spectra beside the road that the profile was realised from."""

import dataclasses
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import Iso8608Road, MeasuredRoad, PowerLawRoad
from suspension_ctrl.roads.coherence import Exponential, Isotropic, Tabulated
from suspension_ctrl.roads.profiles import Profile

TABLE = MeasuredRoad([0.01, 0.1, 2.0], [1e-3, 1e-5, 1e-8])


def excerpts(road, realisations: int, tracks) -> list[Profile]:
    """Halves of periodic profiles, which are not periodic themselves, as measured ones are not."""
    whole = [road.profile(819.2, 0.1, seed, tracks) for seed in range(realisations)]
    return [Profile(p.distance[:4096], p.height[:4096], p.tracks) for p in whole]


@pytest.mark.parametrize("exponent", [1.5, 2.0, 2.5])
def test_spectrum_of_a_profile_is_the_roads(exponent):
    """Means over 40 profiles of two tracks: bias by leakage and by the width of the bands 6 % at most, scatter of
    one estimate 0.25 at the lowest bands, of the mean a sixth of that, held to three.
    """
    road = PowerLawRoad(roughness=1e-6, exponent=exponent, coherence=Isotropic())
    measured = [MeasuredRoad.from_profile(p) for p in excerpts(road, 40, (0.75, -0.75))]
    n = measured[0].wavenumber
    quotient = np.mean([m.density for m in measured], axis=0) / road.psd(n, 1.0)
    assert np.abs(quotient - 1).max() < 0.06 + 3 * 0.25 / np.sqrt(40)
    assert np.abs(quotient[8:] - 1).max() < 0.03 + 3 * 0.10 / np.sqrt(40)
    assert 4 / 51.2 <= measured[0].band[0] < 4.5 / 51.2
    assert 2.0 < measured[0].band[1] <= 1 / (4 * 0.1)


def test_spectrum_of_white_noise():
    """Independent heights of deviation s in steps d have the spectrum 2 s^2 d; bands of some 20 waves and more in
    segments worth about 10 scatter by 0.07, the mean over these by less, held to 0.1.
    """
    noise = 0.01 * np.random.default_rng(1).standard_normal((8192, 1))
    road = MeasuredRoad.from_profile(Profile(np.arange(8192) * 0.05, noise))
    assert road.density[8:].mean() == pytest.approx(2 * 0.01**2 * 0.05, rel=0.1)


def test_slope_and_offset_of_a_profile_are_left_out():
    (profile,) = excerpts(Iso8608Road("C"), 1, (0.0,))
    tilted = Profile(profile.distance, profile.height + 3 + 0.02 * profile.distance[:, None])
    np.testing.assert_allclose(
        MeasuredRoad.from_profile(tilted).density, MeasuredRoad.from_profile(profile).density, rtol=1e-6
    )


def test_coherence_of_two_tracks_is_the_roads():
    """Means over 30 profiles where bands hold five waves and more: 15 segments that overlap are worth about 10
    and bias the root by 1/sqrt(10 x 5) where there is none; scatter 0.1 over sqrt(30).
    """
    road = Iso8608Road("C", coherence=Exponential(1.0))
    measured = [MeasuredRoad.from_profile(p) for p in excerpts(road, 30, (0.75, -0.75))]
    n = measured[0].wavenumber
    models = [m.coherence for m in measured]
    assert all(isinstance(model, Tabulated) and model.distance == 1.5 for model in models)
    mean = np.mean([model.between(n, 1.5) for model in models], axis=0)
    np.testing.assert_allclose(mean[7:], np.exp(-1.5 * n[7:]), atol=1 / np.sqrt(50))
    assert (np.array([model.between(n, 1.5) for model in models]) <= 1).all()


def test_one_track_twice_is_coherent():
    (profile,) = excerpts(Iso8608Road("C"), 1, (0.0,))
    same = Profile(profile.distance, np.repeat(profile.height, 2, axis=1), (0.7, -0.7))
    road = MeasuredRoad.from_profile(same)
    f = np.array([2.0, 10.0])
    spectra = road.cross_spectrum(f, 20.0, [[0, 0.7], [0, -0.7]])
    np.testing.assert_allclose(spectra, np.ones((2, 2)) * road.psd(f, 20.0)[:, None, None], rtol=1e-12)


def test_coherence_that_is_stated_goes_before_the_measured_one():
    (profile,) = excerpts(Iso8608Road("C"), 1, (0.75, -0.75))
    assert MeasuredRoad.from_profile(profile, coherence=Isotropic(2.0)).coherence == Isotropic(2.0)


def test_a_table_is_straight_in_log_log():
    n = np.array([0.01, np.sqrt(0.001), 0.1, np.sqrt(0.2), 2.0])
    by_hand = np.array([1e-3, 1e-4, 1e-5, np.sqrt(1e-13), 1e-8])
    np.testing.assert_allclose(TABLE.psd(20 * n, 20.0) * 20, by_hand, rtol=1e-12)
    assert TABLE.breakpoints(20.0) == (2.0,)
    assert TABLE.band == (0.01, 2.0)


@given(st.floats(1, 60))
def test_the_ends_of_the_band_belong_to_it(speed):
    np.testing.assert_allclose(TABLE.psd(np.array(TABLE.band) * speed, speed) * speed, [1e-3, 1e-8], rtol=1e-6)


@pytest.mark.parametrize("f", [0.19, 41])
def test_outside_of_the_band_there_is_no_spectrum(f):
    allowed = "f must lie from 0.2 to 40 Hz at 20 m/s, as the road is known from 0.01 to 2 cycle/m"
    with pytest.raises(ValueError, match=rf"^{allowed}, got {f} Hz$"):
        TABLE.psd([1.0, f], 20.0)


def test_realisations_keep_to_the_band():
    assert TABLE.profile(100.0, 0.25, 1).height.shape == (400, 1)
    with pytest.raises(ValueError, match=r"^f must lie from 0.01 to 2 Hz at 1 m/s"):
        TABLE.profile(200.0, 0.25, 1)


def test_isotropy_needs_an_exponent():
    points = [[0, 0.7], [0, -0.7]]
    assert TABLE.cross_spectrum([1.0], 20.0, [[0, 0.7], [-2.6, 0.7]]).shape == (1, 2, 2)
    with pytest.raises(
        ValueError, match=r"^coherence of a measured spectrum must be .*Isotropic\(exponent=2.0\)[^\n]*$"
    ):
        TABLE.cross_spectrum([1.0], 20.0, points)
    stated = dataclasses.replace(TABLE, coherence=Isotropic(2.5))
    law = PowerLawRoad(roughness=1.0, exponent=2.5)
    here, there = (road.cross_spectrum([1.0], 20.0, points)[0] for road in (stated, law))
    np.testing.assert_allclose(here / here[0, 0], there / there[0, 0], rtol=1e-12)


def test_measured_roads_say_which_they_are():
    assert TABLE.describe() == "measured, a table: Gd(0.1 cycle/m) = 1e-05 m^3, known from 0.01 to 2 cycle/m"
    assert MeasuredRoad([0.2, 1], [1, 1]).describe() == "measured, a table: known from 0.2 to 1 cycle/m"


def test_measured_roads_go_to_other_processes():
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(TABLE)).psd([1.0], 20.0), TABLE.psd([1.0], 20.0))


def flat(points: int, step: float = 0.1) -> Profile:
    return Profile(np.arange(points) * step, np.zeros((points, 1)))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: MeasuredRoad([0.1], [1.0]), "wavenumber and density must be of one length >= 2"),
        (lambda: MeasuredRoad([0.1, 0.2], [1.0]), "wavenumber and density must be of one length >= 2"),
        (lambda: MeasuredRoad([0.2, 0.1], [1.0, 1.0]), "wavenumber must be finite, above zero and ascend"),
        (lambda: MeasuredRoad([0.0, 0.1], [1.0, 1.0]), "wavenumber must be finite, above zero and ascend"),
        (lambda: MeasuredRoad([0.1, 0.2], [1.0, 0.0]), "density must be finite and > 0 m\\^3 throughout"),
        (
            lambda: MeasuredRoad.from_profile(flat(255)),
            "a profile in steps of 0.1 m must have 256 points at least, or .* got 255",
        ),
        (
            lambda: MeasuredRoad.from_profile(flat(255), segment=30.0),
            "a profile in steps of 0.1 m must have a segment from 3.2 to 25.5 m, got 30.0",
        ),
        (
            lambda: MeasuredRoad.from_profile(flat(255), segment=1.0),
            "a profile in steps of 0.1 m must have a segment from 3.2 to 25.5 m, got 1.0",
        ),
        (lambda: MeasuredRoad.from_profile(flat(512)), "a profile must not be flat in any track"),
        (
            lambda: MeasuredRoad.from_profile(
                Profile(np.arange(512.0), np.stack([np.sin(np.arange(512)), np.zeros(512)], axis=1), (1, -1))
            ),
            "a profile must not be flat in any track",
        ),
        (
            lambda: MeasuredRoad.from_profile(flat(512), segment=np.nan),
            "segment must be finite and > 0 m, got nan",
        ),
    ],
)
def test_rejects_impossible_measurements(make, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        make()
