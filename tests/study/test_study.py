"""Studies: a tidy table of every run, judged by what was seen, whoever makes the runs and in whatever order."""

import pickle
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from functions import dtlz2, srn, srn_set, zdt1
from suspension_ctrl import MoeadDra, Nsga2, Problem, minimise
from suspension_ctrl.search.indicators import ReferenceFront, non_dominated
from suspension_ctrl.search.sampling import Sampling
from suspension_ctrl.search.trace import trace
from suspension_ctrl.study.judging import ARCHIVE, CUT_ARCHIVE, INDICATORS, POPULATION
from suspension_ctrl.study.store import FolderStore
from suspension_ctrl.study.study import ApproximationWarning, Study

F1 = np.linspace(0, 1, 200)
ZDT1_FRONT = ReferenceFront.of(np.stack([F1, 1 - np.sqrt(F1)], axis=1))


@pytest.fixture(scope="module")
def small() -> Study:
    return Study(
        problems={"zdt1": zdt1(4), "dtlz2": dtlz2(4)},
        algorithms={"nsga2": Nsga2(population=20), "sobol": Sampling(population=20)},
        seeds=[3, 4],
        budgets=[40, 205],
        references={"zdt1": ZDT1_FRONT},
    )


@pytest.fixture(scope="module")
def table(small) -> pd.DataFrame:
    return small.run()


def test_a_row_per_run_budget_and_set(table):
    assert len(table) == 2 * 2 * 2 * 2 * 3
    assert not table.duplicated(["problem", "algorithm", "seed", "budget", "set"]).any()
    assert table[table.budget == 205].evaluations.unique().tolist() == [200]
    assert table[list(INDICATORS)].notna().all(axis=None)
    assert table.error.eq("").all()


def test_indicators_are_those_of_the_runs(table):
    run = minimise(zdt1(4), Nsga2(population=20), evaluations=205, seed=4)
    best = run.objectives[non_dominated(run.objectives)]
    rows = table[(table.problem == "zdt1") & (table.algorithm == "nsga2") & (table.seed == 4)]
    row = rows[(rows.budget == 205) & (rows.set == POPULATION)].iloc[0]
    assert row.members == len(best)
    for indicator in INDICATORS:
        assert row[indicator] == getattr(ZDT1_FRONT, indicator)(best)


def test_an_archive_is_at_least_as_good_as_what_it_is_cut_to(table):
    by_set = table.pivot_table(
        index=["problem", "algorithm", "seed", "budget"], columns="set", values=["relative_hypervolume", "members"]
    )
    volume, size = by_set.relative_hypervolume, by_set.members
    assert (volume[ARCHIVE] >= volume[POPULATION] - 1e-12).all()
    assert (volume[ARCHIVE] >= volume[CUT_ARCHIVE] - 1e-12).all()
    assert (size[CUT_ARCHIVE] == size[ARCHIVE].clip(upper=20)).all()
    sobol = volume.xs("sobol", level="algorithm")
    np.testing.assert_array_equal(sobol[POPULATION], sobol[CUT_ARCHIVE])


def test_without_a_reference_the_first_seeds_runs_are_it(small, table):
    archives = table[(table.problem == "dtlz2") & (table.seed == 3) & (table.set == ARCHIVE)]
    assert archives.relative_hypervolume.max() <= 1
    assert small.reference("dtlz2").relative_hypervolume(small.reference("dtlz2").objectives) == pytest.approx(1)


def test_what_is_stored_is_not_made_again(small, table, tmp_path):
    store = FolderStore(tmp_path / "kept", {"plan": 1})
    made = small.carry_out(store)
    first = [next(made)[0].name for _ in range(3)]
    made.close()
    again = FolderStore(tmp_path / "kept", {"plan": 1})
    assert sorted(again) == sorted(first)
    rest = [run.name for run, _ in small.carry_out(again)]
    assert sorted(first + rest) == sorted(run.name for run in small.runs())
    pd.testing.assert_frame_equal(small.table(again).drop(columns="seconds"), table.drop(columns="seconds"))


def failing(designs: np.ndarray) -> np.ndarray:
    if designs[0, 0] > 0.5:
        raise RuntimeError("the road\nends here")
    return np.stack([designs[:, 0], 1 - designs[:, 0]], axis=1)


