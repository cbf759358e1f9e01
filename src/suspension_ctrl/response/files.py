"""Ride problems in TOML files, see `schema`: measures, limits, bounds, and load cases with vehicles and roads."""

import warnings
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, cast

from .. import checks
from ..documents import Folder, Mistakes, Table, document, keyed
from ..quantities import unit
from ..roads.files import KINDS as ROADS
from ..schema.keys import BAD, Key, bad, keys_of
from ..schema.reading import read
from ..schema.usual import check_bare, is_usual
from ..schema.writing import content, toml
from ..tables import write_text
from ..vehicles.files import VehicleFile, coefficient_table, read_coefficients, vehicle_table
from ..vehicles.handling import RollGeometry
from ..vehicles.mounted import Payload, Seat
from ..vehicles.plant_files import is_plant, plant_table
from ..vehicles.unit_slips import UnitSlipWarning, slip_of
from ..vehicles.vehicle import Vehicle, coefficients_by_name
from . import weightings
from .bands import BAND, OwnBand
from .case_files import FROM_TOP, CaseDocument, filled, given_at, read_cases
from .event_files import IN_FILES
from .load_case import Drive, LoadCase
from .measures.limits import Limit, has_unit
from .measures.measure import Measure
from .placed_nodes import ACCURACIES
from .problem import RideProblem
from .scatter import Scatter
from .scatter_files import IN_TABLE
from .scores import NODES


@dataclass(frozen=True, kw_only=True)
class Document:
    """Keys of a problem file.

    Parameters
    ----------
    title : str
        A line about the problem.
    vehicle, road : str or table
        Of all load cases that do not name their own; without ``cases`` they are those of the one case.
    speed : float
        Likewise the vehicle speed [m/s].
    payload, roll_geometry : array of tables, table
        Likewise loads fixed to the body, and heights for cornering.
    measures, constraints : array of str
        Objectives, and limits on measures.
    weighting : str
        Weighting of ``ACC``.
    band : (float, float)
        Frequencies over which the spectra are integrated [Hz]; 0 to 20 Hz, of measured roads as far as known.
    worst_case : bool
        Whether an objective is the worst load case, in place of the mean square over them.
    unusual : bool
        Whether speeds, limits, bands and vehicles may be of no usual size: units are not judged by it.
    nodes : int
        Quadrature nodes; found if not given.
    accuracy : float
        Largest relative error by fewer nodes that are placed for the bounds, for very long searches.
    bounds : table
        Lowest and highest value of each coefficient that varies; those of the first case's vehicle if not given.
    kinds : table
        By the keys of ``bounds``: "integer", "log", "fixed" or an array of values.
    struts : table
        Coefficients that do not vary; those of the first case's vehicle if not given.
    scatter : table
        Deviations by name for robust measures such as ``q95 SWS``, and their sample, see ``[scatter]``.
    seats : array of tables
        Seats that are put on the vehicle of every case.
    events : table
        Events of every case by name, for measures such as ``peak front_travel bump``.
    cases : array of tables
        The load cases, if they are several.
    present, search : table, table
        Of a study: coefficients of the present design, and settings of searches.
    """

    title: str = ""
    measures: tuple[str, ...]
    constraints: tuple[str, ...] = ()
    weighting: str = "Wk"
    band: tuple[float, float] | None = field(default=None, metadata=unit("Hz"))
    worst_case: bool = False
    unusual: bool = False
    nodes: int | None = field(default=None, metadata=unit("", 2, NODES[-1]))
    accuracy: float | None = field(default=None, metadata=unit("", *ACCURACIES))
    vehicle: str | Mapping[str, Any] = ""
    road: str | Mapping[str, Any] = ""
    speed: float | None = field(default=None, metadata=unit("m/s", 1e-3, 1e3))
    bounds: Mapping[str, Any] = field(default_factory=dict)
    kinds: Mapping[str, Any] = field(default_factory=dict)
    struts: Mapping[str, Any] = field(default_factory=dict)
    scatter: Scatter | None = field(default=None, metadata=IN_TABLE)
    present: Mapping[str, Any] = field(default_factory=dict)
    search: Mapping[str, Any] = field(default_factory=dict)
    roll_geometry: RollGeometry | None = None
    seats: tuple[Seat, ...] = field(default=(), metadata={"most": 50})
    payload: tuple[Payload, ...] = ()
    events: Mapping[str, Drive] = field(default_factory=dict, metadata=IN_FILES)
    cases: tuple[CaseDocument, ...] = ()


