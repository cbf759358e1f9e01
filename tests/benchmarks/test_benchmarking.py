"""What the benchmark makes of its timings, on timings made up for the purpose."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from peers import OURS, Contenders, Job
from sections import (
    arithmetic,
    cold_start,
    derivatives,
    evaluation,
    full_car,
    moead_limits,
    page_tables,
    process,
    report,
    roofline,
    searches,
    struts,
    summary,
    timing,
)
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront


@pytest.fixture
def clock(monkeypatch):
    """A clock that only moves when a contender says so."""
    now = SimpleNamespace(seconds=0.0)
    for name in ("perf_counter", "process_time"):
        monkeypatch.setattr(timing, name, lambda: now.seconds)
    return now


def contenders(clock, **seconds):
    calls = []

    def prepare(name):
        def prepared(repeat):
            def run():
                calls.append((name, repeat))
                clock.seconds += seconds[name]

            return run

        return prepared

    return {name: prepare(name) for name in seconds}, calls


def test_contenders_take_turns_after_a_warm_up(clock):
    entries, calls = contenders(clock, a=1.0, b=2.0)
    rows = timing.take_turns(entries, 3, limit=10)
    assert calls == [("a", 0), ("b", 0), ("a", 1), ("b", 1), ("b", 2), ("a", 2), ("a", 3), ("b", 3)]
    table = pd.DataFrame(rows)
    assert (table[table.contender == "b"].seconds == 2.0).all()
    assert sorted(table.repeat) == [1, 1, 2, 2, 3, 3]


def test_who_passes_the_limit_has_one_turn(clock):
    entries, _ = contenders(clock, slow=11.0, quick=1.0)
    table = pd.DataFrame(timing.take_turns(entries, 7, limit=10))
    assert table.groupby("contender").seconds.agg(list).to_dict() == {"slow": [11.0], "quick": [1.0] * 7}


def test_short_calls_are_repeated_within_a_timing(clock):
    entries, calls = contenders(clock, a=0.25)
    (row,) = timing.take_turns(entries, 1, limit=10, least=1.0)
    assert row["seconds"] == 0.25
    assert len(calls) == 2 + 4  # two to warm up


def test_libraries_drop_out_where_they_would_take_too_long(clock, table1_problem, monkeypatch):
    def search(seconds_each):
        def prepare(task):
            def run():
                clock.seconds += seconds_each * task.population**2
                task.problem.evaluate(np.full((task.population, 2), 2e3))

            return Job(run, lambda _: None)

        return prepare

    entries = {"slow": search(1e-4), "quick": search(1e-6)}
    table = searches.by_population(
        entries, table1_problem, [100, 400, 2000], 0, repeats=3, limit=30, repeat_limit=10
    )
    counts = table.groupby(["contender", "population"]).repeat.count().to_dict()
    # 16 s at 400 is once too long to repeat; 80 s at 2000 is out of the question.
    assert counts == {("slow", 100): 3, ("slow", 400): 1, ("quick", 100): 3, ("quick", 400): 3, ("quick", 2000): 3}
    assert table[table.population == 100].evaluations.unique().tolist() == [100]


def test_time_to_target_is_that_of_the_shortest_run_that_gets_there(monkeypatch):
    """Hypervolume of one point (x, x) below 1.1 is (1.1 - x)^2: generation 4 is the first below 0.1."""
    times = iter(np.arange(1.0, 1000.0))
    monkeypatch.setattr(searches, "timed", lambda run, calls=1: timing.Timing(next(times), 0.0, run()))
    reference = ReferenceFront.of(np.array([[0.0, 1.0], [1.0, 0.0]]))

    def prepare(task):
        x = 0.5 - 0.1 * task.generations - 0.01
        return Job(lambda: None, lambda _: np.array([[x, x]]))

    def hopeless(task):
        return Job(lambda: None, lambda _: np.array([[1.0, 1.0]]))

    found = searches.to_target(
        {"a": prepare, "never": hopeless}, SimpleNamespace(), reference, 0.99, [10], repeats=2, limit=1e9
    )
    assert found[found.contender == "a"].generations.tolist() == [4, 4]
    assert found[found.contender == "a"].seconds.diff().iloc[-1] == 4  # one timing per length tried
    assert found[found.contender == "never"].seconds.isna().tolist() == [True]
    once_in_two = found.assign(seconds=found.seconds.where(found.repeat != 2))
    assert summary.best_to_target(once_in_two)["median"].isna().all()
    best = summary.best_to_target(found)
    assert best.contender.tolist() == ["a", "never"]


def test_searches_that_fail_are_absent_and_the_others_go_on(table1_problem):
    def prepare(task):
        return Job(lambda: task.problem.evaluate(np.full((task.population, 2), 2e3)), lambda found: found)

    def broken(task):
        raise RuntimeError("first line\nsecond line")

    field = Contenders({"a": prepare, "b": broken}, {"c": prepare}, {}, {"d": "not installed"})
    found = searches.working(field, table1_problem)
    assert (list(found.nsga2), list(found.moead)) == (["a"], ["c"])
    assert found.absent == {"d": "not installed", "b": "RuntimeError: first line"}


def test_growth_of_power_laws():
    rows = [
        {"contender": name, "population": n, "seconds": 1e-3 * n**exponent + extra}
        for name, exponent, extra in (("ours", 1.1, 0.0), ("square", 2.0, 0.0))
        for n in (500, 1000, 4000, 16000)
    ]
    rows.append({"contender": "once", "population": 1000, "seconds": 1.0})
    rows[0]["seconds"] = 99.0  # below 1000, not fitted
    exponents = summary.growth(pd.DataFrame(rows))
    assert exponents["ours"] == pytest.approx(1.1)
    assert exponents["square"] == pytest.approx(2.0)
    assert np.isnan(exponents["once"])


def measurements(ours: float, theirs: float) -> summary.Measurements:
    """Every timing of ours and of a peer's is one of two figures; the peer grows with the square."""

    def searched(populations):
        return pd.DataFrame(
            [
                {
                    "contender": name, "population": n, "repeat": r, "generations": 4.0, "evaluations": 5.0,
                    "seconds": seconds * (n / 1000) ** power,
                }
                for name, seconds, power in ((OURS, ours, 1), ("peer", theirs, 2))
                for n in populations
                for r in (1, 2, 3)
            ]
        )  # fmt: skip

    names = {evaluation.OURS: 1e-3, evaluation.LOOP: 3.0}
    imports = dict(zip(process.IMPORTS, (1.0, 0.2), strict=True))
    return summary.Measurements(
        evaluation=pd.DataFrame([{"contender": n, "designs": 1000, "seconds": s} for n, s in names.items()]),
        nsga2=searched([1000, 16000]),
        moead=searched([1000]),
        moead_limits=pd.DataFrame([{"contender": n, "seconds": 1.0, "igd": 0.1} for n in LIMITS]),
        target=searched([500]).assign(contender=lambda t: t.contender + ", NSGA-II"),
        process=pd.DataFrame([{"contender": n, "seconds": s} for n, s in imports.items()]),
        cold_start=cold_starts(0.1, 1.0),
        struts=strut_times(1.0, 1.4),
        derivatives=derivative_times(2.5),
        full_car=pd.DataFrame(
            [
                {"contender": name, "population": 100, "seconds": s, "generations": 10, "whole_seconds": 2 * s}
                for name, s in ((OURS, 1.0), (full_car.PYMOO, 4.0))
            ]
        ),
        usual_seconds=0.01,
        roofline=roofline_times(),
        limits=arithmetic.Limits(3e10, 3e9, 2e10),
        errors=dict.fromkeys(names, 1e-8),
        memory=100.0,
        absent={"other": "ModuleNotFoundError: no"},
    )


