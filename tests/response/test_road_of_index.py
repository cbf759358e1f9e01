"""Roads of an index: beside long realisations, in small steps."""

import numpy as np
import pytest

from suspension_ctrl import Constant, international_roughness_index, road_of_iri
from suspension_ctrl.response.road_of_index import expected_index


@pytest.mark.parametrize("waviness", [1.5, 2.0, 3.0])
def test_realisations_have_the_index_on_average(waviness):
    """Four tracks of 3 km, alike but for chance: their indices scatter by some percent, most with long waves.

    In steps of 50 mm the held slope lowers the index by less than a percent.
    """
    road = road_of_iri(2.5, waviness=waviness, coherence=Constant(0.0))
    profile = road.profile(3000.0, 0.05, 1, (0.0, 1.0, 2.0, 3.0))
    indices = international_roughness_index(profile).tracks
    scatter = np.std(indices, ddof=1) / 2
    assert scatter < 0.06
    assert np.mean(indices) == pytest.approx(2.5, abs=0.025 + 3 * scatter)


def test_the_index_is_proportional_to_the_root_of_the_roughness():
    road = road_of_iri(4.0, waviness=2.5)
    assert road.exponent == 2.5
    assert expected_index(road.roughness, 2.5) == pytest.approx(4.0, rel=1e-12)
    assert road_of_iri(8.0, waviness=2.5).roughness == pytest.approx(4 * road.roughness, rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 2.0), "index must be finite and > 0 mm/m, got 0.0"),
        (("2.5", 2.0), "index must be finite and > 0 mm/m, got '2.5'"),
        ((2.5, 0.5), "waviness must be a number from 1.0 to 4.0, got 0.5"),
    ],
)
def test_other_values_are_one_line(arguments, message):
    with pytest.raises(ValueError, match=r"^") as error:
        road_of_iri(arguments[0], waviness=arguments[1])
    assert str(error.value) == message
