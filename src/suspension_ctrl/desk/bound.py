"""The bound of all controllers: criteria of designs by the weights of optimal ones, and its edge in a picture."""

from typing import TYPE_CHECKING

import numpy as np

from ..quantities import Real

if TYPE_CHECKING:
    import pandas as pd

LQR, LQG, SKYHOOK = "LQR", "LQG", "skyhook"
LEAST, WITHIN = "least [-]", "within band [-]"


def criterion(table: "pd.DataFrame", objectives: Real) -> Real:
    """Return the criterion (n, k) of objectives (n, m) by the weights of each LQR of a table of `attainable`."""
    rows = table[table["controller"] == LQR]
    weights = rows.filter(regex=r" weight \[-\]$").to_numpy()
    return np.asarray((objectives / table.attrs["present"]) ** 2 @ weights.T)


def edge(table: "pd.DataFrame", front: "pd.DataFrame", pair: tuple[str, str], x: Real) -> Real:
    """Return the least value (n,) of the second of a pair of measures at values x (n,) of the first.

    It is that with all other measures at most as large as on a front, by the criterion of each LQR of a table
    within the band.
    """
    headers, present = table.attrs["measures"], np.array(table.attrs["present"])
    across, up = (headers.index(one) for one in pair)
    rows = table[table["controller"] == LQR]
    weights = rows.filter(regex=r" weight \[-\]$").to_numpy()
    most = (front[headers].max().to_numpy() / present) ** 2
    most[[across, up]] = 0.0
    left = rows[WITHIN].to_numpy() - weights @ most - np.outer((x / present[across]) ** 2, weights[:, across])
    return np.asarray(present[up] * np.sqrt(np.maximum(left / weights[:, up], 0.0).max(axis=1)))
