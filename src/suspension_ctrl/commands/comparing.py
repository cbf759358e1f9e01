"""A comparison as its command asks for it, carried out: time, judge, write, say."""

import platform
import warnings
from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import pandas as pd
import typer

from .. import checks
from ..paper import experiment as paper
from ..quantities import column_headers
from ..response.files import load_problem
from ..response.problem import RideProblem
from ..search.constraints import InfeasibleWarning
from ..search.indicators import ReferenceFront
from ..study import machine, reference, timing, workers
from ..study.comparison import Comparison
from ..study.findings import findings
from ..study.store import FolderStore
from ..tables import write_csv, write_json
from . import options as o
from . import quality, reports, results, terminal

QUICK_TOLERANCE = 1e-3
PAPERS = ("vehicle", "road", "speed", "band", "problem")
"""Options without which the problem is the paper's."""

GRID_VARIABLES = 2  # of more a grid is too coarse, and of several wheels it would take too long
Cluster = AbstractContextManager[Any]


@dataclass(frozen=True)
class Request:
    """A comparison with its problem, all options of the command, and the folder of results and finished runs."""

    comparison: Comparison
    problem: RideProblem
    options: Mapping[str, Any]
    folder: Path

    @classmethod
    def of(cls, options: Mapping[str, Any]) -> Self:
        """Return the request of checked options, and make its folder."""
        checks.within("target", options["target"], 0, 1)
        problem = chosen_problem(options)
        comparison = Comparison(
            problem=problem,
            algorithms=o.names(options["algorithms"]),
            populations=o.whole_numbers("populations", options["populations"]),
            iterations=o.whole_numbers("iterations", options["iterations"]),
            repeats=options["repeats"],
            seeds=options["seeds"],
            seed=options["seed"],
        )
        return cls(comparison, problem, options, results.results_folder(options["out"], resumed_by="timed"))

    @property
    def tolerance(self) -> float:
        """Largest relative change of the reference hypervolume by a finer grid."""
        return QUICK_TOLERANCE if self.options["quick"] else reference.TOLERANCE

    def published(self) -> pd.DataFrame:
        """Return the times of the paper, none beside another problem."""
        of_paper = all(self.options[name] is None for name in PAPERS)
        return paper.published_seconds() if of_paper else paper.published_seconds().iloc[:0]

    def headers(self) -> dict[str, str]:
        """Return the objectives with their units by name, first a travel, or else the last."""
        names, units = self.problem.objectives, self.problem.units
        across = next((name for name in names if units[name] == "m"), names[-1])
        ordered = [across, *(name for name in names if name != across)]
        return dict(zip(ordered, column_headers(ordered, units), strict=True))

    def store(self, name: str, *also: str, **plan: Any) -> FolderStore:
        """Return the finished runs in a subfolder that belongs to these settings, values and versions."""
        names = ("populations", "iterations", "algorithms", "seed", *also)
        settings = {key: getattr(self.comparison, key) for key in names}
        settings["problem"] = reference.key(self.problem, self.tolerance)
        return FolderStore(self.folder / name, plan | settings | machine.provenance())


def chosen_problem(options: Mapping[str, Any]) -> RideProblem:
    """Return the problem in a file, or the paper's with another vehicle, road, speed or other settings."""
    named = [options[name] for name in ("vehicle", "road", "speed")]
    settings, file = o.settings(options["weighting"], options["band"]), options["problem"]
    if file is None:
        return paper.chosen(*named, **settings)[0]
    if settings or any(value is not None for value in named):
        raise ValueError(
            f"problem must stand without weighting, vehicle, road, speed and band, got {str(file)!r} with one"
        )
    return load_problem(file)


