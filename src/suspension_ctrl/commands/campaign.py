"""The runs of a comparison that are judged, made here or on a cluster."""

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

import pandas as pd

from .. import checks
from ..search.indicators import ReferenceFront
from ..study import workers as clusters
from ..study.comparison import Comparison
from ..study.store import FolderStore
from . import terminal


@dataclass(frozen=True)
class Workers:
    """Where the runs are made: here, in so many processes of this machine, or by a scheduler's workers."""

    jobs: int | None = None
    scheduler: str | None = None

    def __post_init__(self) -> None:
        if self.jobs is not None:
            checks.at_least("jobs", self.jobs, 1)
        if self.jobs is not None and self.scheduler is not None:
            raise ValueError(f"jobs must stand without scheduler, got {self.jobs} and {self.scheduler!r}")
        if self.scheduler is not None:
            clusters.check_address(self.scheduler)

    def client(self) -> AbstractContextManager[Any]:
        """Return a context with a Dask client, or None for runs made here."""
        if self.scheduler is not None:
            return clusters.scheduler_at(self.scheduler)
        return nullcontext() if self.jobs is None else clusters.local_cluster(self.jobs)


def carry_out(
    comparison: Comparison, reference: ReferenceFront, store: FolderStore, workers: Workers
) -> pd.DataFrame:
    """Make the judged runs that the store does not hold and return one row per run, budget and set."""
    parts = []
    with workers.client() as client:
        for population, one in comparison.studies(reference).items():
            missing = sum(run.name not in store for run in one.runs())
            terminal.note(f"quality, N = {population}: {missing} of {len(one.runs())} runs to be made")
            made = terminal.progress(one.carry_out(store, client), missing)
            parts.append(one.table(store, {run.name: error for run, error in made if error}))
    return pd.concat(parts, ignore_index=True).drop(columns="problem")
