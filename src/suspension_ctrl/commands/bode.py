"""Figures 6 and 7: Bode plots and spectra of responses to the road, of the paper's car or any other vehicle.

Without designs it draws the paper's reference car against its published optimum, or a vehicle's own struts.
Under several wheels the Bode plot is that of a road alike on all tracks, which the rear wheels meet later. Writes
figure6, figure7 (PNG and PDF), natural_frequencies.csv and curves.csv to a folder whose path is the last line
printed.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd
from typer import Option

from .. import checks
from .. import tables as files
from ..paper import experiment as paper
from ..quantities import column_headers, signal_unit
from ..response import figures, responses, weightings
from ..response.figures import DesignCurves
from ..response.problem import RideProblem
from ..vehicles.vehicle import assembled
from . import results, terminal

LOWEST = 0.1  # Hz, of a band from 0 on
PAPERS_ORDER = ("suspension_travel", "body_acceleration", "tyre_load")


def main(
    design: Annotated[
        list[str] | None, Option(help="Spring [N/m] and damper [N s/m]: 22000,1500. Repeatable.")
    ] = None,
    designs: Annotated[
        Path | None, Option(help="CSV with a column for each variable: 'spring [N/m]' and 'damper [N s/m]'.")
    ] = None,
    vehicle: Annotated[str | None, Option(help=paper.VEHICLE_HELP)] = None,
    road: Annotated[str | None, Option(help=paper.ROAD_HELP)] = None,
    speed: Annotated[float | None, Option(parser=terminal.number, help="Speed [m/s].")] = None,
    band: Annotated[str | None, Option(help="Frequencies [Hz]: 0.5,20.")] = None,
    response: Annotated[
        list[str] | None, Option(help="Response to be drawn, e.g. pitch_acceleration. Repeatable.")
    ] = None,
    weighting: Annotated[str, Option(help="ISO 2631 weighting of the dashed spectra.")] = "Wk",
    points: Annotated[int, Option(parser=terminal.whole_number, help="Frequencies on each curve.")] = 800,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
) -> None:
    """Draw the frequency responses and response spectra of any number of designs."""
    checks.at_least("points", points, 2)
    settings = terminal.band_of(band)
    problem, struts = paper.chosen(vehicle, road, speed, weighting=weighting, **settings)
    chosen = [terminal.numbers("design", text, len(problem.variables)) for text in design or []]
    if designs is not None:
        chosen += read_designs(designs, problem)
    labelled = [(design_label(values), values) for values in chosen]
    if not chosen and vehicle is None:
        labelled = [
            (f"{name}: {design_label(values)}", values)
            for name, values in (
                ("reference car", paper.reference_design()),
                ("published optimum", paper.optimised_design()),
            )
        ]
    elif not chosen:
        labelled = [(vehicle, [struts[name] for name in problem.variables])]
    shown = response or default_responses(problem)
    curves = [design_curves(problem, label, values, shown, points) for label, values in labelled]
    folder = results.results_folder(out)
    natural = pd.concat([natural_frequencies(problem, label, values) for label, values in labelled])
    terminal.show("Natural frequencies", natural, {"natural frequency [Hz]": 3, "damping ratio [-]": 3})
    files.write_csv(folder / "natural_frequencies.csv", natural)
    files.write_csv(folder / "curves.csv", pd.concat([curve_table(c) for c in curves]))
    results.write_figure(folder / "figure6", figures.bode(curves))
    results.write_figure(folder / "figure7", figures.spectra(curves, weighting))
    print(folder)


def read_designs(path: Path, problem: RideProblem) -> list[list[float]]:
    columns = column_headers(problem.variables, problem.units)
    allowed = f"designs must be a CSV file with numbers in the columns {', '.join(columns)}"
    try:
        table = pd.read_csv(path)
        values = table[columns].astype(float).to_numpy()
    except OSError as error:
        raise ValueError(f"{allowed}, got {str(path)!r}: {error.strerror}") from None
    except KeyError as error:
        raise ValueError(f"{allowed}, got {str(path)!r}: {error.args[0]}") from None
    except ValueError as error:  # pandas' parser errors are among them
        raise ValueError(f"{allowed}, got {str(path)!r}: {error}") from None
    if not len(values):
        raise ValueError(f"{allowed}, got {str(path)!r} without a row")
    return values.tolist()


def design_label(values: list[float]) -> str:
    if len(values) == 2:
        return f"{values[0] / 1e3:.10g} kN/m, {values[1] / 1e3:.10g} kN s/m"
    return ", ".join(f"{value:.6g}" for value in values)


def default_responses(problem: RideProblem) -> list[str]:
    """Return a travel, the body's acceleration and a tyre's load, of the first wheel."""
    names = problem.cases[0].vehicle.responses
    return [next(name for name in names if name.endswith(last)) for last in PAPERS_ORDER]


def frequencies(band: tuple[float, float], points: int) -> np.ndarray:
    """Return frequencies evenly apart on a logarithmic axis, which does not reach down to 0."""
    low, high = band
    return np.geomspace(low or min(LOWEST, high / 10), high, points)


def settings_of(problem: RideProblem, values: list[float]) -> dict[str, float]:
    return {**problem.struts, **dict(zip(problem.variables, values, strict=True))}


def design_curves(
    problem: RideProblem, label: str, values: list[float], shown: list[str], points: int
) -> DesignCurves:
    case = problem.cases[0]
    closed = case.vehicle.closed(settings_of(problem, values), responses=shown)
    f = frequencies(problem.band, points)
    densities = responses.response_psds(closed, f, case.cross_spectrum(f))
    factor = weightings.by_name(problem.weighting).factor(f)
    for name in shown:
        if name.endswith("acceleration"):
            densities[figures.weighted_name(name)] = densities[name] * factor**2
    x = case.vehicle.contact_points[:, 0]
    h = responses.frequency_responses(closed, f, (x.max() - x) / case.speed)
    return DesignCurves(label, f, h, densities, responses.natural_frequencies(closed))


def natural_frequencies(problem: RideProblem, label: str, values: list[float]) -> pd.DataFrame:
    modes = assembled(problem.cases[0].vehicle).modes(settings_of(problem, values))
    swinging = modes[modes["damping ratio [-]"] < 1]
    shown = swinging.rename(columns={"name": "mode", "frequency [Hz]": "natural frequency [Hz]"})
    shown.insert(0, "design", label)
    return shown[["design", "mode", "natural frequency [Hz]", "damping ratio [-]"]]


def curve_table(curve: DesignCurves) -> pd.DataFrame:
    table = pd.DataFrame({"design": curve.label, "frequency [Hz]": curve.f})
    for name, h in curve.responses.items():
        unit = signal_unit(name)
        table[f"{name} magnitude [{unit}/m]"] = np.abs(h)
        table[f"{name} phase [deg]"] = responses.phase_degrees(h)
        table[f"{name} PSD [({unit})^2/Hz]"] = curve.densities[name]
        if (weighted := figures.weighted_name(name)) in curve.densities:
            table[f"{weighted} PSD [({unit})^2/Hz]"] = curve.densities[weighted]
    return table
