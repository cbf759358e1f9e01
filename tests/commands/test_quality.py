"""What is reported of a campaign in which runs raise: the others, and which raised."""

import re
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.commands import comparing, quality, terminal
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import comparison, workers
from suspension_ctrl.study import reference as references
from suspension_ctrl.study.campaign import Campaign
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.findings import findings, last_rows
from suspension_ctrl.study.reference import grid_front


def campaign(raises) -> Comparison:
    ride = paper.ride_problem()

    def evaluate(designs: np.ndarray) -> np.ndarray:
        if raises(designs):
            raise RuntimeError("no such strut")
        return ride.evaluate(designs)

    problem = Problem(
        evaluate=evaluate, lower=ride.lower, upper=ride.upper, objectives=ride.objectives,
        variables=ride.variables, units=ride.units,
    )  # fmt: skip
    return Comparison(problem=problem, algorithms=["nsga2", "sobol"], populations=[20], iterations=[2], seeds=8)


def clock() -> pd.DataFrame:
    """Seconds as if timed, a thousandth per evaluation."""
    rows = [(name, 20, e, e / 1000) for name in ("nsga2", "sobol") for e in (20, 60)]
    return pd.DataFrame(rows, columns=["algorithm", "population", "evaluations", "seconds"])


def reported(one: Comparison, folder, monkeypatch) -> pd.DataFrame:
    monkeypatch.setattr(references, "fingerprint", lambda problem: "")  # it evaluates the problem
    campaign = Campaign(one, folder)
    front = ReferenceFront.of(grid_front(paper.ride_problem(), 40))
    table, store = campaign.judge(front)
    if found := findings(one, table, clock(), 0.9):
        quality.write(comparing.Request(campaign, SimpleNamespace(problem=one.problem), {}), found, store)
    return table


def test_runs_that_raise_leave_the_others_in_tables_and_figures(tmp_path, monkeypatch):
    """The first run of the first algorithm is among those that raise."""
    first = np.random.default_rng(0).random((20, 2))[0, 0]
    ride = paper.ride_problem()
    limit = ride.lower[0] + (ride.upper[0] - ride.lower[0]) * first
    table = reported(campaign(lambda x: x[0, 0] >= limit - 1e-6), tmp_path, monkeypatch)
    rows = last_rows(table)
    assert len(rows) == 16
    raised = rows[rows.error != ""]
    assert ("nsga2", 0) in set(zip(raised.algorithm, raised.seed, strict=True))
    assert 0 < len(raised) < 16
    assert set(raised.error) == {"RuntimeError: no such strut"}
    differences = pd.read_csv(tmp_path / "differences.csv")
    assert set(differences["first"]) == {"nsga2"}
    words = (tmp_path / "verdict.md").read_text()
    assert re.match(r"No verdict: [1-5] runs against 6 cannot differ significantly\.", words)
    assert (tmp_path / "attainment_n20.png").exists()


def test_a_verdict_is_a_table_and_words(tmp_path, monkeypatch, capsys):
    """Printed with a column for each lens; the same in the files, with the numbers behind it."""
    reported(campaign(lambda x: False), tmp_path, monkeypatch)
    table = pd.read_csv(tmp_path / "verdict.csv")
    lenses = [f"equal {lens}" for lens in ("iterations", "evaluations", "time")]
    assert list(table) == ["set", "population", "iterations", "other", *lenses]
    assert table["set"].tolist() == ["population", "archive of N"]
    assert set(table[lenses].to_numpy().ravel()) <= {"nsga2", "sobol", "no difference"}
    words = (tmp_path / "verdict.md").read_text()
    assert words.startswith("| set ")
    assert words.count("nsga2 against sobol. At equal iterations ") == 2
    assert r"\toprule" in (tmp_path / "verdict.tex").read_text()
    quality.say_verdict(table, "nsga2")
    terminal.say()
    rows = [line.split() for line in capsys.readouterr().out.splitlines() if line.startswith(("archive", "popul"))]
    assert " ".join(rows[0]) == f"population 20 2 sobol {' '.join(table[lenses].iloc[0])}"


def test_an_algorithm_without_any_run_is_left_out(tmp_path, monkeypatch):
    one = campaign(lambda x: False)
    monkeypatch.setitem(comparison.ALGORITHMS, "nsga2", lambda population: Broken(population))
    table = reported(one, tmp_path, monkeypatch)
    assert set(table[table.error != ""].algorithm) == {"nsga2"}
    assert set(pd.read_csv(tmp_path / "equal.csv").algorithm) == {"sobol"}
    assert not (tmp_path / "attainment_n20.png").exists()


class Broken:
    def __init__(self, population):
        self.population = population

    def evaluations_per_iteration(self, objectives):
        return self.population

    def toolbox(self, problem):
        raise RuntimeError("out of order")


def test_a_campaign_in_which_all_raise_says_only_that(tmp_path, monkeypatch):
    table = reported(campaign(lambda x: True), tmp_path, monkeypatch)
    assert (table.error == "RuntimeError: no such strut").all()
    assert sorted(path.name for path in tmp_path.glob("[!.]*")) == ["quality"]


def test_runs_are_made_in_one_place():
    with pytest.raises(ValueError, match=r"^jobs must stand without scheduler, got 2 and 'tcp://h:1'$"):
        workers.cluster(2, "tcp://h:1")