def test_a_run_that_raises_is_recorded_and_the_others_go_on():
    problem = Problem(evaluate=failing, lower=(0,), upper=(1,), objectives=("f1", "f2"))
    found = Study(
        problems={"p": problem},
        algorithms={"random": Sampling(population=4, points="random")},
        seeds=range(12),
        budgets=[8],
        references={"p": ReferenceFront.of(np.array([[0.0, 1.0], [1.0, 0.0]]))},
    ).run()
    raised = found[found.error != ""]
    assert 0 < len(raised) < 12
    assert set(raised.error) == {"RuntimeError: the road ends here"}
    assert raised[list(INDICATORS)].isna().all(axis=None)
    assert found.seed.nunique() == 12


def unsolved(designs: np.ndarray) -> np.ndarray:
    """ZDT1, whose solver fails for some 0.1 % of the designs."""
    if (np.floor(1e4 * designs[:, 1:].sum(axis=1)) % 1000 < 1).any():
        raise RuntimeError("solver did not converge")
    return zdt1(10).evaluate(designs)


@pytest.mark.parametrize("references", [{}, {"p": ZDT1_FRONT}], ids=["of first seed", "given"])
def test_a_run_that_raises_keeps_the_budgets_before(references):
    """Their numbers are those of a study that ends before the failure."""
    problem = Problem(evaluate=unsolved, lower=[0.0] * 10, upper=[1.0] * 10, objectives=("f1", "f2"))
    one = Study(
        problems={"p": problem}, algorithms={"nsga2": Nsga2(population=20)}, seeds=range(6),
        budgets=[20, 200, 1000], references=references,
    )  # fmt: skip
    table = one.run()
    raised = table[table.error.ne("")]
    assert set(raised.error) == {"RuntimeError: solver did not converge"}
    counts = raised.groupby("seed").budget.nunique()
    assert counts.isin([1, 2]).any()
    assert raised[raised.budget.isna()].seed.is_unique
    for seed, count in counts[counts > 0].items():
        found = raised[raised.seed.eq(seed) & raised.budget.notna()]
        reference = {"p": one.reference("p")}
        sooner = replace(one, seeds=[seed], budgets=one.budgets[:count], references=reference).run()
        same = ["budget", "set", "members", "evaluations", *INDICATORS]
        pd.testing.assert_frame_equal(
            found[same].reset_index(drop=True), sooner[same].reset_index(drop=True), check_dtype=False
        )


def unsolvable(designs: np.ndarray) -> np.ndarray:
    raise RuntimeError("the road\nends here")


def test_a_reference_that_cannot_be_made_is_the_error_of_its_runs():
    problems = {
        "p": Problem(evaluate=unsolvable, lower=(0,), upper=(1,), objectives=("f1", "f2")),
        "zdt1": zdt1(4),
    }
    algorithms = {"random": Sampling(population=4, points="random")}
    found = Study(problems=problems, algorithms=algorithms, seeds=range(3), budgets=[40]).run()
    assert (found[found.problem == "p"].error == "RuntimeError: the road ends here").all()
    assert (found[found.problem == "zdt1"].error == "").all()
    assert found.groupby("problem").seed.nunique().tolist() == [3, 3]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"seeds": []}, r"seeds must be one or more, got \(\)"),
        ({"algorithms": {}}, r"algorithms must be one or more, got \{\}"),
        ({"seeds": [-1]}, "seeds must be a whole number >= 0, got -1"),
        ({"seeds": [1, 2, 1]}, r"seeds must be different, got \[1, 2, 1\]"),
        ({"budgets": [40, 8]}, "budgets must be a whole number >= 20, got 8"),
        (
            {
                "problems": {"p": zdt1(4), "p_q": zdt1(4)},
                "algorithms": {"q_a": Nsga2(population=20), "a": Nsga2(population=20)},
            },
            "names must not give files of two runs the same name",
        ),
        ({"references": {"zdt2": ZDT1_FRONT}}, "references must be one of zdt1, got 'zdt2'"),
    ],
)
def test_rejects_bad_studies(change, message):
    settings = {
        "problems": {"zdt1": zdt1(4)}, "algorithms": {"a": Nsga2(population=20)}, "seeds": [1], "budgets": [40]
    }  # fmt: skip
    with pytest.raises(ValueError, match=f"^{message}"):
        Study(**settings | change)


