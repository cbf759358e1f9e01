"""The paper's experiment: NSGA-II against MOEA/D-DRA on Table 1's vehicle, Tables 2 to 4 and Figure 5.

Or on any other vehicle, road and speed, or on a problem from a file. Prints the measured tables, those of the
paper's problem beside the published ones. Writes them, every run, every final front and Figure 5 to a folder,
whose path is the last line printed. With `--quality` every algorithm is also judged over many
seeds: at equal iterations, evaluations and time, with statistics and a verdict; those runs are never timed and
can be spread over processes and machines. What was stopped goes on with the same `--out`.
"""

import platform
import warnings
from pathlib import Path
from typing import Annotated, Any

import pandas as pd
import typer
from typer import Option

from .. import checks
from .. import tables as files
from ..paper import experiment as paper
from ..paper import tables
from ..quantities import column_headers
from ..response import files as problem_files
from ..response.problem import RideProblem
from ..search.constraints import InfeasibleWarning
from ..search.indicators import ReferenceFront
from ..search.moead_dra import MoeadDra
from ..study import figures
from ..study import machine as environment
from ..study import reference as references
from ..study import timing as experiments
from ..study.comparison import ALGORITHMS as KNOWN
from ..study.comparison import Comparison
from ..study.store import FolderStore
from . import reports, results, terminal
from .campaign import Workers, carry_out

POPULATIONS, ITERATIONS = ",".join(map(str, paper.POPULATIONS)), ",".join(map(str, paper.ITERATIONS))
ALGORITHMS = "nsga2,moead-dra"
SEEDS = 31
QUICK_TOLERANCE = 1e-3
GRID_VARIABLES = 2  # of more a grid is too coarse, and of several wheels it would take too long
SHORT = {
    "population": "N", "iterations": "iter.", "budget": "equal", "evaluations": "evals",
    "published_seconds": "publ. [s]", "seconds": "here [s]", "microseconds_per_evaluation": "µs/eval",
    "published_ratio_percent": "publ. [%]", "ratio_percent": "here [%]", "hypervolume": "HV", "igd_plus": "IGD+",
}  # fmt: skip
DECIMALS = {
    "publ. [s]": 1, "here [s]": 4, "µs/eval": 2, "publ. [%]": 0, "here [%]": 0, "HV": 4, "IGD+": 5,
}  # fmt: skip


