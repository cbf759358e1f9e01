"""Curves of dampers beside straight dampers, in data/studies/damper_curve.toml: searched, then driven in time.

NSGA-II evaluates 10,000 designs with curves and as many with straight dampers. Straight dampers are also searched
on the springs and anti-roll bars of the best design with curves. The best design has the least ACC within limits.
Searches keep a margin to the limit on travel, by which the travel in time is larger than the linearised one.
"""

import argparse
import time
import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

import suspension_ctrl as sc

STUDY = Path(__file__).parents[1] / "data" / "studies" / "damper_curve.toml"
DAMPERS = (1e3, 9e3)  # N s/m, bounds of straight dampers: those of the slope up to the knee
TRAVEL = {"curves": 0.0111, "straight": 0.0114}  # m, in place of the 0.0115 of the study
LENGTH, SEEDS = 10e3, range(8)  # m, of the roads on which designs are driven


class Found(NamedTuple):
    """The best design of a search with its problem, and the processor time of the search [s]."""

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


def best(title: str, problem: sc.RideProblem, population: int, seed: int = 1) -> Found:
    """Return the design with the least ACC that 49 iterations find within the limits."""
    margin = f"SWS <= {TRAVEL[title.split()[0]]}"
    limits = [margin if limit.measure.label == "SWS" else limit for limit in problem.constraints]
    searched, optimiser = problem.replace(constraints=limits), sc.Nsga2(population=population)
    with warnings.catch_warnings(action="ignore"):  # a search of eight designs, which compiles
        sc.minimise(searched, sc.Nsga2(population=4), iterations=1, seed=0)
    started = time.process_time()
    run = sc.minimise(searched, optimiser, iterations=49, seed=seed)
    seconds = time.process_time() - started
    i = int(np.where(run.feasible, run.objectives[:, 0], np.inf).argmin())
    design = dict(zip(problem.variables, run.designs[i].tolist(), strict=True))
    return Found(
        title, problem, design, dict(zip(problem.objectives, run.objectives[i].tolist(), strict=True)), seconds
    )


def main() -> None:
    """Search, print the designs and their certificates."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--population", type=int, default=200)
    parser.add_argument("--length", type=float, default=LENGTH, help="m, of each road")
    options = parser.parse_args()
    problem = sc.load_problem(STUDY)
    curves = best("curves", problem, options.population)
    springs = {name: value for name, value in curves.design.items() if ".damper." not in name}
    others = {"straight dampers": straight(problem), "straight dampers on its springs": straight(problem, springs)}
    found = [curves, *(best(title, one, options.population) for title, one in others.items())]
    for one in found:
        values = ", ".join(f"{name} {value:.4g}" for name, value in [*one.objectives.items(), *one.design.items()])
        print(f"{one.title}: {values}; {one.seconds:.1f} s")
    print(f"time of curves by that of straight dampers: {found[0].seconds / found[1].seconds:.1f}")
    for one in found:
        certificate = sc.certify(one.problem, list(one.design.values()), length=options.length, seeds=SEEDS)
        print(f"\n{one.title}\n{certificate}", flush=True)


if __name__ == "__main__":
    main()