def test_moead_is_judged_by_what_its_kernel_returned():
    problem = dtlz2(4, compiled=True)
    one = Study(problems={"p": problem}, algorithms={"m": MoeadDra(population=20)}, seeds=[1], budgets=[20, 80])
    rows = one.run()
    run = minimise(problem, MoeadDra(population=20), evaluations=80, seed=1)
    best = run.objectives[non_dominated(run.objectives)]
    final = rows[(rows.budget == 80) & (rows.set == POPULATION)].iloc[0]
    assert final.relative_hypervolume == one.reference("p").relative_hypervolume(best)
    assert rows[(rows.budget == 80) & (rows.set == ARCHIVE)].relative_hypervolume.item() == pytest.approx(1)


def test_nothing_is_judged_twice_by_name(small):
    names = [run.name for run in small.runs()]
    assert len(set(names)) == len(names) == 8
    assert names[0] == "zdt1_nsga2_n20_s3"
    assert small.runs()[0].key == {"problem": "zdt1", "algorithm": "nsga2", "population": 20, "seed": 3}


def test_a_study_is_compared_hashed_pickled_and_shown(small, table1_problem):
    """Also with its reference front, whose arrays are equal but others."""
    fronts = {"ride": ReferenceFront.of(ZDT1_FRONT.objectives.copy())}
    study = replace(small, problems={"ride": table1_problem}, references=fronts)
    same = replace(study, references={"ride": ZDT1_FRONT})
    assert study == same
    assert hash(study) == hash(same)
    assert study != replace(study, seeds=[3, 5])
    assert pickle.loads(pickle.dumps(study)).references == study.references
    assert repr(study) == (
        "Study(problems=['ride'], algorithms=['nsga2', 'sobol'], seeds=2 from 3 to 4, budgets=2\n"
        "    from 40 to 205, references=['ride'])"
    )
    with pytest.raises(ValueError, match="read-only"):
        fronts["ride"].objectives[0, 0] = 1


def test_any_name_makes_a_file(small):
    """Also on systems that tell no ``A`` from ``a``: there two runs would share a file."""
    named = replace(small, algorithms={"a/b: c?": Nsga2(population=20)}, problems={"zdt1": zdt1(4)})
    assert named.runs()[0].name == "zdt1_a_b__c__n20_s3"
    with pytest.raises(ValueError, match=r"^names must not give files of two runs the same name, got "):
        replace(named, algorithms={"A": Nsga2(population=20), "a": Nsga2(population=20)})


def nowhere(designs: np.ndarray) -> np.ndarray:
    return np.column_stack([designs, 1 - designs, 0 * designs + 1])


NOWHERE = Problem(
    evaluate=nowhere, lower=(0,), upper=(1,), objectives=("f1", "f2"), constraints=("g",)
)  # fmt: skip


def test_only_feasible_designs_are_judged():
    """Population, archive and what is cut of it, against what a run and a trace of it give by hand."""
    problem, front = srn(), ReferenceFront.of(srn().evaluate(srn_set(200))[:, :2])
    algorithms = {"nsga2": Nsga2(population=20), "moead": MoeadDra(population=20)}
    store = {}
    one = Study(
        problems={"srn": problem}, algorithms=algorithms, seeds=[2], budgets=[20, 200], references={"srn": front}
    )
    assert not any(failure for _, failure in one.carry_out(store))
    table = one.table(store)
    for name, optimiser in algorithms.items():
        rows = table[table.algorithm == name].set_index(["budget", "set"])
        for budget in (20, 200):
            seen = trace(problem, optimiser, [budget], seed=2)
            for kept, objectives, feasible in (
                (POPULATION, seen.states[budget].objectives, seen.states[budget].violation == 0),
                (ARCHIVE, seen.objectives, seen.feasible),
            ):
                best = objectives[feasible][non_dominated(objectives[feasible])]
                row = rows.loc[budget, kept]
                assert row.members == len(best) > 0
                assert row.relative_hypervolume == front.relative_hypervolume(best)
                assert row.igd_plus == front.igd_plus(best)
        assert rows.loc[(20, POPULATION), "members"] < non_dominated(seen.objectives[:20]).sum()
        final = store[one.runs()[list(algorithms).index(name)].name].final
        assert list(final.columns) == ["f1", "f2", "violation"]
        np.testing.assert_array_equal(final.violation, seen.states[200].violation)


