"""MOEA/D-DRA beside its limits: the same loop in C, and its arithmetic without the bookkeeping."""

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np
import pandas as pd
from numba import njit
from numpy.typing import NDArray

from suspension_ctrl import MoeadDra, Problem, minimise
from suspension_ctrl.compiled import call, linked, verb_of
from suspension_ctrl.search.decomposition import ZERO_WEIGHT, tchebycheff, weight_vectors
from suspension_ctrl.search.neighbours import neighbourhoods
from suspension_ctrl.search.operators import mutated_value

SOURCE = Path(__file__).parents[1] / "moead_dra.c"
LOOP, UF1 = "UF1, the same loop in C", "UF1, MoeadDra"
BARE, RIDE = "Table 1's problem, arithmetic and evaluation", "Table 1's problem, MoeadDra"
BAR = 1.3


def measure(
    problem: Problem, population: int, generations: int, uf1_evaluations: int, repeats: int
) -> pd.DataFrame:
    """Return one row per run: contender, repeat, processor seconds, and igd of those on UF1.

    UF1 is left out for no evaluations, and the loop in C without a compiler.
    """
    ways: dict[str, Callable[[int], tuple[float, float]]] = {
        RIDE: lambda seed: (_timed(lambda: ride(problem, population, generations, seed)), np.nan),
        BARE: bare_run(problem, population, generations),
    }
    with TemporaryDirectory() as folder:
        if uf1_evaluations:
            ways[UF1] = lambda seed: ours(uf1_evaluations, seed)
            program = compile_loop(Path(folder))
            if program:
                ways[LOOP] = lambda seed: loop_in_c(program, uf1_evaluations, seed)
        rows = []
        for repeat in range(repeats + 1):
            for name, way in list(ways.items())[:: 1 if repeat % 2 else -1]:
                seconds, igd = way(repeat)
                rows.append({"contender": name, "repeat": repeat, "seconds": seconds, "igd": igd})
    table = pd.DataFrame(rows)
    return table[table.repeat > 0].reset_index(drop=True)  # the first compiles


def _timed(function: Callable[[], Any]) -> float:
    begin = process_time()
    function()
    return process_time() - begin


def compile_loop(folder: Path) -> Path | None:
    """Return the program of the loop in C, None without a compiler."""
    compiler, program = shutil.which("cc"), folder / "moead_dra"
    if compiler is None:
        return None
    options = ["-O3", "-march=native", "-o", str(program), str(SOURCE), "-lm"]
    subprocess.run([compiler, *options], check=True)
    return program


def loop_in_c(program: Path, evaluations: int, seed: int) -> tuple[float, float]:
    """Return processor seconds and distance from the front of a run in C."""
    done = subprocess.run([program, str(evaluations), str(seed)], check=True, capture_output=True, text=True)
    seconds, *rows = done.stdout.splitlines()
    return float(seconds), distance(np.array([row.split() for row in rows], dtype=float))


def ours(evaluations: int, seed: int) -> tuple[float, float]:
    """Return the same of a run of MoeadDra."""
    begin = process_time()
    run = minimise(uf1(), MoeadDra(population=600, normalise=False), evaluations=evaluations, seed=seed)
    return process_time() - begin, distance(run.objectives)


def distance(objectives: NDArray[np.float64]) -> float:
    """Return the inverted generational distance of objectives (n, 2) from 500 points of UF1's front."""
    first = np.linspace(0, 1, 500)
    front = np.stack([first, 1 - np.sqrt(first)], axis=1)
    return float(np.linalg.norm(front[:, np.newaxis] - objectives, axis=2).min(axis=1).mean())


@njit(cache=True)
def uf1_values(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the objectives (2,) of a design (n,) of UF1 of CEC 2009."""
    odd, even = 0.0, 0.0
    for v in range(1, x.size):
        off = x[v] - np.sin(6 * np.pi * x[0] + (v + 1) * np.pi / x.size)
        if v % 2:
            even += off * off
        else:
            odd += off * off
    values = np.empty(2)
    values[0] = x[0] + 2 * odd / ((x.size - 1) // 2)
    values[1] = 1 - np.sqrt(x[0]) + 2 * even / (x.size // 2)
    return values


def uf1() -> Problem:
    """Return UF1 with 30 variables."""
    return Problem(
        evaluate=lambda designs: np.array([uf1_values(design) for design in designs]),
        lower=(0.0,) + (-1.0,) * 29,
        upper=(1.0,) * 30,
        objectives=("f1", "f2"),
        kernel=(uf1_values, ()),
    )


def ride(problem: Problem, population: int, generations: int, seed: int) -> None:
    """Search the problem, neighbourhoods anew."""
    neighbourhoods.cache_clear()
    minimise(problem, MoeadDra(population=population), evaluations=(generations + 1) * population, seed=seed)


def bare_run(problem: Problem, population: int, generations: int) -> Callable[[int], tuple[float, float]]:
    """Return what times the arithmetic of a search of as many evaluations.

    That is evaluation, differential evolution, mutation of one variable, and the comparison of the child with its
    partners, a tenth of N for nine children of ten and all for the tenth; without draws and without replacement.
    """
    lower, upper = np.array(problem.lower), np.array(problem.upper)
    weights = np.maximum(weight_vectors(population, len(problem.objectives)), ZERO_WEIGHT)
    kernel: Any = problem.kernel
    near = neighbourhoods(population, len(problem.objectives), max(20, population // 10))

    def run(seed: int) -> tuple[float, float]:
        rng = np.random.default_rng(seed)
        plan = rng.integers(0, population, (generations * population, 3))
        designs, u = rng.uniform(lower, upper, (population, lower.size)), rng.random(len(plan))
        begin = process_time()
        values = problem.evaluate(designs)
        costs = tchebycheff(values, weights, values.min(axis=0))
        bare(linked(verb_of(kernel)), designs, weights, costs, near, plan, u, lower, upper)
        return process_time() - begin, np.nan

    return run


@njit
def bare(
    evaluate: Any,
    designs: NDArray[np.float64],
    weights: NDArray[np.float64],
    costs: NDArray[np.float64],
    near: NDArray[np.int64],
    plan: NDArray[np.int64],
    u: NDArray[np.float64],
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
) -> int:
    """Return how many partners the children of a plan (k, 3) of parents and mates better."""
    child, everyone, better = np.empty(lower.size), np.arange(costs.size), 0
    for k in range(len(plan)):
        i, one, other = plan[k]
        for v in range(child.size):
            value = designs[i, v] + 0.5 * (designs[one, v] - designs[other, v])
            child[v] = min(max(value, lower[v]), upper[v])
        v = k % child.size
        child[v] = mutated_value(child[v], u[k], lower[v], upper[v], 20.0)
        a, b, c = call(evaluate, (child,))
        partners = near[i] if k % 10 else everyone
        for p in partners:
            cost = costs[p]
            better += (weights[p, 0] * a < cost) & (weights[p, 1] * b < cost) & (weights[p, 2] * c < cost)
    return better


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float, str]]:
    """Return what is to hold: what, largest ratio, the one measured, and to what."""
    seconds = timings.groupby("contender").seconds.median()
    pairs = [("MOEA/D-DRA, UF1", UF1, LOOP), ("MOEA/D-DRA, Table 1's problem", RIDE, BARE)]
    return [
        (what, BAR, float(seconds[name] / seconds[limit]), limit.partition(", ")[2])
        for what, name, limit in pairs
        if {name, limit} <= set(seconds.index)
    ]
