"""Kinds of variables: whole numbers, catalogues, logarithms and held values behind the real box of a search.

A search works on codes (e,) in a box, `Coded` turns them into designs (d,). Codes of whole numbers, and of places
in a catalogue, are rounded: half a unit beyond the ends makes all equally likely. The code of a logarithmic
variable is its logarithm; a held variable has none.
"""

from collections.abc import Callable, Sequence
from math import exp
from operator import lt
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .. import checks
from ..compiled import call, call_compiled, compilable, verb_of
from ..quantities import Integer, Real

if TYPE_CHECKING:
    from .problem import Minimisable

HELD, REAL, LOGARITHM, WHOLE, LISTED = range(5)  # those from WHOLE on are discrete
_FORMS = {"log": LOGARITHM, "integer": WHOLE}


class Decode(NamedTuple):
    """Designs of codes."""

    form: Integer  # (d,) HELD, REAL, LOGARITHM, WHOLE or LISTED
    lower: Real  # (d,) least and greatest value, or place in `catalogue`
    upper: Real
    catalogue: Real  # (k,) the values of all catalogues, one after the other

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
    """A kernel of designs, called with codes."""

    decode: Decode
    kernel: Any

    @compilable()
    def __call__(self, code: Real) -> Real:
        """Return the kernel's values (m + c,) of a code (e,)."""
        designs = call(self.decode, (code.reshape(1, code.size),))
        value: Real = call(self.kernel, (designs[0],))
        return value


class Coded:
    """A problem in one search on codes; it remembers the values of designs whose variables are all discrete.

    `evaluate` takes designs as in the user's problem, `kernel` takes a code.
    """

    def __init__(self, problem: "Minimisable") -> None:
        self.evaluate, self.objectives, self.constraints = (
            problem.evaluate,
            problem.objectives,
            problem.constraints,
        )
        names = getattr(problem, "variables", ()) or [f"x{i + 1}" for i in range(len(problem.lower))]
        kinds = getattr(problem, "kinds", {})
        self.variables = tuple(names)
        self.decoding = _decoding([kinds.get(name, "") for name in names], problem.lower, problem.upper)
        form, low, high, _ = self.decoding
        half = np.where(form >= WHOLE, 0.5, 0.0)
        with np.errstate(invalid="ignore", divide="ignore"):  # of variables without a logarithm
            low, high = (np.where(form == LOGARITHM, np.log(bound), bound) for bound in (low, high))
        self.lower, self.upper = (low - half)[form != HELD], (high + half)[form != HELD]
        self.kernel = None if problem.kernel is None else DecodedKernel(self.decoding, verb_of(problem.kernel))
        self.repeats = 0  # designs with known values
        self._known: dict[bytes, Real] | None = {} if (form[form != HELD] >= WHOLE).all() else None

    def decode(self, codes: Real) -> Real:
        """Return the designs (n, d) of codes (n, e)."""
        designs: Real = call_compiled(self.decoding, np.ascontiguousarray(codes))
        return designs

    def encode(self, name: str, designs: Real) -> Real:
        """Return codes (n, e) of designs (n, d) called `name`; ValueError for a value without one."""
        form, low, high, catalogue = self.decoding
        codes = designs.copy()
        for v in np.flatnonzero(form == LISTED):
            values = catalogue[int(low[v]) : int(high[v]) + 1]
            codes[:, v] = low[v] + np.searchsorted(values, designs[:, v])
        codes[:, form == LOGARITHM] = np.log(designs[:, form == LOGARITHM])
        codes = np.clip(codes[:, form != HELD], self.lower, self.upper)
        other = (self.decode(codes) != designs) & ((form >= WHOLE) | (form == HELD))
        if other.any():
            row, v = np.argwhere(other)[0].tolist()
            known = catalogue[int(low[v]) : int(high[v]) + 1] if form[v] == LISTED else low[v : v + 1]
            allowed = "a whole number" if form[v] == WHOLE else f"one of {known.tolist()}"
            raise ValueError(f"{name} must have {allowed} in {self.variables[v]}, got {designs[row, v]}")
        return codes

    def values(self, codes: Real, evaluate: Callable[[Real], Real]) -> Real:
        """Return the values (n, m + c) of codes (n, e); `evaluate` gives those that are not known, by designs."""
        designs = self.decode(codes)
        if self._known is None:
            return evaluate(designs)
        keys = [row.tobytes() for row in designs]
        new = {key: i for i, key in enumerate(keys) if key not in self._known}
        if new:
            self._known.update(zip(new, evaluate(designs[list(new.values())]), strict=True))
        self.repeats += len(keys) - len(new)
        return np.array([self._known[key] for key in keys])


def _decoding(kinds: Sequence[str | tuple[float, ...]], lower: Sequence[float], upper: Sequence[float]) -> Decode:
    """Return the decoding of variables of checked kinds, ``""`` for real ones, within their bounds."""
    rows: list[tuple[int, float, float]] = []
    catalogue: list[float] = []
    for kind, low, high in zip(kinds, lower, upper, strict=True):
        first, last = checks.kind_ends(kind, low, high)
        form = _FORMS.get(kind, REAL) if isinstance(kind, str) else LISTED
        if first == last:
            form = HELD
        elif isinstance(kind, tuple):
            first, last = len(catalogue), len(catalogue) + len(kind) - 1
            catalogue += kind
        rows.append((form, first, last))
    forms, ends = np.array(rows)[:, 0].astype(np.int64), np.array(rows)[:, 1:].T
    return Decode(forms, ends[0].copy(), ends[1].copy(), np.array(catalogue, dtype=float))


def coded(problem: "Minimisable") -> "Minimisable":
    """Return a problem for one search: on codes where a variable has a kind or is held, itself otherwise."""
    plain = not getattr(problem, "kinds", None) and all(map(lt, problem.lower, problem.upper))
    return problem if plain or isinstance(problem, Coded) else Coded(problem)


def box(problem: "Minimisable") -> tuple[Real, Real]:
    """Return the bounds (e,) of the codes of a problem, of its designs if it has none."""
    problem = coded(problem)
    return np.asarray(problem.lower, dtype=float), np.asarray(problem.upper, dtype=float)


def decoded(problem: "Minimisable", codes: Real) -> Real:
    """Return the designs (n, d) of codes (n, e) of a search on a problem, themselves if it has none."""
    return problem.decode(codes) if isinstance(problem, Coded) else codes


def grid_axes(problem: "Minimisable", points: int) -> list[Real]:
    """Return up to `points` codes of each variable, evenly spread and each of another value."""
    searched = coded(problem)
    lower, upper = box(searched)
    discrete = np.zeros(lower.size, dtype=bool)
    if isinstance(searched, Coded):
        form = searched.decoding.form
        discrete = form[form != HELD] >= WHOLE
    half = np.where(discrete, 0.5, 0.0)
    sizes = np.where(discrete, np.minimum(upper - lower, points), points).astype(int)
    axes = map(np.linspace, lower + half, upper - half, sizes)
    return [np.rint(axis) if whole else axis for axis, whole in zip(axes, discrete, strict=True)]
