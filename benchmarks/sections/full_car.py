"""An engineer's study, a full car in three load cases within two limits, by NSGA-II of every library.

All have the same evaluator, and for scale there is the usual one: a python-control model of each design.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from peers import OURS, Prepare, Task
from sections.timing import timed
from suspension_ctrl import LoadCase, Nsga2, Problem, RideProblem, load_study, minimise
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.response.weightings import by_name
from suspension_ctrl.search.indicators import ReferenceFront, best_of

STUDY = "full_car"
LOOP = "python-control per design, in pymoo"
PYMOO = "pymoo"
CONTENDERS = (OURS, "genoxide", "vamos moocore", "vamos numba", "pygmo", PYMOO)

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
COMFORT = (
    ("driver_acceleration", "Wk", 1.0),
    ("roll_acceleration", "We", 0.63),
    ("pitch_acceleration", "We", 0.4),
)
"""Response, weighting and multiplying factor of the study's objective discomfort."""


def problem() -> RideProblem:
    """Return the problem of the study."""
    return load_study(STUDY).problem


def reference(ride: RideProblem, population: int, generations: int) -> ReferenceFront:
    """Return what a long run of ours finds: it sets the level that all others are timed to reach."""
    run = minimise(ride, Nsga2(population=population), iterations=generations, seed=0)
    return ReferenceFront.of(best_of(run.objectives[(run.constraints <= 0).all(axis=1)]))


@dataclass
class Watched:
    """A problem that keeps when each call of its evaluator ended, and the feasible objectives it returned."""

    ride: RideProblem
    calls: list[tuple[float, NDArray[np.float64]]] = field(default_factory=list)

    def evaluate(self, designs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return objectives and limits (n, m + c) of designs (n, d)."""
        values, m = self.ride.evaluate(designs), len(self.ride.objectives)
        self.calls.append((perf_counter(), values[(values[:, m:] <= 0).all(axis=1), :m]))
        return values

    def as_problem(self) -> Problem:
        """Return the problem without a compiled kernel: every design goes through `evaluate`."""
        return Problem(
            evaluate=self.evaluate,
            lower=self.ride.lower,
            upper=self.ride.upper,
            objectives=self.ride.objectives,
            constraints=list(map(str, self.ride.constraints)),
        )

    def reached(self, front: ReferenceFront, target: float) -> tuple[float, int]:
        """Return when the designs evaluated so far had the hypervolume, and how many calls that took.

        NaN and 0 if they never had.
        """
        best = np.empty((0, len(self.ride.objectives)))
        for number, (at, objectives) in enumerate(self.calls, start=1):
            best = best_of(np.concatenate([best, objectives]))
            if len(best) and front.hypervolume(best) >= target:
                return at, number
        return np.nan, 0


def measure(
    searches: Mapping[str, Prepare],
    ride: RideProblem,
    front: ReferenceFront,
    share: float,
    population: int,
    generations: int,
    repeats: int,
) -> pd.DataFrame:
    """Return a row per run: contender, repeat, population, seconds and generations to the target, whole_seconds.

    Contenders take turns; a first short run of each warms it up.
    """
    rows: list[dict[str, Any]] = []
    for prepare in searches.values():
        prepare(Task(Watched(ride).as_problem(), population, 1, 0)).run()
    for repeat in range(1, repeats + 1):
        order = list(searches.items())
        for name, prepare in order if repeat % 2 else order[::-1]:
            watched = Watched(ride)
            job = prepare(Task(watched.as_problem(), population, generations, repeat))
            watched.calls.clear()
            start = perf_counter()
            timing = timed(job.run)
            at, number = watched.reached(front, share * front.volume)
            rows.append(
                {
                    "contender": name,
                    "repeat": repeat,
                    "seconds": at - start,
                    "generations": number - 1 if number else np.nan,
                    "whole_seconds": timing.seconds,
                    "population": population,
                }
            )
    return pd.DataFrame(rows)


def usual_way(ride: RideProblem, design: Sequence[float]) -> NDArray[np.float64]:
    """Return the objectives (m,) of a design (d,) by python-control: a closed loop for each load case.

    Comfort is the root of the sum of weighted squares, travel and dynamic over static tyre load those of the worst
    wheel, each the root mean square over the cases; static loads are those in the middle of the box, as of `DLC`.
    The limits take no further frequency response.
    """
    f, w = frequency_nodes(ride.band, ride.nodes)
    setting = dict(zip(ride.variables, design, strict=True))
    mean_squares = [case.share * _of_case(case, setting, ride.scoring.middle, f, w) for case in ride.cases]
    return np.sqrt(np.sum(mean_squares, axis=0) / sum(case.share for case in ride.cases))


def _of_case(
    case: LoadCase,
    setting: dict[str, float],
    middle: dict[str, float],
    f: NDArray[np.float64],
    w: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the mean squares (m,) of the objectives in a load case at nodes f (n,) with weights w (n,)."""
    car = case.vehicle.closed(setting)
    h = np.moveaxis(car.frequency_response(2 * np.pi * f).frdata, 2, 0)
    roads = case.cross_spectrum(f)
    height, rate = np.split(h, 2, axis=2)  # of each road, which reach the car through springs and dampers of tyres
    h = height + 2j * np.pi * f[:, None, None] * rate
    spectra = np.einsum("nmi,nij,nmj->mn", h, roads, h.conj()).real
    density = dict(zip(car.output_labels, spectra, strict=True))
    static = case.vehicle.static(middle)["value"]
    discomfort = sum((k * by_name(name).factor(f)) ** 2 * density[response] for response, name, k in COMFORT)
    travel = [density[f"{wheel}_suspension_travel"] @ w for wheel in WHEELS]
    load = [density[f"{wheel}_tyre_load"] @ w / static[f"{wheel}_wheel_load"] ** 2 for wheel in WHEELS]
    return np.array([discomfort @ w, max(travel), max(load)])


def seconds_of_usual_way(ride: RideProblem, designs: int) -> float:
    """Return the seconds that the usual evaluator takes for a design, the mean of so many."""
    sample = np.random.default_rng(0).uniform(ride.lower, ride.upper, (designs + 1, len(ride.lower)))
    usual_way(ride, sample[0])
    return timed(lambda: [usual_way(ride, design) for design in sample[1:]]).seconds / designs


def against_fastest(timings: pd.DataFrame) -> tuple[str, float]:
    """Return the other library that is soonest at the target, and our seconds over its."""
    seconds = quartiles(timings)["median"]
    others = seconds.drop(OURS).dropna()
    return (str(others.idxmin()), float(seconds[OURS] / others.min())) if len(others) else ("-", np.nan)


def usual_seconds(timings: pd.DataFrame, per_design: float) -> float:
    """Return what pymoo's run to the target would take with the usual evaluator: an estimate [s]."""
    run = timings[timings.contender == PYMOO]
    designs = run.population * (run.generations + 1)
    return float((run.seconds + designs * per_design).median(skipna=False))


def quartiles(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by contender: lower quartile, median and upper quartile of seconds to the target, soonest first.

    They are NaN unless each repeat got there. Beside them are the medians of generations and of the whole run.
    """
    by = timings.groupby("contender")
    seconds, every = by.seconds, by.seconds.count() == by.size()
    found = {name: seconds.quantile(q) for name, q in (("lower", 0.25), ("median", 0.5), ("upper", 0.75))}
    table = pd.DataFrame({**found, "generations": by.generations.median()}).where(every)
    return table.assign(repeats=by.size(), whole=by.whole_seconds.median()).sort_values("median")
