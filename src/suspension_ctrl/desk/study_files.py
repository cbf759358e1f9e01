"""Studies in TOML files: a problem, the present design and the settings of searches."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from .. import checks, datafiles
from ..documents import Folder, Mistakes, Table, document, keyed
from ..quantities import FrozenMapping, Record, unit
from ..response.files import Content, problem_table, read_problem
from ..response.problem import RideProblem
from ..schema.keys import BAD, bad, keys_of
from ..schema.reading import fields_named, read
from ..schema.writing import toml
from ..study.comparison import ALGORITHMS, Comparison, evaluations
from ..tables import write_text
from ..vehicles.files import coefficient_table, read_coefficients
from ..vehicles.vehicle import Vehicle, coefficients_by_name

_OWN = {"present", "search"}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SearchSettings(Record):
    """Settings of searches in a study.

    Parameters
    ----------
    algorithms : array of str
        Names as of `compare --algorithms`; the first is the baseline.
    populations, iterations : array of int
        Population sizes and numbers of iterations, each with each.
    repeats : int
        Timed runs of each algorithm at each configuration.
    seeds : int
        Judged runs of each algorithm at each population.
    seed : int
        Seed of the first run, zero or more; the next run has the next number.
    target : float
        Share of the reference hypervolume to reach, above 0 up to 1 [-].

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.SearchSettings(populations=(200,), iterations=(50,), seed=7)
    SearchSettings(populations=(200,), iterations=(50,), seed=7)
    """

    algorithms: tuple[str, ...] = ("nsga2", "moead-dra")
    populations: tuple[int, ...] = (500, 1000)
    iterations: tuple[int, ...] = (10, 20)
    repeats: int = 5
    seeds: int = 31
    seed: int = 0
    target: float = field(default=0.995, metadata=unit("", 0, 1))

    def __post_init__(self) -> None:
        self._keep(**{name: tuple(getattr(self, name)) for name in ("algorithms", "populations", "iterations")})
        for name in ("algorithms", "populations", "iterations"):
            values = getattr(self, name)
            if not values or len(set(values)) < len(values):
                got = ", ".join(map(str, values)) or "none"
                raise ValueError(f"{name} must be one at least and different, got {got}")
        for name in self.algorithms:
            checks.one_of("algorithms", name, ALGORITHMS)
        checks.positive("target", self.target)
        checks.within("target", self.target, 0, 1)

    def comparison(self, problem: RideProblem) -> Comparison:
        """Return the comparison of the algorithms on a problem; ValueError if a setting does not fit it."""
        names = ("algorithms", "populations", "iterations", "repeats", "seeds", "seed")
        return Comparison(problem=problem, **{name: getattr(self, name) for name in names})


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class StudyFile(Record):
    """The content of a study file.

    Parameters
    ----------
    problem : RideProblem
        Measures, limits, bounds and load cases.
    name : str
        Title of the study, or name of its vehicle.
    present : mapping of str to float
        The present design by variable, empty where it is unknown; it may lie outside of the bounds.
    search : SearchSettings
        Algorithms, budgets and seeds.

    Examples
    --------
    A study of the package, on the car of Yuen and Ramli 2010:

    >>> import suspension_ctrl as sc
    >>> study = sc.load_study("paper")
    >>> print(study.name, dict(study.present), study.search.populations)
    Yuen and Ramli 2010 {'spring': 22000.0, 'damper': 1500.0} (500, 1000)
    """

    problem: RideProblem
    name: str = ""
    present: Mapping[str, float] = FrozenMapping({})
    search: SearchSettings = SearchSettings()

    def __post_init__(self) -> None:
        checks.of_kind("problem", self.problem, RideProblem)
        checks.of_kind("search", self.search, SearchSettings)
        checks.of_kind("name", self.name, str)
        checks.mapped("present", self.present)
        variables = self.problem.variables
        if self.present and set(self.present) != set(variables):
            needed, got = checks.listing(variables), checks.listing(self.present)
            raise ValueError(f"present must hold {needed}, got {got}")
        self._keep(present=FrozenMapping({name: float(self.present[name]) for name in variables if self.present}))
        self.search.comparison(self.problem)


def load_study(
    path: str | PathLike[str], *, allow_outside: bool = False, search: SearchSettings | None = None
) -> StudyFile:
    """Return the study of a TOML file; the file of a problem is one too.

    Parameters
    ----------
    path : str or path-like
        The path of a TOML file, or the name of one that comes with the package, ``"full_car"``.
    allow_outside : bool
        As in `load_road`.
    search : SearchSettings, optional
        Settings that hold where the file has none.

    Raises
    ------
    ValueError
        That lists the mistakes of the file, each with file, line, key and value.
    OSError
        If it, or a file that it names, cannot be read.

    Examples
    --------
    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> text = '''
    ... vehicle = "yuen_ramli_2010"
    ... road = "C"
    ... speed = "80 km/h"
    ... measures = ["ACC", "DTL"]
    ... constraints = ["SWS <= 12mm"]
    ... [bounds]
    ... spring = ["10 kN/m", "30 kN/m"]
    ... damper = ["0.5 kN s/m", "4 kN s/m"]
    ... [present]
    ... spring = "20 kN/m"
    ... [search]
    ... populations = [200]
    ... '''
    >>> _ = Path("mine.toml").write_text(text)
    >>> study = sc.load_study("mine.toml")
    >>> dict(study.present)
    {'spring': 20000.0, 'damper': 1500.0}
    >>> study.problem
    RideProblem(ACC [m/s^2], DTL [N]; SWS <= 0.012; spring 10000 to 30000 N/m; damper 500 to
        4000 N s/m; QuarterCar at 22.2222 m/s; 0 to 20 Hz, weighting Wk, 384 nodes)
    """
    file = datafiles.named("study", "studies", path)
    with document(file, allow_outside) as table:
        return _study(table, search or SearchSettings(), file.stem)


def save_study(path: str | PathLike[str], study: StudyFile) -> None:
    """Write a file that `load_study` reads as `study`, vehicles and roads in it; ValueError if it cannot.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> study = sc.load_study("full_car")
    >>> sc.save_study("study.toml", study)
    >>> sc.load_study("study.toml") == study
    True
    """
    if not isinstance(study, StudyFile):
        raise ValueError(f"study must be a StudyFile, got {checks.shown(study)}")
    file, problem = checks.path_of("path", path), study.problem
    study = replace(study, problem=problem.replace(struts=coefficients_by_name(problem.struts, {})))
    text = toml(_table(study, file), study, lambda one: _study(one, SearchSettings(), ""), Folder(file.parent))
    write_text(file, text)


def check_fits_file(study: StudyFile) -> None:
    """Raise ValueError, before a search and not after it, unless a file can hold the study."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "study.toml"
        toml(_table(study, file), None, _check_table, Folder(file.parent))


