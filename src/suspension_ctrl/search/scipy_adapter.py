"""One measure of a problem within its limits, for the optimisers of SciPy."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import FrozenMapping, Real
from .kinds import Coding
from .problem import Minimisable

_STEP = 1e-4  # of the box: central differences are then off by 1e-8, by truncation as by rounding
_CONTINUOUS = ("log", "fixed")


class ScipyProblem(FrozenMapping[str, Any]):
    """Arguments of `scipy.optimize.minimize` by name, and designs of its results, see `as_scipy`."""

    def __init__(self, problem: Minimisable, measure: str) -> None:
        self._problem, self._coding = problem, Coding(problem)
        self._m, self._column = len(problem.objectives), list(problem.objectives).index(measure)
        middle = np.full(self._coding.lower.size, 0.5)
        self._scale = abs(float(self._values(middle)[0, self._column])) or 1.0
        bounds = [(0.0, 1.0)] * middle.size
        functions = {"fun": self._measure, "jac": self._slope}
        super().__init__({**functions, "x0": middle, "bounds": bounds, "constraints": self._constraints()})

    def at(self, x: ArrayLike) -> dict[str, float]:
        """Return variables, measures and constraints by name at a result x (e,), in the units of the problem."""
        point, problem = checks.reals("x must be", x), self._problem
        if point.shape != self["x0"].shape:
            raise ValueError(f"x must have shape {self['x0'].shape}, got {point.shape}")
        names = [*problem.variables, *problem.objectives, *map(str, problem.constraints)]
        numbers = np.concatenate([self._designs(point)[0], self._values(point)[0]])
        return dict(zip(names, numbers.tolist(), strict=True))

    def _designs(self, points: Real) -> Real:
        """Return designs (n, d) at points (n, e) or (e,) of the unit box."""
        lower, upper = self._coding.lower, self._coding.upper
        return self._coding.decode(np.clip(lower + np.atleast_2d(points) * (upper - lower), lower, upper))

    def _values(self, points: Real) -> Real:
        """Return objectives and constraints (n, m + c) at points (n, e) or (e,)."""
        return np.asarray(self._problem.evaluate(self._designs(points)), dtype=float)

    def _slopes(self, x: Real) -> Real:
        """Return slopes (e, m + c) at a point (e,) by central differences within the box."""
        nearest = np.clip(x, 0.0, 1.0)
        above, below = (np.clip(nearest + step * np.eye(x.size), 0.0, 1.0) for step in (_STEP, -_STEP))
        rise = np.subtract(*np.split(self._values(np.concatenate([above, below])), 2))
        return np.asarray(rise / (above - below).diagonal()[:, None])

    def _measure(self, x: Real) -> Any:
        """Return the measure at a point (e,), or at points (e, n), over that in the middle of the box."""
        found = self._values(np.transpose(x))[:, self._column] / self._scale
        return found if np.ndim(x) > 1 else float(found[0])

    def _slope(self, x: Real) -> Real:
        return self._slopes(x)[:, self._column] / self._scale

    def _constraint(self, x: Real) -> Real:
        """Return the constraints (c,) at a point (e,), or (c, n) at points (e, n)."""
        found = self._values(np.transpose(x))[:, self._m :].T
        return found if np.ndim(x) > 1 else found[:, 0]

    def _constraint_slopes(self, x: Real) -> Real:
        return self._slopes(x)[:, self._m :].T

    def _constraints(self) -> list[Any]:
        from scipy.optimize import NonlinearConstraint

        limits = NonlinearConstraint(self._constraint, -np.inf, 0.0, jac=self._constraint_slopes)
        return [limits] if self._problem.constraints else []


def as_scipy(problem: Minimisable, measure: str) -> ScipyProblem:
    """Return one measure of a problem, to be minimised within its limits by SciPy.

    SciPy's steps and tolerances expect numbers of size 1: a point ``x`` has a number from 0 to 1 for each variable
    between its bounds, of a logarithmic one by its logarithm, none of one that is held; ``fun`` is the measure
    over its size in the middle of the box. Beyond the box the nearest design in it counts.

    Parameters
    ----------
    problem : Problem or RideProblem
        Its constraints are the limits.
    measure : str
        Name of an objective of the problem.

    Returns
    -------
    ScipyProblem
        A mapping with the arguments of `scipy.optimize.minimize`: ``fun``, ``jac`` (central differences, all in
        one evaluation), ``x0`` (the middle), ``bounds`` and ``constraints``. ``fun`` and constraints take points
        as columns too (``vectorized=True``). Its method ``at(x)`` returns variables, measures and constraints by
        name in their own units.

    Raises
    ------
    ValueError
        If the measure is no objective, or a variable is a whole number or of a catalogue.

    Notes
    -----
    A measure of several wheels is that of the worst and has kinks, where a method that descends by slopes may
    stop short: start it from several points, or take the measure of each wheel.

    Examples
    --------
    Least discomfort with a travel of 10 mm, by a gradient and by differential evolution:

    >>> from scipy import optimize
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> limits = ["SWS <= 0.01"]
    >>> problem = sc.RideProblem(
    ...     file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, constraints=limits
    ... )
    >>> least = sc.as_scipy(problem, "ACC")
    >>> one = least.at(optimize.minimize(**least).x)
    >>> other = optimize.differential_evolution(
    ...     least["fun"], least["bounds"], constraints=least["constraints"], rng=1
    ... )
    >>> for found in (one, least.at(other.x)):
    ...     print(f"damper {found['damper']:.0f} N s/m: ACC {found['ACC']:.3f} m/s^2, SWS {found['SWS']:.4f} m")
    damper 1833 N s/m: ACC 1.244 m/s^2, SWS 0.0100 m
    damper 1833 N s/m: ACC 1.244 m/s^2, SWS 0.0100 m
    """
    checks.with_method("problem", problem, "evaluate")
    checks.one_of("measure", measure, problem.objectives)
    for name, kind in problem.kinds.items():
        if kind not in _CONTINUOUS:
            raise ValueError(
                f"kinds must be log or fixed for SciPy, which descends, got {checks.shown(kind)} of {name}"
            )
    return ScipyProblem(problem, measure)
