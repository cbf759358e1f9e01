"""Figures 6 and 7: Bode plots and spectra of responses to the road, of the paper's car or any other vehicle."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from . import options as o

if TYPE_CHECKING:
    from ..response.problem import RideProblem

SHOWN = ("suspension_travel", "body_acceleration", "tyre_load")  # of the first wheel, in the paper's order


def bode(
    design: o.Design = None,
    designs: o.Designs = None,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
    speed: o.Speed = None,
    band: o.Band = None,
    response: o.Response = None,
    weighting: o.Weighting = None,
    points: o.Points = 800,
    out: o.Out = None,
) -> None:
    """Draw Bode plots and spectra of responses: Figures 6 and 7.

    Without designs: the paper's reference car and its published optimum, or the struts of the vehicle. Under
    several wheels the Bode plot is of a road identical on all tracks, which the rear wheels meet later. Writes
    figure6, figure7 (PNG, PDF), natural_frequencies.csv and curves.csv to a folder; its path is the last line
    printed.
    """
    import pandas as pd

    from .. import checks
    from ..paper import experiment, figures
    from ..response import curves
    from ..tables import write_csv, write_figure
    from . import results, terminal

    checks.at_least("points", points, 2)
    settings = o.settings(weighting, band)
    problem, own = experiment.chosen(vehicle, road, speed, allow_outside=allow_outside, **settings)
    labelled = labelled_designs(problem, design or [], designs, vehicle, own)
    case, (low, high) = problem.cases[0], problem.band
    shown = response or [next(r for r in case.vehicle.responses if r.endswith(last)) for last in SHOWN]
    drawn = [curves.design_curves(problem, label, values, shown, points) for label, values in labelled.items()]
    natural = pd.concat([one.modes for one in drawn])
    folder = results.results_folder(out)
    write_csv(folder / "natural_frequencies.csv", natural)
    write_csv(folder / "curves.csv", pd.concat([curves.curve_table(one) for one in drawn]))
    with terminal.waiting("drawing"):
        write_figure(folder / "figure6", figures.bode(drawn))
        write_figure(folder / "figure7", figures.spectra(drawn, str(problem.weighting)))
    terminal.note(f"Road: {case.describe()}; {low:g} to {high:g} Hz.")
    terminal.show("Natural frequencies", natural, dict.fromkeys(natural.columns[2:], 3), keys=2)
    print(folder)


def labelled_designs(
    problem: "RideProblem", texts: Sequence[str], file: Path | None, vehicle: str | None, own: Mapping[str, float]
) -> dict[str, Sequence[float]]:
    """Return the designs of texts and of a file by label; by default the vehicle's own, or the paper's two."""
    from ..paper import experiment as paper

    units = [problem.units[name] for name in problem.variables]
    designs: list[Sequence[float]] = [o.numbers("design", text, units) for text in texts]
    designs += [] if file is None else read_designs(file, problem)
    if not designs and vehicle is not None:
        return {vehicle: [own[name] for name in problem.variables]}
    if designs:
        return {design_label(values): values for values in designs}
    papers = {"reference car": paper.reference_design(), "published optimum": paper.optimised_design()}
    return {f"{name}: {design_label(values)}": values for name, values in papers.items()}


def read_designs(path: Path, problem: "RideProblem") -> list[list[float]]:
    """Return the designs in a CSV file with a column for each variable; ValueError for another file."""
    from ..quantities import column_headers
    from ..tables import read_table

    _, values = read_table(path, column_headers(problem.variables, problem.units), rows=1)
    designs: list[list[float]] = values.tolist()
    return designs


def design_label(values: Sequence[float]) -> str:
    """Return the label of a design."""
    if len(values) == 2:
        return f"{values[0] / 1e3:.10g} kN/m, {values[1] / 1e3:.10g} kN s/m"
    return ", ".join(f"{value:.6g}" for value in values)
