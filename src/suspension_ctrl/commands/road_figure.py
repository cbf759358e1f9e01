"""Picture of a measured road: profile, roughness index by segments, and spectrum among the classes of ISO 8608."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ..response.roughness import RoughnessIndex
from ..roads.spectra import limits_of_classes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..roads.measured import MeasuredRoad
    from ..roads.profiles import Profile

_POINTS = 20_000  # of a drawn profile


def road_figure(
    profile: "Profile", index: RoughnessIndex, segment: float | None, measured: "MeasuredRoad | None"
) -> Figure:
    """Return the figure; the index by segments of a length [m] and the spectrum if there are any."""
    figure = Figure(figsize=(7, 8), layout="constrained")
    top, middle, bottom = figure.subplots(3)
    thinned = slice(None, None, -(-profile.distance.size // _POINTS))
    for y, height in zip(profile.tracks, profile.height.T, strict=True):
        top.plot(profile.distance[thinned], 1e3 * height[thinned], lw=0.8, label=f"track at {y:g} m")
    top.set(xlabel="distance [m]", ylabel="elevation [mm]")
    top.legend(frameon=False)
    _draw_index(middle, index, segment)
    _draw_spectrum(bottom, measured)
    return figure


def _draw_index(axes: "Axes", index: RoughnessIndex, segment: float | None) -> None:
    """Draw the index by segments, a line for each track."""
    if segment is not None:
        table = index.by_segment(segment)
        edges = [*table["start [m]"], table["end [m]"].iloc[-1]]
        for values in table.iloc[:, 2:].to_numpy().T:
            axes.stairs(values, edges)
        axes.set_title(f"segments of {segment:g} m", fontsize=10)
    axes.axhline(index.mean, ls=":", color="grey")
    axes.set(xlabel="distance [m]", ylabel="IRI [mm/m]", ylim=(0, None))


def _draw_spectrum(axes: "Axes", measured: "MeasuredRoad | None") -> None:
    """Draw the spectrum over the limits of the classes."""
    n = np.array([0.01, 10.0])
    for name, limit in limits_of_classes().items():
        if np.isfinite(limit):
            axes.loglog(n, limit * (n / 0.1) ** -2, color="0.8", lw=0.8, zorder=0)
            axes.annotate(name, (0.0105, 0.5 * limit * 100), color="0.5", fontsize=8, va="center")
    if measured is not None:
        axes.loglog(measured.wavenumber, measured.density)
    axes.set(xlabel="wavenumber [cycle/m]", ylabel="PSD [m³]", xscale="log", yscale="log")
