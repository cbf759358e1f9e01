"""The paper's experiment: NSGA-II against MOEA/D-DRA on Table 1's vehicle, Tables 2 to 4 and Figure 5.

Prints the measured tables beside the published ones. Writes them, every run, every final front and Figure 5
to a folder, whose path is the last line printed.
"""

from pathlib import Path
from typing import Annotated

import pandas as pd
from typer import Option

from suspension_ctrl import (
    MoeadDra,
    RideProblem,
    environment,
    experiments,
    figures,
    files,
    paper,
    tables,
    terminal,
)
from suspension_ctrl.experiments import Results
from suspension_ctrl.indicators import ReferenceFront

POPULATIONS, ITERATIONS = ",".join(map(str, paper.POPULATIONS)), ",".join(map(str, paper.ITERATIONS))
GRID = 400  # values per variable of the reference front
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
        int, Option(parser=terminal.whole_number, help="Runs of each algorithm at each population and iterations.")
    ] = paper.REPEATS,
    algorithms: Annotated[
        str, Option(help=f"Of {', '.join(experiments.ALGORITHMS)}; the first is the baseline.")
    ] = "nsga2,moead-dra",
    weighting: Annotated[str, Option(help="ISO 2631 weighting of ACC: Wk, Wb, Wb-table, ...")] = "Wk",
    seed: Annotated[
        int,
        Option(
            parser=terminal.whole_number,
            help="Seed of the first repeat; the next has the next.",
        ),
    ] = 0,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
    quick: Annotated[
        bool, Option("--quick", help="Short form: populations 60,100, iterations 5,10, two repeats.")
    ] = False,
) -> None:
    """Compare NSGA-II and MOEA/D-DRA as the paper does: Tables 2, 3 and 4 and Figure 5."""
    if quick:
        if (populations, iterations, repeats) != (POPULATIONS, ITERATIONS, paper.REPEATS):
            raise ValueError(
                "quick must stand without populations, iterations and repeats, got it with one of them"
            )
        populations, iterations, repeats = "60,100", "5,10", 2
    arguments = locals() | {"out": str(out) if out else None}
    problem = paper.ride_problem(weighting=weighting)
    sizes, counts = (
        terminal.whole_numbers("populations", populations),
        terminal.whole_numbers("iterations", iterations),
    )
    runs = experiments.plan(problem, terminal.names(algorithms), sizes, counts, repeats, seed)
    folder = files.results_folder(out)
    with environment.single_thread():
        record = environment.describe(arguments)
        experiments.warm_up(problem, runs)
        results = list(terminal.progress(experiments.carry_out(problem, runs), len(runs)))
        reference = ReferenceFront.on_grid(problem, GRID)
        table = experiments.tidy(results, reference)
    files.write_json(folder / "environment.json", record)
    files.write_csv(folder / "runs.csv", table)
    write_tables(table, folder)
    write_fronts(problem, results, folder / "fronts")
    files.write_figure(
        folder / "figure5", figures.final_populations(experiments.final_populations(problem, results))
    )
    terminal.console.print(
        f"ACC is weighted with {weighting}. Hypervolume and IGD+ are medians over the repeats, against the "
        f"non-dominated designs of a {GRID} x {GRID} grid (hypervolume "
        f"{reference.hypervolume(reference.objectives):.4f})."
    )
    if min(counts) <= MoeadDra.utility_period and "moead" in algorithms:
        terminal.console.print(
            f"In up to {MoeadDra.utility_period} iterations MOEA/D-DRA has not allocated resources yet: "
            f"its utilities first change after iteration {MoeadDra.utility_period}."
        )
    print(folder)


def write_tables(runs: pd.DataFrame, folder: Path) -> None:
    published = paper.published_seconds()
    for number, family in ((2, "nsga2"), (3, "moead-dra")):
        table = tables.seconds_by_repeat(runs, published, family)
        if not table.empty:
            files.write_csv(folder / f"table{number}.csv", table)
            for algorithm, part in table.groupby("algorithm", sort=False):
                terminal.show(f"Table {number}: {algorithm}, seconds published / here", tables.as_printed(part))
    table = tables.comparison(runs, published)
    files.write_csv(folder / "table4.csv", table)
    terminal.show(
        f"Table 4: % is the time of {runs.algorithm.iloc[0]} over the time of each",
        table.rename(columns=SHORT),
        DECIMALS,
    )


def write_fronts(problem: RideProblem, results: Results, folder: Path) -> None:
    folder.mkdir()
    for planned, run in results:
        files.write_csv(folder / f"{planned.name}.csv", experiments.front(problem, run))


if __name__ == "__main__":
    terminal.run_script(main)
