"""Figures of a decision: front with limits, present design and candidates; changes against the present design."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from .. import escaping
from ..study.figures import COLOURS, panels
from ..tables.headers import shown_header

_GREY = "#bbbbbb"
_OFFSETS = ((5, 4), (5, -10), (-11, 4), (-11, -10))  # of a number from its point


def front_figure(
    front: pd.DataFrame,
    free: pd.DataFrame,
    table: pd.DataFrame,
    objectives: Sequence[str],
    limits: Mapping[str, float],
    title: str,
) -> Figure:
    """Draw a front over one objective, a panel for each of the others, with candidates by their numbers.

    Tables have columns `objectives`, the first of them across; `free` is the front without limits, empty if there
    are none. `limits` are values by column.
    """
    across, *up = objectives
    figure, axes = panels(len(up), columns=min(2, len(up)))
    for ax, header in zip(axes, up, strict=True):
        pair = (across, header)
        if len(free):
            _dots(ax, free, pair, color=_GREY, label="front without limits")
        _dots(ax, front, pair, color=COLOURS[0], label="front within limits" if len(free) else "front")
        _limit_lines(ax, limits, pair)
        chosen, present = table[table.index > 0], table[table.index == 0]
        x, y = _columns(chosen, pair)
        ax.plot(x, y, "o", ms=7, mfc="none", mec=COLOURS[1], mew=1.4, label="candidates")
        for i, number in enumerate(chosen.index):
            offset = _OFFSETS[i % len(_OFFSETS)]
            text = ax.annotate(str(number), (x[i], y[i]), xytext=offset, textcoords="offset points", fontsize=10)
            text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
        if len(present):
            ax.plot(*_columns(present, pair), "X", ms=9, color="black", label="present design")
        ax.set(xlabel=_label(across), ylabel=_label(header))
        ax.grid(alpha=0.25)
    known = {str(line.get_label()): line for ax in axes for line in ax.get_lines()}
    style: dict[str, Any] = {"loc": "outside upper center", "ncols": 3, "frameon": False}
    figure.legend(list(known.values()), list(known), title=escaping.figure(title), **style)
    return figure


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
