"""Load cases that share a plant: vehicles alike on other roads or at other speeds, solved once for all of them."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Bool, Real
from .many_struts import ManyStruts
from .mapped import mean_squares_of


class Shared(NamedTuple):
    """A case, and the numbers of the load cases of which it gives the mean squares in order."""

    case: Any
    numbers: tuple[int, ...]


def shared(cases: Sequence[Any]) -> list[Shared]:
    """Return cases, in place of those with the same plant one for all of them."""
    groups: list[list[int]] = []
    for number, case in enumerate(cases):
        group = next((one for one in groups if _alike(cases[one[0]], case)), None)
        if group is None:
            groups.append([number])
        else:
            group.append(number)
    return [Shared(_joined([cases[i] for i in group]), tuple(group)) for group in groups]


def squares_by_case(groups: Sequence[Shared], designs: Real) -> list[Real]:
    """Return the mean squares (p, k) of designs (p, v) in each load case."""
    found: dict[int, Real] = {}
    for case, numbers in groups:
        squares = mean_squares_of(case, designs)
        parts = [squares] if len(numbers) == 1 else np.split(squares, len(numbers), axis=1)
        found |= zip(numbers, parts, strict=True)
    return [found[number] for number in range(len(found))]


def _alike(one: Any, other: Any) -> bool:
    """Whether two cases have the same plant, and differ in the sources of their blocks alone."""
    if not (isinstance(one, ManyStruts) and isinstance(other, ManyStruts)):
        return False
    names = [name for name in ManyStruts._fields if name != "rows"]
    if not all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names):
        return False
    plant = ~_of_sources(one)
    return bool(plant.any()) and np.array_equal(one.rows[plant], other.rows[plant])


def _of_sources(struts: ManyStruts) -> Bool:
    """Return which rows (l,) are those by sources."""
    parts = [[q * q, q * s, k * s, k * q] for q, s, k in struts.sizes.tolist()]
    kinds = np.tile([False, True, True, False], len(parts))
    return np.repeat(kinds, np.array(parts, dtype=np.int64).ravel())


def _joined(cases: Sequence[Any]) -> Any:
    """Return cases with the same plant as one, with the sources of one after those of another."""
    first = cases[0]
    if len(cases) == 1:
        return first
    rows, start = list[Real](), 0
    for q, s, k in first.sizes.tolist():
        for count, sources in ((q * q, 0), (q, s), (k, s), (k * q, 0)):
            stop = start + count * (sources or 1)
            parts = [case.rows[start:stop].reshape(count, -1, *first.rows.shape[1:]) for case in cases]
            joined = np.concatenate(parts, axis=1) if sources else parts[0]
            rows.append(joined.reshape(-1, *first.rows.shape[1:]))
            start = stop
    sizes = first.sizes * [1, len(cases), 1]
    return first._replace(rows=np.concatenate(rows), sizes=sizes, cases=len(cases))
