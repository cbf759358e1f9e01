"""Tables 2 to 4, Figure 5 and the fronts of the timed runs, written to a folder and printed."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pandas as pd

from ..paper import figures
from ..paper import tables as printed
from ..search.moead_dra import MoeadDra
from ..study import timing
from ..study.store import StoredRun
from ..tables import write_csv, write_figure, write_table
from . import terminal

if TYPE_CHECKING:
    from .comparing import Request

Store = Mapping[str, StoredRun]
SHORT = {
    "population": "N", "iterations": "iter.", "budget": "equal", "evaluations": "evals",
    "published_seconds": "publ. [s]", "seconds": "here [s]", "microseconds_per_evaluation": "µs/eval",
    "published_ratio_percent": "publ. [%]", "ratio_percent": "here [%]", "hypervolume": "HV", "igd_plus": "IGD+",
}  # fmt: skip
DECIMALS = {"publ. [s]": 1, "here [s]": 4, "µs/eval": 2, "publ. [%]": 0, "here [%]": 0, "HV": 4, "IGD+": 5}


def write(request: "Request", store: Store, timed: pd.DataFrame) -> None:
    """Write runs, tables, fronts and Figure 5."""
    folder = request.campaign.folder
    write_csv(folder / "runs.csv", timed)
    for name, table in printed.timed_tables(timed, request.published()).items():
        write_table(folder / name, table)
    (folder / "fronts").mkdir(exist_ok=True)
    for run in request.campaign.comparison.timed_runs():
        front = timing.front(request.problem, store[run.name])
        write_csv(folder / "fronts" / f"{run.name}.csv", front)
    with terminal.waiting("drawing"):
        _write_figure5(request, timing.final_populations(request.campaign.comparison, store))


def say(request: "Request", store: Store, timed: pd.DataFrame, origin: str) -> None:
    """Print the tables, the problem and the reference front."""
    problem, comparison = request.problem, request.campaign.comparison
    runs = comparison.timed_runs()
    tables = printed.timed_tables(timed, request.published())
    for number, algorithm in printed.ALGORITHMS.items():
        if f"table{number}" in tables:
            table = printed.as_printed(tables[f"table{number}"])
            terminal.show(f"Table {number}: {algorithm}, seconds published / here", table)
    title = f"Table 4: % is the time of {comparison.algorithms[0]} over the time of each"
    terminal.show(title, tables["table4"].rename(columns=SHORT), DECIMALS, keys=4)
    for line in problem.describe():
        terminal.note(line)
    weighted = f"ACC is weighted with {problem.weighting}. " if problem.weighted else ""
    terminal.note(f"{weighted}Hypervolume and IGD+ are medians over the repeats, against {origin}.")
    period = MoeadDra.utility_period
    if min(comparison.iterations) <= period and any(isinstance(run.optimiser, MoeadDra) for run in runs):
        terminal.note(
            f"In up to {period} iterations MOEA/D-DRA has not allocated resources yet: its utilities first change "
            f"after iteration {period}."
        )
    barren = sum(store[run.name].feasible.empty for run in runs)
    if barren:
        terminal.note(f"{barren} of {len(runs)} timed runs found no design within the limits.")


def _write_figure5(request: "Request", populations: pd.DataFrame) -> None:
    """Draw the first algorithm with the second, and in further figures with each of the others."""
    across, *up = request.headers().values()
    first, *others = request.campaign.comparison.algorithms
    for number, other in enumerate(others or [first]):
        shown = populations[populations.algorithm.isin([first, other])]
        stem = f"figure5_{other}" if number else "figure5"
        write_figure(request.campaign.folder / stem, figures.final_populations(shown, across, up))
