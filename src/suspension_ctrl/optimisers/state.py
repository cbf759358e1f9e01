"""What a search hands out after each iteration."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class State:
    """Population of a search.

    Parameters
    ----------
    designs : (n, d) ndarray
    objectives : (n, m) ndarray
    ideal : (m,) ndarray
        Least value seen of each objective.
    evaluations : int
        Designs evaluated so far.
    """

    designs: NDArray[np.float64]
    objectives: NDArray[np.float64]
    ideal: NDArray[np.float64]
    evaluations: int
