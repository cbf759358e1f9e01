"""A design in files for others: vehicle, state space, numbers and the page for the supplier."""

import re
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import control

from .. import checks
from ..quantities import column_headers
from ..response.load_case import LoadCase
from ..response.problem import RideProblem
from ..tables import write_json
from ..tables.atomic import write_whole
from ..vehicles.feedback import System
from ..vehicles.files import VehicleFile, save_vehicle
from ..vehicles.networks import has_force_laws
from ..vehicles.system_files import save_system
from .candidate_table import Present
from .design_documents import can_be_written, design_document
from .designs import closed_at, present_of, setting_at, values_of, vehicle_file
from .pages import PAGE
from .sheet_tables import checked_tolerances
from .supplier import draw_sheet

if TYPE_CHECKING:
    import pandas as pd

_LONGEST = 40  # letters of the name of a file


def export(
    problem: RideProblem,
    design: Present,
    folder: str | PathLike[str],
    *,
    present: Present | None = None,
    name: str = "design",
    tolerances: Mapping[str, float] | None = None,
    date: str = "",
) -> list[Path]:
    """Write a design for others: as a vehicle, as state space, as numbers and as a page for the supplier.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like, or mapping of str to float
        Variables of the design.
    folder : str or path-like
        It is made if it does not exist; files of the same names are replaced.
    present : (d,) array_like, or mapping of str to float, optional
        Design of today, to compare with.
    name : str
        Name of the design: title of the page, and beginning of the names of the files.
    tolerances, date
        As of `supplier_sheet`.

    Returns
    -------
    list of Path
        The files. ``.toml`` is the vehicle with the design in place for `load_vehicle` and commands; ``.mat`` and
        ``.m`` are its state space from roads to responses, with names and units, force laws replaced by equivalent
        springs and dampers as on the road of the load case; ``.csv`` of frequency responses is in their place for
        a vehicle that is known by these. A further load case with another vehicle, or with force laws, has files
        with ``_case_2`` and so on in their names. ``.json`` holds design, vehicles, matrices, parts, measures and
        working ranges in SI units, ``.pdf`` the page of `supplier_sheet`. What a vehicle cannot have is left out:
        a plant has no ``.toml``, measured stiffness no state space.

    Raises
    ------
    ValueError
        As of `supplier_sheet`; OSError if a file cannot be written.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(car.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=car.bounds)
    >>> files = sc.export(problem, [12.389e3, 1616.3], "handed_on", present=car.setting, name="optimum")
    >>> [file.name for file in files]
    ['optimum.toml', 'optimum.mat', 'optimum.m', 'optimum.json', 'optimum.pdf']
    """
    from matplotlib.figure import Figure

    chosen = values_of("design", problem, design)
    before = present_of(problem, present)
    sheet, shares = Figure(figsize=PAGE), checked_tolerances(problem, chosen, tolerances or {})
    draw_sheet(sheet, problem, chosen, before, name=name, tolerances=shares, date=date)
    place = checks.path_of("folder", folder)
    place.mkdir(parents=True, exist_ok=True)
    stem, written = place / script_name(name), list[Path]()
    for number, case in enumerate(problem.cases, start=1):
        if number == 1 or _differs(case, problem.cases[0]):
            own = stem if number == 1 else stem.with_name(f"{stem.name}_case_{number}")
            written += _written(
                own,
                vehicle_file(problem, chosen, case=number, name=name),
                closed_at(case, setting_at(problem, chosen), problem.band),
            )
    table, page = stem.with_suffix(".json"), stem.with_suffix(".pdf")
    write_json(table, design_document(problem, chosen, before, name))
    write_whole(page, lambda path: sheet.savefig(path, metadata={"CreationDate": None}))
    return [*written, table, page]


def save_candidates(problem: RideProblem, table: "pd.DataFrame", folder: Path, title: str) -> list[Path]:
    """Write a vehicle file for each row of a table of `candidates`, none of a vehicle that a file cannot hold."""
    headers, written = column_headers(problem.variables, problem.units), list[Path]()
    for number, row in table.iterrows():
        file = vehicle_file(problem, row[headers].to_list(), name=f"{title}: {number} {row['name']}")
        if can_be_written(file):
            folder.mkdir(exist_ok=True)
            written.append(folder / f"{number}_{script_name(row['name'])}.toml")
            save_vehicle(written[-1], file)
    return written


def script_name(name: str) -> str:
    """Return a name as one of a script of MATLAB: letters, digits and underscores, a letter first."""
    text = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")[:_LONGEST]
    return text if text[:1].isalpha() else f"design_{text}".rstrip("_")


def _differs(case: LoadCase, first: LoadCase) -> bool:
    """Whether the linear vehicle of a load case is another than that of the first."""
    return case.vehicle != first.vehicle or has_force_laws(case.vehicle.networks)


def _written(stem: Path, file: VehicleFile, system: "System | None") -> Iterator[Path]:
    """Write vehicle and system, each where a file can hold it, and yield the paths."""
    if can_be_written(file):
        save_vehicle(stem.with_suffix(".toml"), file)
        yield stem.with_suffix(".toml")
    if system is not None:
        for ending in (".mat", ".m") if isinstance(system, control.StateSpace) else (".csv",):
            save_system(stem.with_suffix(ending), system)
            yield stem.with_suffix(ending)
