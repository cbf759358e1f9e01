"""Figure of dampers: their curves, and below them the distribution of the rate."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .. import checks, escaping
from ..quantities import Real
from .dampers import TableDamper
from .force_laws import ForceLaw

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_DEVIATIONS, _POINTS, _BINS = 4.0, 801, 60


def damper_figure(laws: Mapping[str, ForceLaw], rates: Mapping[str, ArrayLike]) -> "Figure":
    """Draw curves of dampers, and below them how their rate is distributed.

    Parameters
    ----------
    laws : mapping of str to ForceLaw
        Dampers by the text of the legend, with values for their coefficients; rows of tables are marked.
    rates : mapping of str to float or (n,) array_like
        By the text of the legend a standard deviation, drawn as a Gaussian density, or a history of the rate, as a
        histogram [m/s].

    Returns
    -------
    matplotlib.figure.Figure
        Rates and forces positive in extension (rebound) and in tension.

    Raises
    ------
    ValueError
        If a law is not one of the rate or lacks a coefficient, or a rate is not as described.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> laws = {"measured": sc.load_vehicle("volvo_xc90_full").vehicle.front_strut.elements[1]}
    >>> laws["digressive"] = sc.DigressiveDamper(low_speed=4000.0, high_speed=1500.0, knee=0.1)
    >>> figure = sc.damper_figure(laws, {"class A": 0.05, "class D": 0.3})
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['tension [kN]', 'density [s/m]']
    """
    import matplotlib.pyplot as plt

    if wrong := [name for name, law in laws.items() if not (isinstance(law, ForceLaw) and law.of_rate)]:
        raise ValueError(f"laws must be dampers, got {checks.shown(laws[wrong[0]])}")
    known = {name: _rates(given) for name, given in rates.items()}
    if not known:
        raise ValueError("rates must be given, one at least, got none")
    reach = max(
        _DEVIATIONS * float(given) if given.ndim == 0 else float(abs(given).max()) for given in known.values()
    )
    figure, (above, below) = plt.subplots(
        2, sharex=True, figsize=(6.4, 6.0), height_ratios=(2, 1), layout="constrained"
    )
    _draw_laws(above, laws, np.linspace(-reach, reach, _POINTS))
    _draw_rates(below, known, reach, first=len(laws))
    above.set(ylabel="tension [kN]")
    below.set(xlabel="rate, positive in extension [m/s]", ylabel="density [s/m]", xlim=(-reach, reach))
    for axes in (above, below):
        axes.axvline(0.0, color="0.7", lw=0.8, zorder=0)
        axes.grid(alpha=0.25)
        axes.legend(frameon=False, fontsize=8)
    return figure


def _rates(given: ArrayLike) -> Real:
    """Return a standard deviation () or a history (n,)."""
    values = checks.reals("rates must be", given)
    if values.ndim == 0:
        checks.positive("rates", float(values), "m/s")
    elif values.ndim > 1 or values.size < 2 or not (np.isfinite(values).all() and values.any()):
        raise ValueError(
            f"rates must be standard deviations or histories of finite values, got {checks.shown(given)}"
        )
    return values


def _draw_laws(axes: "Axes", laws: Mapping[str, ForceLaw], v: Real) -> None:
    for i, (name, law) in enumerate(laws.items()):
        axes.plot(v, law.tension(v) / 1e3, color=f"C{i}", label=escaping.figure(name))
        if isinstance(law, TableDamper):
            rows = np.asarray(law.velocity)
            rows = rows[abs(rows) <= v[-1]]
            axes.plot(rows, law.tension(rows) / 1e3, ".", color=f"C{i}")


def _draw_rates(axes: "Axes", rates: Mapping[str, Real], reach: float, first: int) -> None:
    v = np.linspace(-reach, reach, _POINTS)
    for i, (name, given) in enumerate(rates.items(), start=first):  # in other colours than the laws
        style: dict[str, Any] = {"color": f"C{i}", "label": escaping.figure(name)}
        if given.ndim:
            axes.hist(given, _BINS, range=(-reach, reach), density=True, alpha=0.5, **style)
        else:
            density = np.exp(-((v / given) ** 2) / 2) / (given * np.sqrt(2 * np.pi))
            axes.fill_between(v, density, alpha=0.3, lw=0, color=style["color"])
            axes.plot(v, density, **style)
