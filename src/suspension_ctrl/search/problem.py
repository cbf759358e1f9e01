"""Optimisation problems: objectives to be minimised over a box of variables, with constraints."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np
from numba.extending import is_jitted

from .. import checks
from ..quantities import FrozenMapping, Real, Record, column_headers

Kernel = tuple[Any, ...]
"""A compiled function from a design (d,) to values (m + c,) and its further arguments, or a verb (`compiled`)."""


class Minimisable(Protocol):
    """The interface of `Problem` and `RideProblem`."""

    @property
    def lower(self) -> Sequence[float]:
        """Lower bounds of the variables (d,)."""

    @property
    def upper(self) -> Sequence[float]:
        """Upper bounds of the variables (d,)."""

    @property
    def objectives(self) -> Sequence[str]:
        """Names of the objectives (m,)."""

    @property
    def constraints(self) -> Sequence[object]:
        """Constraints (c,), whose texts are their names."""

    @property
    def variables(self) -> Sequence[str]:
        """Names of the variables (d,)."""

    @property
    def units(self) -> Mapping[str, str]:
        """Unit of a variable or an objective by name."""

    @property
    def kinds(self) -> Mapping[str, str | Sequence[float]]:
        """Kind of a variable by name."""

    @property
    def kernel(self) -> Kernel | None:
        """Compiled function from a design (d,) to its values (m + c,), if any."""

    @property
    def evaluate(self) -> Callable[[Real], Real]:
        """Function from designs (n, d) to values (n, m + c): objectives, then constraints."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Problem(Record):
    """Two or more objectives to be minimised over a box.

    Parameters
    ----------
    evaluate : callable
        From designs (n, d) to objectives (n, m), row by row; with constraints to (n, m + c).
    lower, upper : (d,) sequence of float
        Bounds of the variables; equal ones hold a variable at their value.
    objectives : (m,) sequence of str
        Names of the objectives, m >= 2.
    constraints : (c,) sequence of str, optional
        Names of the constraints: `evaluate` and `kernel` return a value g of each after the objectives, met where
        g <= 0. Violations are summed: divide each g by its limit, as in ``temperature / limit - 1``.
    variables : (d,) sequence of str, optional
        Names of the variables, ``x1 .. xd`` if not given.
    units : mapping, optional
        Unit of a variable or an objective by name.
    kernel : (callable, tuple), optional
        Function compiled by numba from a design (d,) to objectives and constraints (m + c,), and its further
        arguments: for optimisers that evaluate designs one by one in compiled code.
    kinds : mapping of str to str or sequence of float, optional
        By name ``"integer"``, whole numbers; ``"log"``, searched by the logarithm; ``"fixed"``, held by equal
        bounds; or the values of a catalogue, within the bounds. Other variables are real.

    Raises
    ------
    ValueError
        If the bounds are not finite, not in order or all equal, the names or kinds do not fit, or the kernel is
        not compiled.

    Notes
    -----
    Optimisers search a real box: a variable with a kind has a code in it, such as its place in a catalogue
    (`search.kinds`). Verbs of a toolbox work on codes; `evaluate`, `start`, callbacks and results have designs. If
    all variables are whole numbers, of catalogues or held, a search evaluates each design once. A budget counts
    repeated designs too, and `Run.repeats` is their number. A kernel evaluates repeated designs again, as this
    costs no more than looking them up. A resumed search does too: a run keeps its population, not every design.

    Examples
    --------
    An engine mount: static sag against the force that it transmits at 25 Hz, where the transmissibility at
    resonance must not exceed 3. Damping harms the isolation: the best mounts have no more than the limit asks
    for, 1/(2 (3^2 - 1)^0.5) = 0.18.

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> def mount(designs):
    ...     frequency, ratio = designs.T  # Hz, -
    ...     r = 25.0 / frequency
    ...     passed = np.hypot(1, 2 * ratio * r) / np.hypot(1 - r**2, 2 * ratio * r)
    ...     sag = 9.81 / (2 * np.pi * frequency) ** 2
    ...     return np.column_stack([sag, passed, np.hypot(1, 1 / (2 * ratio)) / 3 - 1])
    >>> problem = sc.Problem(
    ...     evaluate=mount,
    ...     lower=(2.0, 0.02),
    ...     upper=(12.0, 1.0),
    ...     variables=("frequency", "damping ratio"),
    ...     objectives=("sag", "transmissibility"),
    ...     constraints=("resonance",),
    ...     units={"frequency": "Hz", "sag": "m"},
    ... )
    >>> front = sc.minimise(problem, sc.Nsga2(population=40), iterations=100, seed=1).front()
    >>> print(list(front.columns), round(front["damping ratio"].median(), 2))
    ['frequency [Hz]', 'damping ratio', 'sag [m]', 'transmissibility'] 0.18
    """

    evaluate: Callable[[Real], Real]
    lower: Sequence[float]
    upper: Sequence[float]
    objectives: Sequence[str]
    constraints: Sequence[str] = ()
    variables: Sequence[str] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    kernel: Kernel | None = None
    kinds: Mapping[str, str | Sequence[float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        checks.ordered("lower", "upper", self.lower, self.upper)
        if not callable(self.evaluate):
            raise ValueError(f"evaluate must be callable, got {checks.shown(self.evaluate)}")
        for name in ("objectives", "constraints", "variables"):
            checks.listed(name, getattr(self, name))
            for one in getattr(self, name):
                checks.of_kind(f"each of {name}", one, str)
        if len(set(self.objectives)) < max(2, len(self.objectives)):
            raise ValueError(f"objectives must be 2 or more different names, got {self.objectives!r}")
        outputs = [*self.objectives, *self.constraints]
        if len(set(outputs)) < len(outputs):
            raise ValueError(f"constraints must be names different from all others, got {self.constraints!r}")
        names = tuple(self.variables) or tuple(f"x{i + 1}" for i in range(len(self.lower)))
        if not len(set(names)) == len(names) == len(self.lower):
            raise ValueError(f"variables must be {len(self.lower)} different names, got {self.variables!r}")
        if self.kernel is not None and not _is_kernel(self.kernel):
            got = checks.shown(self.kernel)
            raise ValueError(f"kernel must be a function compiled by numba and a tuple, got {got}")
        lower, upper = (tuple(np.asarray(bound, dtype=float).tolist()) for bound in (self.lower, self.upper))
        lists = {name: tuple(getattr(self, name)) for name in ("objectives", "constraints")}
        self._keep(lower=lower, upper=upper, variables=names, units=FrozenMapping(self.units), **lists)
        self._keep(kinds=FrozenMapping(checks.kinds(self.kinds, names, lower, upper)))

    def replace(self, **changes: Any) -> "Problem":
        """Return the problem with other parameters."""
        return replace(self, **changes)


def _is_kernel(kernel: Any) -> bool:
    match kernel:
        case (function, tuple()) if is_jitted(function):
            return True
    return isinstance(kernel, tuple) and callable(kernel)


def headers_of(problem: Minimisable) -> tuple[str, ...]:
    """Return the names of variables and objectives (d + m,) with their units."""
    return tuple(column_headers([*problem.variables, *problem.objectives], problem.units))
