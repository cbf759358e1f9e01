"""Correlation of a model with a measured vehicle: spectra and root mean squares in bands beside each other."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from .. import checks, escaping
from ..quantities import Real, Record, signal_unit
from ..roads.profiles import Profile
from ..vehicles.assembly import ResponseName, label
from ..vehicles.vehicle import Setting, Vehicle
from .channels import Channels, Source, channels_of
from .driving import simulate
from .estimates import Estimate, intervals, mean_squares, third_octaves, welch
from .linearisation import linear_at
from .load_case import LoadCase, Road
from .responses import response_psds

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_NODES = 24  # of Gauss and Legendre in each band of a computed spectrum


@dataclass(frozen=True, eq=False, repr=False)
class Correlation(Record):
    """Computed beside measured, see `correlate`.

    Parameters
    ----------
    table : DataFrame
        By response and band, and over all bands together, root mean squares ``computed`` and ``measured``, ``low``
        and ``high``, the 95 % interval of the measured one (NaN for given spectra), ``unit`` and ``ratio [dB]``,
        20 log10(computed/measured).
    spectra : DataFrame
        ``frequency [Hz]``, and by response the computed and the measured spectrum.
    """

    table: "pd.DataFrame" = field(metadata={"show": lambda table: f"{len(table)} rows"})
    spectra: "pd.DataFrame" = field(metadata={"show": lambda spectra: f"{len(spectra)} lines"})


def correlate(
    vehicle: Vehicle,
    setting: Setting,
    measured: Source,
    road: Road | Profile,
    speed: float,
    *,
    channels: Mapping[str, ResponseName] | None = None,
    band: tuple[float, float] = (0.5, 20.0),
    bands: Sequence[float] | None = None,
    segment: float | None = None,
) -> Correlation:
    """Compare a model with measured histories or spectra of its responses.

    Parameters
    ----------
    vehicle : Vehicle
    setting : mapping of str to float or (float, float)
        Coefficients of its struts, as for ``vehicle.closed``.
    measured : path or DataFrame
        A CSV or RPC III file (.rpc, .rsp, .tim), or a table. Histories have the columns ``time [s]``, in even
        steps, and responses by name with their unit, ``body_acceleration [g]``; their means do not count. Spectra
        have ``frequency [Hz]`` and ``body_acceleration [g^2/Hz]``.
    road : Road or Profile
        The road on which was measured: a `Profile` is driven over with `simulate` and the same estimate made of
        its responses; of another road they are computed in the frequency domain.
    speed : float
        Vehicle speed V [m/s].
    channels : mapping of str to str or ("acceleration", x, y), optional
        Responses by the names of their columns; others are passed over. If not given, all but ``distance [m]``
        are responses by their names.
    band : (float, float)
        Third octaves with a middle in it are compared [Hz].
    bands : sequence of float, optional
        In place of them the edges of other bands, ascending [Hz].
    segment : float, optional
        Length of the segments of Welch's method [s]. If not given, it has four lines in the narrowest band and
        lasts 20 s, but an eighth of the histories at most.

    Returns
    -------
    Correlation
        ``table`` and ``spectra``; `correlation_figure` draws it.

    Raises
    ------
    ValueError
        Naming the file: about its columns or units, or histories too short or too coarse for the bands.

    Examples
    --------
    A simulated drive of a car whose damper is worn stands for the measurement:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> road = sc.Iso8608Road("C")
    >>> profile = road.profile(length=4000.0, step=0.05, seed=2)
    >>> measured = sc.simulate(car, {"spring": 22e3, "damper": 900.0}, profile, speed=20.0, periodic=True)
    >>> for damper in (1500.0, 900.0):
    ...     found = sc.correlate(car, (22e3, damper), measured, road, speed=20.0, bands=[1, 5, 20])
    ...     accelerations = found.table[found.table["response"] == "body_acceleration"]
    ...     print(damper, accelerations["ratio [dB]"].round(1).to_list())
    1500.0 [-1.0, 1.7, 0.5]
    900.0 [-0.1, 0.2, 0.0]
    """
    known = channels_of(measured, channels)
    edges = _edges(band, bands)
    estimate = _estimate(known, edges, segment)
    f = estimate.f[(estimate.f >= edges[0]) & (estimate.f <= edges[-1])]
    if isinstance(road, Profile):
        squares, spectra = _driven(vehicle, setting, road, speed, known.responses, edges, f, segment)
    else:
        case = LoadCase(vehicle=vehicle, road=road, speed=speed)
        squares, spectra = _computed(case, setting, known.responses, edges, f)
    names = [label(one) for one in known.responses]
    return Correlation(_table(names, edges, squares, estimate), _spectra(names, f, spectra, estimate))


def _edges(band: tuple[float, float], bands: Sequence[float] | None) -> Real:
    if bands is None:
        return third_octaves(band)
    edges = checks.reals("bands must be", bands)
    if edges.ndim != 1 or edges.size < 2:
        raise ValueError(f"bands must be two edges or more, got {checks.shown(bands)}")
    checks.ascending("bands", edges)
    return edges


def _estimate(known: Channels, edges: Real, segment: float | None) -> Estimate:
    """Return the measured spectra."""
    if not known.are_spectra:
        step = float(known.axis[-1] - known.axis[0]) / (len(known.axis) - 1)
        return welch(known.numbers, step, edges, segment)
    if (known.numbers < 0).any():
        raise ValueError(f"spectra must be >= 0 throughout, got {known.numbers.min():.4g}")
    return Estimate(known.axis, known.numbers)


def _driven(
    vehicle: Vehicle,
    setting: Setting,
    profile: Profile,
    speed: float,
    responses: Sequence[ResponseName],
    edges: Real,
    f: Real,
    segment: float | None,
) -> tuple[Real, Real]:
    """Return mean squares (b, m) and spectra (k, m) of a drive over a profile."""
    history = simulate(vehicle, setting, profile, speed, responses=responses)
    time, values = history["time [s]"].to_numpy(), history.iloc[:, -len(responses) :].to_numpy()
    found = welch(values, float(time[-1] / (len(time) - 1)), edges, segment)
    spectra = np.stack([np.interp(f, found.f, one) for one in found.psd.T], axis=-1)
    return mean_squares(found.f, found.psd, edges), spectra


def _computed(
    case: LoadCase, setting: Setting, responses: Sequence[ResponseName], edges: Real, f: Real
) -> tuple[Real, Real]:
    """Return mean squares (b, m) and spectra (k, m) on a random road."""
    x, w = np.polynomial.legendre.leggauss(_NODES)
    middles, halves = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    nodes = (middles[:, None] + halves[:, None] * x).ravel()
    vehicle, setting = linear_at(case, setting, (float(edges[0]), float(edges[-1])))
    closed = vehicle.closed(setting, responses=responses)
    every = np.union1d(nodes, f)
    found = np.array([*response_psds(closed, every, case.cross_spectrum(every)).values()]).T
    at_nodes = found[np.searchsorted(every, nodes)].reshape(len(middles), _NODES, -1)
    return np.einsum("bnm,n,b->bm", at_nodes, w, halves), found[np.searchsorted(every, f)]


def _table(names: Sequence[str], edges: Real, computed: Real, estimate: Estimate) -> "pd.DataFrame":
    """Return the root mean squares by response and band, the last band being all together."""
    import pandas as pd

    whole = edges[[0, -1]]
    measured = mean_squares(estimate.f, estimate.psd, edges)
    limits = np.concatenate([intervals(estimate, edges), intervals(estimate, whole)], axis=1)
    lower, upper = np.append(edges[:-1], edges[0]), np.append(edges[1:], edges[-1])
    parts = []
    for i, name in enumerate(names):
        here, there = (np.sqrt(np.append(one[:, i], one[:, i].sum())) for one in (computed, measured))
        low, high = there * np.sqrt(limits[..., i])
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = 20 * np.log10(here / there)
        columns = {"from [Hz]": lower, "to [Hz]": upper, "computed": here, "measured": there, "low": low,
                   "high": high, "unit": signal_unit(name), "ratio [dB]": ratio}  # fmt: skip
        parts.append(pd.DataFrame({"response": name, **columns}))
    return pd.concat(parts, ignore_index=True)


def _spectra(names: Sequence[str], f: Real, computed: Real, estimate: Estimate) -> "pd.DataFrame":
    import pandas as pd

    measured = estimate.psd[np.searchsorted(estimate.f, f)]
    columns = {"frequency [Hz]": f}
    for i, name in enumerate(names):
        for kind, values in (("computed", computed), ("measured", measured)):
            columns[f"{name} {kind} [({signal_unit(name)})^2/Hz]"] = values[:, i]
    return pd.DataFrame(columns)


def correlation_figure(correlation: Correlation) -> "Figure":
    """Draw the spectra of a correlation, and below them the ratio of the root mean squares in each band.

    Parameters
    ----------
    correlation : Correlation

    Returns
    -------
    matplotlib.figure.Figure
        A column of axes for each response; the interval of the measured values is grey.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> road = sc.Iso8608Road("C")
    >>> profile = road.profile(length=4000.0, step=0.1, seed=1)
    >>> measured = sc.simulate(car, (22e3, 1500.0), profile, speed=20.0, periodic=True)
    >>> figure = sc.correlation_figure(sc.correlate(car, (22e3, 1500.0), measured, road, speed=20.0))
    >>> len(figure.axes)
    6
    """
    import matplotlib.pyplot as plt

    names = list(dict.fromkeys(correlation.table["response"]))
    size = (3.2 * len(names) + 1.2, 5.0)
    figure, axes = plt.subplots(2, len(names), sharex=True, squeeze=False, figsize=size, layout="constrained")
    for column, name in enumerate(names):
        above, below = axes[:, column]
        spectra = correlation.spectra.filter(regex=rf"^{name} (computed|measured) ")
        for header in spectra:
            kind = str(header)[len(name) + 1 :].partition(" ")[0]
            above.loglog(correlation.spectra["frequency [Hz]"], spectra[header], label=kind)
        bands = correlation.table[correlation.table["response"] == name].iloc[:-1]
        middle = np.sqrt(bands["from [Hz]"] * bands["to [Hz]"])
        decibels = {end: 20 * np.log10(bands[end] / bands["measured"]) for end in ("low", "high")}
        below.fill_between(middle, decibels["low"], decibels["high"], color="0.85", step="mid")
        below.plot(middle, bands["ratio [dB]"], "o-", ms=3)
        above.set(title=escaping.figure(name), ylabel=f"spectrum [({bands['unit'].iloc[0]})^2/Hz]")
        below.set(xlabel="frequency [Hz]", ylabel="computed over measured [dB]")
        for one in (above, below):
            one.grid(alpha=0.25)
    axes[0, 0].legend(frameon=False, fontsize=8)
    return figure
