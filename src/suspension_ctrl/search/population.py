"""What a search hands out after each iteration."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .constraints import violations


@dataclass(frozen=True)
class State:
    """Population of a search.

    Parameters
    ----------
    designs : (n, d) ndarray
    objectives : (n, m) ndarray
    constraints : (n, c) ndarray
        Values g of the constraints, met where g <= 0.
    ideal : (m,) ndarray
        Least value seen of each objective, among feasible designs as soon as there is one.
    evaluations : int
        Designs evaluated so far.
    """

    designs: NDArray[np.float64]
    objectives: NDArray[np.float64]
    constraints: NDArray[np.float64]
    ideal: NDArray[np.float64]
    evaluations: int

    @classmethod
    def of(
        cls,
        designs: NDArray[np.float64],
        values: NDArray[np.float64],
        ideal: NDArray[np.float64],
        evaluations: int,
    ) -> "State":
        """Return the state of a population with these values (n, m + c)."""
        m = ideal.size
        objectives, constraints = np.ascontiguousarray(values[:, :m]), np.ascontiguousarray(values[:, m:])
        return cls(designs, objectives, constraints, ideal, evaluations)

    @cached_property
    def violation(self) -> NDArray[np.float64]:
        """Total violation of each design (n,): the sum of max(0, g) over its constraints."""
        return violations(self.constraints, 0)
