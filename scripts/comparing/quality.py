"""The quality of the algorithms over many seeds: a campaign, its tables, its verdict and its figures."""

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from suspension_ctrl import (
    RideProblem,
    checks,
    clusters,
    comparison_figures,
    experiments,
    files,
    lenses,
    statistics,
    study,
    terminal,
    verdicts,
)
from suspension_ctrl.indicators import ReferenceFront
from suspension_ctrl.problems import column_headers
from suspension_ctrl.stores import FolderStore, Record
from suspension_ctrl.study import INDICATORS, Study

VALUE = "relative_hypervolume"
CONFIGURATION = ["lens", "population", "iterations"]


@dataclass(frozen=True)
class Workers:
    """Where the runs are made: here, in so many processes of this machine, or by a scheduler's workers."""

    jobs: int | None = None
    scheduler: str | None = None
    tls: clusters.Tls | None = None

    def __post_init__(self) -> None:
        if self.jobs is not None:
            checks.at_least("jobs", self.jobs, 1)
        if self.jobs is not None and self.scheduler is not None:
            raise ValueError(f"jobs must stand without scheduler, got {self.jobs} and {self.scheduler!r}")

    def client(self) -> AbstractContextManager[Any]:
        """Return a context with a Dask client, or None for runs made here."""
        if self.scheduler is not None:
            return clusters.scheduler_at(self.scheduler, self.tls)
        return nullcontext() if self.jobs is None else clusters.local_cluster(self.jobs)


