"""The steps of `suspension-ctrl compare`: timed runs, quality over seeds, files and printed tables."""

from collections.abc import Mapping
from contextlib import AbstractContextManager
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
from ..search.kinds import Coding
from ..study import machine, reference, timing
from ..study.campaign import Campaign
from ..study.comparison import Comparison
from ..study.findings import findings, last_rows
from ..study.store import keeping
from ..tables import write_csv, write_json
from . import options as o
from . import quality, reports, results, terminal

QUICK_TOLERANCE = 1e-3
GRID_VARIABLES = 2  # of more a grid is too coarse, and of several wheels it would take too long
RECORD = "environment.json"  # the first file in the folder of a comparison
PAPERS = ("vehicle", "road", "speed", "band", "problem")
"""Options without which the problem is the paper's."""


@dataclass(frozen=True)
class Request:
    """A campaign with its problem and all options of the command."""

    campaign: Campaign
    problem: RideProblem
    options: Mapping[str, Any]

    @classmethod
    def of(cls, options: Mapping[str, Any]) -> Self:
        """Return the request of these options, checked, and make its folder."""
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
        tolerance = QUICK_TOLERANCE if options["quick"] else reference.TOLERANCE
        folder = results.results_folder(options["out"], resumed_by=RECORD)
        return cls(Campaign(comparison, folder, tolerance, terminal.progress), problem, options)

    def published(self) -> pd.DataFrame:
        """Return the times of the paper, empty for another problem."""
        of_paper = all(self.options[name] is None for name in PAPERS)
        return paper.published_seconds() if of_paper else paper.published_seconds().iloc[:0]

    def headers(self) -> dict[str, str]:
        """Return the headers of the objectives by name; a travel comes first, or else the last objective."""
        names, units = self.problem.objectives, self.problem.units
        across = next((name for name in names if units[name] == "m"), names[-1])
        ordered = [across, *(name for name in names if name != across)]
        return dict(zip(ordered, column_headers(ordered, units), strict=True))


def chosen_problem(options: Mapping[str, Any]) -> RideProblem:
    """Return the problem of a file, or the paper's with another vehicle, road, speed or other parameters."""
    named = [options[name] for name in ("vehicle", "road", "speed")]
    settings, file = o.settings(options["weighting"], options["band"]), options["problem"]
    if file is None:
        return paper.chosen(*named, allow_outside=options["allow_outside"], **settings)[0]
    if settings or any(value is not None for value in named):
        raise ValueError(
            f"problem must stand without weighting, vehicle, road, speed and band, got {str(file)!r} with one"
        )
    return load_problem(file, allow_outside=options["allow_outside"])


def carry_out(request: Request, cluster: AbstractContextManager[Any] | None) -> None:
    """Make, write and print the timed runs; with a cluster, also the runs over many seeds."""
    with keeping(request.campaign.folder):
        raised = _carried_out(request, cluster)
    print(request.campaign.folder)
    if raised:
        terminal.complain(f"{raised} runs raised: see the column error of {request.campaign.folder / 'runs.csv'}")
        raise typer.Exit(1)


def _carried_out(request: Request, cluster: AbstractContextManager[Any] | None) -> int:
    """Return the number of runs that raised."""
    campaign, record = request.campaign, request.campaign.folder / RECORD
    if not record.exists():  # written by the command that started the timed runs
        texts = {name: str(value) if isinstance(value, Path) else value for name, value in request.options.items()}
        with machine.single_thread():
            write_json(record, machine.describe(texts))
    with terminal.compiling():
        store = campaign.time()
    several = any(len(case.vehicle.contact_points) > 1 for case in request.problem.cases)
    with terminal.waiting("reference front"):
        grid = not several and Coding(request.problem).lower.size <= GRID_VARIABLES
        front, origin = campaign.reference(store, grid=grid)
    timed = timing.tidy(campaign.comparison, store, front).assign(timing=True)
    reports.write(request, store, timed)
    reports.say(request, store, timed, origin)
    if cluster is None:
        return 0
    with cluster as client, terminal.compiling():
        table, judged = campaign.judge(front, client)
    write_csv(campaign.folder / "runs.csv", pd.concat([timed, last_rows(table)]))
    clock, target = timing.seconds_by_evaluations(campaign.comparison, store), request.options["target"]
    if results := findings(campaign.comparison, table, clock, target):
        quality.write(request, results, judged)
        quality.say(results, target)
    return int((table.error.ne("") & table.budget.isna()).sum())
