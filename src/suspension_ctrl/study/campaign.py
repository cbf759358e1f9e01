"""A comparison in a results folder, resumable: timed runs, reference front, runs over many seeds."""

import platform
import warnings
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from ..quantities import Real
from ..search.constraints import InfeasibleWarning
from ..search.indicators import ReferenceFront
from . import lock, machine, plans, reference, timing
from .comparison import Comparison
from .kept_fronts import NONE_KEPT, KeptFronts
from .reference import Reference
from .store import FolderStore, Remembered, StoredRun, count_runs

if TYPE_CHECKING:
    from distributed import Client

TIMED, QUALITY = "timed", "quality"
"""Folders of finished runs in the folder of a campaign."""


@dataclass(frozen=True)
class Campaign:
    """A comparison with its results folder; an interrupted campaign resumes with the missing runs.

    It locks the folder: BlockingIOError if another process has. `watch(runs, number, text, found)` yields the runs
    of an iterator unchanged, like a progress bar: those that are missing of a number, of which some were found.
    """

    comparison: Comparison
    folder: Path
    tolerance: float = reference.TOLERANCE  # largest relative change of the reference hypervolume by a finer grid
    watch: Callable[[Iterator[Any], int, str, int], Iterator[Any]] = lambda runs, _total, _text, _found: runs
    fronts: KeptFronts = NONE_KEPT  # of grids, found by earlier comparisons
    _lock: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_lock", lock.hold(self.folder))

    def time(self) -> MutableMapping[str, StoredRun]:
        """Make the timed runs one after the other on one thread, after a warm-up; return their store."""
        made_on = {"processor": machine.processor_name(), "python": platform.python_version()}
        store = Remembered(self._store(TIMED, "repeats", **made_on))
        found, runs = len(store), len(self.comparison.timed_runs())
        with machine.single_thread(), warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # their table shows runs without a feasible design
            for _ in self.watch(timing.carry_out(self.comparison, store), runs, "timed runs", found):
                pass
        return store

    def kept(self, *, judged: bool) -> tuple[int, int]:
        """Return the numbers of stored runs and of all runs, timed ones and, if asked for, `judged` ones."""
        plan = {TIMED: len(self.comparison.timed_runs())}
        if judged:
            plan[QUALITY] = sum(len(study.runs()) for study in self.comparison.studies().values())
        return sum(count_runs(self.folder / name) for name in plan), sum(plan.values())

    @property
    def has_reference(self) -> bool:
        """Whether the folder has a reference front."""
        return count_runs(self.folder / reference.FOLDER) > 0

    @property
    def has_judged(self) -> bool:
        """Whether the folder has judged runs."""
        return count_runs(self.folder / QUALITY) > 0

    @cached_property
    def kept_front(self) -> Reference | None:
        """The reference front of this problem and tolerance among `fronts`, None without one."""
        return self.fronts.find(self.comparison.problem, self.tolerance)

    def check_judged(self, *, judged: bool) -> None:
        """Raise ValueError if judged runs are to have other seeds or budgets than those in the folder."""
        if judged and self.has_judged:
            planned = {"seeds": self.comparison.seeds, "budgets": self._budgets()}
            plans.agree(self.folder / QUALITY / plans.FILE, planned, "to resume there")

    def _budgets(self) -> dict[int, list[int]]:
        """Return the budgets at which runs are judged, by population."""
        return {n: self.comparison.budgets(n) for n in self.comparison.populations}

    def reference(
        self,
        store: Mapping[str, StoredRun],
        given: Reference | None = None,
        known: Callable[[], Real] | None = None,
    ) -> Reference | None:
        """Return the reference front, stored in the folder: the given one, one of `fronts` or that sought."""
        of_given = {"given": given and reference.summary(given.front)}
        kept = self._store(reference.FOLDER, "repeats", **of_given)
        if reference.NAME not in kept:
            found = given or self._sought(store, known)
            if found is None:
                return None
            kept[reference.NAME] = found.stored()
        return Reference.of(kept[reference.NAME])

    def _sought(self, store: Mapping[str, StoredRun], known: Callable[[], Real] | None) -> Reference | None:
        """Return the front of a grid, kept or found now, or that of `reference.sought`."""
        if self.kept_front:
            return self.kept_front
        problem = self.comparison.problem
        made = [run.name for run in self.comparison.timed_runs() if run.name in store]
        finals = [timing.feasible_objectives(problem, store[name]) for name in made]
        keep = partial(self.fronts.keep, problem, self.tolerance)
        return reference.sought(problem, finals, self.tolerance, known=known, keep=keep)

    def judge(
        self, front: ReferenceFront, client: "Client | None" = None
    ) -> tuple[pd.DataFrame, Mapping[str, StoredRun]]:
        """Make the runs over many seeds, on a cluster if given; return their table (`Study.table`) and store."""
        plan = {"reference": reference.summary(front), "budgets": self._budgets()}
        store = Remembered(self._store(QUALITY, "seeds", **plan))
        studies, tables = self.comparison.studies(front), dict[int, pd.DataFrame]()
        for population in sorted(studies, reverse=True):  # the last runs, for which processes wait, are short
            study = studies[population]
            planned = study.runs()
            found = sum(run.name in store for run in planned)
            text = f"quality, N = {population}"
            runs = self.watch(study.carry_out(store, client), len(planned), text, found)
            tables[population] = study.table(store, {run.name: failure for run, failure in runs if failure})
        parts = [tables[population] for population in studies]
        return pd.concat(parts, ignore_index=True).drop(columns="problem"), store

    def _store(self, name: str, *also: str, **plan: Any) -> FolderStore:
        """Return the store of a subfolder; its plan holds settings, a digest of values, and versions."""
        keys = ("populations", "iterations", "algorithms", "seed", *also)
        plan |= {key: getattr(self.comparison, key) for key in keys}
        problem = self.comparison.problem
        plan |= {"problem": problem, "values": reference.fingerprint(problem), "tolerance": self.tolerance}
        return FolderStore(self.folder / name, plan | machine.provenance())