@dataclass(frozen=True)
class Campaign:
    """Studies of the same algorithms at several populations, as the timed comparison has them.

    Parameters
    ----------
    problem : RideProblem
    algorithms : sequence of str
        Names in `experiments.ALGORITHMS`; the first two are compared in words and in attainment differences.
    populations, iterations : sequence of int
        The configurations.
    seeds : sequence of int
    reference : ReferenceFront
    """

    problem: RideProblem
    algorithms: Sequence[str]
    populations: Sequence[int]
    iterations: Sequence[int]
    seeds: Sequence[int]
    reference: ReferenceFront

    def cost(self) -> dict[tuple[str, int], int]:
        """Return the evaluations of an iteration by algorithm and population."""
        m = len(self.problem.objectives)
        return {
            (name, n): experiments.optimiser(name, n).evaluations_per_iteration(m)
            for name in self.algorithms
            for n in self.populations
        }

    def budgets(self, population: int) -> list[int]:
        """Return the evaluations at which runs are judged: by N/5 up to 5 N, by N beyond, and all compared."""
        spent = {
            population + count * self.cost()[name, population]
            for name in self.algorithms
            for count in self.iterations
        }
        most = max(spent)
        fine = {population + k * (population // 5) for k in range(21)}
        coarse = set(range(population, most, population))
        return sorted(budget for budget in fine | coarse | spent if budget <= most)

    def studies(self) -> dict[int, Study]:
        """Return a study by population."""
        return {
            n: Study(
                problems={"ride": self.problem},
                algorithms={name: experiments.optimiser(name, n) for name in self.algorithms},
                seeds=self.seeds,
                budgets=self.budgets(n),
                references={"ride": self.reference},
            )
            for n in self.populations
        }


def carry_out(campaign: Campaign, store: FolderStore, workers: Workers) -> pd.DataFrame:
    """Make the runs that the store does not hold and return one row per run, budget and set."""
    parts = []
    with workers.client() as client:
        for population, one in campaign.studies().items():
            missing = sum(run.name not in store for run in one.runs())
            terminal.note(f"quality, N = {population}: {missing} of {len(one.runs())} runs to be made")
            made = terminal.progress(one.carry_out(store, client), missing)
            parts.append(one.table(store, {run.name: error for run, error in made if error}))
    return pd.concat(parts, ignore_index=True).drop(columns="problem")


def last_rows(quality: pd.DataFrame) -> pd.DataFrame:
    """Return one row per run, as in the table of timed runs: its population at the end, or its error."""
    ends = quality[quality.error.ne("") | quality.set.eq(study.POPULATION)]
    return (
        ends.groupby(["population", "algorithm", "seed"], sort=False)
        .tail(1)
        .drop(columns=["set", "size", "budget"])
    )


def report(
    campaign: Campaign,
    quality: pd.DataFrame,
    store: Mapping[str, Record],
    clock: pd.DataFrame,
    target: float,
    folder: Path,
) -> None:
    """Write and print what follows from the runs that ended, if any: tables, verdict, figures."""
    ended = quality[quality.error.eq("")].drop(columns="error")
    if ended.empty:
        return
    timed = lenses.with_seconds(ended, clock)
    files.write_csv(folder / "quality.csv", timed.drop(columns="seconds"))
    equal = lenses.at_equal(timed, campaign.algorithms, campaign.iterations, campaign.cost())
    by = [*CONFIGURATION, "set", "algorithm"]
    spent = equal.groupby(by, sort=False)[["evaluations", "seconds"]].median().reset_index()
    summary = spent.merge(statistics.quartiles(equal, by, INDICATORS), on=by)
    compared = statistics.pairwise(equal, [*CONFIGURATION, "set"], INDICATORS, campaign.algorithms)
    reached = lenses.reached_by(lenses.to_reach(timed, target))
    for name, table in (("equal", summary), ("differences", compared), ("to_reach", reached)):
        files.write_table(folder / name, table.rename(columns=_headers(table.columns)))
    judged = {"final population": study.POPULATION, "archive cut to N": study.CUT_ARCHIVE}
    words = [
        verdicts.verdict(
            compared[(compared.set == chosen) & (compared.value == VALUE)],
            *campaign.algorithms[:2],
            f"Hypervolume of the {what}",
        )
        for what, chosen in judged.items()
        if len(compared)
    ]
    files.write_text(folder / "verdict.md", "\n\n".join(words) + "\n")
    _show(summary, reached, words, target)
    draw(campaign, timed, equal, store, folder)


def _headers(columns: Sequence[str]) -> dict[str, str]:
    units = {"seconds": "s"}
    plain = {
        "value",
        "lens",
        "population",
        "iterations",
        "set",
        "algorithm",
        "first",
        "second",
        "size",
        "runs",
        "reached",
    }
    return {c: c if c in plain else f"{c.replace('_', ' ')} [{units.get(c, '-')}]" for c in columns}


def _show(summary: pd.DataFrame, reached: pd.DataFrame, words: Sequence[str], target: float) -> None:
    final = summary[summary.set == study.POPULATION]
    kept = [*CONFIGURATION, "algorithm", "evaluations", *INDICATORS]
    short = {
        "population": "N",
        "iterations": "iter.",
        "evaluations": "evals",
        VALUE: "HV / ref.",
        "igd_plus": "IGD+",
    }
    digits = {"evals": 0, "HV / ref.": 4, "IGD+": 5, "epsilon": 4, "spread": 3}
    terminal.show("Final populations, medians", final[kept].rename(columns=short), digits)
    terminal.show(
        f"To {target:g} of the reference hypervolume, medians",
        reached.rename(columns={"population": "N", "evaluations": "evals", "seconds": "time [s]"}),
        {"evals": 0, "time [s]": 4},
    )
    for paragraph in words:
        terminal.note(paragraph)


def draw(
    campaign: Campaign, timed: pd.DataFrame, equal: pd.DataFrame, store: Mapping[str, Record], folder: Path
) -> None:
    """Write anytime curves, box plots and attainment differences, a figure of each per population."""
    for population in campaign.populations:
        curves = timed[timed.population == population]
        figure, axes = comparison_figures.panels(4, columns=2)
        places = ((s, x) for s in (study.POPULATION, study.CUT_ARCHIVE) for x in ("evaluations", "seconds"))
        for ax, (chosen, over) in zip(axes, places, strict=True):
            comparison_figures.anytime(ax, curves[curves.set == chosen], over)
            ax.set_title(f"{chosen}, N = {population}", fontsize=10)
        axes[0].legend(frameon=False, fontsize=8)
        files.write_figure(folder / f"anytime_n{population}", figure)

        last = equal[
            (equal.population == population)
            & (equal.iterations == max(campaign.iterations))
            & (equal.lens == lenses.EVALUATIONS)
            & (equal.set == study.POPULATION)
        ]
        figure, axes = comparison_figures.panels(len(INDICATORS), columns=2)
        for ax, indicator in zip(axes, INDICATORS, strict=True):
            comparison_figures.boxes(ax, last, indicator)
        files.write_figure(folder / f"boxes_n{population}", figure)
        if len(campaign.algorithms) > 1:
            _draw_attainment(campaign, population, store, folder)


def _draw_attainment(campaign: Campaign, population: int, store: Mapping[str, Record], folder: Path) -> None:
    names = campaign.algorithms[:2]
    runs = campaign.studies()[population].runs()
    kept = {
        name: {r.seed: store[r.name].final for r in runs if r.algorithm == name and r.name in store}
        for name in names
    }
    shared = sorted(set(kept[names[0]]) & set(kept[names[1]]))
    if not shared:
        return
    sides = [pd.concat([kept[name][seed].assign(seed=seed) for seed in shared]) for name in names]
    headers = dict(
        zip(
            campaign.problem.objectives,
            column_headers(campaign.problem.objectives, campaign.problem.units),
            strict=True,
        )
    )
    acc, sws, dtl = headers.values()
    figure, axes = comparison_figures.panels(3)
    sides = [side.rename(columns=headers) for side in sides]
    for ax, pair in zip(axes, ((sws, acc), (sws, dtl), (acc, dtl)), strict=True):
        drawn = comparison_figures.attainment_differences(ax, *sides, pair)
    figure.colorbar(drawn, ax=axes, label=f"share of runs attaining: {names[0]} less {names[1]}")
    files.write_figure(folder / f"attainment_n{population}", figure)
