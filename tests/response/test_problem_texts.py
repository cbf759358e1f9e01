"""Sentences about a problem: what varies, limits, load cases, scatter."""

import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.problem_texts import representation, sentences, sentences_of_cases


@pytest.fixture(scope="module")
def file():
    return sc.load_vehicle("yuen_ramli_2010")


def problem(file, **others):
    return sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, nodes=256, **others)


def test_catalogues_and_limits_are_told_in_units_to_read(file):
    kinds, limits = {"spring": (18e3, 20e3), "damper": "log"}, ["SWS <= 0.03"]
    lines = sentences(problem(file, kinds=kinds, constraints=limits))
    assert lines[:2] == [
        "Varied: spring of 18, 20 kN/m; damper 1 to 5 kN s/m, log.",
        "Limits: SWS <= 30 mm.",
    ]
    assert "damper 1000 to 5000 N s/m, log" in " ".join(representation(problem(file, kinds=kinds)).split())


def test_a_road_in_common_is_told_once(file):
    speeds, road = (10.0, 30.0), sc.Iso8608Road("C")
    cases = [sc.LoadCase(vehicle=file.vehicle, road=road, speed=v, share=0.5) for v in speeds]
    both = sc.RideProblem(cases=cases, bounds=file.bounds, worst_case=True, nodes=256)
    first, *others = sentences_of_cases(both)
    assert first.startswith("Road of all cases: ISO 8608 class C")
    assert others == ["Case 1, share 0.5: 10 m/s.", "Case 2, share 0.5: 30 m/s."]
    assert "Objectives are over 2 load cases, their worst; limits hold in each." in sentences(both)
    one_more = sc.LoadCase(vehicle=file.vehicle, road=sc.Iso8608Road("A"), speed=10.0)
    unlike = sc.RideProblem(cases=[*cases, one_more], bounds=file.bounds, nodes=256)
    assert len(sentences_of_cases(unlike)) == 3
    assert sum("class C" in line for line in sentences_of_cases(unlike)) == 2


def test_scatter_is_told(file):
    lines = sentences(problem(file, measures=["mean ACC", "SWS"], scatter={"spring": 0.05}))
    assert "Scatter: spring ±5 %; 256 samples, seed 1." in lines
