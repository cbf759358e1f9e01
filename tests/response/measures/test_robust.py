"""Mean, quantile and CVaR of measures: their texts, and their weights by second roads."""

import pickle
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage import QUARTER, ROAD, on_road
from suspension_ctrl import ACC, DTL, SWS, Bottoming, CVaR, Limit, Mean, Measure, Quantile, RollDamping, ride
from suspension_ctrl.response.measures.measure import measure_of
from suspension_ctrl.response.measures.robust import of_quantile, of_tail

COST = Measure("cost", "EUR", lambda designs: designs @ [1e-3, 1e-2])
samples = st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=60)
levels = st.integers(0, 999).map(lambda tenths: tenths / 10)
inner = st.sampled_from([ACC(), ACC((1.2, -0.4)), SWS("front"), RollDamping(), Bottoming("front", gap=0.06)])
names = st.sampled_from(["", "comfort", "q95"])
written = st.one_of(
    st.builds(Mean, inner, name=names, maximise=st.booleans()),
    *(st.builds(kind, inner, levels, name=names, maximise=st.booleans()) for kind in (Quantile, CVaR)),
)


@given(written)
def test_a_robust_measure_is_read_from_its_text(measure):
    assert Measure.parse(str(measure)) == measure
    assert pickle.loads(pickle.dumps(measure)) == measure
    assert measure.unit == measure.nominal.unit


@pytest.mark.parametrize(
    ("text", "measure"),
    [
        ("mean ACC", Mean(ACC)),
        ("q95 SWS", Quantile("SWS", 95)),
        ("q99.5 DTL rear", Quantile(DTL("rear"), 99.5)),
        ("CVaR90 DTL front", CVaR("DTL front", 90.0)),
        ("-CVaR90 roll_damping", CVaR(RollDamping(), 90, maximise=True)),
        ("comfort = mean Wk driver_acceleration", Mean("Wk driver_acceleration", name="comfort")),
        ("q95 bottoming front 60mm", Quantile(Bottoming("front", gap=0.06), 95, name="q95 bottoming front 60mm")),
    ],
)
def test_texts_of_robust_measures(text, measure):
    assert measure_of(text) == measure
    assert measure_of(text).label == text.partition(" = ")[0]


def test_a_limit_on_a_robust_measure_and_the_nominal_one():
    limit = Limit.parse("q95 SWS <= 30mm")
    assert limit == Limit(Quantile(SWS(), 95), 0.03)
    assert limit.nominal == Limit(SWS(), 0.03)
    assert Limit.parse("comfort <= 1", [Mean(ACC(), name="comfort")]).measure == Mean(ACC(), name="comfort")
    assert Limit(SWS(), 0.03).nominal == Limit(SWS(), 0.03)
    assert str(Mean(COST)) == "mean cost"


@given(samples, levels)
def test_a_quantile_is_the_least_value_with_its_share_of_samples(values, level):
    ordered = np.sort(values)
    found = float(ordered @ of_quantile(ordered.size, level))
    share = (ordered <= found).mean()
    assert share >= level / 100 - 1e-9
    below = ordered[ordered < found]
    assert below.size / ordered.size < level / 100 or not below.size


@pytest.mark.parametrize(("samples", "level", "place"), [(20, 95, 19), (250, 64.4, 161), (375, 8.8, 33)])
def test_a_share_that_is_a_whole_number_of_samples_is_not_rounded_up(samples, level, place):
    assert of_quantile(samples, level).argmax() == place - 1


@given(samples, levels)
def test_cvar_is_the_minimum_of_rockafellar_and_uryasev(values, level):
    """CVaR = min over t of t + E[max(x - t, 0)]/(1 - level), at a sample: the function is linear between them."""
    x = np.sort(values)
    expected = min(t + np.maximum(x - t, 0).mean() / (1 - level / 100) for t in x)
    assert float(x @ of_tail(x.size, level, 1.0)) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    lower = -min(-t + np.maximum(t - x, 0).mean() / (1 - level / 100) for t in x)
    assert float(x @ of_tail(x.size, level, -1.0)) == pytest.approx(lower, rel=1e-9, abs=1e-9)


@given(samples, levels)
def test_cvar_is_at_least_the_quantile_and_the_mean(values, level):
    x = np.sort(values)
    slack = 1e-9 * (1 + np.abs(x).max())  # rounding of sums of 60 terms
    tail = x @ CVaR(ACC(), level).weights(x.size, 1.0)
    assert tail >= x @ Quantile(ACC(), level).weights(x.size, 1.0) - slack
    assert tail >= x @ Mean(ACC()).weights(x.size, 1.0) - slack
    assert x @ Mean(ACC()).weights(x.size, 1.0) == pytest.approx(x.mean(), abs=slack)


def test_one_vehicle_has_no_robust_measure():
    with pytest.raises(ValueError, match=r"^scatter must be given for q95 SWS, got none$"):
        ride(QUARTER, (22e3, 1500.0), ROAD, speed=20.0, measures=["q95 SWS"])
    with pytest.raises(ValueError, match=r"^scatter must be given for mean ACC, got none$"):
        Mean(ACC()).in_case(on_road(QUARTER), None)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("q SWS", "q must be like 'q95 SWS', got 'q SWS'"),
        ("CVaR", "CVaR must be like 'CVaR95 SWS', got 'CVaR'"),
        ("q101 SWS", "level of q must be a number from 0 to 100.0, got 101.0"),
        ("CVaR100 SWS", "level of CVaR must be a number from 0 to 99.99, got 100.0"),
        ("mean q95 SWS", "mean must be of a measure of one vehicle without - in front, got 'q95 SWS'"),
        ("mean -roll_damping", "mean must be of a measure of one vehicle without - in front, got '-roll_damping'"),
        ("mean", "measure must be a text such as 'SWS front'"),
    ],
)
def test_what_is_no_robust_measure_is_told_in_one_line(text, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        Measure.parse(text)
