"""One page for the supplier of springs, dampers, bars and stops of a design."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from .. import escaping
from ..response.problem import RideProblem
from .candidate_table import Present
from .curves import Curve, curves_of, force_of
from .designs import present_of, setting_at, values_of
from .pages import PAGE, Content, Picture, fill
from .parts import Part, parts_of
from .sheet_tables import checked_tolerances, curve_blocks, described, measure_block, part_block, range_block

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES, _POINTS = 8, 201  # of a picture, and of a line
_IN_COLUMN = 3  # of a legend
_REACH = 4.0  # forces of stops that are drawn, over that of the softest spring


def supplier_sheet(
    problem: RideProblem,
    design: Present,
    *,
    present: Present | None = None,
    name: str = "",
    tolerances: Mapping[str, float] | None = None,
    date: str = "",
) -> "Figure":
    """Draw one page, A4, with all that a supplier of springs, dampers, bars and stops asks for.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like, or mapping of str to float
        Variables of the design.
    present : (d,) array_like, or mapping of str to float, optional
        Design of today, to compare with.
    name : str
        Title: the vehicle and the design.
    tolerances : mapping of str to float, optional
        By coefficient its tolerance as a share, 0.05 for 5 %.
    date : str
        Printed as it is; without it the page depends on the design alone.

    Returns
    -------
    matplotlib.figure.Figure
        Values with units and tolerances; curves of dampers, stops and springs with tables of force; static
        deflection, root mean squares and largest expected values of travel, rate and force of each strut in each
        load case; measures beside those of the present design. ``figure.savefig("sheet.pdf")`` writes it.

    Raises
    ------
    ValueError
        If a design lacks a variable or has an unknown one, or a tolerance is not of a coefficient and above zero.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(car.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=car.bounds)
    >>> figure = sc.supplier_sheet(problem, [12.389e3, 1616.3], present=car.setting, tolerances={"damper": 0.1})
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['tension [N]']
    """
    import matplotlib.pyplot as plt

    chosen, before = values_of("design", problem, design), present_of(problem, present)
    shares = checked_tolerances(problem, chosen, tolerances or {})
    figure = plt.figure(figsize=PAGE)
    draw_sheet(figure, problem, chosen, before, name=name, tolerances=shares, date=date)
    return figure


def draw_sheet(
    figure: "Figure",
    problem: RideProblem,
    design: Mapping[str, float],
    present: Mapping[str, float],
    *,
    name: str,
    tolerances: Mapping[str, float],
    date: str,
) -> None:
    """Draw the sheet on a figure of the size of a page; `present` may be empty."""
    vehicle, values = problem.cases[0].vehicle.at(setting_at(problem, design))
    parts = parts_of(vehicle, values)
    today = problem.cases[0].vehicle.at(setting_at(problem, present))[1] if present else {}
    curves = curves_of(parts)
    contents: list[Content] = [
        *described(problem),
        part_block(parts, tolerances, today),
        *_pictures(parts, curves),
        *curve_blocks(curves),
        range_block(problem, design),
        measure_block(problem, design, present),
    ]
    fill(figure, name or "Springs and dampers", date, contents)


def _pictures(parts: Sequence[Part], curves: Sequence[Curve]) -> list[Picture]:
    """Return the picture of the curves, dampers beside springs and stops."""
    named = {part.name: part for part in parts}
    drawn = []
    for of_rate in (True, False):
        own = [one for one in curves if one.of_rate == of_rate][:_LINES]
        if own:
            drawn.append(partial(_draw, [(named[one.part], one) for one in own], of_rate))
    return [Picture(drawn)] if drawn else []


def _draw(own: Sequence[tuple[Part, Curve]], of_rate: bool, axes: "Axes") -> None:
    """Draw forces over rate [m/s] or deflection [mm], points of the table marked."""
    for i, (part, curve) in enumerate(own):
        x = np.linspace(curve.x[0], curve.x[-1], _POINTS)
        scale = 1.0 if of_rate else 1e3
        axes.plot(scale * x, force_of(part, x), color=f"C{i}", lw=1, label=escaping.figure(part.name))
        axes.plot(scale * curve.x, curve.force, ".", color=f"C{i}", ms=3)
    largest = [float(np.abs(curve.force).max()) for _, curve in own if curve.force.any()]
    if not of_rate and largest and max(largest) > (most := _REACH * min(largest)):  # of stops
        axes.set_ylim(-most, most)
    axes.set_xlabel("rate [m/s]" if of_rate else "deflection [mm]", fontsize=7)
    axes.set_ylabel("tension [N]", fontsize=7)
    axes.tick_params(labelsize=7)
    axes.locator_params(axis="x", nbins=6)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=6, loc="upper left", ncols=-(-len(own) // _IN_COLUMN), edgecolor="none", framealpha=0.7)
