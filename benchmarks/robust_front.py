"""A front of robust designs beside that of nominal ones, judged on vehicles that neither search has seen.

The car is jian_2022_full with eight variables, the springs, dampers, anti-roll bars and tyres of both axles, on a
road of class C at 20 m/s. All of them scatter: springs ±5 %, bars ±5 %, tyres ±10 %, dampers -25 to +10 %.
NSGA-II searches for comfort and tyre load within a limit on travel, once of the nominal vehicle, once of 256
vehicles per design. Both fronts are then judged on 10,000 other vehicles: by the mean of ACC, the 95 % quantile of
DTL, and whether 95 % of the vehicles keep to the limit.
"""

import argparse
import time
import warnings
from typing import NamedTuple

import moocore
import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.quantities import Bool, Real
from suspension_ctrl.search.indicators import non_dominated

TOLERANCES: dict[str, float | str | tuple[float | str, float | str]] = {
    "spring": 0.05,
    "antiroll": 0.05,
    "tyre_stiffness": 0.1,
    "damper": (-0.25, 0.1),
}
TYRES = {"front_tyre_stiffness": (160e3, 240e3), "rear_tyre_stiffness": (160e3, 240e3)}
TRAVEL = "10mm"  # most travel
JUDGES = 10_000  # vehicles that judge the fronts
SEED, OTHER = 1, 2  # of the sample in the search, and of the one that judges


class Judged(NamedTuple):
    """A front with its designs on the judging vehicles, and the time of its search."""

    designs: Real  # (n, 8)
    values: Real  # (n, 2), mean ACC and 95 % quantile of DTL
    met: Bool  # (n,), whether 95 % of the vehicles keep to the limit
    processor: float  # s
    wall: float  # s


def problem(samples: int, seed: int = SEED) -> sc.RideProblem:
    """Return the robust problem."""
    file = sc.load_vehicle("jian_2022_full")
    return sc.RideProblem(
        file.vehicle,
        sc.Iso8608Road("C"),
        speed=20.0,
        band=(0.3, 20.0),
        bounds={**file.bounds, **TYRES},
        measures=["mean ACC", "q95 DTL"],
        constraints=[f"q95 SWS <= {TRAVEL}"],
        scatter=sc.Scatter(TOLERANCES, samples=samples, seed=seed),
    )


def judged(searched: sc.RideProblem, judge: sc.RideProblem, population: int, iterations: int) -> Judged:
    """Search for a front, and judge it."""
    with warnings.catch_warnings(action="ignore"):  # a search of few designs, which compiles
        sc.minimise(searched, sc.Nsga2(population=4), iterations=1, seed=0)
    processor, wall = time.process_time(), time.perf_counter()
    run = sc.minimise(searched, sc.Nsga2(population=population), iterations=iterations, seed=1)
    processor, wall = time.process_time() - processor, time.perf_counter() - wall
    designs = run.designs[run.on_front()]
    values = judge.evaluate(designs)
    return Judged(designs, values[:, :2], values[:, 2] <= 0, processor, wall)


def hypervolumes(fronts: list[Judged]) -> list[float]:
    """Return the hypervolume of the designs that meet the limit, of each front over that of all."""
    met = [front.values[front.met] for front in fronts]
    every = np.concatenate(met)
    worst = every.max(axis=0) + 0.01 * np.ptp(every, axis=0)
    volumes = [float(moocore.hypervolume(one, ref=worst)) if len(one) else 0.0 for one in [*met, every]]
    return [one / volumes[-1] for one in volumes[:-1]]


def beaten(front: Judged, by: Judged) -> float:
    """Return the share of a front [%] that misses the limit or is dominated by designs of another that meet it."""
    others = by.values[by.met]
    lost = [
        not met or not non_dominated(np.vstack([one, others]))[0]
        for one, met in zip(front.values, front.met, strict=True)
    ]
    return 100 * float(np.mean(lost))


def main() -> None:
    """Search and judge both fronts, and print what they are worth."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--population", type=int, default=100)
    parser.add_argument("--iterations", type=int, default=50)
    parser.add_argument("--samples", type=int, default=256, help="vehicles per design")
    parser.add_argument("--judges", type=int, default=JUDGES, help="vehicles that judge the fronts")
    options = parser.parse_args()
    robust, judge = problem(options.samples), problem(options.judges, OTHER)
    searches = {"nominal": robust.nominal, f"robust, {options.samples} vehicles per design": robust}
    fronts = [judged(one, judge, options.population, options.iterations) for one in searches.values()]
    for title, front, volume in zip(searches, fronts, hypervolumes(fronts), strict=True):
        print(f"{title}: {front.processor:.1f} s of processor time, {front.wall:.1f} s")
        print(
            f"  {len(front.designs)} designs, {front.met.sum()} of them within the limit for 95 % of the vehicles"
        )
        print(f"  hypervolume of these by that of both fronts {volume:.4f}")
    nominal, other = fronts
    shares = beaten(nominal, other), beaten(other, nominal)
    print(
        "beaten by the other front: {:.0f} % of the nominal designs, {:.0f} % of the robust ones".format(*shares)
    )


if __name__ == "__main__":
    main()
