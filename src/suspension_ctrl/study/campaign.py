"""A comparison carried out in a folder, resumable: timed runs, their reference front, runs over many seeds."""

import platform
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from ..search.constraints import InfeasibleWarning
from ..search.indicators import ReferenceFront
from . import lock, machine, reference, timing
from .comparison import Comparison
from .store import FolderStore
from .study import PlannedRun

if TYPE_CHECKING:
    from distributed import Client


@dataclass(frozen=True)
class Campaign:
    """A comparison in a folder of finished runs; a stopped campaign resumes with the missing ones.

    Parameters
    ----------
    comparison : Comparison
    folder : Path
    tolerance : float
        Largest relative change of the reference hypervolume by a finer grid [-].
    watch : callable
        Passes runs through as they are made, from their iterator, their number and a text: a progress bar.

    Raises
    ------
    BlockingIOError
        If another process has a campaign in the folder.
    """

    comparison: Comparison
    folder: Path
    tolerance: float = reference.TOLERANCE
    watch: Callable[[Iterator[Any], int, str], Iterator[Any]] = lambda runs, _total, _text: runs
    _lock: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_lock", lock.hold(self.folder))  # the folder is this process's from here on

    def time(self) -> FolderStore:
        """Make the timed runs one after the other on one thread, after a warm-up, and return them."""
        made_on = {"processor": machine.processor_name(), "python": platform.python_version()}
        store = self._store("timed", "repeats", **made_on)
        runs = len(self.comparison.timed_runs())
        with machine.single_thread(), warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # their table shows runs without a feasible design
            for _ in self.watch(self._timed(store), runs, "timed runs"):
                pass
        return store

    def _timed(self, store: FolderStore) -> Iterator[PlannedRun]:
        timing.warm_up(self.comparison)
        yield from timing.carry_out(self.comparison, store)

    def reference(self, store: FolderStore, *, grid: bool) -> tuple[ReferenceFront, str]:
        """Return the front of a grid, kept in the folder, or of the best timed runs, and its origin in words."""
        problem = self.comparison.problem
        if grid:
            kept = self._store("reference")
            if "grid" not in kept:
                kept["grid"] = reference.refined(problem, self.tolerance).stored()
            refined = reference.Refined.of(kept["grid"])
            return refined.front, refined.describe(problem)
        runs = (store[run.name] for run in self.comparison.timed_runs())
        found = [timing.feasible_objectives(problem, run) for run in runs]
        return reference.best_known(found), "the non-dominated designs of all these runs"

    def judge(self, front: ReferenceFront, client: "Client | None" = None) -> tuple[pd.DataFrame, FolderStore]:
        """Make the runs over many seeds, here or on a cluster; return a row per run, budget and set, and them."""
        store = self._store("quality", "seeds", reference=reference.summary(front))
        parts = []
        for population, study in self.comparison.studies(front).items():
            missing = sum(run.name not in store for run in study.runs())
            made = self.watch(study.carry_out(store, client), missing, f"quality, N = {population}")
            parts.append(study.table(store, {run.name: error for run, error in made if error}))
        return pd.concat(parts, ignore_index=True).drop(columns="problem"), store

    def _store(self, name: str, *also: str, **plan: Any) -> FolderStore:
        """Return the finished runs in a subfolder that belongs to these settings, values and versions."""
        keys = ("populations", "iterations", "algorithms", "seed", *also)
        plan |= {key: getattr(self.comparison, key) for key in keys}
        problem = self.comparison.problem
        plan |= {"problem": problem, "values": reference.fingerprint(problem), "tolerance": self.tolerance}
        return FolderStore(self.folder / name, plan | machine.provenance())
