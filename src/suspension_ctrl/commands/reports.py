"""Times, fronts and quality of the timed runs, written and printed; for the paper Tables 2 to 4 and Figure 5."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pandas as pd

from ..paper import experiment
from ..paper import tables as printed
from ..quantities import column_headers
from ..search.moead_dra import MoeadDra
from ..study import figures, timing
from ..study.reference import Reference
from ..study.store import StoredRun
from ..tables import write_csv, write_table, write_tables
from . import stages, terminal

if TYPE_CHECKING:
    from .comparing import Request

Store = Mapping[str, StoredRun]
HEADERS = {
    "budget": "equal", "seconds": "time [s]", "microseconds_per_evaluation": "time per evaluation [µs]",
    "ratio_percent": "ratio of times [%]", "hypervolume": "hypervolume [-]", "igd_plus": "IGD+ [-]",
}  # fmt: skip
SHORT = {
    "population": "N", "iterations": "iter.", "budget": "equal", "evaluations": "evals",
    "published_seconds": "publ. [s]", "seconds": "here [s]", "microseconds_per_evaluation": "µs/eval",
    "published_ratio_percent": "publ. [%]", "ratio_percent": "here [%]", "hypervolume": "HV", "igd_plus": "IGD+",
}  # fmt: skip
OWN = SHORT | {"seconds": "time [s]", "ratio_percent": "ratio [%]"}
DECIMALS = {
    "publ. [s]": 1, "here [s]": 4, "time [s]": 4, "µs/eval": 2, "publ. [%]": 0, "here [%]": 0, "ratio [%]": 0,
    "HV": 4, "IGD+": 5,
}  # fmt: skip
KEYS = 4  # first columns of a table: population, iterations, algorithm, budget


def write_times(request: "Request", store: Store, timed: pd.DataFrame) -> None:
    """Write the timed runs, the tables of their times and their fronts; begin the figures of final populations."""
    folder = request.campaign.folder
    _draw(request, timing.final_populations(request.campaign.comparison, store))
    write_csv(folder / "runs.csv", timed)
    if request.of_paper:
        for name, table in printed.timed_tables(timed, experiment.published_seconds()).items():
            write_table(folder / name, table, KEYS)
    else:
        write_table(folder / "times", timing.compared(timed).rename(columns=HEADERS), KEYS)
    (folder / "fronts").mkdir(exist_ok=True)
    runs = request.campaign.comparison.timed_runs()
    fronts = {run.name: timing.front(request.problem, store[run.name]) for run in runs}
    write_tables(folder / "fronts", fronts)


def say_times(request: "Request", store: Store, timed: pd.DataFrame) -> None:
    """Print the problem and the tables of the times, once the figures are written."""
    with stages.stage("figures of the timed runs"):
        request.figures.settle()
    comparison, (low, high) = request.campaign.comparison, request.problem.band
    terminal.note(f"Study: {request.study.name}; {low:g} to {high:g} Hz.")
    for line in request.problem.describe():
        terminal.note(line)
    meaning = f"the ratio is the time of {comparison.algorithms[0]} over that of the row"
    if request.of_paper:
        _say_papers(timed, meaning)
    else:
        terminal.show(f"Times: {meaning}", timing.compared(timed).rename(columns=OWN), DECIMALS, keys=KEYS)
    runs, period = comparison.timed_runs(), MoeadDra.utility_period
    if min(comparison.iterations) <= period and any(isinstance(run.optimiser, MoeadDra) for run in runs):
        terminal.note(
            f"In up to {period} iterations MOEA/D-DRA has not allocated resources yet: its utilities first change "
            f"after iteration {period}."
        )
    barren = sum(store[run.name].feasible.empty for run in runs)
    if barren:
        terminal.note(f"{barren} of {len(runs)} timed runs found no design within the limits.")


def _say_papers(timed: pd.DataFrame, meaning: str) -> None:
    """Print Tables 2 to 4."""
    tables = printed.timed_tables(timed, experiment.published_seconds())
    for number, algorithm in printed.ALGORITHMS.items():
        if f"table{number}" in tables:
            table = printed.as_printed(tables[f"table{number}"])
            terminal.show(f"Table {number}: {algorithm}, seconds published / here", table)
    terminal.show(f"Table 4: {meaning}", tables["table4"].rename(columns=SHORT), DECIMALS, keys=KEYS)


def write_quality(request: "Request", judged: pd.DataFrame, reference: Reference) -> None:
    """Write the timed runs with their quality, its table and the reference front."""
    folder = request.campaign.folder
    write_csv(folder / "runs.csv", judged)
    write_table(folder / "hypervolume", timing.quality(judged).rename(columns=HEADERS), KEYS)
    problem = request.problem
    headers = column_headers(problem.objectives, problem.units)
    write_csv(folder / "reference.csv", pd.DataFrame(reference.front.objectives, columns=headers))


def say_quality(request: "Request", judged: pd.DataFrame, reference: Reference) -> None:
    """Print the quality of the timed runs and the reference front."""
    title = "Quality of the final populations of the timed runs, medians"
    terminal.show(title, timing.quality(judged).rename(columns=SHORT), DECIMALS, keys=KEYS)
    weighted = f"ACC is weighted with {request.problem.weighting}. " if request.problem.weighted else ""
    terminal.note(
        f"{weighted}More hypervolume (HV) is better, and less IGD+. The reference front is of {reference.origin}."
    )


def _draw(request: "Request", populations: pd.DataFrame) -> None:
    """Begin the figure of the first algorithm with the second, and further ones with each of the others."""
    across, *up = request.headers().values()
    first, *others = request.campaign.comparison.algorithms
    name = "figure5" if request.of_paper else "populations"
    for number, other in enumerate(others or [first]):
        shown = populations[populations.algorithm.isin([first, other])]
        stem = f"{name}_{other}" if number else name
        request.figures.begin(request.campaign.folder / stem, figures.final_populations, shown, across, up)
