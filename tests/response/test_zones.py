"""Shares of time in zones beside a histogram of driving."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, QUARTER, struts_of

EDGES = [-0.4, -0.1, 0.0, 0.1, 0.4]


def test_shares_are_those_of_a_histogram_of_driving():
    """Over 20 km the share of a zone is within 3 % of the whole."""
    road, band = sc.Iso8608Road("C"), (20.0 / 20e3, 20.0 / 0.2)
    profile = road.profile(20e3, 0.1, seed=5)
    rate = "suspension_travel_rate"
    driven = sc.simulate(QUARTER, (22e3, 1500.0), profile, 20.0, periodic=True, responses=[rate]).iloc[:, -1]
    table = sc.time_in_zones(QUARTER, (22e3, 1500.0), road, 20.0, EDGES, band=band)
    counted, _ = np.histogram(driven, [-np.inf, *EDGES, np.inf])
    np.testing.assert_allclose(table[rate], counted / counted.sum(), rtol=0, atol=0.03)
    assert table[rate].sum() == pytest.approx(1.0, rel=1e-12)
    assert table["to [m/s]"].tolist() == [*EDGES, np.inf]


def test_an_axle_has_a_column_by_wheel():
    table = sc.time_in_zones(
        FULL, struts_of(FULL), sc.Iso8608Road("C"), 20.0, [0.0, 0.02], response="rear_travel", band=(0.1, 20.0)
    )
    assert list(table.columns) == [
        "from [m]", "to [m]", "rear_left_suspension_travel", "rear_right_suspension_travel",
    ]  # fmt: skip
    assert table["rear_left_suspension_travel"][0] == 0.5


@pytest.mark.parametrize(
    ("edges", "response", "key"),
    [([0.1, 0.0], "travel", "edges"), ([], "travel", "edges"), ([0.0], "body_displacement", "response")],
)
def test_what_is_wrong_is_named(edges, response, key):
    with pytest.raises(ValueError, match=rf"^{key} "):
        sc.time_in_zones(QUARTER, (22e3, 1500.0), sc.Iso8608Road("C"), 20.0, edges, response=response)