def main(
    populations: Annotated[str, Option(help="Population sizes.")] = POPULATIONS,
    iterations: Annotated[str, Option(help="Iterations after the start.")] = ITERATIONS,
    repeats: Annotated[
        int, Option(parser=terminal.whole_number, help="Timed runs of each algorithm at each configuration.")
    ] = paper.REPEATS,
    algorithms: Annotated[str, Option(help=f"Of {', '.join(KNOWN)}; the first is the baseline.")] = ALGORITHMS,
    weighting: Annotated[str | None, Option(help="ISO 2631 weighting of ACC: Wk, Wb, Wb-table, ...")] = None,
    vehicle: Annotated[str | None, Option(help=paper.VEHICLE_HELP)] = None,
    road: Annotated[str | None, Option(help=paper.ROAD_HELP)] = None,
    speed: Annotated[float | None, Option(parser=terminal.number, help="Speed [m/s].")] = None,
    band: Annotated[str | None, Option(help="Frequencies [Hz]: 0.5,20.")] = None,
    problem_file: Annotated[
        Path | None, Option("--problem", help="TOML file with vehicles, roads, speeds, objectives, limits.")
    ] = None,
    seed: Annotated[
        int, Option(parser=terminal.whole_number, help="Seed of the first repeat; the next has the next.")
    ] = 0,
    out: Annotated[
        Path | None, Option(help="Folder for the results: absent, empty, or of the same command, to go on.")
    ] = None,
    quick: Annotated[
        bool, Option("--quick", help="Short form: populations 60,100, iterations 5,10, two repeats, three seeds.")
    ] = False,
    quality: Annotated[bool, Option("--quality", help="Judge quality over many seeds too.")] = False,
    seeds: Annotated[
        int, Option(parser=terminal.whole_number, help="Runs of each algorithm in --quality.")
    ] = SEEDS,
    target: Annotated[
        float, Option(parser=terminal.number, help="Share of the reference hypervolume to be reached.")
    ] = 0.995,
    jobs: Annotated[
        int | None, Option(parser=terminal.whole_number, help="Processes for the runs of --quality.")
    ] = None,
    scheduler: Annotated[str | None, Option(help="Dask scheduler for them: tcp://host:8786 or tls://...")] = None,
) -> None:
    """Compare NSGA-II and MOEA/D-DRA as the paper does, and with --quality as a careful reader would."""
    if quick:
        if (populations, iterations, repeats, seeds) != (POPULATIONS, ITERATIONS, paper.REPEATS, SEEDS):
            raise ValueError(
                "quick must stand without populations, iterations, repeats and seeds, got it with one of them"
            )
        populations, iterations, repeats, seeds = "60,100", "5,10", 2, 3
    arguments = locals() | {"out": str(out) if out else None, "problem_file": str(problem_file or "")}
    if not quality and (jobs is not None or scheduler):
        raise ValueError(f"jobs and scheduler must stand with quality, got {scheduler or jobs!r} without it")
    workers = Workers(jobs, scheduler)
    sizes, counts = (
        terminal.whole_numbers("populations", populations),
        terminal.whole_numbers("iterations", iterations),
    )
    checks.within("target", target, 0, 1)
    problem = _problem(weighting, vehicle, road, speed, band, problem_file)
    names = terminal.names(algorithms)
    comparison = Comparison(
        problem=problem,
        algorithms=names,
        populations=sizes,
        iterations=counts,
        repeats=repeats,
        seeds=seeds,
        seed=seed,
    )
    runs = comparison.timed_runs()
    folder = results.results_folder(out, resumed_by="timed")
    machine = {"processor": environment.processor_name(), "python": platform.python_version()}
    tolerance = QUICK_TOLERANCE if quick else references.TOLERANCE
    arguments["problem"] = references.key(problem, tolerance)
    store = FolderStore(folder / "timed", machine | _plan(arguments, "seed", "repeats"))
    with environment.single_thread(), warnings.catch_warnings():
        warnings.simplefilter("ignore", InfeasibleWarning)  # what runs found is said of all of them together
        record = environment.describe(arguments)
        experiments.warm_up(comparison)
        for _ in terminal.progress(experiments.carry_out(comparison, store), len(runs)):
            pass
    front, made_of = _reference(comparison, store, tolerance, folder)
    timed = experiments.tidy(comparison, store, front).assign(timing=True)
    if not (folder / "environment.json").exists():  # of the command that began the timed runs
        files.write_json(folder / "environment.json", record)
    files.write_csv(folder / "runs.csv", timed)
    write_tables(timed, folder, beside_paper=(vehicle, road, speed, band, problem_file) == (None,) * 5)
    write_fronts(comparison, store, folder / "fronts")
    write_figure5(problem, experiments.final_populations(comparison, store), names, folder)
    explain(problem, made_of, counts, names)
    barren = sum(experiments.feasible_rows(problem, store[run.name].final).empty for run in runs)
    if barren:
        terminal.note(f"{barren} of {len(runs)} timed runs found no design within the limits.")
    raised = 0
    if quality:
        judged_by = {"reference": references.digest(front)}
        kept = FolderStore(folder / "quality", judged_by | _plan(arguments, "seed", "seeds"))
        table = carry_out(comparison, front, kept, workers)
        files.write_csv(folder / "runs.csv", pd.concat([timed, reports.last_rows(table).assign(timing=False)]))
        clock = experiments.seconds_by_evaluations(comparison, store)
        reports.report(comparison, table, kept, clock, target, folder)
        raised = int(table.error.ne("").sum())
    print(folder)
    if raised:
        terminal.complain(f"{raised} runs raised: see the column error of {folder / 'runs.csv'}")
        raise typer.Exit(1)


def _problem(
    weighting: str | None,
    vehicle: str | None,
    road: str | None,
    speed: float | None,
    band: str | None,
    file: Path | None,
) -> RideProblem:
    if file is None:
        settings = {} if weighting is None else {"weighting": weighting}
        return paper.chosen(vehicle, road, speed, **settings, **terminal.band_of(band))[0]
    if (weighting, vehicle, road, speed, band) != (None,) * 5:
        raise ValueError(
            f"problem must stand without weighting, vehicle, road, speed and band, got {str(file)!r} with one"
        )
    return problem_files.load_problem(file)


