"""Ride problems from TOML files, and from a vehicle, a road and a speed named on a command line.

A file holds ``measures`` and, as wanted, ``constraints`` (see those modules), ``weighting``, ``band_Hz``,
``worst_case`` and ``title``; ``[bounds]`` and ``[struts]`` as the file of a vehicle has them, in place of those of
the first case's vehicle; ``[kinds]`` with the keys of ``[bounds]``, each "integer", "log", "fixed" or an array of
values; ``[[seats]]`` that are put on the vehicle of every case; and ``[[cases]]``, each with

- vehicle: the path of a file from this one, or the name of one that comes with the package (see `vehicle_files`);
- road: a class of ISO 8608 or the path of a file from this one (see `road_files`), and speed_m_per_s;
- if wanted share, ``[[cases.payload]]`` of mass_kg and position_m, and ``[cases.roll_geometry]``.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..documents import Table, keyed, made, naming, read_toml, under
from ..roads.files import load_road
from ..vehicles.files import (
    VehicleFile,
    load_vehicle,
    read_bounds,
    read_kinds,
    read_roll_geometry,
    read_setting,
    with_seats,
)
from ..vehicles.mounted import Payload
from ..vehicles.vehicle import Vehicle
from . import weightings
from .load_case import LoadCase
from .measures.limits import Limit
from .measures.measure import Measure
from .problem import RideProblem

_KEYS = (
    "title", "measures", "constraints", "weighting", "band_Hz", "worst_case", "bounds", "kinds", "struts", "seats",
    "cases",
)  # fmt: skip
_CASE = ("vehicle", "road", "speed_m_per_s", "share", "payload", "roll_geometry")


def load_problem(path: str | Path, *, allow_outside: bool = False) -> RideProblem:
    """Return the problem of a TOML file, `allow_outside` as in `load_road`.

    Raises
    ------
    ValueError
        Naming the file and the key if it does not hold a problem.
    OSError
        If it, or a file that it names, cannot be read.

    Examples
    --------
    The bounds are those of the vehicle's file where the problem has none:

    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> text = '''
    ... measures = ["ACC", "DTL"]
    ... constraints = ["SWS <= 0.03"]
    ...
    ... [[cases]]
    ... vehicle = "yuen_ramli_2010"
    ... road = "C"
    ... speed_m_per_s = 20.0
    ... '''
    >>> _ = Path("comfort.toml").write_text(text)
    >>> problem = sc.load_problem("comfort.toml")
    >>> dict(problem.bounds)
    {'spring': (1000.0, 30000.0), 'damper': (1000.0, 5000.0)}
    """
    path = Path(path)
    with naming(path):
        table = read_toml(path)
        table.check_keys(dict(zip(_KEYS, _KEYS, strict=True)), ["cases", "measures"])
        settings = _settings(table)
        if not (given := table.tables("cases")):
            raise ValueError("cases must be an array of tables, one at least, got none")
        files, cases = zip(*(_case(table, one, path.parent, allow_outside) for one in given), strict=True)
        bounds, struts = _bounds_and_struts(table, files[0], cases[0].vehicle)
        settings["kinds"] = read_kinds(table.table("kinds").flat(), cases[0].vehicle)
        settings |= {key: table.texts(key) for key in ("measures", "constraints")}
        for case in cases:
            _check_texts(case, settings)
        with keyed("", {"band_Hz": "band"}), keyed("", {"band_Hz": "f"}):  # f of a road that is not known there
            return RideProblem(cases=cases, bounds=bounds, struts=struts, **settings)


def _settings(table: Table) -> dict[str, Any]:
    """Return weighting, band and worst case where the file has them."""
    readers = {"title": table.text, "weighting": table.text, "band_Hz": table.pair, "worst_case": table.boolean}
    found = {key: read(key) for key, read in readers.items() if key in table.content}
    weightings.checked(found.get("weighting"))
    return {key.removesuffix("_Hz"): value for key, value in found.items() if key != "title"}


def _bounds_and_struts(
    table: Table, file: VehicleFile, vehicle: Vehicle
) -> tuple[dict[str, tuple[float, float]], dict[str, float]]:
    """Return the bounds of coefficients that vary and the values of those that do not."""
    own = "bounds" in table.content
    bounds = read_bounds(table.table("bounds").flat(), vehicle) if own else dict(file.bounds)
    if not bounds:
        raise ValueError("bounds must be given, one at least, where the first case's vehicle has none, got none")
    struts = read_setting(table.table("struts").flat(), vehicle) if "struts" in table.content else file.setting
    return bounds, {name: value for name, value in struts.items() if name not in bounds}


def _check_texts(case: LoadCase, settings: Mapping[str, Any]) -> None:
    """Raise ValueError that says which measure or constraint means nothing in a case."""
    weighting, measures = settings.get("weighting", "Wk"), []
    for i, text in enumerate(settings["measures"], start=1):
        with under(f"measures[{i}]"):
            measures.append(Measure.parse(text))
            measures[-1].in_case(case, weighting)
    for i, text in enumerate(settings["constraints"], start=1):
        with under(f"constraints[{i}]"):
            Limit.parse(text, measures).in_case(case, weighting)


def _case(table: Table, case: Table, folder: Path, allow_outside: bool) -> tuple[VehicleFile, LoadCase]:
    """Return the file of a case's vehicle, and the case."""
    case.check_keys(dict(zip(_CASE, _CASE, strict=True)), _CASE[:3])
    names = {key: _beside(folder, case.text(key)) for key in _CASE[:2]}
    with under(f"{case.name}vehicle"):
        file = load_vehicle(names["vehicle"])
    with under(f"{case.name}road"):
        road = load_road(names["road"], allow_outside=allow_outside)
    vehicle = with_seats(file.vehicle, table)
    for load in case.tables("payload"):
        with keyed(load.name, {"position_m": "position"}):
            vehicle = made(load, Payload).on(vehicle)
    with keyed(case.name, {"speed_m_per_s": "speed", "share": "share"}):
        return file, LoadCase(
            vehicle=vehicle,
            road=road,
            speed=case.number("speed_m_per_s"),
            share=case.number("share") if "share" in case.content else 1.0,
            roll_geometry=read_roll_geometry(case) or file.roll_geometry,
        )


def _beside(folder: Path, text: str) -> str:
    """Return a path as seen from the file that names it; a name without an ending is none."""
    return str(folder / text) if Path(text).suffix else text
