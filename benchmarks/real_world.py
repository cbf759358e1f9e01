"""Both optimisers on the engineering problems of the RE and CRE suites.

``fronts`` compares with the known fronts, ``peers`` with pymoo on six of the problems, ``record`` finds the known
fronts anew. Tables go to a folder, whose path is the last line printed.
"""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd
import typer
from numpy.typing import NDArray
from typer import Option

import engineering
from engineering import fronts as known
from peers import Prepare, Task
from suspension_ctrl import MoeadDra, Problem, checks, minimise
from suspension_ctrl import tables as files
from suspension_ctrl.commands import options, results, terminal
from suspension_ctrl.search.indicators import ReferenceFront, best_of
from suspension_ctrl.search.run import Optimiser
from suspension_ctrl.search.trace import trace
from suspension_ctrl.study import comparison, inference

ALL = ",".join(engineering.NAMES)
SIX = "RE21,RE23,RE33,RE34,RE37,RE41"
"""A truss, a vessel of sheets of whole sixteenths, a brake, two crashes and a rocket; 2, 3 and 4 objectives."""

CLIPPED = "moead-dra-clipped"
"""MOEA/D-DRA without own scales, for scaled objectives, and with variables clipped to their bounds."""

PAIRS = (("nsga2", "pymoo nsga2"), ("moead-dra", "pymoo moead"))
SCALED_PAIRS = (*PAIRS, (CLIPPED, "pymoo moead"))

Real = NDArray[np.float64]
Search = Callable[[Problem, int], Real]
"""From a problem and a seed to the objectives (N, m) of the final population."""

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
Names = Annotated[str, Option(help="Names of problems.")]
Number = Annotated[int, Option(parser=options.whole_number)]
Folder = Annotated[Path | None, Option(help="Folder for the results, absent or empty.")]


def ours(population: int) -> dict[str, Optimiser]:
    """Return both optimisers and a random sample."""
    return {name: comparison.optimiser(name, population) for name in ("nsga2", "moead-dra", "random")}


def to_fronts(
    names: tuple[str, ...], algorithms: dict[str, Optimiser], evaluations: int, seeds: int
) -> Iterator[dict[str, Any]]:
    """Yield hypervolumes over those of the known fronts, a row per problem, algorithm and seed."""
    for name in names:
        front = known.reference(name)
        for seed in range(seeds):
            for algorithm, optimiser in algorithms.items():
                seen = trace(engineering.problem(name), optimiser, [evaluations], seed)
                state = seen.states[evaluations]
                yield {
                    "problem": name,
                    "algorithm": algorithm,
                    "seed": seed,
                    "archive": front.relative_hypervolume(known.archive(seen)),
                    "population": front.relative_hypervolume(state.objectives[state.feasible]),
                }