def _reference(
    comparison: Comparison, store: FolderStore, tolerance: float, folder: Path
) -> tuple[ReferenceFront, str]:
    """Return what fronts are judged by, and what it was made of in words."""
    problem = comparison.problem
    big = any(len(case.vehicle.contact_points) > 1 for case in problem.cases)
    if big or len(problem.variables) > GRID_VARIABLES:
        found = [
            experiments.objectives_of(problem, experiments.feasible_rows(problem, store[run.name].final))
            for run in comparison.timed_runs()
        ]
        return references.best_known(found), "the non-dominated designs of all these runs"
    grid = references.kept(folder / "reference.npz", problem, tolerance)
    points = " x ".join([str(grid.points)] * len(problem.variables))
    return grid.front, (
        f"the non-dominated designs of a {points} grid (hypervolume "
        f"{grid.front.volume:.4f}, which half as many values change by {grid.change:.1e} and a second "
        f"grid by {grid.second:.1e})"
    )


def explain(problem: RideProblem, made_of: str, counts: list[int], algorithms: list[str]) -> None:
    """Say what the tables rest on."""
    if problem.constraints:
        terminal.note(f"Limits: {', '.join(problem.constraints)}.")
    if len(problem.cases) > 1:
        how = "their worst" if problem.worst_case else "their mean square by shares"
        terminal.note(f"Objectives are over {len(problem.cases)} load cases, {how}; limits hold in each.")
    for number, case in enumerate(problem.cases, start=1):
        terminal.note(f"Case {number}, share {case.share:g}: {case.road.describe()}; {case.speed:g} m/s.")
    accelerated = any(text.split("=")[-1].strip(" -").startswith("ACC") for text in problem.measures)
    weighted = f"ACC is weighted with {problem.weighting}. " if accelerated else ""
    terminal.note(f"{weighted}Hypervolume and IGD+ are medians over the repeats, against {made_of}.")
    if min(counts) <= MoeadDra.utility_period and any(name.startswith("moead") for name in algorithms):
        terminal.note(
            f"In up to {MoeadDra.utility_period} iterations MOEA/D-DRA has not allocated resources yet: "
            f"its utilities first change after iteration {MoeadDra.utility_period}."
        )


def _plan(arguments: dict[str, Any], *also: str) -> dict[str, Any]:
    """Return what the results of a run depend on: these arguments, and the versions that compute it."""
    kept = {name: arguments[name] for name in ("populations", "iterations", "problem", "algorithms", *also)}
    return kept | environment.provenance()


def write_tables(runs: pd.DataFrame, folder: Path, *, beside_paper: bool) -> None:
    published = paper.published_seconds() if beside_paper else paper.published_seconds().iloc[:0]
    for number, family in ((2, "nsga2"), (3, "moead-dra")):
        table = tables.seconds_by_repeat(runs, published, family)
        if not table.empty:
            results.write_table(folder / f"table{number}", table)
            for algorithm, part in table.groupby("algorithm", sort=False):
                terminal.show(f"Table {number}: {algorithm}, seconds published / here", tables.as_printed(part))
    table = tables.comparison(runs, published)
    results.write_table(folder / "table4", table)
    terminal.show(
        f"Table 4: % is the time of {runs.algorithm.iloc[0]} over the time of each",
        table.rename(columns=SHORT),
        DECIMALS,
    )


def write_figure5(problem: RideProblem, populations: pd.DataFrame, algorithms: list[str], folder: Path) -> None:
    """Draw the first algorithm beside the second, and in further figures beside each of the others."""
    headers = column_headers(problem.objectives, problem.units)
    across = next((header for header in headers if header.startswith("SWS")), headers[-1])
    up = [header for header in headers if header != across]
    for number, other in enumerate(algorithms[1:] or algorithms):
        shown = populations[populations.algorithm.isin([algorithms[0], other])]
        stem = "figure5" if number == 0 else f"figure5_{other}"
        results.write_figure(folder / stem, figures.final_populations(shown, across, up))


def write_fronts(comparison: Comparison, store: FolderStore, folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    for planned in comparison.timed_runs():
        final = experiments.front(comparison.problem, store[planned.name].final)
        files.write_csv(folder / f"{planned.name}.csv", final)