class Content(NamedTuple):
    """A problem file as read, with mistakes that are noted."""

    values: Mapping[str, Any]  # parameters of the problem beside its cases
    cases: Sequence[LoadCase]
    file: VehicleFile  # of the first case, `BAD` if it cannot be read
    vehicle: Vehicle  # of the first case with its parts, `BAD` if one does not fit
    unusual: bool
    title: str
    present: Mapping[str, Any]
    search: Mapping[str, Any]

    def problem(self) -> RideProblem:
        """Return the problem; ValueError about a likely slip of units, unless a vehicle may be unusual."""
        with keyed("", {"band": "band_Hz", "f": "band_Hz"}), warnings.catch_warnings():  # f of an unknown road
            warnings.simplefilter("ignore" if self.unusual else "error", UnitSlipWarning)
            try:
                return RideProblem(cases=self.cases, **self.values)
            except UnitSlipWarning as slip:
                raise ValueError(str(slip)) from None


def load_problem(path: str | PathLike[str], *, allow_outside: bool = False) -> RideProblem:
    """Return the problem of a TOML file, also of a study, `allow_outside` as in `load_road`.

    Raises
    ------
    ValueError
        That lists the mistakes of the file, each with file, line, key and value.
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
    with document(checks.path_of("path", path), allow_outside) as table:
        return _problem(table)


def save_problem(path: str | PathLike[str], problem: RideProblem) -> None:
    """Write a file that `load_problem` reads as `problem`, vehicles and roads in it; ValueError if it cannot.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file, road = sc.load_vehicle("yuen_ramli_2010"), sc.load_road("C")
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds)
    >>> sc.save_problem("problem.toml", problem)
    >>> sc.load_problem("problem.toml") == problem
    True
    """
    if not isinstance(problem, RideProblem):
        raise ValueError(f"problem must be a RideProblem, got {checks.shown(problem)}")
    file = checks.path_of("path", path)
    problem = problem.replace(struts=coefficients_by_name(problem.struts, {}))
    write_text(file, toml(problem_table(problem, file), problem, _problem, Folder(file.parent)))


def problem_table(problem: RideProblem, path: Path) -> dict[str, Any]:
    """Return the table that `read_problem` reads as the problem; ValueError if there is none.

    Systems of plants are written beside the file at `path`.
    """
    if any(case.events != problem.cases[0].events for case in problem.cases):
        raise ValueError("events must be the same in all load cases of a file, got others")
    vehicle, bounds, weighting = problem.cases[0].vehicle, problem.bounds, cast(str, problem.weighting)
    order = [name for name in vehicle.variables if name in bounds]
    if list(bounds) != order:
        right, wrong = next((a, b) for a, b in zip(order, bounds, strict=True) if a != b)
        needed = checks.listing(order, right)
        raise ValueError(f"bounds must be in the vehicle's order, {needed}, got {wrong} in place of {right}")
    file = Document(
        measures=tuple(map(str, problem.measures)),
        constraints=tuple(map(str, problem.constraints)),
        weighting=weighting,
        band=None if isinstance(problem.band, OwnBand) else problem.band,
        worst_case=problem.worst_case,
        unusual=not _of_usual_size(problem),
        nodes=problem.nodes if type(problem.nodes) is int else None,  # those that were found are of a subclass
        accuracy=problem.accuracy,
        bounds=coefficient_table(vehicle, bounds),
        kinds=coefficient_table(vehicle, problem.kinds),
        struts=coefficient_table(vehicle, problem.struts),
        scatter=problem.scatter,
        events=dict(problem.cases[0].events),
    )
    return _with_cases(content(file), [content(one) for one in _case_documents(problem.cases, path)])


def _of_usual_size(problem: RideProblem) -> bool:
    """Whether a file may hold the speeds, the band and the limits of a problem without their units."""
    sizes = [(case.speed, "m/s") for case in problem.cases] + [(problem.band[1], "Hz")]
    sizes += [(one.value, one.measure.unit) for one in problem.constraints]
    return all(is_usual(*size) for size in sizes)


def _with_cases(table: dict[str, Any], cases: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the table of a problem with load cases, at its top what is the same in all."""
    first, keys = cases[0], (*FROM_TOP, "roll_geometry")
    same = {key: first[key] for key in keys if all(key in one and one[key] == first[key] for one in cases)}
    others = [{key: value for key, value in one.items() if key not in same} for one in cases]
    return {**same, **table, **({} if others == [{}] else {"cases": others})}


def _case_documents(cases: Sequence[LoadCase], path: Path) -> Iterator[CaseDocument]:
    """Yield the load cases, each vehicle written once."""
    vehicles: dict[Vehicle, dict[str, Any]] = {}
    for case in cases:
        vehicle = case.vehicle
        if vehicle not in vehicles:
            system = path.with_name(f"{path.stem}_vehicle{len(vehicles) + 1}")
            vehicles[vehicle] = (
                plant_table(vehicle, system)
                if is_plant(vehicle)
                else vehicle_table(VehicleFile(vehicle=vehicle, unusual=slip_of(vehicle) is not None))
            )
        yield CaseDocument(
            vehicle=vehicles[vehicle],
            road=content(case.road, ROADS),
            speed=case.speed,
            share=case.share,
            roll_geometry=case.roll_geometry,
        )


def _problem(table: Table) -> RideProblem:
    mistakes = Mistakes()
    found = read_problem(table, mistakes)
    mistakes.settle()
    return found.problem()


