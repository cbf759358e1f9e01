"""Figures 6 and 7: Bode plots and spectra of suspension travel, body acceleration and tyre load.

Without designs it draws the paper's reference car against its published optimum. Writes figure6, figure7
(PNG and PDF), natural_frequencies.csv and curves.csv to a folder whose path is the last line printed.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd
from typer import Option

from suspension_ctrl import RideProblem, checks, figures, files, paper, responses, terminal, weightings
from suspension_ctrl.figures import DesignCurves


def main(
    design: Annotated[
        list[str] | None, Option(help="Spring [N/m] and damper [N s/m]: 22000,1500. Repeatable.")
    ] = None,
    designs: Annotated[
        Path | None, Option(help="CSV with the columns 'spring [N/m]' and 'damper [N s/m]'.")
    ] = None,
    weighting: Annotated[str, Option(help="ISO 2631 weighting of the dashed spectra.")] = "Wk",
    points: Annotated[int, Option(parser=terminal.whole_number, help="Frequencies on each curve.")] = 800,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
) -> None:
    """Draw the frequency responses and response spectra of any number of designs."""
    chosen = [terminal.numbers("design", text, 2) for text in design or []]
    if designs is not None:
        chosen += read_designs(designs)
    labelled = [(design_label(*pair), *pair) for pair in chosen] or [
        (f"reference car: {design_label(*paper.reference_design())}", *paper.reference_design()),
        (f"published optimum: {design_label(*paper.optimised_design())}", *paper.optimised_design()),
    ]
    checks.at_least("points", points, 2)
    problem = paper.ride_problem(weighting=weighting)
    curves = [design_curves(problem, label, spring, damper, points) for label, spring, damper in labelled]
    folder = files.results_folder(out)
    natural = pd.DataFrame({"design": c.label, "natural frequency [Hz]": f} for c in curves for f in c.natural)
    terminal.show("Natural frequencies", natural, {"natural frequency [Hz]": 3})
    files.write_csv(folder / "natural_frequencies.csv", natural)
    files.write_csv(folder / "curves.csv", pd.concat([curve_table(c) for c in curves]))
    files.write_figure(folder / "figure6", figures.bode(curves))
    files.write_figure(folder / "figure7", figures.spectra(curves, weighting))
    print(folder)


def read_designs(path: Path) -> list[list[float]]:
    columns = ["spring [N/m]", "damper [N s/m]"]
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


def design_label(spring: float, damper: float) -> str:
    return f"{spring / 1e3:.10g} kN/m, {damper / 1e3:.10g} kN s/m"


def design_curves(problem: RideProblem, label: str, spring: float, damper: float, points: int) -> DesignCurves:
    closed = problem.vehicle.closed(spring, damper)
    f = np.geomspace(0.1, problem.band[1], points)
    densities = responses.response_psds(closed, f, problem.road.psd(f, problem.speed))
    factor = weightings.by_name(problem.weighting).factor(f)
    densities["weighted_acceleration"] = densities["body_acceleration"] * factor**2
    h = responses.frequency_responses(closed, f)
    return DesignCurves(label, f, h, densities, responses.natural_frequencies(closed))


def curve_table(curve: DesignCurves) -> pd.DataFrame:
    units = {"body_acceleration": "m/s^2", "suspension_travel": "m", "tyre_load": "N"}
    table = pd.DataFrame({"design": curve.label, "frequency [Hz]": curve.f})
    for name, h in curve.responses.items():
        table[f"{name} magnitude [{units[name]}/m]"] = np.abs(h)
        table[f"{name} phase [deg]"] = responses.phase_degrees(h)
        table[f"{name} PSD [({units[name]})^2/Hz]"] = curve.densities[name]
    table["weighted_acceleration PSD [(m/s^2)^2/Hz]"] = curve.densities["weighted_acceleration"]
    return table


if __name__ == "__main__":
    terminal.run_script(main)