def test_a_run_without_a_feasible_design_has_no_hypervolume(tmp_path):
    """It is no error, also not when it is read back from disk; statistics rank it below all others."""
    front = ReferenceFront.of(np.array([[0.0, 1.0], [1.0, 0.0]]))
    algorithms = {
        "nsga2": Nsga2(population=20),
        "moead": MoeadDra(population=20),
        "sobol": Sampling(population=20),
    }
    one = Study(
        problems={"p": NOWHERE}, algorithms=algorithms, seeds=[1, 2], budgets=[40], references={"p": front}
    )
    store = FolderStore(tmp_path, {})
    assert not any(failure for _, failure in one.carry_out(store))
    table = one.table(store)
    assert table.relative_hypervolume.eq(0).all()
    assert table.members.eq(0).all()
    assert np.isposinf(table[["igd_plus", "epsilon"]]).all(axis=None)
    assert table.spread.isna().all()
    assert all(store[run.name].final.violation.eq(1).all() for run in one.runs())


def test_without_a_feasible_design_there_is_no_reference():
    found = Study(problems={"p": NOWHERE}, algorithms={"a": Nsga2(population=20)}, seeds=[1], budgets=[40]).run()
    assert found.error.tolist() == ["ValueError: constraints must leave a feasible design, got none in any run"]


def test_final_designs_of_problems_with_and_without_constraints_stand_in_one_table():
    """All of ZDT1's and those of SRN without violation."""
    fronts = {"zdt1": ZDT1_FRONT, "srn": ReferenceFront.of(srn().evaluate(srn_set(50))[:, :2])}
    one = Study(
        problems={"zdt1": zdt1(4), "srn": srn()}, algorithms={"sobol": Sampling(population=20)}, seeds=[1],
        budgets=[20], references=fronts,
    )  # fmt: skip
    store = {}
    assert not any(failure for _, failure in one.carry_out(store))
    finals = one.finals(store)
    feasible = int(store["srn_sobol_n20_s1"].final.violation.eq(0).sum())
    sizes = {"zdt1": len(store["zdt1_sobol_n20_s1"].final), "srn": feasible}
    assert finals.groupby("problem", sort=False).size().to_dict() == sizes
    assert "violation" not in finals


def sphere(x: np.ndarray) -> np.ndarray:
    """Eight objectives on the unit sphere, times a distance of 1 or more."""
    angles, g = x[:, :7] * np.pi / 2, 1 + ((x[:, 7:] - 0.5) ** 2).sum(axis=1)
    sines = np.cumprod(np.column_stack([np.ones(len(x)), np.sin(angles)]), axis=1)
    return g[:, None] * sines * np.column_stack([np.cos(angles), np.ones(len(x))])


def test_eight_objectives_are_judged_by_an_approximation_that_is_told():
    """A search of 1,000 evaluations, whose exact hypervolume takes minutes."""
    problem = Problem(evaluate=sphere, lower=(0,) * 12, upper=(1,) * 12, objectives=[f"f{i}" for i in range(8)])
    one = Study(problems={"many": problem}, algorithms={"a": Nsga2(population=100)}, seeds=[0], budgets=[1000])
    said = "^problem 'many' has 8 objectives: its hypervolumes are approximations by moocore$"
    with pytest.warns(ApproximationWarning, match=said):
        found = one.run().set_index("set")
    assert found.error.eq("").all()
    assert found.relative_hypervolume[ARCHIVE] == pytest.approx(1)
    assert found.relative_hypervolume.between(0.5, 1.001).all()


def test_a_flat_front_is_judged_against_a_given_one_and_told_without():
    """An objective of 3.3 everywhere changes nothing of ZDT1's values."""

    def flat(x: np.ndarray) -> np.ndarray:
        return np.column_stack([zdt1(4).evaluate(x), np.full(len(x), 3.3)])

    problem = Problem(evaluate=flat, lower=(0,) * 4, upper=(1,) * 4, objectives=("f1", "f2", "f3"))
    one = Study(problems={"p": problem}, algorithms={"a": Sampling(population=20)}, seeds=[1], budgets=[40])
    assert (
        one.run()
        .error.item()
        .startswith("ValueError: the best designs of all runs must differ in every objective, got ")
    )
    front = ReferenceFront.of(np.column_stack([ZDT1_FRONT.objectives, np.full(200, 3.3)]))
    found = replace(one, references={"p": front}).run().set_index("set")
    plain = replace(one, problems={"p": zdt1(4)}, references={"p": ZDT1_FRONT}).run().set_index("set")
    for name in ("relative_hypervolume", "igd_plus"):
        assert found[name][ARCHIVE] == pytest.approx(plain[name][ARCHIVE], rel=1e-9)