def cluster_of(jobs: int | None, scheduler: str | None) -> Cluster:
    """Return a context with a Dask client, or with None for runs made here."""
    if jobs is not None and scheduler is not None:
        raise ValueError(f"jobs must stand without scheduler, got {jobs} and {scheduler!r}")
    if jobs is not None:
        checks.at_least("jobs", jobs, 1)
        return workers.local_cluster(jobs)
    if scheduler is None:
        return nullcontext()
    workers.check_address(scheduler)
    return workers.scheduler_at(scheduler)


def carry_out(request: Request, cluster: Cluster | None) -> None:
    """Time, judge, write and say; with a cluster likewise the runs over many seeds."""
    store = time(request)
    front, origin = judge(request, store)
    timed = timing.tidy(request.comparison, store, front).assign(timing=True)
    reports.write(request, store, timed)
    reports.say(request, store, timed, origin)
    raised = 0
    if cluster is not None:
        judged = request.store("quality", "seeds", reference=reference.digest(front))
        table = judge_seeds(request.comparison, front, judged, cluster)
        raised = int(table.error.ne("").sum())
        clock = timing.seconds_by_evaluations(request.comparison, store)
        write_csv(request.folder / "runs.csv", pd.concat([timed, quality.last_rows(table)]))
        if found := findings(request.comparison, table, clock, request.options["target"]):
            quality.write(request, found, judged)
            quality.say(found, request.options["target"])
    print(request.folder)
    if raised:
        terminal.complain(f"{raised} runs raised: see the column error of {request.folder / 'runs.csv'}")
        raise typer.Exit(1)


def time(request: Request) -> FolderStore:
    """Make the timed runs that the folder does not hold, one after the other on one thread."""
    made_on = {"processor": machine.processor_name(), "python": platform.python_version()}
    store = request.store("timed", "repeats", **made_on)
    with machine.single_thread(), warnings.catch_warnings(), terminal.compiling():
        warnings.simplefilter("ignore", InfeasibleWarning)  # the report counts runs without a feasible design
        record = request.folder / "environment.json"
        if not record.exists():  # of the command that began the timed runs
            texts = {name: str(v) if isinstance(v, Path) else v for name, v in request.options.items()}
            write_json(record, machine.describe(texts))
        with terminal.waiting("warming up"):
            timing.warm_up(request.comparison)
        made = timing.carry_out(request.comparison, store)
        for _ in terminal.progress(made, len(request.comparison.timed_runs()), "timed runs"):
            pass
    return store


def judge(request: Request, store: FolderStore) -> tuple[ReferenceFront, str]:
    """Return the front that measures the runs, and its origin in words."""
    problem = request.problem
    several = any(len(case.vehicle.contact_points) > 1 for case in problem.cases)
    if several or len(problem.variables) > GRID_VARIABLES:
        finals = (store[run.name].final for run in request.comparison.timed_runs())
        found = [timing.objectives_of(problem, timing.feasible_rows(problem, final)) for final in finals]
        return reference.best_known(found), "the non-dominated designs of all these runs"
    with terminal.waiting("reference front"):
        grid = reference.kept(request.folder / "reference.npz", problem, request.tolerance)
    points = " x ".join([str(grid.points)] * len(problem.variables))
    return grid.front, (
        f"the non-dominated designs of a {points} grid (hypervolume {grid.front.volume:.4f}, which half as many "
        f"values change by {grid.change:.1e} and a second grid by {grid.second:.1e})"
    )


def judge_seeds(
    comparison: Comparison, front: ReferenceFront, store: FolderStore, cluster: Cluster
) -> pd.DataFrame:
    """Make the runs over many seeds that the store does not hold, and return a row per run, budget and set."""
    parts = []
    with cluster as client, terminal.compiling():
        for population, study in comparison.studies(front).items():
            missing = sum(run.name not in store for run in study.runs())
            terminal.note(f"quality, N = {population}: {missing} of {len(study.runs())} runs to make")
            made = terminal.progress(study.carry_out(store, client), missing, f"N = {population}")
            parts.append(study.table(store, {run.name: error for run, error in made if error}))
    return pd.concat(parts, ignore_index=True).drop(columns="problem")
