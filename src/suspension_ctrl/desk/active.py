"""Bounds and limits that a design reaches, in words."""

from collections.abc import Sequence

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.measures.limits import Limit
from ..search.problem import Minimisable

NEAR = 0.01
"""Largest distance of an active bound, as a share of its range, and of an active limit, as a share of it."""


def reached(problem: Minimisable, designs: Real, constraints: Real) -> list[list[str]]:
    """Return by design (n, d) with constraints (n, c) its active bounds and limits, and limits that it exceeds."""
    texts: list[list[str]] = [[] for _ in designs]
    for name, values, low, high in zip(problem.variables, designs.T, problem.lower, problem.upper, strict=True):
        kind = problem.kinds.get(name, "")
        first, last = checks.kind_ends(kind if isinstance(kind, str) else tuple(kind), low, high)
        if first == last:
            continue
        share = _share(values, first, last, logarithmic=kind == "log")
        for text, place in zip(texts, share.tolist(), strict=True):
            if abs(place - 0.5) >= 0.5 - NEAR:
                where = "at" if abs(place - 0.5) <= 0.5 + NEAR else "beyond"
                text.append(f"{name} {where} its {'lower' if place < 0.5 else 'upper'} bound")
    for limit, values in zip(map(limit_text, problem.constraints), constraints.T, strict=True):
        for text, g in zip(texts, values.tolist(), strict=True):
            if g >= -NEAR:
                text.append(f"{'beyond' if g > 0 else 'at'} the limit {limit}")
    return texts


def limit_text(limit: object) -> str:
    """Return a limit as an engineer reads it, ``SWS <= 12 mm``; of another constraint its name."""
    return limit.describe() if isinstance(limit, Limit) else str(limit)


def designs_by_text(texts: Sequence[Sequence[str]], first: int = 1) -> dict[str, list[int]]:
    """Return the numbers of designs by text, counted from `first`."""
    found: dict[str, list[int]] = {}
    for number, listed in enumerate(texts, start=first):
        for text in listed:
            found.setdefault(text, []).append(number)
    return found


def _share(values: Real, first: float, last: float, *, logarithmic: bool) -> Real:
    """Return the place (n,) of values between bounds, from 0 to 1."""
    if logarithmic:
        return np.asarray(np.log(values / first) / np.log(last / first))
    return np.asarray((values - first) / (last - first))
