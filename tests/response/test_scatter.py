"""Deviations by name and their samples."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from suspension_ctrl import Scatter
from suspension_ctrl.response.scatter import scatter_of

NAMES = (
    "front.spring",
    "rear.spring",
    "front.damper.scale",
    "rear.damper",
    "front_tyre_stiffness",
    "payload.mass",
)


def test_a_name_stands_for_all_that_end_with_it_and_the_longest_counts():
    scatter = Scatter({"rear.spring": 0.01, "spring": 0.05, "damper": (-0.25, 0.0), "tyre_stiffness": "10 %"})
    assert scatter.of(NAMES) == {
        "front.spring": (-0.05, 0.05),
        "rear.spring": (-0.01, 0.01),
        "front.damper.scale": (-0.25, 0.0),
        "rear.damper": (-0.25, 0.0),
        "front_tyre_stiffness": (-0.1, 0.1),
    }
    assert Scatter({"mass": 0.1}).of(NAMES) == {"payload.mass": (-0.1, 0.1)}


def test_what_has_no_deviation_does_not_scatter():
    assert Scatter({"spring": 0.0, "damper": 0.1}).of(["spring", "damper"]) == {"damper": (-0.1, 0.1)}
    assert Scatter({"spring": 0}, samples=3).factors([]).shape == (3, 0)


@given(st.integers(1, 300), st.integers(0, 9), st.floats(-0.9, 0.0), st.floats(0.0, 0.9))
def test_samples_fill_the_deviations(samples, seed, low, high):
    scatter = Scatter({"spring": (low, high)}, samples=samples, seed=seed)
    factors = scatter.factors([(low, high), (-0.1, 0.0)])
    assert factors.shape == (samples, 2)
    np.testing.assert_array_equal(factors, scatter.factors([(low, high), (-0.1, 0.0)]))
    assert (factors[:, 0] >= 1 + low).all()
    assert (factors[:, 0] <= 1 + high).all()
    if samples & (samples - 1) == 0:  # a power of 2: one in each of as many equal parts
        places = np.sort(np.floor((factors[:, 1] - 0.9) / 0.1 * samples))
        np.testing.assert_allclose(places, np.arange(samples), atol=1)  # by rounding in a neighbour


def test_a_normal_distribution_is_truncated_at_three_standard_deviations():
    """Against scipy's truncated normal: one sample in each of 1024 parts of equal probability."""
    scatter = Scatter({"damper": 0.15}, samples=1024, distribution="normal")
    found = np.sort(scatter.factors([(-0.15, 0.15)])[:, 0])
    exact = stats.truncnorm(-3, 3, loc=1.0, scale=0.05)
    assert (exact.ppf(np.arange(1024) / 1024) <= found + 1e-12).all()
    assert (found <= exact.ppf(np.arange(1, 1025) / 1024) + 1e-12).all()


def test_the_seed_and_the_distribution_are_told():
    assert Scatter({"spring": 0.05}, seed=7).describe() == "spring ±5 %; 256 samples, seed 7"
    told = Scatter({"damper": ("-25 %", 0)}, samples=8, distribution="normal").describe()
    assert told == "damper -25 to 0 %, normal; 8 samples, seed 1"


def test_texts_and_numbers_are_the_same():
    assert scatter_of({"spring": "5 %"}) == Scatter({"spring": 0.05}) == Scatter({"spring": (-0.05, 0.05)})
    assert scatter_of(None) is None


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"tolerances": {"spring": 1.0}}, "scatter.spring must leave values above zero, 0.05 for 5 %, got 1.0"),
        ({"tolerances": {"spring": 5}}, "scatter.spring must leave values above zero, 0.05 for 5 %, got 5"),
        ({"tolerances": {"spring": (-1.0, 0.0)}}, "scatter.spring must leave values above zero"),
        ({"tolerances": {"spring": (0.1, -0.1)}}, "scatter.spring must leave values above zero"),
        ({"tolerances": {"spring": -0.1}}, "scatter.spring must leave values above zero"),
        ({"tolerances": {"spring": "5 kg"}}, "scatter.spring must be a number without unit, got '5 kg' in kg"),
        ({"tolerances": {"spring": (0.1, 0.1, 0.1)}}, "scatter.spring must be a share or two in order"),
        ({"tolerances": {"spring": None}}, "scatter.spring must be a number from -1000.0 to 1000.0, got None"),
        ({"tolerances": {1: 0.1}}, "each name of scatter must be a str, got 1"),
        ({"tolerances": {}}, "scatter must have a tolerance by name, one at least, got none"),
        ({"tolerances": 0.1}, "scatter must be a mapping by name, got 0.1"),
        ({"tolerances": {"spring": 0.1}, "samples": 0}, "samples must be a whole number >= 1, got 0"),
        ({"tolerances": {"spring": 0.1}, "samples": 10**7}, "samples must be a number from 1 to 1000000, got 100"),
        ({"tolerances": {"spring": 0.1}, "seed": -1}, "seed must be a whole number >= 0, got -1"),
        ({"tolerances": {"spring": 0.1}, "distribution": "beta"}, "distribution must be one of uniform, normal"),
    ],
)
def test_what_is_no_scatter_is_told_in_one_line(arguments, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}") as error:
        Scatter(**arguments)
    assert "\n" not in str(error.value)


def test_an_unknown_name_and_another_kind_are_told():
    with pytest.raises(ValueError, match=r"^scatter must be one of front.spring, .*, got 'sprang'$"):
        Scatter({"sprang": 0.1}).of(NAMES)
    with pytest.raises(ValueError, match=r"^scatter must be a Scatter or tolerances by name, got 0.1$"):
        scatter_of(0.1)
