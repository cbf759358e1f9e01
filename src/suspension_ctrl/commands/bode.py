"""Figures 6 and 7: Bode plots and spectra of responses to the road, of the paper's car or any other vehicle."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

    from ..desk.study_files import StudyFile
    from ..response.curves import DesignCurves
    from ..response.problem import RideProblem

SHOWN = ("suspension_travel", "body_acceleration", "tyre_load")  # of the first wheel, in the paper's order
NATURAL = "Natural frequencies"
WRITTEN = 2  # variables whose values stand in the label of a design


def bode(
    design: o.Design = None,
    designs: o.Designs = None,
    study: o.Study = None,
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
    """Draw Bode plots and spectra of responses of any vehicle.

    Without designs: the paper's reference car and its published optimum, or the struts of the vehicle. Under
    several wheels the Bode plot is of a road identical on all tracks, which the rear wheels meet later. Writes
    figure6, figure7 (PNG, PDF), designs.csv, natural_frequencies.csv and curves.csv to a folder; its path is the
    last line printed. Of more than eight designs the figures show eight.
    """
    import pandas as pd

    from .. import checks
    from ..paper import figures
    from ..response import curves
    from ..tables import write_figure, write_tables
    from . import studies, terminal

    checks.at_least("points", points, 2)
    given: dict[str, Any] = {"road": road, "speed": speed, "band": band, "weighting": weighting}
    chosen = studies.chosen_study(study=study, vehicle=vehicle, allow_outside=allow_outside, **given)
    problem, labelled = chosen.problem, labelled_designs(chosen, design or [], designs)
    case, (low, high) = problem.cases[0], problem.band
    shown = response or shown_responses(case.vehicle.responses)
    drawn = [curves.design_curves(problem, label, values, shown, points) for label, values in labelled.items()]
    natural = pd.concat([one.modes for one in drawn])
    folder = studies.folder_with(chosen, out)
    table, rms = design_table(problem, labelled), curves.rms_table(drawn)
    every = pd.concat([curves.curve_table(one) for one in drawn])
    told = table.merge(rms, on="design")
    write_tables(folder, {"designs": told, "natural_frequencies": natural, "curves": every})
    with terminal.waiting("drawing"):
        write_figure(folder / "figure6", figures.bode(drawn))
        write_figure(folder / "figure7", figures.spectra(drawn, str(problem.weighting)))
    terminal.note(f"Road: {case.describe()}; {low:g} to {high:g} Hz.")
    show_tables({"Designs": table, "Root mean squares": rms, NATURAL: natural}, figures.spread(drawn))
    terminal.end(folder)


def show_tables(tables: "Mapping[str, pd.DataFrame]", shown: "Sequence[DesignCurves]") -> None:
    """Print the rows of the designs that the figures show."""
    from . import terminal

    labels = [one.label for one in shown]
    if (count := tables["Designs"].design.nunique()) > len(labels):
        terminal.note(f"Figures and tables show {len(labels)} of {count} designs, the files have all.")
    for title, table in tables.items():
        rows = table[table.design.isin(labels)].replace({"design": short(labels)})
        if title == NATURAL:
            terminal.show(title, rows, keys=2)
        else:
            terminal.show(title, beside_one_another(rows), keys=2, readable=True)


def short(labels: Sequence[str]) -> dict[str, str]:
    """Return labels without the values behind their names, unless names alone are not distinct."""
    names = {label: label.partition(": ")[0] for label in labels}
    return names if len(set(names.values())) == len(labels) else {}


def beside_one_another(designs: "pd.DataFrame") -> "pd.DataFrame":
    """Return a table with a row for each design as one with a column for each: name, unit, designs."""
    from ..tables.headers import own_name_and_unit

    turned = designs.set_index("design").T.reset_index(names="name").rename_axis(columns=None)
    names = [own_name_and_unit(header) for header in turned["name"]]
    turned["name"] = [name for name, _ in names]
    turned.insert(1, "unit", [unit for _, unit in names])
    return turned


def shown_responses(responses: Sequence[str]) -> list[str]:
    """Return travel, body acceleration and tyre load of the first wheel, or the first responses of a plant."""
    found = [next((name for name in responses if name.endswith(last)), None) for last in SHOWN]
    return list(filter(None, found)) or list(responses[: len(SHOWN)])


def labelled_designs(study: "StudyFile", texts: Sequence[str], file: Path | None) -> dict[str, Sequence[float]]:
    """Return the designs of texts and of a file by label; by default the paper's two, or the present one."""
    from ..paper import experiment as paper

    problem = study.problem
    units = [problem.units[name] for name in problem.variables]
    designs: list[tuple[str, Sequence[float]]] = [("", o.numbers("design", text, units)) for text in texts]
    designs += [] if file is None else read_designs(file, problem)
    if not designs and paper.is_papers(problem):
        designs = [("reference car", paper.reference_design()), ("published optimum", paper.optimised_design())]
    elif not designs and not study.present:
        raise ValueError("design must be given where the present one is unknown, got none")
    return with_labels(problem, designs or [(study.name, list(study.present.values()))])


def with_labels(
    problem: "RideProblem", designs: Sequence[tuple[str, Sequence[float]]]
) -> dict[str, Sequence[float]]:
    """Return designs with names by label: the name, and the values of up to two variables; each label once."""
    from ..tables.headers import shown_unit

    shown = [shown_unit(problem.units[name]) for name in problem.variables]
    labels: dict[str, Sequence[float]] = {}
    for number, (name, values) in enumerate(designs, start=1):
        texts = [
            f"{value * factor:.4g} {unit}".rstrip() for value, (unit, factor) in zip(values, shown, strict=True)
        ]
        parts = [name, ", ".join(texts) if len(texts) <= WRITTEN else ""]
        label = ": ".join(filter(None, parts)) or f"design {number}"
        labels[f"{label} ({number})" if label in labels else label] = values
    return labels


def read_designs(path: Path, problem: "RideProblem") -> list[tuple[str, list[float]]]:
    """Return the designs in a CSV file with a column for each variable, each with its name in a column ``design``.

    ValueError for another file.
    """
    from ..quantities import column_headers
    from ..tables import read_table, read_texts

    _, values = read_table(path, column_headers(problem.variables, problem.units), rows=1)
    names = read_texts(path, "design")
    return list(zip(names if len(names) == len(values) else [""] * len(values), values.tolist(), strict=True))


def design_table(problem: "RideProblem", labelled: Mapping[str, Sequence[float]]) -> "pd.DataFrame":
    """Return the variables of designs: a row for each, units in the headers."""
    import pandas as pd

    from ..quantities import column_headers

    rows = [[label, *values] for label, values in labelled.items()]
    return pd.DataFrame(rows, columns=["design", *column_headers(problem.variables, problem.units)])
