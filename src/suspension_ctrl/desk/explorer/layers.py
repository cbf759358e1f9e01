"""Fronts to compare with on a page: exact points, and what controllers attain."""

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...quantities import column_headers
from ...response.problem import RideProblem
from ..continuation import continued
from ..known_front import can_be_continued

if TYPE_CHECKING:
    import pandas as pd

POINTS, VARIABLES = 30, 6
"""Points of an exact front, and most variables with which it takes about a second in one load case."""


class Layer(NamedTuple):
    """A front to compare with, a table with a column for each objective."""

    name: str
    table: "pd.DataFrame"
    kind: str = "front"  # or "run" of an algorithm, "reference", "attainable": how it is marked
    shown: bool = True  # at first


def exact_layers(problem: RideProblem) -> list[Layer]:
    """Return the exact front of a problem in a layer, where it is cheap."""
    import pandas as pd

    cheap = len(problem.variables) <= VARIABLES and len(problem.cases) == 1
    if not (cheap and len(problem.measures) > 1 and can_be_continued(problem)):
        return []
    with suppress(ValueError):  # of limits within which no design is found
        objectives = np.array([point.objectives for point in continued(problem, POINTS)])
        table = pd.DataFrame(objectives, columns=column_headers(problem.objectives, problem.units))
        return [Layer("reference: exact front", table, "reference")]
    return []


def attainable_layers(fronts: "Mapping[str, pd.DataFrame]", passive: "pd.DataFrame") -> list[Layer]:
    """Return the fronts of controllers by name, as far as no measure is above the largest of a passive front."""
    layers = []
    for name, table in fronts.items():
        headers = [header for header in table if header in passive]
        within = table[(table[headers] <= passive[headers].max()).all(axis=1)]
        layers += [Layer(name, within, "attainable")] * bool(len(within))
    return layers
