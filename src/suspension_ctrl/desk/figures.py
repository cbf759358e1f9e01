"""Figures of a decision: front with limits, present design and candidates, beside what is attainable; changes."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from .. import checks, escaping
from ..quantities import Real
from ..study.figures import COLOURS, panels
from ..tables.headers import shown_header
from .bound import LQR, SKYHOOK, edge

_GREY = "#bbbbbb"
_FROM_POINT = 11.0  # distance of a number from its candidate [pt]
_DIRECTIONS = np.exp(2j * np.pi * (np.arange(16) + 0.5) / 16)


def front_figure(
    front: pd.DataFrame,
    free: pd.DataFrame,
    table: pd.DataFrame,
    objectives: Sequence[str],
    limits: Mapping[str, float],
    title: str,
    attainable: pd.DataFrame | None = None,
) -> Figure:
    """Draw a front over one objective, a panel for each of the others, with candidates by their numbers.

    Tables have columns `objectives`, the first of them across; `free` is the front without limits, empty if there
    are none. `limits` are values by column; `attainable` is the table of that function, drawn behind.
    """
    across, *up = objectives
    figure, axes = panels(len(up), columns=min(2, len(up)))
    for ax, header in zip(axes, up, strict=True):
        pair = (across, header)
        if attainable is not None:
            _controllers(ax, attainable, front, pair, [front, free, table])
        if len(free):
            _dots(ax, free, pair, color=_GREY, label="front without limits")
        _dots(ax, front, pair, color=COLOURS[0], label="front within limits" if len(free) else "front")
        _limit_lines(ax, limits, pair)
        chosen, present = table[table.index > 0], table[table.index == 0]
        x, y = _columns(chosen, pair)
        ax.plot(x, y, "o", ms=7, mfc="none", mec=COLOURS[1], mew=1.4, label="candidates")
        if len(present):
            ax.plot(*_columns(present, pair), "X", ms=9, color="black", label="present design")
        _numbers(ax, chosen.index, x, y)
        ax.set(xlabel=_label(across), ylabel=_label(header))
        ax.grid(alpha=0.25)
    known: dict[str, Any] = {str(line.get_label()): line for ax in axes for line in ax.get_lines()}
    if attainable is not None:
        known |= {str(area.get_label()): area for area in axes[0].collections}
    style: dict[str, Any] = {"loc": "outside upper center", "ncols": 3 if len(up) > 1 else 2, "frameon": False}
    figure.legend(list(known.values()), list(known), title=escaping.figure(title), **style)
    return figure


def attainable_figure(table: pd.DataFrame, front: pd.DataFrame) -> Figure:
    """Draw a front and what an active suspension could attain, over the travel.

    Parameters
    ----------
    table : DataFrame
        Of `attainable`.
    front : DataFrame
        Front of passive designs, ``run.front()``, with the measures of the table.

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each further measure. A controller in the grey area, with the measures that the panel does not
        show at most as large as on the front, costs more beyond the band than an optimal one: see `attainable`.

    Raises
    ------
    ValueError
        If the front lacks a measure of the table.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=100), iterations=20, seed=1)
    >>> figure = sc.attainable_figure(sc.attainable(problem, points=16), run.front())
    >>> [ax.get_ylabel() for ax in figure.axes]
    ['ACC [m/s²]', 'DTL [kN]']
    """
    objectives = table.attrs["measures"]
    checks.listed("front", front)
    for header in objectives:
        checks.one_of("measures of the table", header, list(front.columns))
    across = next((one for one in objectives if one.endswith(" [m]")), objectives[0])
    up = [one for one in objectives if one != across]
    figure, axes = panels(len(up), columns=min(2, len(up)))
    for ax, header in zip(axes, up, strict=True):
        pair = (across, header)
        _controllers(ax, table, front, pair, [front])
        _dots(ax, front, pair, color=COLOURS[0], label="front of passive designs")
        ax.set(xlabel=_label(across), ylabel=_label(header))
        ax.grid(alpha=0.25)
    lines, labels = axes[0].get_legend_handles_labels()
    figure.legend(lines, labels, loc="outside upper center", ncols=2, frameon=False)
    return figure


def _controllers(
    ax: Axes, table: pd.DataFrame, front: pd.DataFrame, pair: tuple[str, str], seen: Sequence[pd.DataFrame]
) -> None:
    """Draw optimal controllers, skyhook and the area beyond the bound, in a frame of all that is `seen`.

    Other measures of those drawn are at most as large as on the front.
    """
    others = [one for one in table.attrs["measures"] if one not in pair]
    inside = table[(table[others] <= front[others].max()).all(axis=1)]
    shown = pd.concat([*seen, inside[inside.controller == SKYHOOK]])
    (left, right), (low, high) = (_frame(shown[one].to_numpy(dtype=float)) for one in pair)
    x = np.linspace(left, right, 200)
    y = edge(table, front, pair, x)
    across, up = (shown_header(one)[1] for one in pair)
    style: dict[str, Any] = {"ls": "none", "rasterized": True}
    for name, marker, colour in ((LQR, "^", COLOURS[4]), (SKYHOOK, "s", COLOURS[2])):
        rows = inside[inside.controller == name]
        label = "active, LQR" if name == LQR else name
        ax.plot(*_columns(rows, pair), marker, ms=3, mfc="none", color=colour, label=label, **style)
    label = "only with more beyond the band"
    ax.fill_between(across * x, up * low, up * np.maximum(y, low), color="0.88", lw=0, label=label)
    ax.set(xlim=(across * left, across * right), ylim=(up * low, up * high))


def _frame(values: Real) -> tuple[float, float]:
    """Return the least value, less a half, and the largest, and a tenth more."""
    return 0.5 * float(values.min()), 1.1 * float(values.max())


def changes_figure(table: pd.DataFrame, objectives: Sequence[str], title: str) -> Figure:
    """Draw the change of each objective against the present design by candidate; less is better."""
    chosen = table[table.index > 0]
    figure, axes = panels(len(objectives), columns=min(3, len(objectives)))
    figure.suptitle(escaping.figure(title), fontsize=10)
    places = np.arange(len(chosen))
    for ax, name in zip(axes, objectives, strict=True):
        change = chosen[f"{name} change [%]"].to_numpy(dtype=float)
        colours = [COLOURS[0] if value <= 0 else COLOURS[1] for value in change]
        bars = ax.barh(places, change, color=colours)
        ax.bar_label(bars, [f"{value:+.0f}" for value in change], padding=2, fontsize=8)
        ax.axvline(0.0, color="black", lw=0.8)
        ax.set(xlabel=f"change of {escaping.figure(name)}, less is better [%]", yticks=places)
        ax.set_yticklabels(
            [escaping.figure(f"{n} {text}") for n, text in zip(chosen.index, chosen.name, strict=True)]
        )
        ax.invert_yaxis()
        ax.margins(x=0.18)
        ax.grid(axis="x", alpha=0.25)
        ax.label_outer()
    return figure


def _dots(ax: Axes, frame: pd.DataFrame, pair: tuple[str, str], **style: Any) -> None:
    ax.plot(*_columns(frame, pair), ".", ms=3, rasterized=True, **style)


def _numbers(ax: Axes, numbers: Iterable[int], x: Real, y: Real) -> None:
    """Write numbers beside points (n,), in the directions farthest from other points, numbers and the frame."""
    points = np.vstack(
        [np.reshape(line.get_xydata(), (-1, 2)) for line in ax.get_lines() if line.get_marker() != "None"]
    )
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    width, height = (float(side) * 72 / ax.figure.dpi for side in ax.get_window_extent().size)

    def on_paper(x: Real, y: Real) -> Any:
        """Return places [pt] as complex numbers."""
        return (x - left) / (right - left) * width + 1j * (y - low) / (high - low) * height

    taken = on_paper(*points.T)
    for number, place, xy in zip(numbers, on_paper(x, y), zip(x, y, strict=True), strict=True):
        tried = place + _FROM_POINT * _DIRECTIONS
        frame = np.min([tried.real, width - tried.real, tried.imag, height - tried.imag], axis=0)
        room = np.minimum(abs(tried[:, None] - taken).min(axis=1), 2 * frame)
        best = tried[room.argmax()]
        taken = np.append(taken, best)
        offset = best - place
        style: dict[str, Any] = {"textcoords": "offset points", "ha": "center", "va": "center", "fontsize": 10}
        text = ax.annotate(str(number), xy, xytext=(offset.real, offset.imag), **style)
        text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _limit_lines(ax: Axes, limits: Mapping[str, float], pair: tuple[str, str]) -> None:
    style: dict[str, Any] = {"color": "black", "ls": "--", "lw": 1.0, "label": "limit"}
    for header, line in zip(pair, (ax.axvline, ax.axhline), strict=True):
        if header in limits:
            line(limits[header] * shown_header(header)[1], **style)


def _columns(frame: pd.DataFrame, pair: tuple[str, str]) -> list[Any]:
    """Return the columns (n,) of a pair of objectives as engineers read them."""
    return [frame[header].to_numpy(dtype=float) * shown_header(header)[1] for header in pair]


def _label(header: str) -> str:
    return escaping.figure(shown_header(header)[0].replace("^2", "²"))
