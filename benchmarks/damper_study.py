"""Curves of dampers beside straight dampers, in data/studies/damper_curve.toml: searched, then driven in time.

NSGA-II evaluates 10,000 designs with curves and as many with straight dampers, by each of five seeds; the best
design has the least ACC within the limits. In time the travel with curves is larger than linearised: straight
dampers, free and on the springs and anti-roll bars of the curves, are searched with as much travel in time.
"""

import argparse
import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.certificates import Certificate

STUDY = Path(__file__).parents[1] / "data" / "studies" / "damper_curve.toml"
DAMPERS = (1e3, 9e3)  # N s/m, bounds of straight dampers: those of the slope up to the knee
LARGER = 1.01  # travel of straight dampers in time by the linearised one: there are waves beyond the band
LENGTH, SEEDS = 3e3, range(8)  # m, of the roads on which designs are driven


class Found(NamedTuple):
    """The best design of searches with its problem, and the processor time of the search that found it [s]."""

    title: str
    problem: sc.RideProblem
    design: dict[str, float]
    objectives: dict[str, float]
    seconds: float


def straight(problem: sc.RideProblem, springs: Mapping[str, float] | None = None) -> sc.RideProblem:
    """Return the problem with straight dampers, on given springs and anti-roll bars if there are any."""
    axle = sc.parallel(sc.Spring(), sc.Damper())
    car = problem.vehicle
    if not isinstance(car, sc.FullCar):
        raise TypeError(f"vehicle must be a FullCar, got a {type(car).__name__}")
    bounds = {name: one for name, one in problem.bounds.items() if ".damper." not in name and springs is None}
    bounds |= {"front.damper": DAMPERS, "rear.damper": DAMPERS}
    return problem.replace(
        vehicle=replace(car, front_strut=axle, rear_strut=axle), bounds=bounds, struts=dict(springs or {})
    )


def with_travel(problem: sc.RideProblem, travel: float) -> sc.RideProblem:
    """Return the problem with this limit on the travel [m]."""
    limits = [f"SWS <= {travel:.4g}" if one.measure.label == "SWS" else one for one in problem.constraints]
    return problem.replace(constraints=limits)


def best(title: str, problem: sc.RideProblem, population: int, seeds: Sequence[int]) -> Found:
    """Print the least ACC of each of several searches, and return the best design."""
    found = [searched(title, problem, population, seed) for seed in seeds]
    print(f"{title}: ACC of each search", *(f"{one.objectives['ACC']:.4g}" for one in found), flush=True)
    return min(found, key=lambda one: one.objectives["ACC"])


def searched(title: str, problem: sc.RideProblem, population: int, seed: int) -> Found:
    """Return the design with the least ACC that 49 iterations find within the limits."""
    optimiser = sc.Nsga2(population=population)
    with warnings.catch_warnings(action="ignore"):  # a search of eight designs, which compiles
        sc.minimise(problem, sc.Nsga2(population=4), iterations=1, seed=0)
    started = time.process_time()
    run = sc.minimise(problem, optimiser, iterations=49, seed=seed)
    seconds = time.process_time() - started
    i = int(np.where(run.feasible, run.objectives[:, 0], np.inf).argmin())
    design = dict(zip(problem.variables, run.designs[i].tolist(), strict=True))
    objectives = dict(zip(problem.objectives, run.objectives[i].tolist(), strict=True))
    return Found(title, problem, design, objectives, seconds)


def certified(found: Found, length: float) -> Certificate:
    """Print a design and its certificate, and return that."""
    values = ", ".join(f"{name} {value:.4g}" for name, value in [*found.objectives.items(), *found.design.items()])
    certificate = sc.certify(found.problem, list(found.design.values()), length=length, seeds=SEEDS)
    print(f"{found.title}: {values}; {found.seconds:.1f} s\n\n{certificate}\n", flush=True)
    return certificate


def beside(curves: Found, travel: float, population: int, seeds: Sequence[int]) -> list[Found]:
    """Return the best straight dampers with a travel in time [m], free and on the springs of the curves."""
    springs = {name: value for name, value in curves.design.items() if ".damper." not in name}
    held = {"straight dampers": None, "straight dampers on the same springs": springs}
    return [
        best(title, with_travel(straight(curves.problem, given), travel / LARGER), population, seeds)
        for title, given in held.items()
    ]


def main() -> None:
    """Search and drive the designs; print their certificates and the times of the searches."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--population", type=int, default=200)
    parser.add_argument("--seeds", type=int, default=5, help="Searches for each best design.")
    parser.add_argument("--length", type=float, default=LENGTH, help="m, of each road")
    options = parser.parse_args()
    seeds = range(1, options.seeds + 1)
    curves = best("curves", sc.load_problem(STUDY), options.population, seeds)
    driven = certified(curves, options.length).to_frame()
    travel = float(driven.xs("SWS", level="measure")["simulated"].max())
    others = beside(curves, travel, options.population, seeds)
    for one in others:
        certified(one, options.length)
    print(f"time of curves by that of straight dampers: {curves.seconds / others[0].seconds:.1f}")


if __name__ == "__main__":
    main()