def read_problem(table: Table, mistakes: Mistakes) -> Content:
    """Return the content of a problem's table."""
    values = read(filled(table), _keys(table), mistakes)
    if values.get("cases") == ():
        mistakes.note("cases must be an array of tables, one at least, got none")
    title, present, search = (
        default if bad(value) else value
        for name, default in (("title", ""), ("present", {}), ("search", {}))
        for value in [values.get(name, default)]
    )
    if values.get("cases") in (BAD, ()) or values.get("seats") is BAD:
        return Content({}, [], BAD, BAD, False, title, present, search)
    given, events = read_cases(table, values, mistakes), values.get("events", {})
    unusual = values.get("unusual") is True or any(one.file.unusual for one in given if one)
    if not unusual:
        _check_sizes(table, values, mistakes)
    values = {name: value for name, value in values.items() if name in _OF_PROBLEM and not bad(value)}
    cases = [replace(one.case, events={} if bad(events) else events) for one in filter(None, given) if one.case]
    _check(values, cases, unusual, mistakes)
    first = given[0]
    if first:
        values |= _coefficients(values, first.file, cases[0] if first.case else None, mistakes)
    vehicle = first.case.vehicle if first and first.case else BAD
    return Content(values, cases, first.file if first else BAD, vehicle, unusual, title, present, search)


_OF_PROBLEM = {
    *(
        "measures",
        "constraints",
        "weighting",
        "band",
        "worst_case",
        "nodes",
        "accuracy",
        "bounds",
        "kinds",
        "struts",
        "scatter",
    ),
}


def _keys(table: Table) -> dict[str, Key]:
    """Return the keys of a problem: without load cases, vehicle, road and speed are required if one is given."""
    keys = dict(keys_of(Document))
    if "cases" not in table.content:
        here = any(given_at(table.content, key) for key in FROM_TOP)
        required = FROM_TOP if here else ["cases"]
        keys |= {key: keys[key]._replace(default=MISSING) for key in required}
    return keys


def _check(values: Mapping[str, Any], cases: Sequence[LoadCase], unusual: bool, mistakes: Mistakes) -> None:
    """Note mistakes in band, weighting, measures and limits."""
    with mistakes.noted():
        checks.interval("band_Hz", values.get("band", BAND), "Hz")
    weighting, measures = values.get("weighting", "Wk"), list[Measure]()
    with mistakes.noted():
        weightings.checked(weighting)
        for name in ("measures", "constraints"):
            for i, text in enumerate(values.get(name, ()), start=1):
                with mistakes.noted(f"{name}[{i}]: "):
                    judged = Limit.parse(text, measures) if name == "constraints" else Measure.parse(text)
                    measures += [judged] if isinstance(judged, Measure) else []
                    for case in cases:
                        judged.nominal.in_case(case, weighting)
                    if isinstance(judged, Limit) and not (has_unit(text) or unusual):
                        check_bare(f"limit of {judged.measure.label}", judged.value, judged.measure.unit)


def _check_sizes(table: Table, values: Mapping[str, Any], mistakes: Mistakes) -> None:
    """Note numbers without a unit in their text that are of no usual size: speeds, the band, limits."""
    cases = [{} if bad(one) else {"speed": one.speed} for one in values.get("cases", ())]
    tables = [("", table.content, values)]
    raw = zip(table.content.get("cases", ()), cases, strict=True)
    tables += [(f"cases[{i}].", own, one) for i, (own, one) in enumerate(raw, start=1)]
    for name, own, read_values in tables:
        if isinstance(own, dict) and "speed_m_per_s" in own and not bad(read_values.get("speed", BAD)):
            with mistakes.noted():
                check_bare(f"{name}speed_m_per_s", read_values["speed"], "m/s")
    if "band_Hz" in table.content and not bad(values.get("band", BAD)):
        with mistakes.noted():
            check_bare("band_Hz", values["band"][1], "Hz")


def _coefficients(
    values: Mapping[str, Any], file: VehicleFile, case: LoadCase | None, mistakes: Mistakes
) -> dict[str, Any]:
    """Return bounds, kinds and struts by coefficient; without tables those of the vehicle's file."""

    def table(name: str, form: Any, given: Collection[str] = ()) -> dict[str, Any]:
        vehicle = case.vehicle if case else file.vehicle
        inner = Table(f"{name}.", values[name])
        return read_coefficients(inner, vehicle, form, mistakes, given, others=case is None)

    bounds = table("bounds", tuple[float, float]) if "bounds" in values else dict(file.bounds)
    if not bounds:
        needed = "given, one at least, where the first case's vehicle has none"
        mistakes.note(f"bounds must be {needed}, got none")
    struts = table("struts", float, bounds) if "struts" in values else file.setting
    return {
        "bounds": bounds,
        "kinds": table("kinds", str | tuple[float, ...]) if "kinds" in values else {},
        "struts": {name: value for name, value in struts.items() if name not in bounds},
    }
