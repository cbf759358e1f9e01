"""Quality of algorithms on problems over seeds and budgets, as one tidy table."""

import warnings
from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple

import pandas as pd

from .. import checks
from ..quantities import FrozenMapping, Record
from ..search.indicators import ReferenceFront, evenly_spread
from ..search.problem import Minimisable
from ..search.run import Optimiser
from ..search.trace import trace_so_far
from ..tables import file_name
from .calls import in_one_line, outcome, outcomes
from .judging import INDICATORS, judged
from .reference import best_known
from .store import VIOLATION, StoredRun

if TYPE_CHECKING:
    from distributed import Client


class ApproximationWarning(UserWarning):
    """A problem has so many objectives that hypervolumes are approximated."""


def span(numbers: Sequence[int]) -> str:
    """Return a summary such as ``31 from 0 to 30``."""
    return f"{len(numbers)} from {min(numbers)} to {max(numbers)}"


class PlannedRun(NamedTuple):
    """One run of a study or of a timed comparison."""

    name: str  # a file name
    optimiser: Optimiser
    seed: int
    evaluations: int  # at most
    key: dict[str, Any]  # columns that identify it in a table, such as algorithm and population


class Failure(NamedTuple):
    """A run that raised an exception."""

    error: str  # in one line
    course: pd.DataFrame = pd.DataFrame()  # a row per set and budget reached before


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Study(Record):
    """Searches by several algorithms, on several problems, from several seeds, judged at several budgets.

    Parameters
    ----------
    problems : mapping of str to Problem or RideProblem
        By name.
    algorithms : mapping of str to Optimiser
        By name, e.g. ``{"nsga2": Nsga2(population=100)}``.
    seeds : sequence of int
        Each algorithm runs once from each seed.
    budgets : sequence of int
        Evaluations at which a run is judged: its state after the last iteration within the budget.
    references : mapping of str to ReferenceFront, optional
        By name of a problem. The default is the front of all runs from the first seed, which are repeated for it;
        a run that raises an exception contributes what it found before.

    Raises
    ------
    ValueError
        If a part is empty, seeds or file names repeat, a budget is below a population, or a reference has no
        problem.

    Examples
    --------
    Two searches of equal evaluations from three seeds each; the searches from the first seed give the reference
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
        """Return the runs: problem by problem, seed by seed, algorithm by algorithm."""
        runs, most = [], max(self.budgets)
        for problem, seed, (name, optimiser) in product(self.problems, self.seeds, self.algorithms.items()):
            size = optimiser.population
            key = {"problem": problem, "algorithm": name, "population": size, "seed": seed}
            file = file_name(f"{problem}_{name}_n{size}_s{seed}")
            runs.append(PlannedRun(file, optimiser, seed, most, key))
        return runs

    def run(self, client: "Client | None" = None) -> pd.DataFrame:
        """Make all runs, on the workers of a Dask client if given, and return their `table`."""
        store: dict[str, StoredRun] = {}
        failures = {run.name: failure for run, failure in self.carry_out(store, client) if failure}
        return self.table(store, failures)

    def carry_out(
        self, store: MutableMapping[str, StoredRun], client: "Client | None" = None
    ) -> Iterator[tuple[PlannedRun, Failure | None]]:
        """Make the runs that are not in `store`, store each one at its end, and yield it with its failure or None.

        With a client, runs are yielded in the order of their ends; the results are the same.
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
                yield run, Failure(error)
            else:
                work[run.name] = (self.problems[problem], run.optimiser, self.budgets, run.seed, reference)
        for name, ended, error in outcomes(judged_run, work, client):
            finished, failure = ended or (None, Failure(error))
            if finished is not None:
                store[name] = finished
            yield missing[name], failure

    def reference(self, problem: str) -> ReferenceFront:
        """Return the reference front of a problem: the given one, or that of the runs from the first seed."""
        if problem in self.references:
            return self.references[problem]
        most, seed = max(self.budgets), self.seeds[0]
        traces = [trace_so_far(self.problems[problem], each, [most], seed) for each in self.algorithms.values()]
        for seen, error in traces:
            if error is not None and not len(seen.designs):
                raise error
        return best_known([seen.objectives[seen.feasible] for seen, _ in traces])

    def table(self, store: Mapping[str, StoredRun], failures: Mapping[str, Failure] | None = None) -> pd.DataFrame:
        """Return a row per run, budget and set.

        A run that raised an exception has the rows of the budgets before it and one without a budget, each with
        its error.

        Columns: problem, algorithm, population, seed, budget, evaluations, set (`POPULATION`, `ARCHIVE` or
        `CUT_ARCHIVE`), members of the set, relative_hypervolume, igd_plus, epsilon, spread, seconds (of the whole
        run, untimed), error.
        """
        parts = []
        for run in self.runs():
            if run.name in store:
                parts.append(store[run.name].course.assign(**run.key, error=""))
            elif failures and run.name in failures:
                error, course = failures[run.name]
                rows = pd.DataFrame([*course.to_dict("records"), {}])
                parts.append(rows.assign(**run.key, error=error))
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
) -> tuple[StoredRun | None, Failure | None]:
    """Return the tables of one run, judged at each budget, or its failure."""
    start = perf_counter()
    traced, error = trace_so_far(problem, optimiser, budgets, seed)
    seconds = perf_counter() - start
    course = pd.DataFrame(judged(traced, optimiser.population, reference)).assign(seconds=seconds)
    if error is not None:
        return None, Failure(in_one_line(error), course)
    last = traced.states[max(budgets)]
    kept = evenly_spread(last.objectives, optimiser.population)
    final = pd.DataFrame(last.objectives[kept], columns=list(problem.objectives))
    if problem.constraints:
        final[VIOLATION] = last.violation[kept]
    return StoredRun(course, final), None
