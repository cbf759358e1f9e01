"""Figure of a design over a scatter: the distribution of each measure with its nominal value and its limits."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .. import escaping
from ..response.measures.limits import Limit
from ..response.problem import RideProblem
from ..response.scatter import Scatter, Tolerance
from ..tables.headers import shown_unit, shown_value
from .candidate_table import Present
from .scatter_table import Sampled, samples_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_BINS, _COLUMNS = 25, 3


def robustness_figure(
    problem: RideProblem,
    design: Present,
    scatter: Scatter | Mapping[str, Tolerance] | None = None,
    samples: int | None = None,
    seed: int | None = None,
) -> "Figure":
    """Draw the distribution of each measure and of each limit of a design over a scatter.

    Parameters
    ----------
    problem, design, scatter, samples, seed
        As of `robustness`.

    Returns
    -------
    matplotlib.figure.Figure
        A histogram by measure, with the nominal value; by limit also the limit and the share of samples beyond it.

    Raises
    ------
    ValueError
        As of `robustness`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road, limits = sc.Iso8608Road("C"), ["SWS <= 12mm"]
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds, constraints=limits)
    >>> figure = sc.robustness_figure(problem, file.setting, {"spring": 0.05, "damper": 0.15}, samples=256)
    >>> [axes.get_xlabel() for axes in figure.axes]
    ['ACC [m/s^2]', 'DTL [kN]', 'SWS [mm]']
    >>> figure.axes[2].get_title()
    '0 % beyond 12 mm'
    """
    import matplotlib.pyplot as plt

    found = samples_of(problem, design, scatter, samples, seed)
    limited = {found.measure(k) for k, one in enumerate(found.judged) if isinstance(one, Limit)}
    drawn = [k for k, one in enumerate(found.judged) if one not in limited]
    rows = -(-len(drawn) // _COLUMNS)
    columns = -(-len(drawn) // rows)
    size = (3.6 * columns, 2.8 * rows + 0.5)
    figure, grid = plt.subplots(rows, columns, squeeze=False, figsize=size, layout="constrained")
    axes = grid.ravel()[: len(drawn)]
    for unused in grid.ravel()[len(drawn) :]:
        unused.remove()
    for ax, k in zip(axes, drawn, strict=True):
        _draw(ax, found, k)
    known = {str(one.get_label()): one for ax in axes for one in ax.get_legend_handles_labels()[0]}
    figure.legend(list(known.values()), list(known), loc="outside upper center", ncols=len(known), frameon=False)
    axes[0].set_ylabel(f"of {found.scatter.samples} samples [-]")
    return figure


def _draw(ax: "Axes", found: Sampled, k: int) -> None:
    """Draw a measure or a limit."""
    judged, measure = found.judged[k], found.measure(k)
    unit, factor = shown_unit(measure.unit)
    ax.hist(factor * found.samples[0, k], bins=_BINS, color="#0072B2", alpha=0.6, label="scatter")
    ax.axvline(factor * found.nominal[0, k], color="black", lw=1.2, label="nominal")
    if isinstance(judged, Limit):
        ax.axvline(factor * judged.value, color="#D55E00", ls="--", lw=1.2, label="limit")
        ax.set_title(f"{found.beyond(k):.0f} % beyond {shown_value(judged.value, measure.unit)}", fontsize=9)
    ax.set_xlabel(f"{escaping.figure(measure.label)} [{unit}]")
    ax.grid(alpha=0.25)
