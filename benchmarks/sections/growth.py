"""How cost grows: seconds per design and per run against each size, ours and other libraries'."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import cos, pi, sin
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numba import njit
from numpy.typing import NDArray

import suspension_ctrl as sc
from peers import Prepare, Task
from sections import struts
from sections.timing import take_turns
from suspension_ctrl.search.problem import Minimisable

LEAST = 0.02
"""Seconds up to which a call is repeated within one timing."""
NSGA2, MOEAD = "NSGA-II", "MOEA/D"
ROAD = sc.Iso8608Road("C")


class Curve(NamedTuple):
    """A curve: what varies, what a point is the cost of, and lines of seconds by size."""

    name: str
    size: str
    of: str  # a design or a run


CURVES = (
    Curve("nodes", "nodes over frequency", "design"),
    Curve("struts", "struts with coefficients that vary", "design"),
    Curve("coordinates", "coordinates of the vehicle", "design"),
    Curve("cases", "load cases", "design"),
    Curve("designs", "designs in a call", "design"),
    Curve("population", "population N", "run"),
    Curve("variables", "variables", "run"),
)

Line = Mapping[int, tuple[Callable[[], Any], int]]
"""By size: what is timed, and by how many its time is divided."""


def measure(lines: Mapping[str, Line], curve: str, repeats: int, limit: float) -> pd.DataFrame:
    """Return a row per timed call: curve, line, size, repeat, seconds of a design or a run.

    A line ends where in proportion to its last time it would take longer than `limit` seconds.
    """
    rows: list[dict[str, Any]] = []
    for name, line in lines.items():
        next(iter(line.values()))[0]()  # compiles and imports what the line needs
        before = 0.0
        for size, (call, count) in line.items():
            if before * size > limit:
                break
            found = take_turns({name: _given(call)}, repeats, limit / 4, least=LEAST)
            before = found[-1]["seconds"] / size
            key = {"curve": curve, "line": name, "size": size}
            rows += [{**key, "repeat": row["repeat"], "seconds": row["seconds"] / count} for row in found]
    return pd.DataFrame(rows)


def _given(call: Callable[[], Any]) -> Callable[[int], Callable[[], Any]]:
    """Return what is timed in every repeat."""
    return lambda _: call


def exponents(timings: pd.DataFrame) -> pd.Series:
    """Return by curve and line the exponent of seconds ~ size^b, fitted to medians of the upper half of the sizes.

    NaN where there are fewer than two sizes.
    """

    def fitted(part: pd.DataFrame) -> float:
        medians = part.groupby("size").seconds.median()
        upper = medians.iloc[len(medians) // 2 - (len(medians) < 4) :]
        return float(np.polyfit(np.log(upper.index), np.log(upper), 1)[0]) if len(upper) > 1 else np.nan

    lines = timings.groupby(["curve", "line"], sort=False)
    return pd.Series({key: fitted(part) for key, part in lines}, dtype=float)


def of_problem(problem: sc.RideProblem, designs: int, nodes: int | None = None) -> tuple[Callable[[], Any], int]:
    """Return the evaluation of designs (n, d) drawn from the box of a problem, at its nodes or at others."""
    drawn = np.random.default_rng(1).uniform(problem.lower, problem.upper, (designs, len(problem.lower)))
    return lambda: problem.scores.evaluate(drawn, nodes or problem.nodes), designs


def by_nodes(counts: Iterable[int], designs: Mapping[str, int]) -> dict[str, Line]:
    """Return lines of a quarter and a full car."""
    cars = {struts.QUARTER: quarter_car(), struts.FULL: full_car()}
    return {name: {n: of_problem(problem, designs[name], n) for n in counts} for name, problem in cars.items()}


def by_struts(axles: Iterable[int], designs: int) -> dict[str, Line]:
    """Return the line of a semitrailer of which one axle after the other has struts that vary, two on each."""
    return {struts.TRUCK: {2 * n: of_problem(struts.semitrailer(256, n), designs) for n in axles}}


def by_coordinates(modes: Iterable[int], designs: int) -> dict[str, Line]:
    """Return the line of a full car whose body bends in so many modes beside seven rigid coordinates."""
    return {struts.FULL: {7 + n: of_problem(struts.imported(256, n), designs) for n in modes}}


def by_cases(counts: Iterable[int], designs: int) -> dict[str, Line]:
    """Return the line of a full car at so many speeds from 5 to 36 m/s."""
    speeds = {n: np.linspace(5.0, 36.0, n) if n > 1 else [20.0] for n in counts}
    car = sc.load_vehicle("jian_2022_full").vehicle
    cases = {n: [sc.LoadCase(vehicle=car, road=ROAD, speed=float(v)) for v in each] for n, each in speeds.items()}
    return {struts.FULL: {n: of_problem(full_car(cases=each), designs) for n, each in cases.items()}}


def by_designs(counts: Iterable[int]) -> dict[str, Line]:
    """Return the line of a quarter car."""
    return {struts.QUARTER: {n: of_problem(quarter_car(), n) for n in counts}}


def by_population(
    searches: Mapping[str, Mapping[str, Prepare]], counts: Iterable[int], generations: int
) -> dict[str, Line]:
    """Return lines of NSGA-II and MOEA/D of each library on the quarter car, by name and algorithm."""
    problem = quarter_car()
    return {
        f"{name}, {algorithm}": {n: (_run(prepare, Task(problem, n, generations, 0)), 1) for n in counts}
        for algorithm, each in searches.items()
        for name, prepare in each.items()
    }


def by_variables(
    searches: Mapping[str, Mapping[str, Prepare]], counts: Iterable[int], population: int, generations: int
) -> dict[str, Line]:
    """Return lines of each library on a function of three objectives and so many variables."""
    return {
        f"{name}, {algorithm}": {
            d: (_run(prepare, Task(sphere(d), population, generations, 0)), 1) for d in counts
        }
        for algorithm, each in searches.items()
        for name, prepare in each.items()
    }


def _run(prepare: Prepare, task: Task) -> Callable[[], Any]:
    """Return a call that sets a search up and runs it: a search may bear one run only."""
    return lambda: prepare(task).run()


def quarter_car() -> sc.RideProblem:
    """Return the problem of a quarter car, spring and damper."""
    car: Any = sc.load_vehicle("yuen_ramli_2010").vehicle
    bounds = {"spring": (1e3, 3e4), "damper": (1e3, 5e3)}
    return sc.RideProblem(car, ROAD, speed=20.0, bounds=bounds, nodes=256)


def full_car(cases: Sequence[sc.LoadCase] = ()) -> sc.RideProblem:
    """Return the problem of a full car, springs and dampers of two axles, in one load case or in `cases`."""
    car: Any = sc.load_vehicle("jian_2022_full").vehicle
    bounds = {
        f"{axle}.{name}": pair
        for axle in ("front", "rear")
        for name, pair in (("spring", (1e4, 3e4)), ("damper", (1e3, 5e3)))
    }
    fixed = {one.name: 2e4 for one in car.strut_coefficients if "antiroll" in one.name}
    given: dict[str, Any] = {"cases": cases} if cases else {"vehicle": car, "road": ROAD, "speed": 20.0}
    return sc.RideProblem(bounds=bounds, struts=fixed, band=(0.1, 20.0), nodes=256, **given)


@njit(cache=True)
def on_sphere(design: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the objectives (3,) of DTLZ2 (Deb, Thiele, Laumanns and Zumbrunnen 2002) of a design (d,)."""
    radius = 1.0
    for v in range(2, design.size):
        radius += (design[v] - 0.5) ** 2
    a, b = design[0] * pi / 2, design[1] * pi / 2
    return np.array([radius * cos(a) * cos(b), radius * cos(a) * sin(b), radius * sin(a)])


@njit(cache=True)
def all_on_sphere(designs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the objectives (n, 3) of designs (n, d)."""
    values = np.empty((len(designs), 3))
    for i in range(len(designs)):
        values[i] = on_sphere(designs[i])
    return values


def sphere(variables: int) -> Minimisable:
    """Return DTLZ2 of so many variables."""
    return sc.Problem(
        evaluate=lambda designs: all_on_sphere(np.ascontiguousarray(designs)),
        lower=[0.0] * variables,
        upper=[1.0] * variables,
        objectives=("f1", "f2", "f3"),
        kernel=(on_sphere, ()),
    )
