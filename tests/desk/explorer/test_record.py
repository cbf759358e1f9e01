"""The record of a study: columns with their limits, and a study file with any design as its present one."""

import json
from dataclasses import replace

import pytest

from suspension_ctrl import Nsga2, load_study
from suspension_ctrl.desk.decision import Decision
from suspension_ctrl.desk.explorer.layers import Layer
from suspension_ctrl.desk.explorer.record import columns_of, record_of

SEARCH = {"iterations": 2, "seed": 1}


@pytest.fixture(scope="module")
def study():
    found = load_study("full_car")
    limits = [*found.problem.constraints, "roll_damping >= 0.1"]
    problem = found.problem.replace(constraints=limits, cases=found.problem.cases[:1], nodes=256)
    return replace(found, problem=problem, name="mine")


@pytest.fixture(scope="module")
def record(study):
    decision = Decision.of(study.problem, Nsga2(population=20), present=study.present, **SEARCH)
    return json.loads(
        json.dumps(
            record_of(study, decision, [Layer("other", decision.run.front(), "run", False)]), allow_nan=False
        )
    )


def test_columns_are_measures_limits_and_variables(study):
    columns = {one.name: one for one in columns_of(study.problem)}
    objectives, variables = list(study.problem.objectives), list(study.problem.variables)
    assert list(columns) == [*objectives, "roll_gradient", "roll_damping", *variables]
    assert columns["SWS"].limits == (None, 0.012)
    assert (columns["SWS"].unit, columns["SWS"].factor, columns["SWS"].csv) == ("mm", 1e3, "SWS [mm]")
    damping = columns["roll_damping"]
    assert (damping.kind, damping.limits, damping.computed, damping.unit) == ("limit", (0.1, None), True, "")
    assert damping.scale * 0.1 + damping.offset == pytest.approx(0.0)  # at the limit
    assert (columns["front.spring"].unit, columns["front.spring"].place) == ("kN/m", 0)


def test_the_record_holds_the_front_the_candidates_and_the_present_design(study, record):
    d, s = len(study.problem.variables), len(study.problem.measures) + len(study.problem.constraints)
    assert record["present"]["names"] == ["present design"]
    titles = [title for title, _ in record["candidates"]["known"][0]]
    assert {"residual", "largest travel in 1 km [mm]"} <= set(titles)
    assert record["candidates"]["designs"]["shape"][1] == d
    assert record["candidates"]["scores"]["shape"] == [len(record["candidates"]["names"]), s]
    assert record["front"]["scores"]["shape"][1] == s
    assert [[one[key] for key in ("name", "kind", "shown")] for one in record["others"]] == [
        ["other", "run", False]
    ]
    assert record["others"][0]["objectives"]["shape"] == [record["front"]["scores"]["shape"][0], 3]


def test_the_study_file_takes_any_design(study, record, tmp_path):
    design = [low + 0.3 * (high - low) for low, high in study.problem.bounds.values()]
    lines = [f"{key} = {value!r}" for key, value in zip(record["study"]["keys"], design, strict=True)]
    (tmp_path / "mine.toml").write_text("\n".join([record["study"]["text"], "[present]", *lines]))
    found = load_study(tmp_path / "mine.toml")
    assert list(found.present.values()) == design
    assert found.problem == study.problem


def test_a_limit_in_the_worst_load_case_is_no_limit_of_the_mean():
    problem = load_study("full_car").problem
    found = {one.name: one.limits for one in columns_of(problem) if one.kind != "variable"}
    assert found["SWS"] == (None, None)
    assert found["SWS, worst case"] == (None, 0.012)
    worst = {one.name: one.limits for one in columns_of(problem.replace(worst_case=True))}
    assert worst["SWS"] == (None, 0.012)
    assert "SWS, worst case" not in worst
