"""Ride problems from TOML files, and from a vehicle, a road and a speed named on a command line.

A file holds, as wanted, ``measures`` and ``constraints`` (see those modules), ``weighting``, ``band_Hz``,
``worst_case`` and ``title``; ``[bounds]`` and ``[struts]`` as the file of a vehicle has them, in place of those of
the first case's vehicle; ``[[seats]]`` that are put on the vehicle of every case; and ``[[cases]]``, each with

- vehicle: the path of a file from this one, or the name of one that comes with the package (see `vehicle_files`);
- road: a class of ISO 8608 or the path of a file from this one (see `road_files`), and speed_m_per_s;
- if wanted share, ``[[cases.payload]]`` of mass_kg and position_m, and ``[cases.roll_geometry]``.
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from . import checks, paper
from .cases import LoadCase
from .mounted import Payload
from .objectives import RideProblem
from .road_files import load_road
from .toml_tables import Table, keyed, naming, read_toml
from .vehicle_files import VehicleFile, load_vehicle, read_bounds, read_roll_geometry, read_struts, with_seats

VEHICLE_HELP = "Vehicle in place of the paper's: path of a TOML file, or the name of one that comes along."
ROAD_HELP = "Road in place of the paper's: class of ISO 8608 (C, C-lower, C-upper), or path of a CSV or TOML file."

_KEYS = (
    "title", "measures", "constraints", "weighting", "band_Hz", "worst_case", "bounds", "struts", "seats", "cases",
)  # fmt: skip
_CASE = ("vehicle", "road", "speed_m_per_s", "share", "payload", "roll_geometry")
_PAYLOAD = {"mass_kg": "mass", "position_m": "position"}


def chosen(
    vehicle: str | None, road: str | None, speed: float | None, **settings: Any
) -> tuple[RideProblem, Mapping[str, float]]:
    """Return the paper's problem with another vehicle, road or speed, and the vehicle's own struts by name.

    Parameters
    ----------
    vehicle, road : str, optional
        As for `vehicle_files.load_vehicle` and `road_files.load_road`.
    speed : float, optional
        [m/s].
    **settings
        What else of `RideProblem` is to be other than in the paper.

    Raises
    ------
    ValueError
        If a file is not in order, has no bounds, or the settings do not fit.
    """
    papers = paper.ride_problem()
    changes: dict[str, Any] = {
        "road": load_road(road) if road else papers.road,
        "speed": speed or papers.speed,
    } | settings
    if vehicle is None:
        struts = dict(zip(papers.variables, paper.reference_design(), strict=True))
        return replace(papers, **changes), struts
    file = load_vehicle(vehicle)
    if not file.bounds:
        raise ValueError(f"vehicle must be a file with bounds, got {vehicle!r}")
    if "bounds" not in settings:
        changes["bounds"] = file.bounds
    struts = file.vehicle.coefficients(file.struts)
    fixed = {name: value for name, value in struts.items() if name not in changes["bounds"]}
    return replace(papers, vehicle=file.vehicle, struts=fixed, **changes), struts


def load_problem(path: Path) -> RideProblem:
    """Return the problem that a TOML file holds.

    Raises
    ------
    ValueError
        Naming the file and the key if it does not hold a problem.
    OSError
        If it, or a file that it names, cannot be read.
    """
    with naming(path):
        table = read_toml(path)
        table.check_keys(dict(zip(_KEYS, _KEYS, strict=True)), ["cases", "measures"])
        files, cases = zip(*(_case(table, one, path.parent) for one in _cases(table)), strict=True)
        first = cases[0].vehicle
        bounds = read_bounds(table.table("bounds").flat(), first) if "bounds" in table.content else files[0].bounds
        struts = files[0].struts
        if "struts" in table.content:
            struts = {**struts, **read_struts(table.table("struts").flat(), first)}
        settings: dict[str, Any] = {"weighting": table.text("weighting")} if "weighting" in table.content else {}
        if "band_Hz" in table.content:
            settings["band"] = table.pair("band_Hz")
        if "worst_case" in table.content:
            checks.one_of("worst_case", table.content["worst_case"], (True, False))
            settings["worst_case"] = table.content["worst_case"]
        return RideProblem(
            cases=cases,
            bounds=bounds,
            struts={name: value for name, value in struts.items() if name not in bounds},
            measures=_texts(table, "measures"),
            constraints=_texts(table, "constraints"),
            **settings,
        )


def _cases(table: Table) -> list[Table]:
    cases = table.tables("cases")
    if not cases:
        raise ValueError("cases must be an array of tables, one at least, got none")
    return cases


def _case(table: Table, case: Table, folder: Path) -> tuple[VehicleFile, LoadCase]:
    """Return the file of a case's vehicle, and the case."""
    case.check_keys(dict(zip(_CASE, _CASE, strict=True)), _CASE[:3])
    file = load_vehicle(_beside(folder, case.text("vehicle")))
    vehicle = with_seats(file.vehicle, table)
    for load in case.tables("payload"):
        load.check_keys(_PAYLOAD, ["mass_kg"])
        with keyed(load.name, _PAYLOAD):
            position = load.pair("position_m") if "position_m" in load.content else (0.0, 0.0)
            vehicle = Payload(mass=load.number("mass_kg"), position=position).on(vehicle)
    with keyed(case.name, {"speed_m_per_s": "speed", "share": "share"}):
        return file, LoadCase(
            vehicle=vehicle,
            road=load_road(_beside(folder, case.text("road"))),
            speed=case.number("speed_m_per_s"),
            share=case.number("share") if "share" in case.content else 1.0,
            roll_geometry=read_roll_geometry(case) or file.roll_geometry,
        )


def _beside(folder: Path, text: str) -> str:
    """Return a path as seen from the file that names it; a name without an ending is none."""
    return str(folder / text) if Path(text).suffix else text


def _texts(table: Table, key: str) -> tuple[str, ...]:
    value = table.content.get(key, [])
    if not (isinstance(value, list) and all(isinstance(text, str) for text in value)):
        raise ValueError(f"{key} must be an array of texts, got {value!r}")
    return tuple(value)
