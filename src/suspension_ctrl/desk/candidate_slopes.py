"""What changes the measures of candidates most, as a small table."""

from typing import TYPE_CHECKING

import numpy as np

from ..quantities import column_headers
from ..response.problem import RideProblem
from .candidate_table import reaching
from .slope_table import STEP

if TYPE_CHECKING:
    import pandas as pd

_SHOWN = 0.005  # least change that is not 0.00 % [%]


def candidate_slopes(problem: RideProblem, table: "pd.DataFrame") -> "pd.DataFrame":
    """Return by candidate the variable that changes each measure of the nominal vehicle most, and by how much.

    Changes are by 1 % more of a variable; at an optimum of the measure there may be none.
    """
    import pandas as pd

    designs = table[column_headers(problem.variables, problem.units)].to_numpy(dtype=float)
    wide, names = problem.nominal, np.array(problem.variables)
    for design in designs:  # the present one may be outside of the bounds
        wide = reaching(wide, design)
    values, jacobian = wide.with_jacobian(designs)
    changes = 100 * STEP * jacobian * designs[:, np.newaxis]
    columns: dict[str, object] = {"name": table["name"].to_list()}
    for k, label in enumerate(wide.objectives):
        size = np.abs(values[:, k, np.newaxis])
        shares = wide.measures[k].sign * changes[:, k] / np.where(size > 0, size, np.nan)
        most = np.nan_to_num(np.abs(shares)).argmax(axis=1)
        columns[f"{label} by 1 % more"] = [
            f"{name} {share:+.2f} %" if abs(share) >= _SHOWN else "none"
            for name, share in zip(names[most], shares[np.arange(len(most)), most], strict=True)
        ]
    return pd.DataFrame(columns, index=table.index)
