"""Figures of a comparison over many seeds, drawn from DataFrames; nothing is saved here."""

from collections.abc import Sequence
from itertools import combinations, product
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from .. import escaping
from ..quantities import Integer, Real
from ..search.indicators import best_of
from ..tables.headers import shown_header
from .comparison import CONFIGURATION

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LABELS = {
    "relative_hypervolume": "hypervolume / reference [-], more is better", "igd_plus": "IGD+ [-], less is better",
    "epsilon": "additive epsilon [-], less is better", "spread": "generalised spread [-], less is more even",
    "evaluations": "evaluations [-]", "seconds": "time [s]",
}  # fmt: skip
FEW = 8
"""Number of runs below which each run is a point, and a curve lies between least and greatest values."""
CELLS = 600
"""Cells of an attainment difference along each axis, of which a panel has fewer pixels."""
# The palette of Okabe and Ito, and grey and black: colour-blind readers can distinguish them.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#666666", "#000000")
STYLES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (1, 1)), (0, (3, 1, 1, 1)), (0, (8, 2, 1, 2)))


def anytime(ax: "Axes", quality: pd.DataFrame, over: str = "evaluations") -> None:
    """Draw median and quartiles of the hypervolume over "evaluations" or "seconds", from `lenses.with_seconds`.

    Dots mark the judged states. Of fewer than `FEW` runs: median, least and greatest value.
    """
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    value = "relative_hypervolume"
    between = (0.25, 0.75) if _fewest(quality) >= FEW else (0.0, 1.0)
    by_algorithm = quality.groupby("algorithm", sort=False)
    for colour, style, (algorithm, part) in zip(COLOURS, STYLES, by_algorithm, strict=False):
        low, middle, high = (part.groupby(over)[value].quantile(q) for q in (between[0], 0.5, between[1]))
        label = escaping.figure(str(algorithm))
        ax.plot(middle.index, middle, color=colour, ls=style, lw=1.4, marker=".", ms=4, label=label)
        ax.fill_between(middle.index, low, high, color=colour, alpha=0.2, lw=0)
    ax.set(xscale="log", xlabel=LABELS[over])
    ax.set_ylabel(LABELS[value], fontsize=9)
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.tick_params(axis="x", labelsize=8)
    ax.grid(which="both", alpha=0.25)


def anytime_panels(quality: pd.DataFrame, sets: Sequence[str]) -> "Figure":
    """Draw `anytime` of one population: a row of panels per set, over evaluations and over time."""
    figure, axes = panels(2 * len(sets), columns=2)
    for ax, (chosen, over) in zip(axes, product(sets, ("evaluations", "seconds")), strict=True):
        anytime(ax, quality[quality.set == chosen], over)
        ax.set_title(escaping.figure(chosen), fontsize=10)
    spread = "quartiles" if _fewest(quality) >= FEW else "range"
    figure.suptitle(f"N = {quality.population.iloc[0]}, median and {spread} of {_runs(quality)}", fontsize=11)
    _legend_below(figure, axes[0])
    return figure


def box_panels(runs: pd.DataFrame, values: Sequence[str], title: str) -> "Figure":
    """Draw box plots of each value by algorithm, without runs that have no feasible design.

    Of fewer than `FEW` runs: a point for each, and the median.
    """
    figure, axes = panels(len(values), columns=2)
    few = _fewest(runs) < FEW
    for ax, value in zip(axes, values, strict=True):
        groups = {str(name): part[value] for name, part in runs.groupby("algorithm", sort=False)}
        finite = [group[np.isfinite(group)].to_numpy() for group in groups.values()]
        (_draw_points if few else _draw_boxes)(ax, finite)
        ax.set_xticks(range(1, len(groups) + 1), list(map(escaping.figure, groups)))
        ax.tick_params(axis="x", rotation=25)
        for label in ax.get_xticklabels():
            label.set(ha="right", rotation_mode="anchor", fontsize=8)
        ax.set_ylabel(LABELS[value], fontsize=9)
        ax.grid(axis="y", alpha=0.25)
    drawn = "points and median" if few else "boxes of median and quartiles"
    figure.suptitle(f"{title}\n{drawn} of {_runs(runs)}", fontsize=11)
    return figure


