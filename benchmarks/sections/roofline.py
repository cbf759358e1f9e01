"""Section 9: times of ours beside what the arithmetic alone takes on this machine in this run, and two threads."""

from collections.abc import Callable
from os import cpu_count
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

import suspension_ctrl as sc
from sections import struts
from sections.arithmetic import STEP, limits, multiply_adds, work_of
from sections.timing import take_turns
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.selection import ranks_and_crowding
from suspension_ctrl.threads import in_blocks

LIMIT, LEAST = 60.0, 0.02
"""Seconds: of a call after which there is no other, and up to which calls are repeated within one timing."""
RANKING = "non-dominated ranking, three objectives"
ARITHMETIC = "multiply-adds alone, 1.6 ms"
_CHAINED = 1 << 19
"""Steps of the chains of multiply-adds in these: as long as 10,000 quarter cars take on a common machine."""


class Row(NamedTuple):
    """What is evaluated, a vehicle and strut of `struts.problems`, and the least share of the limit to hold."""

    what: str
    vehicle: str
    strut: str
    bar: float


ROWS = (
    Row("quarter car", struts.QUARTER, struts.DEFAULT, 0.6),
    Row("quarter car, damper on a mount", struts.QUARTER, "damper on a mount", 0.0),
    Row("quarter car, digressive damper", struts.QUARTER, "digressive damper", 0.0),
    Row("full car", struts.FULL, struts.DEFAULT, 0.5),
    Row("full car, dampers on mounts", struts.FULL, "dampers on mounts", 0.0),
    Row("full car, two dampers by measured tables", struts.FULL, "two dampers by measured tables", 0.0),
    Row("semitrailer", struts.TRUCK, "springs, dampers of two axles", 0.0),
)
THREADS = 1.8
"""Least ratio of one thread's time to that of two."""


def measure(nodes: int, designs: dict[str, int], population: int, repeats: int) -> pd.DataFrame:
    """Return one row per timed call: what, threads, designs, limit of one [s], repeat, seconds, cpu_seconds."""
    entries, known = dict[str, Any](), dict[str, tuple[str, int, int, float]]()

    def add(what: str, threads: int, count: int, limit: float, call: Callable[[], Any]) -> None:
        known[f"{what}, {threads}"], entries[f"{what}, {threads}"] = (what, threads, count, limit), lambda _: call

    counts = (1, 2) if (cpu_count() or 1) > 1 else (1,)
    for threads in counts:
        add(ARITHMETIC, threads, _CHAINED, STEP / limits().multiply_adds, _arithmetic(threads))
    problems = struts.problems(nodes)
    for row in ROWS:
        problem, count = problems[row.vehicle, row.strut], designs[row.vehicle]
        drawn = np.random.default_rng(1).uniform(problem.lower, problem.upper, (count, len(problem.lower)))
        limit = work_of(problem.scores.kernel(nodes).cases[0], drawn[:100]).seconds(limits())
        for threads in counts:
            add(row.what, threads, count, limit, _evaluation(problem, drawn, threads))
    values = paper.ride_problem(nodes=nodes)
    objectives = _objectives(values, population)
    add(
        RANKING,
        1,
        population,
        _sorting(objectives) / population,
        lambda: ranks_and_crowding(objectives, population // 2),
    )
    found = pd.DataFrame(take_turns(entries, repeats, LIMIT, least=LEAST))
    names = ["what", "threads", "designs", "limit"]
    return pd.concat([found, pd.DataFrame(found.pop("contender").map(known).tolist(), columns=names)], axis=1)


def _evaluation(problem: sc.RideProblem, drawn: NDArray[np.float64], threads: int) -> Callable[[], Any]:
    return lambda: problem.evaluate(drawn, threads=threads)


def _arithmetic(threads: int) -> Callable[[], Any]:
    def part_of(part: slice) -> float:
        return multiply_adds(part.stop - part.start, 0.5)

    return lambda: in_blocks(part_of, _CHAINED, _CHAINED * STEP, threads)


def _objectives(problem: sc.RideProblem, population: int) -> NDArray[np.float64]:
    """Return the objectives of designs from the bounds."""
    drawn = np.random.default_rng(2).uniform(problem.lower, problem.upper, (population, 2))
    return problem.evaluate(drawn)


def _sorting(objectives: NDArray[np.float64]) -> float:
    """Return the least time [s] in which numpy sorts each objective, as a ranking does in its own way."""
    columns = np.ascontiguousarray(objectives.T)
    rows = take_turns({"sort": lambda _: lambda: np.sort(columns, axis=1)}, 5, LIMIT, least=LEAST)
    return float(min(row["seconds"] for row in rows))


def shares(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by what: limit and time per design [s] on one thread, the share of the limit, and its bar.

    ``threads`` is the ratio of one thread's time to that of two; NaN where there was one processor.
    """
    each = timings.assign(seconds=timings.seconds / timings.designs)
    least = each.groupby(["what", "threads"], sort=False).seconds.min()
    limit = timings.groupby("what").limit.first()
    names = [ARITHMETIC, *(row.what for row in ROWS), RANKING]
    one, two = (np.array([least.get((name, threads), np.nan) for name in names]) for threads in (1, 2))
    table = pd.DataFrame({"what": names, "limit": limit[names].to_numpy(), "seconds": one})
    return table.assign(share=table.limit / one, bar=[0.0, *(row.bar for row in ROWS), 0.0], threads=one / two)


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float]]:
    """Return what is to hold: what, least value, and the one measured."""
    found = shares(timings).query("bar > 0")
    held = [
        (f"{what}, share of the limit", float(bar), float(share))
        for what, bar, share in zip(found.what, found.bar, found.share, strict=True)
    ]
    both = found.dropna(subset="threads")
    return held + [
        (f"{what}, one thread / two", THREADS, float(ratio))
        for what, ratio in zip(both.what, both.threads, strict=True)
    ]
