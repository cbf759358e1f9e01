"""What a search hands out after each iteration."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class State:
    """Population of a search: designs (n, d), objectives (n, m) and the least value seen of each, (m,)."""

    designs: NDArray[np.float64]
    objectives: NDArray[np.float64]
    ideal: NDArray[np.float64]
