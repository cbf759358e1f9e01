"""Forces of dampers, stops and springs of a strut over rate or deflection, at the element."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..quantities import Real
from .parts import Part

RATES = (0.05, 0.1, 0.2, 0.3, 0.5, 1.0)
"""Rates of a table of a damper, in both directions [m/s]."""
DEFLECTIONS = (0.02, 0.04, 0.06, 0.08, 0.1)
"""Deflections of a table of a spring or a stop, in both directions [m]."""


class Curve(NamedTuple):
    """Force of a part [N] over its rate [m/s] or deflection [m], positive in tension and extension."""

    part: str
    of_rate: bool
    x: Real  # (n,)
    force: Real  # (n,)


def curves_of(parts: Sequence[Part]) -> list[Curve]:
    """Return the curves of all dampers, and of springs and stops that are no straight line."""
    found = []
    for part in parts:
        if part.law is not None or part.kind == "damper":
            of_rate = part.law is None or part.law.of_rate
            x = np.array(RATES if of_rate else DEFLECTIONS)
            found.append(Curve(part.name, of_rate, np.append(-x[::-1], x), force_of(part, np.append(-x[::-1], x))))
    return found


def force_of(part: Part, x: Real) -> Real:
    """Return the force (n,) of a damper at rates, or of a force law at deflections (n,)."""
    if part.law is None:
        return part.values[0].value * x
    own = {one.name.removeprefix(f"{part.name}."): one.value for one in part.values}
    return part.law.tension(x, **own)