def roofline_times(share: float = 0.65) -> pd.DataFrame:
    """A share of the limit on one thread, and twice that on two, at the second of two calls."""
    rows = [
        (name, threads, 10, share * 1e-5, seconds)
        for name in (roofline.ARITHMETIC, *(row.what for row in roofline.ROWS), roofline.RANKING)
        for threads in (1, 2)
        for seconds in (2e-4, 1e-4 / threads)
    ]
    return pd.DataFrame(rows, columns=["what", "threads", "designs", "limit", "seconds"])


LIMITS = moead_limits.RIDE, moead_limits.BARE, moead_limits.UF1, moead_limits.LOOP


def cold_starts(filled: float, empty: float) -> pd.DataFrame:
    rows = [(n, s, m) for n in cold_start.PROGRAMS for s, m in (("filled", filled), ("empty", empty))]
    return pd.DataFrame(rows, columns=["contender", "store", "multiple"])


def strut_times(default: float, others: float) -> pd.DataFrame:
    """The default takes this time, other struts that, at the second of three calls least."""
    struts_of = {row.vehicle: [struts.DEFAULT] for row in struts.ROWS}
    for row in struts.ROWS:
        struts_of[row.vehicle].append(row.strut)
    rows = [
        (vehicle, name, 10, repeat, 10 * factor * (others if name != struts.DEFAULT else default))
        for vehicle, names in struts_of.items()
        for name in names
        for repeat, factor in ((1, 2.0), (2, 1.0), (3, 3.0))
    ]
    return pd.DataFrame(rows, columns=["vehicle", "strut", "designs", "repeat", "cpu_seconds"])


