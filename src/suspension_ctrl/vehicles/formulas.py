"""Coefficients of struts as sums of products of the variables of a design, as data of compiled loops."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..compiled import compilable
from ..quantities import Integer, Real

_FACTORS = 4  # most factors of a product
_NONE = -1


class Formulas(NamedTuple):
    """Sums of products: slots for the variables (v,), then for constants and sums in their order."""

    start: Real  # (s,), constants; sums are added to theirs
    target: Integer  # (t,), slot of the sum to which a product is added
    factor: Real  # (t,), constant of a product
    base: Integer  # (t, 4), slots of its factors, -1 without
    power: Real  # (t, 4), their powers
    result: Integer  # (w,), slots of the coefficients

    def of(self, designs: Real) -> Real:
        """Return the coefficients (p, w) of designs (p, v); NaN where a formula has no value."""
        found = np.empty((len(designs), self.result.size))
        slots = np.empty(self.start.size)
        with np.errstate(all="ignore"):
            for p in range(len(designs)):
                fill(self, designs, p, slots, found)
        return found


@compilable(error_model="numpy")
def fill(formulas: Formulas, designs: Real, p: int, slots: Real, coefficients: Real) -> None:
    """Fill in the coefficients (p, w) of one of the designs (p, v); works in slots (s,)."""
    for i in range(slots.size):
        slots[i] = designs[p, i] if i < designs.shape[1] else formulas.start[i]
    for t in range(formulas.target.size):
        product = formulas.factor[t]
        for j in range(formulas.base.shape[1]):
            if formulas.base[t, j] >= 0:
                product *= slots[formulas.base[t, j]] ** formulas.power[t, j]
        slots[formulas.target[t]] += product
    for i in range(formulas.result.size):
        coefficients[p, i] = slots[formulas.result[i]]


@compilable(error_model="numpy")
def fill_slopes(formulas: Formulas, slots: Real, p: int, rates: Real, slopes: Real) -> None:
    """Fill in the derivatives (p, w, v) of the coefficients by the variables of a design with filled slots (s,).

    Works in the derivatives (s, v) of the slots, each of which stands before those that depend on it.
    """
    base, variables = formulas.base, slopes.shape[2]
    for i in range(slots.size):
        for v in range(variables):
            rates[i, v] = 1.0 if i == v else 0.0
    for t in range(formulas.target.size):
        for j in range(base.shape[1]):
            if base[t, j] >= 0:
                factor = formulas.factor[t] * formulas.power[t, j]
                for other in range(base.shape[1]):
                    if base[t, other] >= 0:
                        power = formulas.power[t, other] - (1.0 if other == j else 0.0)
                        factor *= slots[base[t, other]] ** power
                for v in range(variables):
                    rates[formulas.target[t], v] += factor * rates[base[t, j], v]
    for i in range(formulas.result.size):
        for v in range(variables):
            slopes[p, i, v] = rates[formulas.result[i], v]


class Sheet:
    """Formulas in the making: each value has a slot."""

    def __init__(self, variables: int) -> None:
        self._start = [0.0] * variables
        self._rows: list[tuple[int, float, list[int], list[float]]] = []

    def constant(self, value: float) -> int:
        """Return the slot of a constant."""
        self._start.append(float(value))
        return len(self._start) - 1

    def sum(self, *products: tuple[float, Mapping[int, float]], constant: float = 0.0) -> int:
        """Return the slot of a constant plus products: each a factor, and powers by slot."""
        slot = self.constant(constant)
        for factor, powers in products:
            self._rows.append((slot, factor, list(powers), list(powers.values())))
        return slot

    def formulas(self, result: list[int]) -> Formulas:
        """Return the formulas with these slots as results."""
        base, power = np.full((len(self._rows), _FACTORS), _NONE), np.ones((len(self._rows), _FACTORS))
        for t, (_, _, slots, powers) in enumerate(self._rows):
            base[t, : len(slots)], power[t, : len(slots)] = slots, powers
        return Formulas(
            np.array(self._start),
            np.array([row[0] for row in self._rows], dtype=np.int64),
            np.array([row[1] for row in self._rows], dtype=float),
            base.astype(np.int64),
            power,
            np.array(result, dtype=np.int64),
        )
