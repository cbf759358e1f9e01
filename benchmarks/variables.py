"""From how many variables on do the evolutionary algorithms earn their keep? Test problems of 2 to 8 variables.

Compares their final populations with those of random and Sobol samples of as many evaluations on ZDT1 (two
objectives) and DTLZ2 (three), cut down to so many variables. Writes every run, medians and tests to a folder,
whose path is the last line printed.
"""

from collections.abc import Callable
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from deap import benchmarks
from numpy.typing import NDArray
from typer import Option

from suspension_ctrl import Problem, checks
from suspension_ctrl import tables as files
from suspension_ctrl.commands import options, results, terminal
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import inference as statistics
from suspension_ctrl.study import workers as clusters
from suspension_ctrl.study.comparison import optimiser
from suspension_ctrl.study.judging import POPULATION
from suspension_ctrl.study.study import Study

ALGORITHMS = ("nsga2", "moead-dra", "random", "sobol")
FUNCTIONS: dict[str, tuple[Callable[..., Any], int]] = {
    "zdt1": (benchmarks.zdt1, 2),
    "dtlz2": (partial(benchmarks.dtlz2, obj=3), 3),
}


def main(
    variables: Annotated[str, Option(help="Numbers of variables.")] = "2,3,4,5,6,7,8",
    population: Annotated[int, Option(parser=options.whole_number, help="Population size N.")] = 500,
    evaluations: Annotated[int, Option(parser=options.whole_number, help="Evaluations of each run.")] = 5500,
    seeds: Annotated[int, Option(parser=options.whole_number, help="Runs of each algorithm.")] = 11,
    jobs: Annotated[int | None, Option(parser=options.whole_number, help="Processes for the runs.")] = None,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
) -> None:
    """Compare evolutionary algorithms with samples on problems of 2 to 8 variables."""
    checks.at_least("seeds", seeds, 1)
    numbers = options.whole_numbers("variables", variables)
    if not all(2 <= d <= 30 for d in numbers):
        raise ValueError(f"variables must be >= 2 and <= 30, got {variables!r}")
    if evaluations < 2 * population:
        raise ValueError(f"evaluations must be >= {2 * population}, a start and an iteration, got {evaluations}")
    problems = {
        f"{name}-{d}": row_by_row(function, d, objectives)
        for name, (function, objectives) in FUNCTIONS.items()
        for d in numbers
        if d >= objectives
    }
    one = Study(
        problems=problems,
        algorithms={name: optimiser(name, population) for name in ALGORITHMS},
        seeds=range(seeds),
        budgets=[evaluations],
        references={name: true_front(name) for name in problems},
    )
    folder = results.results_folder(out)
    with nullcontext() if jobs is None else clusters.local_cluster(jobs) as client:
        store: dict[str, Any] = {}
        made = terminal.progress(one.carry_out(store, client), len(one.runs()))
        failures = {run.name: failure for run, failure in made if failure}
    table = one.table(store, failures).drop(columns="seconds")
    final = table[table.set == POPULATION]
    files.write_csv(folder / "runs.csv", table)
    medians = final.pivot_table("relative_hypervolume", "problem", "algorithm", "median", sort=False)
    files.write_table(folder / "medians", medians.reset_index())
    compared = statistics.pairwise(final, ["problem"], ["relative_hypervolume"], ALGORITHMS)
    files.write_table(folder / "differences", compared)
    terminal.show("Hypervolume / reference, medians", medians.reset_index(), dict.fromkeys(ALGORITHMS, 4))
    terminal.end(folder)
    if failures:
        terminal.complain(f"{len(failures)} runs raised: see the column error of {folder / 'runs.csv'}")
        raise typer.Exit(1)


def row_by_row(function: Callable[..., Any], variables: int, objectives: int) -> Problem:
    """Return one of DEAP's functions of a design as a problem on the unit cube."""

    def evaluate(designs: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([function(design) for design in designs.tolist()])

    return Problem(
        evaluate=evaluate,
        lower=(0.0,) * variables,
        upper=(1.0,) * variables,
        objectives=tuple(f"f{j + 1}" for j in range(objectives)),
    )


def true_front(name: str) -> ReferenceFront:
    """Return the known front: f2 = 1 - sqrt(f1) of ZDT1, the unit sphere of DTLZ2."""
    x = np.linspace(0, 1, 1000)
    if name.startswith("zdt1"):
        return ReferenceFront.of(np.stack([x, 1 - np.sqrt(x)], axis=1))
    angles = np.linspace(0, np.pi / 2, 101)
    a, b = (angle.ravel() for angle in np.meshgrid(angles, angles))
    sphere = np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=1)
    return ReferenceFront.of(np.unique(sphere.round(12), axis=0))


if __name__ == "__main__":
    terminal.run_script(main)