def _check_table(table: Table) -> None:
    """Raise ValueError about mistakes in a table, without making its problem, which takes long."""
    mistakes = Mistakes()
    read_problem(table, mistakes)
    mistakes.settle()


def _table(study: StudyFile, file: Path) -> dict[str, Any]:
    """Return the table of a study for a file; systems of plants are written beside it."""
    table: dict[str, Any] = {"title": study.name} if study.name else {}
    table |= problem_table(study.problem, file)
    present = coefficient_table(study.problem.cases[0].vehicle, study.present)
    return table | {"present": present, "search": _all(study.search)}


def _all(search: SearchSettings) -> dict[str, Any]:
    """Return the table of all settings, also of those with their default values."""
    values = {one.key: getattr(search, one.name) for one in keys_of(SearchSettings).values()}
    return {key: list(value) if isinstance(value, tuple) else value for key, value in values.items()}


def _study(table: Table, default: SearchSettings, stem: str) -> StudyFile:
    """Return the study in a table of a file with this stem."""
    mistakes = Mistakes()
    found = read_problem(table, mistakes)
    search = _search(Table("search.", found.search), default, mistakes)
    present = _present(found, mistakes)
    objectives = len(found.values.get("measures", ()))
    if not bad(search) and objectives > 1:
        with mistakes.noted(), keyed("", {"population": "search.populations"}):
            evaluations(search.algorithms, search.populations, objectives)
    mistakes.settle()
    name = found.title or found.file.name or stem
    return StudyFile(problem=found.problem(), name=name, present=present, search=search)


def _search(table: Table, default: SearchSettings, mistakes: Mistakes) -> SearchSettings:
    """Return the settings in a table, in place of the default ones, `BAD` after a mistake."""
    values = read(table, keys_of(SearchSettings), mistakes)
    if bad(*values.values()):
        return BAD
    with mistakes.noted(), fields_named(SearchSettings, table.name):
        return replace(default, **values)
    return BAD


def _present(found: Content, mistakes: Mistakes) -> dict[str, float]:
    """Return the present design: of the file, else of the vehicle's own setting; empty unless it is complete."""
    vehicle, bounds = found.vehicle, found.values.get("bounds", {})
    if bad(vehicle):
        return {}
    names = vehicle.variables
    before = len(mistakes)
    given = read_coefficients(Table("present.", found.present), vehicle, float, mistakes, names)
    for name in given:
        if name not in bounds:
            needed = f"of coefficients that vary, {checks.listing(bounds, name)}"
            mistakes.note(f"present.{name} must be {needed}, got {given[name]:g} {names[name].unit}".rstrip())
    own = {**found.file.setting, **found.values.get("struts", {}), **given}
    design = present_design(vehicle, own, bounds)
    if given and bounds and not design and len(mistakes) == before:
        mistakes.note(f"present must hold all of {checks.listing(bounds)}, got {checks.listing(given)}")
    return design


def present_design(vehicle: Vehicle, setting: Mapping[str, float], bounds: Mapping[str, Any]) -> dict[str, float]:
    """Return the design of a setting by variable, empty unless it is complete."""
    known = {name: one.default for name, one in vehicle.variables.items() if one.default is not None}
    with suppress(ValueError):  # of a setting that is not complete
        known |= vehicle.coefficients(setting)
    known |= setting
    return {name: known[name] for name in bounds} if known.keys() >= bounds.keys() else {}