def _draw_boxes(ax: "Axes", groups: Sequence[Real]) -> None:
    style: dict[str, Any] = {"medianprops": {"color": "black"}, "flierprops": {"markersize": 3}}
    box = ax.boxplot(groups, patch_artist=True, **style)
    for colour, patch in zip(COLOURS, box["boxes"], strict=False):
        patch.set(facecolor=colour, alpha=0.5)


def _draw_points(ax: "Axes", groups: Sequence[Real]) -> None:
    """Draw each value as a point, beside one another, and the median as a line."""
    for place, (colour, group) in enumerate(zip(COLOURS, groups, strict=False), start=1):
        ax.plot(place + np.linspace(-0.15, 0.15, len(group)), group, "o", color=colour, ms=5, alpha=0.7)
        if len(group):
            ax.hlines(np.median(group), place - 0.25, place + 0.25, color="black", lw=1.2)
    ax.set_xlim(0.5, len(groups) + 0.5)


def _fewest(runs: pd.DataFrame) -> int:
    """Return the least number of runs of an algorithm."""
    return int(runs.groupby("algorithm").seed.nunique().min())


def _runs(runs: pd.DataFrame) -> str:
    """Return the numbers of runs of the algorithms: ``"31 runs each"``, ``"29 to 31 runs"``."""
    counts = runs.groupby("algorithm").seed.nunique()
    least, most = counts.min(), counts.max()
    return f"{least} runs each" if least == most else f"{least} to {most} runs"


def _legend_below(figure: "Figure", ax: "Axes", **style: Any) -> None:
    """Draw one legend for all panels under them, at most four names in a row."""
    handles, labels = ax.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=min(4, len(labels)), frameon=False, **style)


