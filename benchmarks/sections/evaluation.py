"""Section 1: objectives of many designs, by three roads over the same nodes, with the error of each."""

import subprocess
import sys
from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import integrate, signal

from sections.timing import take_turns
from suspension_ctrl import RideProblem
from suspension_ctrl.response import weightings
from suspension_ctrl.response.quadrature import frequency_nodes

Method = Callable[[NDArray[np.float64]], NDArray[np.float64]]

OURS, LOOP = "RideProblem.evaluate", "python-control loop"
LEAST = 0.02
"""Seconds up to which a method is called again and again within one timing."""


def methods(problem: RideProblem) -> dict[str, Method]:
    """Return what evaluates designs (n, 2), by name: a python-control loop, a scipy loop, and ours."""
    f, w = frequency_nodes(problem.band, problem.nodes, ())
    density = w * problem.road.psd(f, problem.speed)
    weighted = density * _factor(problem, f) ** 2
    densities = np.array([weighted if r == "body_acceleration" else density for r in problem.vehicle.responses])

    def loop(magnitudes: Callable[[Any], NDArray[np.float64]]) -> Method:
        def evaluate(designs: NDArray[np.float64]) -> NDArray[np.float64]:
            cars = (problem.vehicle.closed((spring, damper)) for spring, damper in designs)
            return np.sqrt([(densities * magnitudes(car) ** 2).sum(axis=1) for car in cars])

        return evaluate

    def by_control(car: Any) -> NDArray[np.float64]:
        return np.abs(car.frequency_response(2 * np.pi * f).frdata[:, 0])

    def by_scipy(car: Any) -> NDArray[np.float64]:
        rows = zip(car.C, car.D, strict=True)
        return np.abs([signal.freqresp((car.A, car.B, c[None], d[None]), 2 * np.pi * f)[1] for c, d in rows])

    return {
        LOOP: loop(by_control),
        "scipy.signal.freqresp loop": loop(by_scipy),
        OURS: problem.evaluate,
    }


def _factor(problem: RideProblem, f: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.ones_like(f) if problem.weighting is None else weightings.by_name(problem.weighting).factor(f)


def errors(problem: RideProblem, sample: int, seed: int) -> dict[str, float]:
    """Return each method's largest relative error against adaptive quadrature.

    The designs are the corners of the box and `sample` drawn from it.
    """
    corners = np.array(list(product(*zip(problem.lower, problem.upper, strict=True))), dtype=float)
    drawn = np.random.default_rng(seed).uniform(problem.lower, problem.upper, (sample, 2))
    designs = np.concatenate([corners, drawn])
    exact = np.array([adaptive(problem, *design) for design in designs])
    return {name: float(np.abs(method(designs) / exact - 1).max()) for name, method in methods(problem).items()}


def adaptive(problem: RideProblem, spring: float, damper: float) -> list[float]:
    """Return the objectives of a design by scipy's adaptive quadrature of python-control's response."""
    car = problem.vehicle.closed((spring, damper))
    resonances = sorted({abs(pole) / (2 * np.pi) for pole in car.poles()})
    low, high = problem.band

    def density(f: float, response: int) -> float:
        h = abs(car(2j * np.pi * f)[response, 0])
        weight = _factor(problem, np.array([f]))[0] if response == 0 else 1.0
        return float((weight * h) ** 2 * problem.road.psd(np.array([f]), problem.speed)[0])

    breaks = [f for f in resonances if low < f < high]
    integrals = [
        # In u = sqrt(f), where the density has no fractional power and no singular slope at zero.
        integrate.quad(
            lambda u, r: 2 * u * density(u * u, r), np.sqrt(low), np.sqrt(high),
            args=(response,), points=np.sqrt(breaks), limit=500, epsabs=0, epsrel=1e-11,
        )[0]
        for response in range(len(problem.vehicle.responses))
    ]  # fmt: skip
    return list(np.sqrt(integrals))


def measure(problem: RideProblem, counts: Sequence[int], repeats: int, limit: float) -> pd.DataFrame:
    """Return one row per timed call: contender, designs, repeat, seconds, cpu_seconds.

    A method is left out of a number of designs for which, by its time at the number before, it would take
    longer than `limit` seconds.
    """
    rows: list[dict[str, Any]] = []
    expected = dict.fromkeys(methods(problem), 0.0)
    for count in counts:
        designs = np.random.default_rng(count).uniform(problem.lower, problem.upper, (count, 2))
        ways = {
            name: lambda _, method=method, designs=designs: lambda: method(designs)
            for name, method in methods(problem).items()
            if expected[name] * count <= limit
        }
        found = take_turns(ways, repeats, limit, least=LEAST)
        rows += [{**row, "designs": count} for row in found]
        expected |= {row["contender"]: row["seconds"] / count for row in found}
    return pd.DataFrame(rows)


MEMORY = """
from pathlib import Path
import numpy as np
from suspension_ctrl.paper import experiment as paper
problem = paper.ride_problem(nodes={nodes})
designs = np.random.default_rng(0).uniform(problem.lower, problem.upper, ({designs}, 2))
problem.evaluate(designs)
status = Path("/proc/self/status")
print(int(status.read_text().split("VmHWM:")[1].split()[0]) / 1e3 if status.exists() else "nan")
"""


def memory(designs: int, nodes: int) -> float:
    """Return the peak memory [MB] of a process that evaluates so many designs, all that it imports included.

    Read from Linux's record of the process, NaN elsewhere: a child's resource usage begins with its parent's.
    """
    program = MEMORY.format(designs=designs, nodes=nodes)
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    return float(done.stdout)
