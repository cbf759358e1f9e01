"""Problems for pymoo: its algorithms on the measures of this library."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import checks
from ..quantities import Real
from .problem import Minimisable


def as_pymoo(problem: Minimisable) -> Any:
    """Return a problem as one of pymoo, evaluated a population at a time.

    Parameters
    ----------
    problem : Problem or RideProblem

    Returns
    -------
    pymoo.core.problem.Problem
        Designs are rows in the units of the problem, ``F`` its objectives, and ``G`` its constraints, met where
        they are <= 0. A logarithmic variable is a real one, as pymoo knows no logarithm; a held one has equal
        bounds.

        With whole numbers or catalogues a design is a mapping by variable, without those that are held: pymoo's
        ``Real``, ``Integer`` and ``Choice`` for its mixed-variable algorithms.

    Raises
    ------
    ValueError
        If it is no problem.
    ImportError
        If pymoo, the extra ``pymoo``, is not installed.

    Examples
    --------
    Another algorithm on the paper's problem, at a travel of 10 mm at most:

    >>> import suspension_ctrl as sc
    >>> from pymoo.algorithms.moo.nsga2 import NSGA2
    >>> from pymoo.optimize import minimize
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> limits = ["SWS <= 0.01"]
    >>> problem = sc.RideProblem(
    ...     file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, constraints=limits
    ... )
    >>> found = minimize(sc.as_pymoo(problem), NSGA2(pop_size=40), ("n_gen", 10), seed=1)
    >>> found.X.shape[1], found.F.shape[1], bool((found.F[:, 1] <= 0.01).all())
    (2, 3, True)
    """
    checks.with_method("problem", problem, "evaluate")
    with checks.installed("pymoo"):
        from pymoo.core.problem import Problem

    class Adapted(Problem):  # type: ignore[misc]  # pymoo has no types
        """The problem of pymoo; it is pickled as the problem of which it was made."""

        def __init__(self) -> None:
            sizes = {"n_obj": len(problem.objectives), "n_ieq_constr": len(problem.constraints)}
            super().__init__(**sizes, **_variables(problem))

        def _evaluate(self, x: Any, out: dict[str, Any], *_: Any, **__: Any) -> None:
            values, m = np.asarray(problem.evaluate(_designs(problem, x))), len(problem.objectives)
            out["F"], out["G"] = values[:, :m], values[:, m:]

        def __reduce__(self) -> Any:
            return as_pymoo, (problem,)

    return Adapted()


def _ends(problem: Minimisable) -> dict[str, tuple[float, float]]:
    """Return the least and the greatest value of each variable by name."""
    bounds = zip(problem.variables, problem.lower, problem.upper, strict=True)
    return {name: checks.kind_ends(_kind(problem, name), low, high) for name, low, high in bounds}


def _kind(problem: Minimisable, name: str) -> str | tuple[float, ...]:
    """Return the kind of a variable, "" of a real one."""
    given = problem.kinds.get(name, "")
    return given if isinstance(given, str) else tuple(given)


def _variables(problem: Minimisable) -> dict[str, Any]:
    """Return the bounds of real designs, or the variables of mixed ones by name without those that are held."""
    if all(kind in ("log", "fixed") for kind in problem.kinds.values()):
        return {"n_var": len(problem.variables), "xl": np.array(problem.lower), "xu": np.array(problem.upper)}
    moving = {name: ends for name, ends in _ends(problem).items() if ends[0] < ends[1]}
    return {"vars": {name: _variable(_kind(problem, name), ends) for name, ends in moving.items()}}


def _variable(kind: str | tuple[float, ...], ends: tuple[float, float]) -> Any:
    """Return pymoo's variable of a kind."""
    from pymoo.core.variable import Choice, Integer, Real

    if not isinstance(kind, str):
        return Choice(options=list(kind))
    return Integer(bounds=(int(ends[0]), int(ends[1]))) if kind == "integer" else Real(bounds=ends)


def _designs(problem: Minimisable, x: Any) -> Real:
    """Return designs (n, d) of pymoo's rows (n, d), or of its mappings by variable (n,)."""
    if not isinstance(x[0], Mapping):
        return np.asarray(x, dtype=float)
    held = {name: low for name, (low, _) in _ends(problem).items()}
    return np.array([[float((held | one)[name]) for name in problem.variables] for one in x])