def final_populations(populations: pd.DataFrame, across: str, up: Sequence[str]) -> "Figure":
    """Draw columns `up` of final populations over column `across`, one or two algorithms, rings and dots."""
    from matplotlib.figure import Figure

    ring: dict[str, Any] = {"ms": 4.7, "mfc": "none", "color": COLOURS[0], "mew": 0.5}
    mark: dict[str, Any] = {"ms": 2.0, "color": COLOURS[1], "mew": 0}
    names = populations.algorithm.unique().tolist()
    if len(names) > 2:
        raise ValueError(f"populations must be of one or two algorithms, got {names}")
    styles = dict(zip(names, (ring, mark), strict=False))
    populations, (across, *up) = readable(populations, [across, *up])
    configurations = list(populations.groupby(CONFIGURATION))
    columns = min(2, len(configurations))
    rows = -(-len(configurations) // columns)
    figure = Figure(figsize=(5.0 * columns, 2.2 * len(up) * rows + 0.6), layout="constrained")
    places = figure.subfigures(rows, columns, squeeze=False).flat
    for place, ((population, iterations), part) in zip(places, configurations, strict=False):
        axes = place.subplots(len(up), 1, sharex=True, squeeze=False)[:, 0]
        for ax, objective in zip(axes, up, strict=True):
            for algorithm, group in part.groupby("algorithm", sort=False):
                label = escaping.figure(str(algorithm))
                ax.plot(group[across], group[objective], "o", label=label, **styles[algorithm])
            ax.set_ylabel(escaping.figure(objective))
        axes[-1].set_xlabel(escaping.figure(across))
        axes[0].set_title(f"N = {population}, {iterations} iterations", fontsize=10)
    figure.suptitle("Final populations of the first repeat; less is better on every axis", fontsize=11)
    _legend_below(figure, axes[0], markerscale=2)
    return figure


def readable(table: pd.DataFrame, headers: Sequence[str]) -> tuple[pd.DataFrame, list[str]]:
    """Return a table with columns in the units in which engineers read them, and their headers."""
    shown = {header: shown_header(header) for header in headers}
    names = {header: name.replace("^2", "²") for header, (name, _) in shown.items()}
    scaled = table.assign(**{header: table[header] * factor for header, (_, factor) in shown.items()})
    return scaled.rename(columns=names), list(names.values())


def attainment_panels(
    first: pd.DataFrame, second: pd.DataFrame, objectives: Sequence[str], names: Sequence[str]
) -> "Figure":
    """Draw `attainment_differences` of each pair of objectives; `names` are of both algorithms."""
    (first, shown), (second, _) = readable(first, objectives), readable(second, objectives)
    pairs = list(combinations(shown, 2))
    figure, axes = panels(len(pairs))
    for ax, pair in zip(axes, pairs, strict=True):
        drawn = attainment_differences(ax, first, second, pair)
    less = escaping.figure(f"{names[0]} less {names[1]}")
    figure.colorbar(drawn, ax=axes, label=f"{less} [-]")
    runs = len(set(first.seed) & set(second.seed))
    title = f"Share of {runs} runs each that attain a point or better, {less}\nless is better on both axes"
    figure.suptitle(title, fontsize=11)
    return figure


def attainment_differences(
    ax: "Axes", first: pd.DataFrame, second: pd.DataFrame, objectives: tuple[str, str]
) -> Any:
    """Draw the difference of two algorithms in the share of runs that attain a point of two objectives.

    `first` and `second` are feasible designs of final populations with a column ``seed``; only common seeds count.
    Returns the image for a colour bar: the difference in the middle of each cell, masked where there is none.

    V. Grunert da Fonseca, C. M. Fonseca, A. O. Hall, "Inferential performance assessment of stochastic optimisers
    and the attainment function", EMO 2001.
    """
    seeds = sorted(set(first.seed) & set(second.seed))
    sides = [_fronts(side, seeds, objectives) for side in (first, second)]
    every = np.concatenate([front for fronts in sides for front in fronts])
    low, high = every.min(axis=0), every.max(axis=0)
    x, y = (low + (high - low) * (np.arange(CELLS)[:, np.newaxis] + 0.5) / CELLS).T
    counts = [sum(_attained(front, x, y) for front in fronts) for fronts in sides]
    difference = np.ma.masked_equal(counts[0] - counts[1], 0) / len(seeds)
    extent = (low[0], high[0], low[1], high[1])
    style: dict[str, Any] = {"cmap": "PuOr", "clim": (-1, 1), "aspect": "auto", "interpolation": "nearest"}
    image = ax.imshow(difference, origin="lower", extent=extent, **style)
    xlim, ylim = np.transpose([low - 0.02 * (high - low), high + 0.02 * (high - low)])
    ax.set(xlim=xlim, ylim=ylim, xlabel=escaping.figure(objectives[0]), ylabel=escaping.figure(objectives[1]))
    return image


def _fronts(populations: pd.DataFrame, seeds: list[int], objectives: tuple[str, str]) -> list[Real]:
    """Return the non-dominated pairs of objectives (n, 2) of each run, by the first."""
    runs = dict(list(populations.groupby("seed")[list(objectives)]))
    fronts = [best_of(runs[seed].to_numpy(dtype=float)) for seed in seeds]
    return [front[np.argsort(front[:, 0])] for front in fronts]


def _attained(front: Real, x: Real, y: Real) -> Integer:
    """Return 1 where a front (n, 2) by its first objective attains a place (y, x), 0 elsewhere."""
    least = np.array([np.inf, *np.minimum.accumulate(front[:, 1])])  # of the second, up to each of the first
    needed = least[np.searchsorted(front[:, 0], x, side="right")]
    return (needed <= y[:, np.newaxis]).astype(np.int64)


def panels(count: int, columns: int = 3) -> "tuple[Figure, list[Axes]]":
    """Return a figure with `count` panels, `columns` in a row, and its Axes."""
    from matplotlib.figure import Figure

    rows = -(-count // columns)
    figure = Figure(figsize=(4.2 * columns, 3.4 * rows + 0.5), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False).flat)
    for ax in axes[count:]:
        ax.remove()
    return figure, axes[:count]
