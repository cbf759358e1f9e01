"""Figures of a comparison, written to its folder."""

from collections.abc import Mapping
from itertools import combinations
from pathlib import Path

import pandas as pd

from ..quantities import column_headers
from ..study import figures as comparison_figures
from ..study import lenses, study
from ..study import timing as experiments
from ..study.comparison import Comparison
from ..study.store import StoredRun
from ..study.study import INDICATORS
from . import results


def draw(
    comparison: Comparison, timed: pd.DataFrame, equal: pd.DataFrame, store: Mapping[str, StoredRun], folder: Path
) -> None:
    """Write anytime curves, box plots and attainment differences, a figure of each per population."""
    for population in comparison.populations:
        curves = timed[timed.population == population]
        figure, axes = comparison_figures.panels(4, columns=2)
        places = ((s, x) for s in (study.POPULATION, study.CUT_ARCHIVE) for x in ("evaluations", "seconds"))
        for ax, (chosen, over) in zip(axes, places, strict=True):
            comparison_figures.anytime(ax, curves[curves.set == chosen], over)
            ax.set_title(f"{chosen}, N = {population}", fontsize=10)
        axes[0].legend(frameon=False, fontsize=8)
        results.write_figure(folder / f"anytime_n{population}", figure)

        last = equal[
            (equal.population == population)
            & (equal.iterations == max(comparison.iterations))
            & (equal.lens == lenses.EVALUATIONS)
            & (equal.set == study.POPULATION)
        ]
        figure, axes = comparison_figures.panels(len(INDICATORS), columns=2)
        for ax, indicator in zip(axes, INDICATORS, strict=True):
            comparison_figures.boxes(ax, last, indicator)
        results.write_figure(folder / f"boxes_n{population}", figure)
        if len(comparison.algorithms) > 1:
            _draw_attainment(comparison, population, store, folder)


def _draw_attainment(
    comparison: Comparison, population: int, store: Mapping[str, StoredRun], folder: Path
) -> None:
    names = comparison.algorithms[:2]
    kept: dict[str, dict[int, pd.DataFrame]] = {name: {} for name in names}
    for run in comparison.studies()[population].runs():
        if run.key["algorithm"] in kept and run.name in store:
            feasible = experiments.feasible_rows(comparison.problem, store[run.name].final)
            kept[run.key["algorithm"]][run.seed] = feasible
    shared = sorted(
        seed for seed in kept[names[0]] if len(kept[names[0]][seed]) and len(kept[names[1]].get(seed, ()))
    )
    if not shared:
        return
    sides = [pd.concat([kept[name][seed].assign(seed=seed) for seed in shared]) for name in names]
    headers = dict(
        zip(
            comparison.problem.objectives,
            column_headers(comparison.problem.objectives, comparison.problem.units),
            strict=True,
        )
    )
    across = sorted(headers.values(), key=lambda header: not header.startswith("SWS"))
    pairs = list(combinations(across, 2))
    figure, axes = comparison_figures.panels(len(pairs))
    sides = [side.rename(columns=headers) for side in sides]
    for ax, pair in zip(axes, pairs, strict=True):
        drawn = comparison_figures.attainment_differences(ax, *sides, pair)
    figure.colorbar(drawn, ax=axes, label=f"share of runs attaining: {names[0]} less {names[1]}")
    results.write_figure(folder / f"attainment_n{population}", figure)