def searches(population: int, evaluations: int) -> dict[str, Search]:
    """Return ours and pymoo's, the latter with neighbourhoods as large."""
    from peers import with_pymoo

    def minimised(optimiser: Optimiser, problem: Problem, seed: int) -> Real:
        return minimise(problem, optimiser, evaluations=evaluations, seed=seed).objectives

    def theirs(prepare: Prepare, problem: Problem, seed: int) -> Real:
        job = prepare(Task(problem, population, evaluations // population - 1, seed))
        return job.objectives(job.run())

    optimisers = ours(population) | {CLIPPED: MoeadDra(population=population, normalise=False, repair_reach=0.0)}
    found: dict[str, Search] = {name: partial(minimised, optimisers[name]) for name, _ in SCALED_PAIRS}
    for name, prepare in (("nsga2", with_pymoo.nsga2), ("moead", with_pymoo.moead)):
        found[f"pymoo {name}"] = partial(theirs, prepare)
    return found


def pairs(scaled: bool) -> tuple[tuple[str, str], ...]:
    """Return the pairs of algorithms to compare."""
    return SCALED_PAIRS if scaled else PAIRS


def for_all(name: str, *, scaled: bool) -> tuple[Problem, ReferenceFront]:
    """Return a problem and its known front, if asked for with objectives scaled to that front.

    pymoo does not know kinds of variables: these are left to the formula.
    """
    problem, front = engineering.problem(name).replace(kinds={}), known.reference(name)
    if not scaled:
        return problem, front
    one = np.ones(front.ideal.size)
    unit = ReferenceFront(front.objectives, 0 * one, one, front.volume)
    return problem.replace(evaluate=lambda designs: front.scaled(problem.evaluate(designs))), unit


def recorded(problem: Problem) -> tuple[Problem, list[Real]]:
    """Return a problem whose objectives (n, m) of each call are appended to a list."""
    seen: list[Real] = []

    def evaluate(designs: Real) -> Real:
        seen.append(problem.evaluate(designs))
        return seen[-1].copy()

    return problem.replace(evaluate=evaluate), seen


def beside_pymoo(
    names: tuple[str, ...], population: int, evaluations: int, seeds: int, *, scaled: bool
) -> Iterator[dict[str, Any]]:
    """Yield hypervolumes over those of the known fronts, a row per problem, algorithm, seed and set."""
    for name in names:
        problem, front = for_all(name, scaled=scaled)
        all_searches = searches(population, evaluations)
        taking_part = dict.fromkeys(chain.from_iterable(pairs(scaled)))
        for seed in range(seeds):
            for algorithm in taking_part:
                search = all_searches[algorithm]
                watched, seen = recorded(problem)
                final, objectives = search(watched, seed), np.concatenate(seen)
                for kind, found in (("population", final), ("archive", objectives)):
                    value = front.relative_hypervolume(np.unique(best_of(found), axis=0))
                    row = {"problem": name, "algorithm": algorithm, "seed": seed, "set": kind}
                    yield row | {"evaluations": len(objectives), "relative_hypervolume": value}


@app.command()
def fronts(
    problems: Names = ALL,
    algorithms: Annotated[str, Option(help="Names of algorithms.")] = "nsga2,moead-dra,random",
    population: Number = 200,
    evaluations: Number = 50_000,
    seeds: Number = 5,
    out: Folder = None,
) -> None:
    """Hypervolume of each algorithm's archive and final population over that of the known front."""
    names, known_ones = chosen("problems", problems, engineering.NAMES), ours(population)
    taking_part = {name: known_ones[name] for name in chosen("algorithms", algorithms, tuple(known_ones))}
    checks.at_least("seeds", seeds, 1)
    folder = results.results_folder(out)
    rows = to_fronts(names, taking_part, evaluations, seeds)
    table = pd.DataFrame(terminal.progress(rows, len(names) * len(taking_part) * seeds))
    files.write_csv(folder / "runs.csv", table)
    groups = table.groupby(["problem", "algorithm"], sort=False)
    summary = pd.DataFrame({
        "archive": groups.archive.median(), "archive, least": groups.archive.min(),
        "population": groups.population.median(),
    }).reset_index()  # fmt: skip
    files.write_table(folder / "fronts", summary)
    terminal.show("Hypervolume / known front's", summary, dict.fromkeys(summary.columns[2:], 4), 2)
    terminal.end(folder)


@app.command()
def peers(
    problems: Names = SIX,
    population: Number = 100,
    evaluations: Number = 10_000,
    seeds: Number = 11,
    scaled: Annotated[
        bool,
        Option("--scaled", help="Give all the scale of the known front."),
    ] = False,
    out: Folder = None,
) -> None:
    """Compare both algorithms with pymoo's, by the statistics of a study."""
    names = chosen("problems", problems, engineering.NAMES)
    checks.at_least("seeds", seeds, 2)
    folder = results.results_folder(out)
    rows = beside_pymoo(names, population, evaluations, seeds, scaled=scaled)
    runs = len(names) * seeds * len(set(chain.from_iterable(pairs(scaled))))
    table = pd.DataFrame(terminal.progress(rows, 2 * runs))  # a row for the population and one for the archive
    files.write_csv(folder / "runs.csv", table)
    compared = pd.concat(
        inference.pairwise(table, ["problem", "set"], ["relative_hypervolume"], pair) for pair in pairs(scaled)
    )
    files.write_table(folder / "differences", compared)
    columns = ["first", "set", "problem", "median_first", "median_second", "p_holm", "a12", "effect"]
    shown = compared[columns].sort_values(["first", "set"])
    digits = {"median_first": 4, "median_second": 4, "p_holm": 3, "a12": 2}
    terminal.show("Hypervolume / published front's, ours and pymoo's", shown, digits, 3)
    terminal.end(folder)


@app.command()
def record(suite: Annotated[Path, typer.Argument(help="Checkout of github.com/ryojitanabe/reproblems.")]) -> None:
    """Write engineering/fronts.json anew: a quarter of an hour."""
    known.record(suite)


def chosen(option: str, text: str, choices: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names in the text of an option; ValueError if one is not among the choices."""
    names = tuple(text.split(","))
    for name in names:
        checks.one_of(option, name, choices)
    return names


if __name__ == "__main__":
    terminal.run(app)
