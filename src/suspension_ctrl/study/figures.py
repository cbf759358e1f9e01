"""Figures of a comparison over many seeds, drawn from DataFrames; nothing is saved here."""

from collections.abc import Sequence
from itertools import combinations, product
from typing import Any

import moocore
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from .. import escaping
from ..quantities import Real
from ..search.indicators import best_of

LABELS = {
    "relative_hypervolume": "hypervolume / reference [-]", "igd_plus": "IGD+ [-]",
    "epsilon": "additive epsilon [-]", "spread": "generalised spread [-]", "evaluations": "evaluations [-]",
    "seconds": "time [s]",
}  # fmt: skip
# The palette of Okabe and Ito, and grey: colour-blind readers can distinguish them.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#666666")
STYLES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (1, 1)), (0, (3, 1, 1, 1)))


def anytime(ax: Axes, quality: pd.DataFrame, over: str = "evaluations") -> None:
    """Draw median and quartiles of the hypervolume over "evaluations" or "seconds", from `lenses.with_seconds`."""
    value = "relative_hypervolume"
    by_algorithm = quality.groupby("algorithm", sort=False)
    for colour, style, (algorithm, part) in zip(COLOURS, STYLES, by_algorithm, strict=False):
        low, middle, high = (part.groupby(over)[value].quantile(q) for q in (0.25, 0.5, 0.75))
        ax.plot(middle.index, middle, color=colour, ls=style, lw=1.4, label=escaping.figure(str(algorithm)))
        ax.fill_between(middle.index, low, high, color=colour, alpha=0.2, lw=0)
    ax.set(xscale="log", xlabel=LABELS[over], ylabel=LABELS[value])
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.grid(which="both", alpha=0.25)


def anytime_panels(quality: pd.DataFrame, sets: Sequence[str]) -> Figure:
    """Draw `anytime` of one population: a row of panels per set, over evaluations and over time."""
    figure, axes = panels(2 * len(sets), columns=2)
    for ax, (chosen, over) in zip(axes, product(sets, ("evaluations", "seconds")), strict=True):
        anytime(ax, quality[quality.set == chosen], over)
        ax.set_title(f"{escaping.figure(chosen)}, N = {quality.population.iloc[0]}", fontsize=10)
    axes[0].legend(frameon=False, fontsize=8)
    return figure


def box_panels(runs: pd.DataFrame, values: Sequence[str]) -> Figure:
    """Draw box plots of each value by algorithm, without runs that have no feasible design."""
    figure, axes = panels(len(values), columns=2)
    style: dict[str, Any] = {"medianprops": {"color": "black"}, "flierprops": {"markersize": 3}}
    for ax, value in zip(axes, values, strict=True):
        groups = {str(name): part[value] for name, part in runs.groupby("algorithm", sort=False)}
        finite = [group[np.isfinite(group)] for group in groups.values()]
        box = ax.boxplot(finite, tick_labels=list(map(escaping.figure, groups)), patch_artist=True, **style)
        for colour, patch in zip(COLOURS, box["boxes"], strict=False):
            patch.set(facecolor=colour, alpha=0.5)
        ax.set_ylabel(LABELS[value])
        ax.tick_params(axis="x", rotation=25)
        ax.grid(axis="y", alpha=0.25)
    return figure


def attainment_panels(
    first: pd.DataFrame, second: pd.DataFrame, objectives: Sequence[str], names: Sequence[str]
) -> Figure:
    """Draw `attainment_differences` of each pair of objectives; `names` are of both algorithms."""
    pairs = list(combinations(objectives, 2))
    figure, axes = panels(len(pairs))
    for ax, pair in zip(axes, pairs, strict=True):
        drawn = attainment_differences(ax, first, second, pair)
    figure.colorbar(drawn, ax=axes, label=escaping.figure(f"share of runs attaining: {names[0]} less {names[1]}"))
    return figure


def attainment_differences(
    ax: Axes, first: pd.DataFrame, second: pd.DataFrame, objectives: tuple[str, str]
) -> Any:
    """Draw the difference of two algorithms in the share of runs that attain a point of two objectives.

    `first` and `second` are feasible designs of final populations with a column ``seed``; only common seeds count.
    Returns the coloured patches for a colour bar.

    V. Grunert da Fonseca, C. M. Fonseca, A. O. Hall, "Inferential performance assessment of stochastic optimisers
    and the attainment function", EMO 2001; computed by moocore.
    """
    seeds = sorted(set(first.seed) & set(second.seed))  # moocore expects as many runs on both sides
    sides = [_fronts(side, seeds, objectives) for side in (first, second)]
    rectangles = moocore.eafdiff(*sides, rectangles=True)
    every = np.concatenate(sides)[:, :2]
    low, high = every.min(axis=0), every.max(axis=0)
    x0, y0, x1, y1 = (np.clip(rectangles[:, c], low[c % 2], high[c % 2]) for c in range(4))
    corners = np.stack([np.stack(pair, axis=-1) for pair in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))], axis=1)
    style: dict[str, Any] = {"cmap": "PuOr", "clim": (-1, 1), "lw": 0, "rasterized": True}
    patches = PolyCollection(list(corners), array=rectangles[:, 4] / len(seeds), **style)
    ax.add_collection(patches)
    xlim, ylim = np.transpose([low - 0.02 * (high - low), high + 0.02 * (high - low)])
    ax.set(xlim=xlim, ylim=ylim, xlabel=escaping.figure(objectives[0]), ylabel=escaping.figure(objectives[1]))
    return patches


def _fronts(populations: pd.DataFrame, seeds: list[int], objectives: tuple[str, str]) -> Real:
    """Return the non-dominated pairs of objectives of each run with its number from 1, (n, 3)."""
    fronts = []
    for run, seed in enumerate(seeds, start=1):
        best = best_of(populations.loc[populations.seed == seed, list(objectives)].to_numpy(dtype=float))
        fronts.append(np.column_stack([best, np.full(len(best), float(run))]))
    return np.concatenate(fronts)


def panels(count: int, columns: int = 3) -> tuple[Figure, list[Axes]]:
    """Return a figure with `count` panels, `columns` in a row, and its Axes."""
    rows = -(-count // columns)
    figure = Figure(figsize=(4.2 * columns, 3.4 * rows + 0.5), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False).flat)
    for ax in axes[count:]:
        ax.remove()
    return figure, axes[:count]