def derivative_times(both: float) -> pd.DataFrame:
    """Values take 1 s, both that long, at the second of two calls least."""
    rows = [
        (row.case, what, 10, repeat, 10 * factor * seconds)
        for row in derivatives.ROWS
        for what, seconds in ((derivatives.VALUES, 1.0), (derivatives.BOTH, both))
        for repeat, factor in ((1, 2.0), (2, 1.0))
    ]
    return pd.DataFrame(rows, columns=["case", "what", "designs", "repeat", "cpu_seconds"])


def test_derivatives_are_held_to_their_bar_by_the_least_time():
    found = derivatives.goals(derivative_times(2.5))
    assert [goal[1:] for goal in found] == [(derivatives.BAR, 2.5) for _ in derivatives.ROWS]


def test_struts_are_held_to_their_bars_by_the_least_time():
    goals = struts.goals(strut_times(0.5, 1.0))
    assert [ratio for _, _, ratio in goals] == [2.0] * 10
    assert [ratio <= bar for _, bar, ratio in goals] == [
        False,
        True,
        True,
        True,
        True,
        False,
        True,
        False,
        False,
        False,
    ]


def test_struts_are_timed_in_turns_by_vehicle():
    """The measured tables are the two dampers of a car; designs are drawn within the bounds of each problem."""
    found = struts.measure(256, {struts.QUARTER: 3, struts.FULL: 2, struts.TRUCK: 2}, repeats=1)
    pairs = set(zip(found.vehicle, found.strut, strict=True))
    assert pairs == {(row.vehicle, row.strut) for row in struts.ROWS} | {
        (vehicle, struts.DEFAULT) for vehicle in (struts.QUARTER, struts.FULL)
    }
    assert dict(zip(found.vehicle, found.designs, strict=True)) == {
        struts.QUARTER: 3,
        struts.FULL: 2,
        struts.TRUCK: 2,
    }
    assert (struts.ratios(found).ratio > 0).all()


def test_cold_starts_are_held_to_their_bars():
    goals = cold_start.goals(cold_starts(0.5, 2.0))
    assert [(what, multiple <= bar) for what, bar, multiple in goals] == [
        ("import", False),
        ("first evaluate", False), ("first Nsga2", True), ("first MoeadDra", True),
        ("second MoeadDra", True), ("second MoeadDra beyond evaluate", True),
    ]  # fmt: skip


def test_processor_time_is_that_of_the_program(tmp_path):
    """Neither holds the import before it, which takes longer than a sum of one number."""
    (control, short), (_, long) = (
        cold_start.processor_seconds(f"sum(range({n}))", str(tmp_path)) for n in (1, 10_000_000)
    )
    assert 0 < short < control
    assert short < long < 30


