"""Mean squares over designs of which the coefficients of the struts are formulas."""

from typing import Any, NamedTuple

import numpy as np

from ..compiled import compiled
from ..compiled_verbs import call
from ..quantities import Real
from ..vehicles.formulas import Formulas, fill, fill_slopes
from .one_strut import OneDesign, OneStrut

_FEW = 512
"""Designs up to which one strut takes one after the other: a tenth slower, and compiled in half the time."""


class Mapped(NamedTuple):
    """Mean squares of a case at the coefficients that formulas give."""

    formulas: Formulas
    case: Any  # OneStrut, OneDesign, ManyStruts, OneFraction, OnePort or AnyStruts

    @compiled(error_model="numpy")
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, v), each as if alone."""
        return call(self.case, (coefficients_of(self.formulas, designs),))


@compiled(nogil=True, error_model="numpy")
def coefficients_of(formulas: Formulas, designs: Real) -> Real:
    """Return the coefficients (p, w) of designs (p, v)."""
    coefficients, slots = np.empty((designs.shape[0], formulas.result.size)), np.empty(formulas.start.size)
    for p in range(designs.shape[0]):
        fill(formulas, designs, p, slots, coefficients)
    return coefficients


@compiled(nogil=True, error_model="numpy")
def slopes_of(formulas: Formulas, designs: Real) -> Real:
    """Return the derivatives (p, w, v) of the coefficients of designs (p, v) by the variables."""
    count, coefficients = designs.shape[0], np.empty((1, formulas.result.size))
    slots = np.empty(formulas.start.size)
    rates = np.empty((slots.size, designs.shape[1]))
    slopes = np.empty((count, formulas.result.size, designs.shape[1]))
    for p in range(count):
        fill(formulas, designs[p : p + 1], 0, slots, coefficients)
        fill_slopes(formulas, slots, p, rates, slopes)
    return slopes


def unmapped(case: Any, designs: Real) -> tuple[Any, Real]:
    """Return a case without formulas and its designs (p, w) of designs (p, v) of the case."""
    return (case.case, coefficients_of(case.formulas, designs)) if isinstance(case, Mapped) else (case, designs)


def mean_squares_of(case: Any, designs: Real) -> Real:
    """Return the mean squares (p, k) of designs (p, v) in two steps: quicker than both compiled into one."""
    inner, coefficients = unmapped(case, designs)
    if not coefficients.flags.carray:  # read-only arrays are another type
        coefficients = coefficients.copy()
    if isinstance(inner, OneStrut) and len(designs) <= _FEW:
        inner = OneDesign(inner)
    return np.asarray(inner(coefficients))
