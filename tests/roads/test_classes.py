"""Classes of ISO 8608 of measured roads, of power laws and of realisations."""

import numpy as np
import pytest

from suspension_ctrl import Iso8608Road, MeasuredRoad
from suspension_ctrl.roads.classes import fitted_class

N = np.geomspace(0.01, 5, 30)


@pytest.mark.parametrize("name", "ABCDEFGH")
@pytest.mark.parametrize("waviness", [1.8, 2.5])
def test_a_power_law_has_its_own_class_and_waviness(name, waviness):
    road = Iso8608Road(name, waviness=waviness)
    found = fitted_class(MeasuredRoad(N, road.psd(N, 1.0)))
    assert found.road_class == name
    assert found.roughness == pytest.approx(road.roughness, rel=1e-9)
    assert found.waviness == pytest.approx(waviness, rel=1e-9)
    assert found.band == (0.011, 2.83)


def test_limits_divide_the_classes():
    for name, other in zip("ABCDEFG", "BCDEFGH", strict=True):
        limit = Iso8608Road(name, level="upper").roughness
        for factor, wanted in ((0.999, name), (1.001, other)):
            density = factor * limit * (N / 0.1) ** -2.0
            assert fitted_class(MeasuredRoad(N, density)).road_class == wanted


def test_a_realisation_is_of_its_class():
    profile = Iso8608Road("C").profile(2000.0, 0.1, 1)
    found = fitted_class(MeasuredRoad.from_profile(profile))
    assert found.road_class == "C"
    assert found.waviness == pytest.approx(2, abs=0.15)


def test_a_spectrum_away_from_the_reference_has_no_class():
    with pytest.raises(
        ValueError, match=r"^spectrum for a class of ISO 8608 must cover an octave around 0.1 cycle/m"
    ):
        fitted_class(MeasuredRoad([0.2, 3.0], [1e-4, 1e-5]))
