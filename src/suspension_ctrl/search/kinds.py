"""Kinds of variables: whole numbers, catalogues, logarithmic and held variables, coded in a real box.

A search works on codes (e,) in a box; `Coding` decodes them into designs (d,). Codes of whole numbers, and of
places in a catalogue, are rounded; the box reaches half a unit beyond both ends, so that all values are equally
likely. The code of a logarithmic variable is its logarithm; a held variable has no code.
"""

from collections.abc import Sequence
from math import exp
from typing import Any, NamedTuple

import numpy as np

from .. import checks
from ..compiled import compilable
from ..compiled_verbs import call, call_compiled, verb_of
from ..quantities import Integer, Real
from .problem import Kernel, Minimisable

HELD, REAL, LOGARITHM, WHOLE, LISTED = range(5)  # discrete from WHOLE on
_FORMS = {"log": LOGARITHM, "integer": WHOLE}


class Decode(NamedTuple):
    """Decoder of codes into designs."""

    form: Integer  # (d,) HELD, REAL, LOGARITHM, WHOLE or LISTED
    lower: Real  # (d,) least and greatest value, or their places in `catalogue`
    upper: Real
    catalogue: Real  # (k,) values of all catalogues, one after the other

    @compilable()
    def __call__(self, codes: Real) -> Real:
        """Return designs (n, d) of codes (n, e)."""
        designs = np.empty((codes.shape[0], self.form.size))
        for i in range(codes.shape[0]):
            e = 0
            for v in range(self.form.size):
                value = self.lower[v]
                if self.form[v] != HELD:
                    value = codes[i, e]
                    e += 1
                if self.form[v] == LOGARITHM:
                    value = exp(value)
                elif self.form[v] >= WHOLE:
                    value = np.floor(value + 0.5)
                value = self.lower[v] if value < self.lower[v] else value
                value = self.upper[v] if value > self.upper[v] else value
                designs[i, v] = self.catalogue[int(value)] if self.form[v] == LISTED else value
        return designs


class DecodedKernel(NamedTuple):
    """A kernel that decodes its argument first."""

    decode: Decode
    kernel: Any

    @compilable()
    def __call__(self, code: Real) -> Real:
        """Return the kernel's values (m + c,) of a code (e,)."""
        codes = np.empty((1, code.size))  # `reshape` takes long to compile
        for v in range(code.size):
            codes[0, v] = code[v]
        designs = call(self.decode, (codes,))
        value: Real = call(self.kernel, (designs[0],))
        return value


class Coding:
    """Coding of the designs of a problem and the box of its codes; real designs are their own codes."""

    def __init__(self, problem: Minimisable) -> None:
        self.variables = problem.variables
        kinds = [problem.kinds.get(name, "") for name in self.variables]
        self.decoding = _decoding(kinds, problem.lower, problem.upper)
        form, low, high, _ = self.decoding
        self.plain = bool((form == REAL).all())
        self.lower, self.upper, self.discrete = low, high, form >= WHOLE
        if not self.plain:
            half, kept = np.where(form >= WHOLE, 0.5, 0.0), form != HELD
            with np.errstate(invalid="ignore", divide="ignore"):  # of variables without a logarithm
                low, high = (np.where(form == LOGARITHM, np.log(bound), bound) for bound in (low, high))
            self.lower, self.upper, self.discrete = (low - half)[kept], (high + half)[kept], self.discrete[kept]

    def kernel(self, kernel: Kernel) -> Kernel:
        """Return the kernel as a function of codes."""
        return kernel if self.plain else DecodedKernel(self.decoding, verb_of(kernel))

    def decode(self, codes: Real) -> Real:
        """Return the designs (n, d) of codes (n, e)."""
        return codes if self.plain else np.asarray(call_compiled(self.decoding, np.ascontiguousarray(codes)))

    def encode(self, name: str, designs: Real) -> Real:
        """Return the codes (n, e) of designs (n, d), `name` in errors; ValueError for a value without a code."""
        form, low, high, catalogue = self.decoding
        codes = designs.copy()
        for v in np.flatnonzero(form == LISTED):
            values = catalogue[int(low[v]) : int(high[v]) + 1]
            codes[:, v] = low[v] + np.searchsorted(values, designs[:, v])
        codes[:, form == LOGARITHM] = np.log(designs[:, form == LOGARITHM])
        if not self.plain:
            codes = np.clip(codes[:, form != HELD], self.lower, self.upper)
        other = (self.decode(codes) != designs) & ((form >= WHOLE) | (form == HELD))
        if other.any():
            row, v = np.argwhere(other)[0].tolist()
            values = catalogue[int(low[v]) : int(high[v]) + 1] if form[v] == LISTED else low[v : v + 1]
            allowed = "a whole number" if form[v] == WHOLE else f"one of {values.tolist()}"
            raise ValueError(f"{name} must have {allowed} in {self.variables[v]}, got {designs[row, v]}")
        return codes

    def grid_axes(self, points: int) -> list[Real]:
        """Return up to `points` codes per variable, evenly spread, that decode to different values."""
        half = np.where(self.discrete, 0.5, 0.0)
        sizes = np.where(self.discrete, np.minimum(self.upper - self.lower, points), points).astype(int)
        axes = map(np.linspace, self.lower + half, self.upper - half, sizes)
        return [np.rint(axis) if whole else axis for axis, whole in zip(axes, self.discrete, strict=True)]


def _decoding(kinds: Sequence[str | Sequence[float]], lower: Sequence[float], upper: Sequence[float]) -> Decode:
    """Return the decoder of variables of checked kinds, ``""`` for a real one, within their bounds (d,)."""
    rows: list[tuple[int, float, float]] = []
    catalogue: list[float] = []
    for given, low, high in zip(kinds, lower, upper, strict=True):
        kind = given if isinstance(given, str) else tuple(given)
        first, last = checks.kind_ends(kind, low, high)
        form = _FORMS.get(kind, REAL) if isinstance(kind, str) else LISTED
        if first == last:
            form = HELD
        elif not isinstance(kind, str):
            first, last = len(catalogue), len(catalogue) + len(kind) - 1
            catalogue += kind
        rows.append((form, first, last))
    forms, ends = np.array(rows)[:, 0].astype(np.int64), np.array(rows, dtype=float)[:, 1:].T
    return Decode(forms, ends[0].copy(), ends[1].copy(), np.array(catalogue, dtype=float))


def box(problem: Minimisable) -> tuple[Real, Real]:
    """Return the bounds (e,) of the codes of a problem."""
    coding = Coding(problem)
    return coding.lower, coding.upper
