"""Figures of the paper, drawn from data; nothing is saved here."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
from numpy.typing import NDArray

from .. import escaping
from ..quantities import Real, signal_unit
from ..response.curves import DesignCurves, weighted_name
from ..response.responses import phase_degrees
from ..response.weightings import BANDS, by_name
from ..study.figures import COLOURS
from ..tables.headers import shown_unit
from ..tables.rounding import rounded

_ACROSS = 4  # panels in a row
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
    figure, panels = _panels(designs, 2, width=3.5)
    for (magnitude, phase), response in zip(panels, designs[0].responses, strict=True):
        unit, scale = _magnitude(signal_unit(response))
        for colour, design in zip(COLOURS, spread(designs), strict=False):
            h = design.responses[response] * scale
            _marked_line(magnitude, design, np.abs(h), colour)
            _marked_line(phase, design, phase_degrees(h), colour)
        magnitude.set(ylabel=f"magnitude [{unit}]")
        if any(design.responses[response].any() for design in designs):
            magnitude.set(yscale="log")
        else:
            words = "none to a road\nidentical on all tracks"
            magnitude.text(0.5, 0.7, words, transform=magnitude.transAxes, ha="center", va="center")
        phase.set(ylabel="phase [deg]")
    return _finished(figure, panels, designs)


def spectra(designs: Sequence[DesignCurves], weighting: str) -> Figure:
    """Draw Figure 7: spectra of the responses, a line per design, and its root mean squares beside.

    Weighted accelerations are dashed.
    """
    figure, panels = _panels(designs, 1, width=4.3)
    for (ax,), response in zip(panels, designs[0].responses, strict=True):
        unit, scale = _shown(signal_unit(response))
        weighted = weighted_name(response)
        for colour, design in zip(COLOURS, spread(designs), strict=False):
            _marked_line(ax, design, design.densities[response] * scale**2, colour)
            if weighted in design.densities:
                ax.plot(design.f, design.densities[weighted], "--", color=colour, lw=1.2)
                ax.set_title(f"{_title(response)} (dashed: {escaping.figure(weighting)})")
        ax.set(yscale="log", ylabel=f"PSD [{f'({unit})' if '/' in unit else unit}²/Hz]")
        _write_root_mean_squares(ax, spread(designs), response, scale, unit)
    return _finished(figure, panels, designs)


def spread(designs: Sequence[DesignCurves]) -> list[DesignCurves]:
    """Return the designs that are drawn: all, or as many as there are colours, even in their order."""
    places = np.linspace(0, len(designs) - 1, min(len(designs), len(COLOURS))).round().astype(int)
    return [designs[place] for place in places]


def _write_root_mean_squares(
    ax: Axes, designs: Sequence[DesignCurves], response: str, scale: float, unit: str
) -> None:
    """Write the root mean square of each design in its colour, of a weighted acceleration behind it."""
    names = [name for name in (response, weighted_name(response)) if name in designs[0].rms]
    columns = [rounded([scale * design.rms[name] for design in designs]) for name in names]
    texts = [" / ".join(text or "-" for text in row) for row in zip(*columns, strict=True)]
    handles = [Line2D([], [], color=colour) for colour, _ in zip(COLOURS, designs, strict=False)]
    title = f"r.m.s.{' / weighted' * (len(names) > 1)}\n[{unit}]"
    style: dict[str, Any] = {"fontsize": 8, "title_fontsize": 8, "handlelength": 1.0, "frameon": False}
    ax.legend(handles, texts, title=title, loc="center left", bbox_to_anchor=(1.0, 0.5), **style)


def _magnitude(unit: str) -> tuple[str, float]:
    """Return the unit of a magnitude for data in a unit per metre of the road, and the factor to it."""
    if unit == "m":
        return "mm/mm", 1.0
    shown, factor = _shown(unit)
    return f"({shown})/m" if "/" in shown else f"{shown}/m", factor


def _shown(unit: str) -> tuple[str, float]:
    """Return the unit of an axis for data in a unit, and the factor to it."""
    shown, factor = shown_unit(unit)
    return shown.replace("^2", "²"), factor


def _title(response: str) -> str:
    return _TITLES.get(response, escaping.figure(response.replace("_", " ")))


def _panels(designs: Sequence[DesignCurves], rows: int, width: float) -> tuple[Figure, NDArray[Any]]:
    """Return a figure with a panel of `rows` Axes and some `width` for each response, and the Axes (m, rows)."""
    count = len(designs[0].responses)
    columns = min(_ACROSS, count)
    down = -(-count // columns)
    size = (0.5 + width * columns, 0.8 + down * (0.6 + 2.6 * rows))
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(down * rows, columns, sharex=True, squeeze=False)
    panels = axes.reshape(down, rows, columns).swapaxes(1, 2).reshape(-1, rows)
    for spare in panels[count:].flat:
        spare.remove()
    for panel, response in zip(panels, designs[0].responses, strict=False):
        panel[0].set_title(_title(response))
    return figure, panels[:count]


def _marked_line(ax: Axes, design: DesignCurves, values: Real, colour: str) -> None:
    """Draw a curve over frequency with markers at the natural frequencies."""
    ax.plot(design.f, values, color=colour, lw=1.4, label=escaping.figure(design.label))
    natural = design.modes["natural frequency [Hz]"].to_numpy(dtype=float)
    shown = natural[(natural >= design.f[0]) & (natural <= design.f[-1])]
    ax.plot(shown, np.interp(shown, design.f, values), "o", color=colour, ms=4)


def _finished(figure: Figure, panels: NDArray[Any], designs: Sequence[DesignCurves]) -> Figure:
    """Return the figure with axes of frequency and a legend; it says if not all designs are drawn."""
    for ax in panels.flat:
        ax.set_xscale("log")
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.title.set_fontsize(10)
        ax.grid(which="both", alpha=0.25)
    for ax in panels[:, -1]:
        ax.set_xlabel("frequency [Hz]")
        ax.tick_params(labelbottom=True)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    drawn = len(spread(designs))
    title = f"{drawn} of {len(designs)} designs" if drawn < len(designs) else None
    columns = max(1, 3 * len(panels) // 4) if len(panels) < _ACROSS else 4
    figure.legend(handles, labels, title=title, loc="outside upper center", ncols=columns, frameon=False)
    return figure
