"""Quality of algorithms on problems over seeds and budgets, as one tidy table."""

import warnings
from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, product
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import pandas as pd

from .. import checks
from ..quantities import FrozenMapping, Record
from ..search.indicators import ReferenceFront, best_of, evenly_spread
from ..search.problem import Minimisable
from ..search.run import Optimiser
from ..search.trace import Trace, trace
from ..tables import file_name
from .calls import outcome, outcomes
from .reference import best_known
from .store import VIOLATION, StoredRun

if TYPE_CHECKING:
    from distributed import Client

POPULATION, ARCHIVE, CUT_ARCHIVE = "population", "archive", "archive of N"
"""Sets judged, of feasible designs: the population, all non-dominated evaluated, and N of those, spread evenly."""

INDICATORS = ("relative_hypervolume", "igd_plus", "epsilon", "spread")


class ApproximationWarning(UserWarning):
    """A problem has so many objectives that hypervolumes are approximated."""


def span(numbers: Sequence[int]) -> str:
    """Return a summary such as ``31 from 0 to 30``."""
    return f"{len(numbers)} from {min(numbers)} to {max(numbers)}"


class PlannedRun(NamedTuple):
    """One run of a study or of a timed comparison."""

    name: str  # fit for a file
    optimiser: Optimiser
    seed: int
    evaluations: int  # at most
    key: dict[str, Any]  # columns that identify it in a table, algorithm and population among them


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Study(Record):
    """Searches of every algorithm on every problem from every seed, judged at every budget.

    Parameters
    ----------
    problems : mapping of str to Problem or RideProblem
        By name.
    algorithms : mapping of str to Optimiser
        By name, e.g. ``{"nsga2": Nsga2(population=100)}``.
    seeds : sequence of int
        Each algorithm is run once from each.
    budgets : sequence of int
        Evaluations at which a run is judged, by its state after the last iteration within the budget.
    references : mapping of str to ReferenceFront, optional
        By name of a problem; if absent, of the first seed's runs of all algorithms, made once more for it.

    Raises
    ------
    ValueError
        If a part is empty, seeds or file names repeat, a budget is below a population, or a reference has no
        problem.

    Examples
    --------
    Two searches with as many evaluations, from three seeds each. The first seed's searches give the reference
    front:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> study = sc.Study(
    ...     problems={"class C": problem},
    ...     algorithms={"nsga2": sc.Nsga2(population=40), "sobol": sc.Sampling(population=40)},
    ...     seeds=range(3),
    ...     budgets=[400],
    ... )
    >>> quality = study.run()
    >>> populations = quality[quality["set"] == "population"]
    >>> populations.groupby("algorithm").size().to_dict()
    {'nsga2': 3, 'sobol': 3}
    >>> bool(populations["relative_hypervolume"].between(0.9, 1.1).all())
    True
    """

    problems: Mapping[str, Minimisable] = field(metadata={"show": list})
    algorithms: Mapping[str, Optimiser] = field(metadata={"show": list})
    seeds: Sequence[int] = field(metadata={"show": span})
    budgets: Sequence[int] = field(metadata={"show": span})
    references: Mapping[str, ReferenceFront] = field(default=FrozenMapping({}), metadata={"show": list})

    def __post_init__(self) -> None:
        for name in ("problems", "algorithms", "references"):
            self._keep(**{name: FrozenMapping(getattr(self, name))})
        self._keep(seeds=tuple(self.seeds), budgets=tuple(self.budgets))
        for name in ("problems", "algorithms", "seeds", "budgets"):
            if len(getattr(self, name)) == 0:
                raise ValueError(f"{name} must be one or more, got {getattr(self, name)!r}")
        self._keep(seeds=tuple(checks.at_least("seeds", seed, 0) for seed in self.seeds))
        if len(set(self.seeds)) < len(self.seeds):
            raise ValueError(f"seeds must be different, got {list(self.seeds)}")
        start = max(o.population for o in self.algorithms.values())
        self._keep(budgets=tuple(checks.at_least("budgets", budget, start) for budget in self.budgets))
        if len({run.name.casefold() for run in self.runs()}) < len(self.runs()):
            names = [*self.problems, *self.algorithms]
            raise ValueError(f"names must not give files of two runs the same name, got {names}")
        for name in self.references:
            checks.one_of("references", name, list(self.problems))

    def runs(self) -> list[PlannedRun]:
        """Return the runs, algorithms taking turns within a seed."""
        found, most = [], max(self.budgets)
        for problem, seed, (name, optimiser) in product(self.problems, self.seeds, self.algorithms.items()):
            size = optimiser.population
            key = {"problem": problem, "algorithm": name, "population": size, "seed": seed}
            file = file_name(f"{problem}_{name}_n{size}_s{seed}")
            found.append(PlannedRun(file, optimiser, seed, most, key))
        return found

    def run(self, client: "Client | None" = None) -> pd.DataFrame:
        """Make all runs, here or on the workers of a Dask client, and return `table`."""
        store: dict[str, StoredRun] = {}
        errors = {run.name: error for run, error in self.carry_out(store, client) if error}
        return self.table(store, errors)

    def carry_out(
        self, store: MutableMapping[str, StoredRun], client: "Client | None" = None
    ) -> Iterator[tuple[PlannedRun, str]]:
        """Make the runs absent from `store`, store each when done, and yield it with its error or ``""``.

        On a client the runs come in the order in which they end, with the same results.
        """
        missing = {run.name: run for run in self.runs() if run.name not in store}
        problems = dict.fromkeys(run.key["problem"] for run in missing.values())
        for name in problems:
            if (m := len(self.problems[name].objectives)) > ReferenceFront.EXACT:
                text = f"problem {name!r} has {m} objectives: its hypervolumes are approximations by moocore"
                warnings.warn(text, ApproximationWarning, stacklevel=2)
        references = {name: outcome(self.reference, (name,)) for name in problems}
        work: dict[str, tuple[Any, ...]] = {}
        for run in missing.values():
            problem = run.key["problem"]
            reference, error = references[problem]
            if reference is None:
                yield run, error
            else:
                work[run.name] = (self.problems[problem], run.optimiser, self.budgets, run.seed, reference)
        for name, finished, error in outcomes(judged_run, work, client):
            if finished is not None:
                store[name] = finished
            yield missing[name], error

    def reference(self, problem: str) -> ReferenceFront:
        """Return the reference front of a problem, of the first seed's runs if none is given."""
        if problem in self.references:
            return self.references[problem]
        most, seed = max(self.budgets), self.seeds[0]
        seen = [trace(self.problems[problem], each, [most], seed) for each in self.algorithms.values()]
        return best_known([one.objectives[one.feasible] for one in seen])

    def table(self, store: Mapping[str, StoredRun], errors: Mapping[str, str] | None = None) -> pd.DataFrame:
        """Return one row per run, budget and set; a run that raised has one row, with its error.

        Columns: problem, algorithm, population, seed, budget, evaluations, set (`POPULATION`, `ARCHIVE` or
        `CUT_ARCHIVE`), members of the set, relative_hypervolume, igd_plus, epsilon, spread, seconds (of the whole
        run on a shared machine), error.
        """
        parts = []
        for run in self.runs():
            if run.name in store:
                parts.append(store[run.name].course.assign(**run.key, error=""))
            elif errors and run.name in errors:
                parts.append(pd.DataFrame([{**run.key, "error": errors[run.name]}]))
        columns = ["problem", "algorithm", "population", "seed", "budget", "evaluations", "set", "members"]
        return pd.concat(parts, ignore_index=True).reindex(columns=[*columns, *INDICATORS, "seconds", "error"])

    def finals(self, store: Mapping[str, StoredRun]) -> pd.DataFrame:
        """Return the feasible designs of the final populations of stored runs.

        Columns: problem, algorithm, population, seed, and one for each objective.
        """
        parts = [store[run.name].feasible.assign(**run.key) for run in self.runs() if run.name in store]
        return pd.concat(parts, ignore_index=True).drop(columns=VIOLATION, errors="ignore")


