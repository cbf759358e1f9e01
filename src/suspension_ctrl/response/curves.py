"""Curves of one design over frequency: its responses to the road and their spectra, for figures and tables."""

import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from ..quantities import Complex, Real, column_headers, signal_unit
from ..vehicles.modes import DAMPED, FREQUENCY, RATIO
from ..vehicles.unit_slips import UnitSlipWarning
from ..vehicles.vehicle import AssembledVehicle, Setting, Vehicle, coefficients_by_name
from . import weightings
from .linearisation import linear_at
from .measures.terms import Term
from .measures.vibration import RootSumSquare
from .problem import RideProblem
from .responses import frequency_responses, phase_degrees, response_psds, ride


@dataclass(frozen=True)
class DesignCurves:
    """Curves of a design over frequency."""

    label: str
    f: Real  # (n,) [Hz]
    responses: Mapping[str, Complex]  # H(w) (n,) from the road
    densities: Mapping[str, Real]  # spectra (n,) on the road, also of weighted accelerations (`weighted_name`)
    modes: pd.DataFrame  # design, mode, natural frequency, damped frequency, damping ratio
    rms: Mapping[str, float]  # root mean squares by name of the spectra; NaN where the integral diverges


def weighted_name(response: str) -> str:
    """Return the name of a weighted acceleration, ``"weighted_acceleration"`` for the body."""
    return f"weighted_{response.removeprefix('body_')}"


def frequencies(band: tuple[float, float], points: int) -> Real:
    """Return logarithmically spaced frequencies [Hz]; a band from 0 on begins at 0.1 Hz or a tenth of its end."""
    low, high = band
    return np.geomspace(low or min(0.1, high / 10), high, points)


def setting_of(problem: RideProblem, design: Sequence[float]) -> dict[str, float]:
    """Return the values of a design by name, with those that do not vary."""
    varied = dict(zip(problem.variables, design, strict=True))
    return coefficients_by_name({**problem.struts, **varied}, {})


def design_curves(
    problem: RideProblem, label: str, design: Sequence[float], responses: Sequence[str], points: int = 800
) -> DesignCurves:
    """Return the curves of a design (d,) in the first load case; accelerations also weighted."""
    case = problem.cases[0]
    vehicle, setting = linear_at(case, setting_of(problem, design), problem.band)
    closed = vehicle.closed(setting, responses=responses)
    f = frequencies(problem.band, points)
    densities = response_psds(closed, f, case.cross_spectrum(f))
    if problem.weighting is not None:
        factor = weightings.by_name(problem.weighting).factor(f)
        for name in responses:
            if name.endswith("acceleration"):
                densities[weighted_name(name)] = densities[name] * factor**2
    x = case.vehicle.contact_points[:, 0]
    h = frequency_responses(closed, f, (x.max() - x) / case.speed)
    rms = _root_mean_squares(problem, design, densities)
    return DesignCurves(label, f, h, densities, _modes(vehicle, setting, label), rms)


def _root_mean_squares(problem: RideProblem, design: Sequence[float], names: Iterable[str]) -> dict[str, float]:
    """Return the root mean squares over the band of spectra in the first load case, by their names."""
    case = problem.cases[0]
    weighted = {weighted_name(name): name for name in case.vehicle.meanings}
    measures = [
        RootSumSquare([Term(weighted[name], problem.weighting)], name=name)
        if name in weighted
        else RootSumSquare([Term(name)])
        for name in names
    ]
    setting, band = setting_of(problem, design), problem.band
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitSlipWarning)  # a design at the edge of the bounds may look like one
        table = ride(case.vehicle, setting, case.road, case.speed, weighting=None, band=band, measures=measures)
    return {name: float(table.value[name]) for name in names}


def rms_table(curves: Sequence[DesignCurves]) -> pd.DataFrame:
    """Return the root mean squares of designs: a row for each design, units in the headers."""
    names = list(curves[0].rms)
    units = [signal_unit(name) for name in names]
    rows = [[one.label, *(one.rms[name] for name in names)] for one in curves]
    return pd.DataFrame(rows, columns=["design", *column_headers(names, dict(zip(names, units, strict=True)))])


def curve_table(curves: DesignCurves) -> pd.DataFrame:
    """Return the curves of a design as columns, units in the headers."""
    table = pd.DataFrame({"design": curves.label, "frequency [Hz]": curves.f})
    for name, h in curves.responses.items():
        unit = signal_unit(name)
        table[f"{name} magnitude [{unit}/m]"] = np.abs(h)
        table[f"{name} phase [deg]"] = phase_degrees(h)
        table[f"{name} PSD [({unit})^2/Hz]"] = curves.densities[name]
        if (weighted := weighted_name(name)) in curves.densities:
            table[f"{weighted} PSD [({unit})^2/Hz]"] = curves.densities[weighted]
    return table


def _modes(vehicle: Vehicle, setting: Setting, label: str) -> pd.DataFrame:
    """Return the modes of a design, none of a plant."""
    columns = ["design", "mode", "natural frequency [Hz]", DAMPED, RATIO]
    if not isinstance(vehicle, AssembledVehicle):
        return pd.DataFrame(columns=columns)
    modes = vehicle.modes(setting).assign(design=label)
    return modes.rename(columns={"name": "mode", FREQUENCY: "natural frequency [Hz]"})[columns]