def test_goals_held_and_missed():
    held = summary.goals(measurements(1.0, 4.0)).set_index("what")
    straight = held.index.str.contains("spring, damper|imported")
    assert held.holds[~straight].all()
    assert not held.holds[straight].any()
    assert held.here["evaluate, 1,000 designs"] == pytest.approx(3000)
    assert held.here["NSGA-II, N = 1,000: ours / fastest"] == pytest.approx(0.25)
    assert held.here["NSGA-II, N = 16,000: ours / fastest"] == pytest.approx(0.25 / 16)
    assert held.here["NSGA-II, growth exponent"] == pytest.approx(1.0)
    assert held.here["import beyond `import control`"] == pytest.approx(0.2)
    missed = summary.goals(measurements(1.0, 0.9)).set_index("what")
    assert not missed.holds["NSGA-II, N = 1,000: ours / fastest"]
    assert not missed.holds["MOEA/D, time per evaluation: ours / fastest"]
    assert not missed.holds["time to the hypervolume: ours / fastest"]
    assert missed.holds["NSGA-II, N = 16,000: ours / fastest"]


def test_page_has_all_sections_and_the_absent():
    settings = {
        "nodes": 200, "repeats": 3, "sample": 2, "evaluation_limit": 1.0, "memory_designs": 10, "generations": 20,
        "limit": 60.0, "repeat_limit": 5.0, "moead_population": 1000,
        "moead_generations": 4, "uf1_evaluations": 300_000,
        "car_reference": (1000, 200), "car_share": 0.98, "car_population": 100, "car_repeats": 3,
        "car_generations": 50, "target_share": 0.995, "target_populations": (500,), "target_repeats": 3,
        "target_limit": 1.0, "strut_nodes": 256, "roofline_repeats": 3,
        "strut_designs": {struts.QUARTER: 4000, struts.FULL: 400, struts.TRUCK: 400},
    }  # fmt: skip
    machine = {"processor": "A processor", "cores": 2, "python": "3.11", "versions": {"numpy": "2.4"}}
    found = measurements(1.0, 4.0)
    text = report.page(found, settings, machine)
    for words in (
        "A processor",
        "Absent: other (ModuleNotFoundError: no)",
        "4,000 (4,000 to 4,000)",
        "1.0e-08",
        "## Struts",
    ):
        assert words in text
    assert "another commit" not in text
    rows = [("this", 0, 2.0, 3.0), ("other", 0, 4.0, 4.0)]
    beside = pd.DataFrame(rows, columns=["side", "repeat", "wall-clock [s]", "processor [s]"])
    text = report.page(replace(found, beside=beside), settings, machine)
    assert "of another commit in turn" in text
    assert "0.75" in text
    assert page_tables.nsga2_ratios(found)["N = 1,000"].tolist() == ["1.00", "4.00"]
    assert len(report.picture(found).axes[0].lines) == 2


@pytest.mark.parametrize(
    ("value", "shown"), [(1234.5, "1,234"), (12.34, "12.3"), (0.0123, "0.0123"), (0.0, "0"), (np.nan, "")]
)
def test_three_digits(value, shown):
    assert page_tables.number(value) == shown


@pytest.mark.filterwarnings("ignore:Badly conditioned")  # scipy, of zeros ahead of its numerators
def test_three_roads_to_the_objectives_agree_and_are_right():
    """Over equal nodes to rounding; against adaptive quadrature to what 200 nodes leave at the box's corners."""
    problem = paper.ride_problem(nodes=200)
    designs = np.array([paper.reference_design(), paper.optimised_design()])
    values = {name: method(designs) for name, method in evaluation.methods(problem).items()}
    for found in values.values():
        np.testing.assert_allclose(found, values[evaluation.OURS], rtol=1e-10)
    errors = evaluation.errors(problem, 1, seed=0)
    assert all(1e-9 < error < 1e-6 for error in errors.values())


def test_imports_are_timed_one_after_the_other():
    """In a process where both are imported already, neither would take any time."""
    times = process.import_seconds()
    assert list(times) == ["import control", "import suspension_ctrl"]
    assert 0 < times["import suspension_ctrl"] < times["import control"]


def test_a_million_designs_stay_below_500_mb():
    megabytes = evaluation.memory(1_000_000, 200)
    assert np.isnan(megabytes) or 40 < megabytes < 500  # designs and objectives alone are 40
