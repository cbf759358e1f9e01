"""Fronts that are known of the problems, by ideal point, nadir and hypervolume, in ``fronts.json``.

Those of RE are what the suite publishes, those of CRE the best found here: non-dominated designs of long searches.
"""

import json
from pathlib import Path

import numpy as np

from suspension_ctrl import Nsga2
from suspension_ctrl import tables as files
from suspension_ctrl.search.indicators import ReferenceFront, best_of
from suspension_ctrl.search.trace import Trace, trace

from . import NAMES, problem
from .formulas import Real

FILE = Path(__file__).with_name("fronts.json")
PUBLISHED = "approximated_Pareto_fronts/reference_points_{}.dat"
"""In github.com/ryojitanabe/reproblems."""

LONG = Nsga2(population=1000)
EVALUATIONS, SEEDS = 1_000_000, range(5)
"""Of the searches for the fronts of CRE."""


def reference(name: str) -> ReferenceFront:
    """Return the front of a problem for relative hypervolumes; its points are not kept."""
    known = json.loads(FILE.read_text(encoding="utf-8"))[name]
    ideal, nadir = np.array(known["ideal"]), np.array(known["nadir"])
    return ReferenceFront(np.empty((0, ideal.size)), ideal, nadir, known["hypervolume"])


def archive(seen: Trace) -> Real:
    """Return the different non-dominated objectives (k, m) of the feasible designs of a search."""
    return np.unique(best_of(seen.objectives[seen.feasible]), axis=0)


def found(name: str) -> ReferenceFront:
    """Return the front of all long searches of a problem."""
    archives = [archive(trace(problem(name), LONG, [EVALUATIONS], seed)) for seed in SEEDS]
    return ReferenceFront.of(np.unique(best_of(np.concatenate(archives)), axis=0))


def published(name: str, suite: Path) -> ReferenceFront:
    """Return the front in a checkout of the suite."""
    return ReferenceFront.of(np.unique(best_of(np.loadtxt(suite / PUBLISHED.format(name))), axis=0))


def record(suite: Path) -> None:
    """Write the fronts of all problems."""
    known = {name: found(name) if name.startswith("C") else published(name, suite) for name in NAMES}
    content = {
        name: {"hypervolume": front.volume, "ideal": front.ideal.tolist(), "nadir": front.nadir.tolist()}
        for name, front in known.items()
    }
    files.write_json(FILE, content)
