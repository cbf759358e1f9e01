"""Evaluation of designs in a search: shapes are checked, and designs that cannot be evaluated count as worst."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real
from .kinds import Coding
from .population import State
from .problem import Minimisable

WORST = 1e150
"""Stands for every value of a design that cannot be evaluated: all others dominate it; its square is finite."""

AGREEMENT = 1e-6
"""Largest difference of a kernel from `evaluate`, in terms of the largest value."""


class FailureWarning(UserWarning):
    """Designs could not be evaluated and count as worst.

    Examples
    --------
    A model has no result below a width of 0.2; the search goes on without these designs:

    >>> import warnings
    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> def beam(width):
    ...     stiffness = np.where(width < 0.2, np.nan, width**3)
    ...     return np.column_stack([width, 1 / stiffness])
    >>> problem = sc.Problem(evaluate=beam, lower=(0.1,), upper=(1.0,), objectives=("mass", "deflection"))
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     run = sc.minimise(problem, sc.Nsga2(population=20), iterations=5, seed=1)
    >>> caught[0].category.__name__, run.failures > 0, bool(run.designs.min() >= 0.2)
    ('FailureWarning', True, True)
    """


def without_worst(values: Real) -> Real:
    """Return values of any shape with NaN for `WORST`."""
    return np.where(values < WORST, values, np.nan)


class SearchProblem:
    """A problem in one search: designs have codes, discrete ones are evaluated once, failures are counted.

    A design that cannot be evaluated is an error if `strict`. A `record` keeps all evaluated designs in order.
    """

    def __init__(self, problem: Minimisable, *, strict: bool = True, record: bool = False) -> None:
        self.coding = Coding(problem)
        self.lower, self.upper, self.decode = self.coding.lower, self.coding.upper, self.coding.decode
        self.objectives, self.constraints = problem.objectives, problem.constraints
        self.evaluate = problem.evaluate
        self.kernel = None if problem.kernel is None else self.coding.kernel(problem.kernel)
        self.sweep: Any = None  # of MOEA/D-DRA, compiled at its first use
        self.together = 1  # iterations that may pass up to the next state of the search
        self.compared = self.kernel is None
        self.strict, self.failures, self.first = strict, 0, ""
        self.repeats = 0  # designs with known values
        self._known: dict[bytes, Real] | None = {} if self.coding.discrete.all() else None
        self._record: list[tuple[Real, Real]] | None = [] if record else None
        self.recorded = 0

    def before_the_start(self) -> State:
        """Return the state of a search without designs."""
        m, c = len(self.objectives), len(self.constraints)
        return State.of(np.empty((0, self.lower.size)), np.empty((0, m + c)), np.full(m, np.inf), 0)

    def values(self, evaluate: Callable[[Real], ArrayLike], codes: Real) -> Real:
        """Return the values (n, m + c) of codes (n, e), `WORST` if not finite; ValueError if of another kind."""
        designs = self.decode(codes)
        if self._known is None:
            return self._evaluated(evaluate, designs)
        keys = [row.tobytes() for row in designs]
        new = {key: i for i, key in enumerate(keys) if key not in self._known}
        if new:
            values = self._evaluated(evaluate, designs[list(new.values())])
            self._known.update(zip(new, values, strict=True))
        self.repeats += len(keys) - len(new)
        return np.array([self._known[key] for key in keys])

    def _evaluated(self, evaluate: Callable[[Real], ArrayLike], designs: Real) -> Real:
        # Copies: a user's evaluation may change its argument and reuse its result.
        values = checks.reals("evaluate must return", evaluate(designs.copy()))
        expected = (designs.shape[0], len(self.objectives) + len(self.constraints))
        if values.shape != expected:
            raise ValueError(
                f"evaluate must return shape {expected} for designs {designs.shape}, got {values.shape}"
            )
        if not (np.abs(values) < WORST).all():
            fails = ~(np.abs(values) < WORST).all(axis=1)
            first = int(fails.argmax())
            self.fail("evaluate", int(fails.sum()), designs[first], values[first])
            values[fails] = WORST
        self.keep(designs, values)
        return values

    def fail(self, source: str, count: int, design: Real, value: Real | None = None) -> None:
        """Count failures of evaluate or kernel; `design` (d,) with its values (m + c,) is the first of them."""
        names = "objectives and constraints" if self.constraints else "objectives"
        got = "others" if value is None else str(value.tolist())
        message = f"{source} must return finite {names}, got {got} for design {design.tolist()}"
        if self.strict:
            raise ValueError(message)
        self.first = self.first or message
        self.failures += count

    def summary(self, evaluations: int) -> str:
        """Return the failures among so many evaluations in words."""
        counted = f"{self.failures} of {evaluations} designs could not be evaluated and count as worst"
        return f"{counted}; first: {self.first}"

    def take(self, codes: Real, values: Real, failures: int) -> None:
        """Take values (n, m + c) of codes (n, e) from the kernel; the first are compared with `evaluate`."""
        if failures:
            self.fail("kernel", failures, self.decode(codes[values[:, 0] >= WORST][:1])[0])
        if not self.compared:
            self.compared = True
            if values[0, 0] < WORST:
                self._compare(codes[0], values[0])
        if self._record is not None:
            self.keep(self.decode(codes), values)

    def _compare(self, code: Real, found: Real) -> None:
        """Raise ValueError unless `evaluate` gives what the kernel found for a code (e,), values (m + c,)."""
        design = self.decode(code[np.newaxis])
        expected = checks.reals("evaluate must return", self.evaluate(design.copy()))[0]
        agree = np.abs(found - expected) <= AGREEMENT * np.maximum(np.abs(expected).max(), 1e-300)
        if not agree.all():
            got = f"{found.tolist()} for design {design[0].tolist()}"
            raise ValueError(f"kernel must return what evaluate does, {expected.tolist()}, got {got}")

    def keep(self, designs: Real, values: Real) -> None:
        """Append designs (n, d) and values (n, m + c) to the record."""
        if self._record is not None:
            self._record.append((designs.copy(), values.copy()))
            self.recorded += len(designs)

    def record(self) -> tuple[Real, Real]:
        """Return the designs (k, d) and values (k, m + c) of the record, NaN of failures."""
        values_each = len(self.objectives) + len(self.constraints)
        none = self.decode(np.empty((0, self.lower.size))), np.empty((0, values_each))
        designs, values = map(np.concatenate, zip(none, *self._record or [], strict=True))
        return designs, without_worst(values)
