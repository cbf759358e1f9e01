"""Reference fronts in files: a table of objectives, or the folder of an earlier comparison."""

from pathlib import Path

import numpy as np

from ..documents import naming
from ..search.indicators import ReferenceFront, best_of
from ..search.problem import Minimisable
from ..tables import read_columns
from . import plans, store
from .reference import FOLDER, NAME, Reference, spans

MOST = 100_000
"""Most rows of a table."""


def load_reference(path: Path, problem: Minimisable) -> Reference:
    """Return the reference front in a CSV file of objectives with units, or that of the comparison in a folder.

    ValueError if the objectives do not fit or the comparison is of another problem.
    """
    return _of_comparison(path, problem) if path.is_dir() else _of_table(path, problem)


def _of_table(path: Path, problem: Minimisable) -> Reference:
    columns = read_columns(path, {name: problem.units.get(name, "") for name in problem.objectives}, MOST)
    best = np.unique(best_of(np.column_stack(list(columns.values()))), axis=0)
    if not spans(best):
        with naming(path):
            got = f"{len(best)} non-dominated ones that do not"
            raise ValueError(f"rows must differ in every objective, got {got}")
    return Reference(ReferenceFront.of(best), repr(str(path)))


def _of_comparison(folder: Path, problem: Minimisable) -> Reference:
    kept = folder / FOLDER
    if not (kept / plans.FILE).exists():
        needed = "a CSV file, or the folder of a comparison with a reference front"
        raise ValueError(f"reference must be {needed}, got {str(folder)!r}")
    plans.agree(kept / plans.FILE, {"problem": problem}, "to take its reference front")
    return Reference.of(store.read_run(kept, NAME))
