"""A campaign: the same studies at several populations, made here or on a cluster."""

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

import pandas as pd

from .. import checks
from ..response.problem import RideProblem
from ..search.indicators import ReferenceFront
from ..study import timing as experiments
from ..study import workers as clusters
from ..study.store import FolderStore
from ..study.study import Study
from . import terminal


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
        if self.scheduler is not None:
            clusters.check_address(self.scheduler, self.tls)

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
