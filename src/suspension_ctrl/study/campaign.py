"""A comparison in a results folder, resumable: timed runs, reference front, runs over many seeds."""

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

if TYPE_CHECKING:
    from distributed import Client


@dataclass(frozen=True)
class Campaign:
    """A comparison with its results folder; an interrupted campaign resumes with the missing runs.

    It locks the folder: BlockingIOError if another process has. `watch(runs, number, text)` yields the runs of an
    iterator unchanged, like a progress bar.
    """

    comparison: Comparison
    folder: Path
    tolerance: float = reference.TOLERANCE  # largest relative change of the reference hypervolume by a finer grid
    watch: Callable[[Iterator[Any], int, str], Iterator[Any]] = lambda runs, _total, _text: runs
    _lock: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_lock", lock.hold(self.folder))

    def time(self) -> FolderStore:
        """Make the timed runs one after the other on one thread, after a warm-up; return their store."""
        made_on = {"processor": machine.processor_name(), "python": platform.python_version()}
        store = self._store("timed", "repeats", **made_on)
        runs = len(self.comparison.timed_runs())
        with machine.single_thread(), warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # their table shows runs without a feasible design
            for _ in self.watch(timing.carry_out(self.comparison, store), runs, "timed runs"):
                pass
        return store

    def reference(self, store: FolderStore, *, grid: bool) -> tuple[ReferenceFront, str]:
        """Return the reference front of a grid, stored in the folder, or of the timed runs; and its origin."""
        problem = self.comparison.problem
        if grid:
            kept = self._store("reference")
            if "grid" not in kept:
                kept["grid"] = reference.refined(problem, self.tolerance).stored()
            refined = reference.Refined.of(kept["grid"])
            return refined.front, refined.describe(problem)
        finals = [timing.feasible_objectives(problem, store[run.name]) for run in self.comparison.timed_runs()]
        return reference.best_known(finals), "the non-dominated designs of all these runs"

    def judge(self, front: ReferenceFront, client: "Client | None" = None) -> tuple[pd.DataFrame, FolderStore]:
        """Make the runs over many seeds, on a cluster if given; return their table (`Study.table`) and store."""
        store = self._store("quality", "seeds", reference=reference.summary(front))
        parts = []
        for population, study in self.comparison.studies(front).items():
            missing = sum(run.name not in store for run in study.runs())
            runs = self.watch(study.carry_out(store, client), missing, f"quality, N = {population}")
            parts.append(study.table(store, {run.name: failure for run, failure in runs if failure}))
        return pd.concat(parts, ignore_index=True).drop(columns="problem"), store

    def _store(self, name: str, *also: str, **plan: Any) -> FolderStore:
        """Return the store of a subfolder; its plan holds settings, a digest of values, and versions."""
        keys = ("populations", "iterations", "algorithms", "seed", *also)
        plan |= {key: getattr(self.comparison, key) for key in keys}
        problem = self.comparison.problem
        plan |= {"problem": problem, "values": reference.fingerprint(problem), "tolerance": self.tolerance}
        return FolderStore(self.folder / name, plan | machine.provenance())
