"""Quadrature nodes for a box of designs: few of many, with weights of their own.

The integrands of all designs in a box lie close to a space of few dimensions. Weights, none of them negative, that
integrate a basis of it are a problem of least squares [1]_; it has a solution at as many nodes as dimensions.
Bremer, Gimbutas and Rokhlin [2]_ build quadratures for a space of functions in this way.

.. [1] C. L. Lawson, R. J. Hanson, "Solving least squares problems", Prentice-Hall, 1974, chapter 23.
.. [2] J. Bremer, Z. Gimbutas, V. Rokhlin, "A nonlinear optimization procedure for generalized Gaussian
   quadratures", SIAM J. Sci. Comput. 32(4), 2010.
"""

from typing import TYPE_CHECKING

import numpy as np

from .. import checks
from ..quantities import Real
from .quadrature import Rule

if TYPE_CHECKING:
    from .scores import Scores

ACCURACIES = 1e-9, 1e-6
"""Least and largest error that may be asked for."""
_TRAINED, _CHECKED = 32, 256
"""Designs of which the integrands are taken, for each variable, and designs on which the error is found."""
_MARGIN = 4  # between the accuracy and the largest error of those: others may be off by more
_LEAST = 1e-15  # smallest share of a direction in the space of integrands


class Placed:
    """A quadrature rule for each load case, to be given in place of a number of nodes."""

    def __init__(self, rules: tuple[Rule, ...]) -> None:
        self.rules = rules

    def __repr__(self) -> str:
        return f"{max(rule.f.size for rule in self.rules)} nodes placed"


def checked_accuracy(accuracy: float | None) -> float | None:
    """Return the accuracy, None for even nodes; ValueError for one out of reach."""
    if accuracy is not None:
        checks.within("accuracy", accuracy, *ACCURACIES)
    return accuracy


def placed(scores: "Scores", nodes: int, corners: Real, accuracy: float) -> Placed | None:
    """Return rules over a box with `corners` (k, v), None if they are not of fewer nodes, or with networks.

    Root mean squares of designs that no rule has seen differ by a quarter of the accuracy at most (relative) from
    those by twice the nodes. Working points of force laws depend on further integrals.
    """
    if any(case.vehicle.networks for case in scores.cases):
        return None
    rng, ends = np.random.default_rng(0), (corners.min(axis=0), corners.max(axis=0))
    trained, checked = (_designs(rng, count, *ends) for count in (_TRAINED * corners.shape[1], _CHECKED))
    every = scores.integrands(np.concatenate([corners, trained]), 2 * nodes)
    known, share = [(rule, *_directions(summands)) for rule, summands in every], accuracy
    while share > _LEAST:
        found = Placed(tuple(_rule(rule, basis[size > share * size[0]]) for rule, size, basis in known))
        if max(rule.f.size for rule in found.rules) >= nodes:
            return None
        errors = scores.changes(np.concatenate([corners, checked]), found, 2 * nodes)
        if max(float(one.max(initial=0.0)) for one in errors) <= accuracy / _MARGIN:
            return found
        share /= 4
    return None


def _designs(rng: np.random.Generator, count: int, lower: Real, upper: Real) -> Real:
    """Draw designs (count, v) of a box, half of them near its faces, where the integrands differ most."""
    share = rng.random((count, lower.size))
    share[::2] = np.sin(np.pi / 2 * share[::2]) ** 2
    return lower + (upper - lower) * share


def _directions(summands: Real) -> tuple[Real, Real]:
    """Return the sizes (n,) of the directions (n, n) of summands (k, n), those of each integral over their sum."""
    sums = summands.sum(axis=1)
    _, size, basis = np.linalg.svd(summands[sums > 0] / sums[sums > 0, None], full_matrices=False)
    return size, basis


def _rule(fine: Rule, basis: Real) -> Rule:
    """Return the nodes of a rule, with other weights, that give the same sums of a basis (k, n) of summands."""
    from scipy.optimize import nnls

    factor, _ = nnls(basis, basis.sum(axis=1), maxiter=50 * fine.f.size)
    taken = np.flatnonzero(factor)
    return Rule(fine.f[taken], (fine.w * factor)[taken])
