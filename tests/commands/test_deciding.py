"""Requests of `optimum`: limits in place of others, the paper's problem, the algorithm, the problem in words."""

import pandas as pd
import pytest

from suspension_ctrl import (
    Iso8608Road,
    Measure,
    MoeadDra,
    Nsga2,
    RideProblem,
    load_vehicle,
    minimise,
)
from suspension_ctrl.commands.deciding import Request, without_designs
from suspension_ctrl.desk.decision import Decision
from suspension_ctrl.desk.study_files import SearchSettings, StudyFile
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.paper.optimum import TRAVEL, table5

FILE = load_vehicle("minaker_half")
PROBLEM = RideProblem(
    FILE.vehicle, Iso8608Road("C"), speed=20.0, bounds=FILE.bounds, band=(0.3, 20.0), constraints=["SWS <= 0.02"]
)


def study_of(problem: RideProblem, *algorithms: str, **present: float) -> StudyFile:
    search = SearchSettings(algorithms=algorithms or ("moead-dra",), populations=(60,), iterations=(5,))
    return StudyFile(problem=problem, name="A car", present=present, search=search)


def request_of(problem: RideProblem, *algorithms: str) -> Request:
    return Request(study_of(problem, *algorithms))


def test_a_limit_takes_the_place_of_that_on_the_same_measure():
    both = PROBLEM.replace(constraints=["DTL <= 3000", "SWS <= 0.02", "SWS front <= 0.01"])
    found = request_of(both).within(0.012)
    assert sorted(map(str, found.study.problem.constraints)) == [
        "DTL <= 3000",
        "SWS <= 0.012",
        "SWS front <= 0.01",
    ]
    assert found.travel is None
    kept = request_of(both).within(None)
    assert sorted(map(str, kept.study.problem.constraints)) == sorted(map(str, both.constraints))
    with pytest.raises(ValueError, match=r"^sws_limit must be finite and > 0 m, got 0.0$"):
        request_of(both).within(0.0)


def test_the_papers_problem_has_the_travel_of_table_5():
    papers = paper.ride_problem(weighting="Wb", band=(0.1, 20.0))
    assert paper.is_papers(papers)
    assert not paper.is_papers(PROBLEM)
    assert not paper.is_papers(papers.replace(speed=21.0))
    assert not paper.is_papers(papers.replace(bounds={"spring": (1e3, 31e3), "damper": (1e3, 5e3)}))
    found = request_of(papers).within(None)
    assert (found.travel, list(map(str, found.study.problem.constraints))) == (TRAVEL, ["SWS <= 0.0287"])
    assert request_of(papers).within(0.02).travel == 0.02
    again = Request(request_of(papers).within(0.02).study).within(None)  # the study in the folder of results
    assert again.travel == 0.02


def test_a_problem_without_a_kernel_is_searched_by_whole_populations():
    assert isinstance(request_of(PROBLEM).optimiser, MoeadDra)
    own = PROBLEM.replace(measures=["ACC", Measure("sum", "N/m", lambda designs: designs.sum(axis=1))])
    assert isinstance(request_of(own).optimiser, Nsga2)
    assert isinstance(request_of(PROBLEM, "nsga2", "moead-dra").optimiser, Nsga2)


def test_rows_that_table_5_lacks_are_told_with_the_travels_of_the_front():
    papers = paper.ride_problem()
    run = minimise(papers, Nsga2(population=20), iterations=1, seed=0)
    decision = Decision(papers, run, run, pd.DataFrame())
    (line,) = without_designs(decision, [table5(papers, run, 0.0449), table5(papers, run, 0.0287)])
    travel = 1e3 * run.objectives[run.on_front(), 1]
    have = f"{travel.min():.4g} to {travel.max():.4g} mm"
    assert line == f"Table 5 lacks designs picked: none is at the limit; the front has SWS of {have}."
    full = pd.DataFrame({"design": ["exact, least ACC", "picked, least ACC"]})
    assert without_designs(decision, [full]) == []
