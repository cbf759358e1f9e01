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
from suspension_ctrl.compiled import compilable
from suspension_ctrl.compiled_verbs import call, linked, verb_of
from suspension_ctrl.search.decomposition import ZERO_WEIGHT, weight_vectors
from suspension_ctrl.search.neighbours import neighbourhoods
from suspension_ctrl.search.operators import mutated_value
from suspension_ctrl.search.sweep import EvaluateChild

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
    """Search the problem, with weight vectors and neighbourhoods at hand."""
    minimise(problem, MoeadDra(population=population), evaluations=(generations + 1) * population, seed=seed)


def bare_run(problem: Problem, population: int, generations: int) -> Callable[[int], tuple[float, float]]:
    """Return what times the arithmetic of a search of as many evaluations, by its seed.

    That is what `bare` does, and evaluation and values of equation (14) at the start, with weight vectors and
    neighbourhoods at hand as for `ride`. Bookkeeping is all else: verbs that can be exchanged, choice of
    subproblems by their utility, checks of results, spans of the objectives, states and history of the run.
    """
    m = len(problem.objectives)
    weights = np.maximum(weight_vectors(population, m), ZERO_WEIGHT)
    near = neighbourhoods(population, m, max(20, population // 10))
    kernel: Any = problem.kernel

    def run(seed: int) -> tuple[float, float]:
        rng = np.random.default_rng(seed)
        parents = rng.integers(0, population, generations * population)
        evaluate, lower, upper = EvaluateChild(verb_of(kernel)), np.array(problem.lower), np.array(problem.upper)
        begin = process_time()
        designs = lower + (upper - lower) * rng.random((population, lower.size))
        values = problem.evaluate(designs)
        bare(
            linked(evaluate), rng, designs, values, weights, near, parents, lower, upper, max(2, population // 100)
        )
        return process_time() - begin, np.nan

    return run


@njit
def bare(
    evaluate: Any,
    rng: np.random.Generator,
    designs: NDArray[np.float64],
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    near: NDArray[np.int64],
    parents: NDArray[np.int64],
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
    limit: int,
) -> None:
    """Make, evaluate and place a child of each parent, as MOEA/D-DE does with three objectives, in one loop."""
    n, d = designs.shape
    ideal, costs, child, found = np.full(3, np.inf), np.empty(n), np.empty(d), np.empty(3)
    everyone, worse = np.arange(n), np.empty(n, dtype=np.int64)
    for p in range(n):
        lowered(ideal, values[p])
    for p in range(n):
        costs[p] = cost(weights, p, *gaps(values[p], ideal))
    for i in parents:
        partners = near[i] if rng.random() < 0.9 else everyone
        first, second = int(rng.random() * partners.size), int(rng.random() * (partners.size - 1))
        one, other = partners[first], partners[second + (second >= first)]
        for v in range(d):
            value = designs[i, v] + 0.5 * (designs[one, v] - designs[other, v])
            if value < lower[v]:
                value = lower[v] + rng.random() * (designs[i, v] - lower[v])
            if value > upper[v]:
                value = upper[v] - rng.random() * (upper[v] - designs[i, v])
            if rng.random() < 1 / d:
                value = mutated_value(value, rng.random(), lower[v], upper[v], 20.0)
            child[v] = value
        call(evaluate, (child, found))
        if lowered(ideal, found):
            for p in range(n):
                costs[p] = cost(weights, p, *gaps(values[p], ideal))
        a, b, c = gaps(found, ideal)
        count = 0
        for k in range(partners.size):
            worse[count] = partners[k]
            count += cost(weights, partners[k], a, b, c) < costs[partners[k]]
        for left in range(count, max(count - limit, 0), -1):
            drawn = int(rng.random() * left)
            p = worse[drawn]
            worse[drawn] = worse[left - 1]
            costs[p] = cost(weights, p, a, b, c)
            for v in range(d):
                designs[p, v] = child[v]
            for j in range(3):
                values[p, j] = found[j]


@compilable()
def lowered(ideal: NDArray[np.float64], value: NDArray[np.float64]) -> bool:
    """Lower the ideal point (3,) to a value (3,); return whether it moves."""
    moves = False
    for j in range(3):
        if value[j] < ideal[j]:
            ideal[j], moves = value[j], True
    return moves


@compilable()
def gaps(value: NDArray[np.float64], ideal: NDArray[np.float64]) -> tuple[float, float, float]:
    """Return the distances of a value (3,) from the ideal point."""
    return abs(value[0] - ideal[0]), abs(value[1] - ideal[1]), abs(value[2] - ideal[2])


@compilable()
def cost(weights: NDArray[np.float64], p: int, a: float, b: float, c: float) -> float:
    """Return equation (14) of subproblem p for these distances from the ideal point."""
    a, b, c = weights[p, 0] * a, weights[p, 1] * b, weights[p, 2] * c
    a = b if b > a else a
    return c if c > a else a


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float, str]]:
    """Return what is to hold: what, largest ratio, the one measured, and to what."""
    seconds = timings.groupby("contender").seconds.median()
    pairs = [("MOEA/D-DRA, UF1", UF1, LOOP), ("MOEA/D-DRA, Table 1's problem", RIDE, BARE)]
    return [
        (what, BAR, float(seconds[name] / seconds[limit]), limit.partition(", ")[2])
        for what, name, limit in pairs
        if {name, limit} <= set(seconds.index)
    ]
