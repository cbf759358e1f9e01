"""Derivatives of mean squares in load cases that share a plant, for the sources of all of them."""

from collections.abc import Sequence

import numpy as np
from scipy.linalg import block_diag

from ...quantities import Bool, Real
from ..many_struts import ManyStruts
from ..mapped import Mapped, slopes_of, unmapped
from ..shared_plants import Shared
from . import struts_in_lanes, two_struts
from .wanted import Wanted


def of_struts(groups: Sequence[Shared]) -> bool:
    """Whether cases, all of one class, are of springs, dampers and inerters alone."""
    case = groups[0].case
    return isinstance(case.case if isinstance(case, Mapped) else case, ManyStruts)


def joined(wanted: Sequence[tuple[Wanted, int]]) -> Wanted:
    """Return what is wanted of load cases side by side, of which each has so many mean squares."""
    factor = block_diag(*(each.factor[:, :terms] for each, terms in wanted))
    return Wanted(factor, np.concatenate([each.largest for each, _ in wanted]))


def slopes_by_case(
    groups: Sequence[Shared],
    wanted: Sequence[Wanted],
    designs: Real,
    squares: Sequence[Real],
    counted: Sequence[Bool],
) -> list[Real]:
    """Return the derivatives (p, s, v) of what is wanted by group, of designs (p, v), in each load case.

    Those of combinations that are not counted (p, s) in a case, with mean squares (p, k) there, are 0.
    """
    found: dict[int, Real] = {}
    for (case, numbers), each in zip(groups, wanted, strict=True):
        inner, coefficients = unmapped(case, designs)
        coefficients = np.require(coefficients, requirements=("C", "W"))  # read-only arrays are another type
        method = two_struts if two_struts.fits(inner) else struts_in_lanes
        own, which = (np.concatenate([of[c] for c in numbers], axis=1) for of in (squares, counted))
        slopes = method.differentiated(inner, each, coefficients, own, which)
        if isinstance(case, Mapped):
            slopes = slopes @ slopes_of(case.formulas, np.require(designs, requirements=("C", "W")))
        ends = np.cumsum([counted[c].shape[1] for c in numbers])
        found |= zip(numbers, np.split(slopes, ends[:-1], axis=1), strict=True)
    return [found[number] for number in range(len(found))]
