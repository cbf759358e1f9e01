"""Figure of what 1 % more of each variable and parameter does to the measures of a design."""

from typing import TYPE_CHECKING

import numpy as np

from .. import checks, escaping
from ..response.problem import RideProblem
from .candidate_table import Present
from .slope_table import Slopes, slopes_at

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLUMNS = 3


def sensitivity_figure(problem: RideProblem, design: Present, most: int = 8) -> "Figure":
    """Draw what 1 % more of each variable, coefficient and parameter does to each measure, the largest first.

    Parameters
    ----------
    problem, design
        As of `sensitivity`.
    most : int
        Number of bars for each measure.

    Returns
    -------
    matplotlib.figure.Figure
        Bars of the changes [%] by measure.

    Raises
    ------
    ValueError
        As of `sensitivity`, or about `most`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road = sc.Iso8608Road("C")
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    >>> figure = sc.sensitivity_figure(problem, file.setting, most=3)
    >>> [label.get_text() for label in figure.axes[2].get_yticklabels()]
    ['tyre_stiffness', 'installation_ratio', 'wheel_mass']
    """
    import matplotlib.pyplot as plt

    most = checks.at_least("most", most, 1)
    found = slopes_at(problem, design)
    rows = -(-len(found.judged) // _COLUMNS)
    columns, bars = -(-len(found.judged) // rows), min(most, len(found.sources))
    size = (3.8 * columns, (0.28 * bars + 0.9) * rows)
    figure, grid = plt.subplots(rows, columns, squeeze=False, figsize=size, layout="constrained")
    for ax in grid.ravel()[len(found.judged) :]:
        ax.remove()
    for k, ax in enumerate(grid.ravel()[: len(found.judged)]):
        _draw(ax, found, k, bars)
    return figure


def _draw(ax: "Axes", found: Slopes, k: int, bars: int) -> None:
    """Draw the largest changes of a measure."""
    changes = np.nan_to_num(found.shares[:, k])
    order = np.argsort(-np.abs(changes), kind="stable")[:bars]
    places, shown = np.arange(len(order)), changes[order]
    drawn = ax.barh(places, shown, color=["#0072B2" if one <= 0 else "#D55E00" for one in shown])
    ax.bar_label(drawn, [f"{one:+.2f}" for one in shown], padding=2, fontsize=8)
    names = [escaping.figure(found.sources[i].name) for i in order]
    ax.set_yticks(places, names, fontsize=8)
    ax.set_xlabel(f"{escaping.figure(found.labels[k])} by 1 % more [%]")
    ax.axvline(0.0, color="black", lw=0.8)
    ax.invert_yaxis()
    ax.margins(x=0.2)
    ax.grid(axis="x", alpha=0.25)
