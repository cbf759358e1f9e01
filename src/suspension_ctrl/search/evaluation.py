"""Evaluation of designs in a search: shapes are checked, and designs that cannot be evaluated count as worst."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real
from .kinds import Coded, coded
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


class Judged:
    """A problem in a search, which counts the designs that cannot be evaluated: an error each if `strict`."""

    def __init__(self, problem: Minimisable, strict: bool = True) -> None:
        searched = coded(problem)
        self.coded = searched if isinstance(searched, Coded) else None
        self.lower, self.upper, self.kernel = searched.lower, searched.upper, searched.kernel
        self.objectives, self.constraints = problem.objectives, problem.constraints
        self.evaluate = self.reference = problem.evaluate
        self.strict, self.compared = strict, problem.kernel is None
        self.failures, self.first = 0, ""
        self.sweep: Any = None  # of MOEA/D-DRA, once it is known

    @classmethod
    def of(cls, problem: Minimisable) -> "Judged":
        """Return a problem as it is if it is judged already."""
        return problem if isinstance(problem, cls) else cls(problem)

    def decode(self, codes: Real) -> Real:
        """Return the designs (n, d) of codes (n, e)."""
        return self.coded.decode(codes) if self.coded else codes

    def fail(self, source: str, count: int, design: Real, value: Real | None = None) -> None:
        """Count failures of evaluate or kernel, at `design` (d,) with its values (m + c,) the first of them."""
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


def evaluate_checked(evaluate: Callable[[Real], ArrayLike], designs: Real, problem: Minimisable) -> Real:
    """Return the values (n, m + c) of designs or codes (n, d); ValueError if of another kind or not finite.

    In a `Judged` problem that is not strict a row that is not finite becomes `WORST` and is counted.
    """
    judged = Judged.of(problem)
    if judged.coded:
        return judged.coded.values(designs, lambda new: _checked(evaluate, new, judged))
    return _checked(evaluate, designs, judged)


def _checked(evaluate: Callable[[Real], ArrayLike], designs: Real, problem: Judged) -> Real:
    # Copies: a user's evaluation may change its argument and reuse its result.
    values = checks.reals("evaluate must return", evaluate(designs.copy()))
    expected = (designs.shape[0], len(problem.objectives) + len(problem.constraints))
    if values.shape != expected:
        raise ValueError(f"evaluate must return shape {expected} for designs {designs.shape}, got {values.shape}")
    if not (np.abs(values) < WORST).all():
        fails = ~(np.abs(values) < WORST).all(axis=1)
        first = int(fails.argmax())
        problem.fail("evaluate", int(fails.sum()), designs[first], values[first])
        values[fails] = WORST
    return values


def compare_kernel(design: Real, found: Real, problem: Judged) -> None:
    """Raise ValueError unless the problem gives what a kernel found for a design (d,), values (m + c,)."""
    expected = evaluate_checked(problem.reference, design[np.newaxis], problem)[0]
    agree = np.abs(found - expected) <= AGREEMENT * np.maximum(np.abs(expected).max(), 1e-300)
    if (found < WORST).all() and not agree.all():
        got = f"{found.tolist()} for design {problem.decode(design[np.newaxis])[0].tolist()}"
        raise ValueError(f"kernel must return what evaluate does, {expected.tolist()}, got {got}")
