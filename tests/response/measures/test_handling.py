"""Measures of handling in a ride problem."""

import numpy as np

from garage import FULL, GEOMETRY, on_road
from suspension_ctrl import RideProblem

BAND, NODES = (0.1, 20.0), 256


def test_measures_of_handling_are_those_of_the_mechanics():
    names = ("roll_gradient", "front_load_transfer", "-roll_damping")
    bounds = {"front_antiroll": (0.0, 3e4), "rear.damper": (1e3, 3e3)}
    fixed = {"front": (2e4, 1500.0), "rear.spring": 2e4}
    p = RideProblem(
        cases=[on_road(FULL)], measures=("ACC", *names),
        bounds=bounds, struts=fixed, band=BAND, nodes=NODES,
    )  # fmt: skip
    assert p.kernel is None
    assert [p.units[name] for name in names] == ["deg/g", "-", "-"]
    found = p.evaluate([[1e4, 1500.0], [2e4, 2500.0]])
    mechanics = FULL.statics
    for row, (bar, damper) in zip(found, ((1e4, 1500.0), (2e4, 2500.0)), strict=True):
        values = np.array([list(FULL.coefficients(
            {"front": (2e4, 1500.0), "rear": (2e4, damper), "front_antiroll": bar}).values())])  # fmt: skip
        expected = [
            mechanics.roll_gradient(values, GEOMETRY)[0],
            mechanics.front_load_transfer(values, GEOMETRY)[0],
            -mechanics.roll_damping(values)[0],
        ]
        np.testing.assert_allclose(row[1:], expected, rtol=1e-12)
