"""Figures of the paper, drawn from data; nothing is saved here."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import escaping
from ..quantities import Real, signal_unit
from ..response.curves import DesignCurves, weighted_name
from ..response.responses import phase_degrees
from ..response.weightings import BANDS, by_name
from ..study.figures import COLOURS

_MOST_IN_LEGEND = 12  # a legend of more designs would cover the curves; curves.csv names all
_TITLES = {
    "suspension_travel": "SWS: suspension travel",
    "body_acceleration": "ACC: body acceleration",
    "tyre_load": "DTL: tyre load",
}


def weighting_factors(ax: Axes, filters: Sequence[str], tables: Sequence[str]) -> None:
    """Draw Figure 2: factors of ISO 2631 weightings over frequency, filters as lines, tables as markers."""
    f = np.geomspace(0.1, 100, 400)
    for colour, name in zip(COLOURS, filters, strict=False):
        ax.loglog(f, by_name(name).factor(f), color=colour, label=f"{name}, filter")
    for colour, name in zip(COLOURS, tables, strict=False):
        label = f"{name.removesuffix('-table')}, table"
        ax.loglog(BANDS, by_name(name).factor(BANDS), "o", ms=3.5, color=colour, label=label)
    ax.set(xlabel="frequency [Hz]", ylabel="weighting factor [-]")
    ax.grid(which="both", alpha=0.3)
    ax.legend(frameon=False)


def bode(designs: Sequence[DesignCurves]) -> Figure:
    """Draw Figure 6: magnitude and phase of the responses to the road, a line per design."""
    figure, axes = _columns(designs, 2)
    for (magnitude, phase), response in zip(axes.T, designs[0].responses, strict=True):
        unit, scale = _shown(signal_unit(response))
        for colour, design in zip(_colours(len(designs)), designs, strict=False):
            h = design.responses[response] * scale
            _marked_line(magnitude, design, np.abs(h), colour)
            _marked_line(phase, design, phase_degrees(h), colour)
        magnitude.set(yscale="log", ylabel=f"magnitude [{unit}/m]")
        phase.set(ylabel="phase [deg]")
    return _finished(figure, axes)


def spectra(designs: Sequence[DesignCurves], weighting: str) -> Figure:
    """Draw Figure 7: spectra of the responses, a line per design; weighted accelerations are dashed."""
    figure, axes = _columns(designs, 1)
    for ax, response in zip(axes[0], designs[0].responses, strict=True):
        unit, scale = _shown(signal_unit(response))
        weighted = weighted_name(response)
        for colour, design in zip(_colours(len(designs)), designs, strict=False):
            _marked_line(ax, design, design.densities[response] * scale**2, colour)
            if weighted in design.densities:
                ax.plot(design.f, design.densities[weighted], "--", color=colour, lw=1.2)
                ax.set_title(f"{_title(response)} (dashed: {escaping.figure(weighting)})")
        ax.set(yscale="log", ylabel=f"PSD [{f'({unit})' if '/' in unit else unit}²/Hz]")
    return _finished(figure, axes)


def _colours(count: int) -> Sequence[Any]:
    """Return `count` colours: of a palette up to four, of a colour map beyond."""
    return COLOURS if count <= 4 else list(colormaps["viridis"](np.linspace(0, 0.9, count)))


def _shown(unit: str) -> tuple[str, float]:
    """Return the unit of an axis for data in a unit, and the factor to it."""
    return ("kN", 1e-3) if unit == "N" else (unit.replace("^2", "²"), 1.0)


def _title(response: str) -> str:
    return _TITLES.get(response, escaping.figure(response.replace("_", " ")))


def _columns(designs: Sequence[DesignCurves], rows: int) -> tuple[Figure, NDArray[Any]]:
    """Return a figure with a column of `rows` Axes for each response, and the Axes."""
    columns = len(designs[0].responses)
    figure = Figure(figsize=(0.5 + 3.5 * columns, 1.4 + 2.6 * rows), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, squeeze=False)
    for ax, response in zip(axes[0], designs[0].responses, strict=True):
        ax.set_title(_title(response))
    return figure, axes


def _marked_line(ax: Axes, design: DesignCurves, values: Real, colour: str) -> None:
    """Draw a curve over frequency with markers at the natural frequencies."""
    ax.plot(design.f, values, color=colour, lw=1.4, label=escaping.figure(design.label))
    natural = design.modes["natural frequency [Hz]"].to_numpy(dtype=float)
    shown = natural[(natural >= design.f[0]) & (natural <= design.f[-1])]
    ax.plot(shown, np.interp(shown, design.f, values), "o", color=colour, ms=4)


def _finished(figure: Figure, axes: NDArray[Any]) -> Figure:
    for ax in axes.flat:
        ax.set_xscale("log")
        ax.title.set_fontsize(10)
        ax.grid(which="both", alpha=0.25)
    for ax in axes[-1]:
        ax.set_xlabel("frequency [Hz]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    if len(labels) <= _MOST_IN_LEGEND:
        figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False)
    return figure
