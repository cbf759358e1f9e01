"""Measures by functions as numbers; `test_numerics` computes them under Node."""

import re
from pathlib import Path

import numpy as np
import pytest

from garage import DRIVER, FULL, GEOMETRY, ROAD
from suspension_ctrl import LoadCase, Measure, RideProblem, SpeedBump
from suspension_ctrl.desk.explorer import functions
from suspension_ctrl.desk.explorer.functions import functions_of, why_not

BOUNDS = {"front.spring": (15e3, 30e3), "rear.spring": (15e3, 30e3)}
FIXED = {"front.damper": 1500.0, "rear.damper": 1500.0}


@pytest.fixture(scope="module")
def problem() -> RideProblem:
    bump = {"bump": SpeedBump(height=0.05, length=2.0)}
    case = LoadCase(vehicle=DRIVER.on(FULL), road=ROAD, speed=20.0, roll_geometry=GEOMETRY, events=bump)
    own = Measure("own", "-", lambda designs: designs[:, 0])
    measures = ["ACC", "lift front", "VDV driver", "peak travel bump", own]
    return RideProblem(
        cases=[case],
        measures=measures,
        bounds=BOUNDS,
        struts=FIXED,
        band=(0.3, 20.0),
        constraints=["roll_gradient <= 6"],
    )


def test_scores_by_mean_squares_of_events_and_of_users_have_none(problem):
    words = [one and one.word for one in functions_of(problem)]
    assert words == [None, "lift", "VDV", None, None, "roll_gradient"]
    assert [why_not(one) for one in problem.measures[3:]] == ["simulated in an event", "a function of your own"]


def test_numbers_are_places_of_terms_and_of_tyres(problem):
    _, lift, vdv, *_, gradient = functions_of(problem)
    terms = [str(one) for one in problem.scores.terms[0]]
    (numbers,) = lift.cases
    assert [terms[i] for i in numbers["terms"]] == ["front_left_tyre_load", "front_right_tyre_load"]
    assert numbers["tyres"] == (0, 1)
    assert vdv.power == 4.0
    np.testing.assert_allclose(vdv.cases[0]["factors"], (3 * 8 * 3600.0) ** 0.25)
    assert [axle["track"] for axle in gradient.cases[0]["axles"]] == [1.5, 1.46]


def test_every_word_has_a_formula():
    text = (Path(functions.__file__).parent / "numerics" / "functions.js").read_text(encoding="utf-8")
    table = text.partition("const OF_WORD = {")[2].partition("\n};")[0]
    assert set(re.findall(r"^  (\w+)[:,]", table, re.MULTILINE)) == functions.WORDS