def judged_run(
    problem: Minimisable, optimiser: Optimiser, budgets: Sequence[int], seed: int, reference: ReferenceFront
) -> StoredRun:
    """Make one run and judge it at each budget, here or on a worker."""
    start = perf_counter()
    seen = trace(problem, optimiser, budgets, seed)
    seconds = perf_counter() - start
    judged = (_judged(seen, budget, optimiser.population, reference) for budget in sorted(set(budgets)))
    last = seen.states[max(budgets)]
    kept = evenly_spread(last.objectives, optimiser.population)
    final = pd.DataFrame(last.objectives[kept], columns=list(problem.objectives))
    if problem.constraints:
        final[VIOLATION] = last.violation[kept]
    return StoredRun(pd.DataFrame(chain.from_iterable(judged)).assign(seconds=seconds), final)


def _judged(seen: Trace, budget: int, population: int, reference: ReferenceFront) -> Iterator[dict[str, Any]]:
    """Yield a row per set of the state at a budget."""
    state = seen.states[budget]
    asked, spent = state.evaluations, seen.spent[budget]
    archive = best_of(seen.objectives[:spent][seen.feasible[:spent]])
    best = best_of(state.objectives[state.feasible])
    cut, best = (found[evenly_spread(found, population)] for found in (archive, best))
    for name, objectives in ((POPULATION, best), (ARCHIVE, archive), (CUT_ARCHIVE, cut)):
        indicators = {indicator: getattr(reference, indicator)(objectives) for indicator in INDICATORS}
        yield {"budget": budget, "evaluations": asked, "set": name, "members": len(objectives), **indicators}
