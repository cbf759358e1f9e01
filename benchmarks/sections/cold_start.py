"""Section 6: processor time of a user's first run, with numba's store empty and filled."""

import os
import subprocess
import sys
from collections.abc import Sequence
from tempfile import TemporaryDirectory

import pandas as pd

IMPORT = "from suspension_ctrl import MoeadDra, Nsga2, RideProblem, minimise"
_PROBLEM = f"{IMPORT}; from suspension_ctrl.paper import experiment; problem = experiment.ride_problem()"
PROGRAMS = {
    "import": "import suspension_ctrl",
    "names": IMPORT,
    "evaluate": f"{_PROBLEM}; problem.evaluate([[2e4, 1500.0]])",
    "Nsga2": f"{_PROBLEM}; minimise(problem, Nsga2(population=500), iterations=10, seed=1)",
    "MoeadDra": f"{_PROBLEM}; minimise(problem, MoeadDra(population=500), iterations=10, seed=1)",
}
"""What is run after `import control` in a process of its own; the searches are the paper's, of 5,500 and 1,500
evaluations."""

EMPTY, FILLED = "empty", "filled"


def measure(repeats: int, programs: Sequence[str] = tuple(PROGRAMS)) -> pd.DataFrame:
    """Return one row per program, repeat and state of the store: contender, repeat, store, seconds, multiple.

    `seconds` is the processor time beyond `import control`, `multiple` the same over that import's.
    """
    rows = []
    for repeat in range(1, repeats + 1):
        for name in programs:
            with TemporaryDirectory() as folder:
                for store in (EMPTY, FILLED):
                    control, beyond = processor_seconds(PROGRAMS[name], folder)
                    rows.append((name, repeat, store, beyond, beyond / control))
    return pd.DataFrame(rows, columns=["contender", "repeat", "store", "seconds", "multiple"])


def processor_seconds(program: str, folder: str) -> tuple[float, float]:
    """Return the processor time [s] of `import control` and of a program after it, numba's store in `folder`."""
    timed = (
        f"from time import process_time as t; a = t(); import control; b = t(); {program}; print(b - a, t() - b)"
    )
    environment = os.environ | {"NUMBA_CACHE_DIR": folder, "PYTHONDONTWRITEBYTECODE": ""}  # as once installed
    done = subprocess.run(
        [sys.executable, "-c", timed], check=True, capture_output=True, text=True, env=environment
    )
    control, beyond = map(float, done.stdout.split())
    return control, beyond


def medians(timings: pd.DataFrame) -> pd.DataFrame:
    """Return the median multiples by program, columns empty and filled."""
    table = timings.pivot_table(index="contender", columns="store", values="multiple", aggfunc="median")
    return table.loc[[name for name in PROGRAMS if name in table.index], [EMPTY, FILLED]]


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float]]:
    """Return what is to hold: what, largest multiple, and the one measured."""
    table = medians(timings)
    first = {"evaluate": 1.2, "Nsga2": 3.0, "MoeadDra": 3.0}
    goals = [
        ("import", 0.1, float(table[FILLED]["import"])),
        *((f"first {name}", bar, float(table[EMPTY][name])) for name, bar in first.items() if name in table.index),
    ]
    if "MoeadDra" in table.index:
        second, evaluation = (float(table[FILLED][name]) for name in ("MoeadDra", "evaluate"))
        goals += [("second MoeadDra", 0.6, second), ("second MoeadDra beyond evaluate", 0.15, second - evaluation)]
    return goals
