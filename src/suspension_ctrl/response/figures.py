"""The paper's figures: data in, Axes or Figure out; nothing is saved here."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..quantities import Complex, Real, signal_unit
from .responses import phase_degrees
from .weightings import BANDS, by_name

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")  # Okabe and Ito: told apart by colour-blind readers

_MOST_IN_LEGEND = 12  # designs: of more, a legend would cover the curves; curves.csv names them all


def colours(count: int) -> Sequence[Any]:
    """Return `count` colours: a palette for a few, a graded map for many."""
    return COLOURS if count <= len(COLOURS) else list(colormaps["viridis"](np.linspace(0, 0.9, count)))


def weighting_factors(ax: Axes, filters: Sequence[str], tables: Sequence[str]) -> None:
    """Draw Figure 2: factors of ISO 2631 weightings over frequency, filters as lines, tables as marks."""
    f = np.geomspace(0.1, 100, 400)
    for colour, name in zip(COLOURS, filters, strict=False):
        ax.loglog(f, by_name(name).factor(f), color=colour, label=f"{name}, filter")
    for colour, name in zip(COLOURS, tables, strict=False):
        label = f"{name.removesuffix('-table')}, table"
        ax.loglog(BANDS, by_name(name).factor(BANDS), "o", ms=3.5, color=colour, label=label)
    ax.set(xlabel="frequency [Hz]", ylabel="weighting factor [-]")
    ax.grid(which="both", alpha=0.3)
    ax.legend(frameon=False)


@dataclass(frozen=True)
class DesignCurves:
    """Curves of a design over frequency, for Figures 6 and 7."""

    label: str
    f: Real  # (n,) [Hz]
    responses: Mapping[str, Complex]  # H(w) (n,) from the road
    densities: Mapping[str, Real]  # spectra (n,) on the road, also of weighted accelerations (`weighted_name`)
    natural: Real  # (k,) natural frequencies [Hz]


def bode(designs: Sequence[DesignCurves]) -> Figure:
    """Draw Figure 6: magnitude and phase of the responses to the road, a line per design."""
    panels = _panels(designs)
    figure, axes = _columns(len(panels), 2)
    for (magnitude, phase), (response, panel) in zip(axes.T, panels.items(), strict=True):
        for colour, design in zip(colours(len(designs)), designs, strict=False):
            h = design.responses[response] * panel.scale
            _marked_line(magnitude, design, np.abs(h), colour)
            _marked_line(phase, design, phase_degrees(h), colour)
        magnitude.set(title=panel.title, yscale="log", ylabel=f"magnitude [{panel.unit}/m]")
        phase.set(ylabel="phase [deg]")
    return _finished(figure, axes)


def spectra(designs: Sequence[DesignCurves], weighting: str) -> Figure:
    """Draw Figure 7: spectra of the responses, a line per design; accelerations weighted too, dashed."""
    panels = _panels(designs)
    figure, axes = _columns(len(panels), 1)
    for ax, (response, panel) in zip(axes[0], panels.items(), strict=True):
        weighted = weighted_name(response)
        for colour, design in zip(colours(len(designs)), designs, strict=False):
            _marked_line(ax, design, design.densities[response] * panel.scale**2, colour)
            if weighted in design.densities:
                ax.plot(design.f, design.densities[weighted], "--", color=colour, lw=1.2)
        note = f" (dashed: {weighting})" if weighted in designs[0].densities else ""
        ax.set(title=panel.title + note, yscale="log", ylabel=f"PSD [{panel.density_unit}]")
    return _finished(figure, axes)


def weighted_name(response: str) -> str:
    """Return the name of an acceleration that is weighted: ``"weighted_acceleration"`` is that of the body."""
    return f"weighted_{response.removeprefix('body_')}"


class _Panel(NamedTuple):
    title: str
    unit: str
    density_unit: str
    scale: float


_TITLES = {
    "suspension_travel": "SWS: suspension travel",
    "body_acceleration": "ACC: body acceleration",
    "tyre_load": "DTL: tyre load",
}
_SHOWN_UNITS = {"m": ("m", "m²/Hz", 1.0), "N": ("kN", "kN²/Hz", 1e-3)}


def _panels(designs: Sequence[DesignCurves]) -> dict[str, _Panel]:
    """Return a panel for each response of the designs."""
    panels = {}
    for response in designs[0].responses:
        unit = signal_unit(response)
        printed = unit.replace("^2", "²")
        shown = _SHOWN_UNITS.get(unit, (printed, f"({printed})²/Hz", 1.0))
        panels[response] = _Panel(_TITLES.get(response, response.replace("_", " ")), *shown)
    return panels


def _columns(columns: int, rows: int) -> tuple[Figure, NDArray[Any]]:
    figure = Figure(figsize=(0.5 + 3.5 * columns, 1.4 + 2.6 * rows), layout="constrained")
    return figure, figure.subplots(rows, columns, sharex=True, squeeze=False)


def _marked_line(ax: Axes, design: DesignCurves, values: Real, colour: str) -> None:
    """Draw a curve over frequency with a mark at each natural frequency."""
    ax.plot(design.f, values, color=colour, lw=1.4, label=design.label)
    shown = design.natural[(design.natural >= design.f[0]) & (design.natural <= design.f[-1])]
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
