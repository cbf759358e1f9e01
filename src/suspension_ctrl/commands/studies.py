"""The study of a command: a file, by default the paper's, with options in place of what it says."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import options as o
from . import results

if TYPE_CHECKING:
    from ..desk.study_files import SearchSettings, StudyFile
    from ..response.problem import RideProblem

PAPER = "paper"
FILE = "study.toml"
"""The resolved study in a results folder."""


def chosen_study(
    *,
    study: str | None = None,
    vehicle: str | None = None,
    road: str | None = None,
    speed: float | None = None,
    band: str | None = None,
    weighting: str | None = None,
    allow_outside: bool = False,
    search: "SearchSettings | None" = None,
    **settings: Any,
) -> "StudyFile":
    """Return the study of a file or a name with what is given in its place.

    A vehicle brings its own bounds, struts and present design. `search` holds where the file has no settings of
    searches; in place of both stand `settings` that are not None, fields of `SearchSettings`, lists as texts.
    """
    from ..desk.study_files import load_study

    found = load_study(PAPER if study is None else study, allow_outside=allow_outside, search=search)
    given = {name: _parsed(name, value) for name, value in settings.items() if value is not None}
    options = (road, speed, band, weighting, allow_outside)
    if vehicle is not None:
        found = _with_vehicle(found, vehicle, *options)
    elif changes := _changes(found.problem, *options):
        found = replace(found, problem=found.problem.replace(**changes))
    return replace(found, search=replace(found.search, **given)) if given else found


def _parsed(name: str, value: Any) -> Any:
    """Return the value of a setting of searches, a list from its text."""
    if isinstance(value, str):
        return o.names(value) if name == "algorithms" else o.whole_numbers(name, value)
    return (value,) if name in ("populations", "iterations") else value


def _changes(
    problem: "RideProblem",
    road: str | None,
    speed: float | None,
    band: str | None,
    weighting: str | None,
    allow_outside: bool,
) -> dict[str, Any]:
    """Return the parameters of a problem that options give; another road keeps the band as far as it is known."""
    from ..response.bands import OwnBand, band_of
    from ..roads.files import load_road

    changes: dict[str, Any] = {} if speed is None else {"speed": speed}
    if road is not None:
        changes["road"] = load_road(road, allow_outside=allow_outside)
        known = [(changes["road"], case.speed if speed is None else speed) for case in problem.cases]
        own = isinstance(problem.band, OwnBand)
        changes["band"] = None if own else tuple(band_of(None, known, problem.band))
    return changes | o.settings(weighting, band)


def _with_vehicle(study: "StudyFile", vehicle: str, *options: Any) -> "StudyFile":
    """Return the study of another vehicle with its bounds, struts and present design."""
    from .. import checks
    from ..desk.study_files import present_design
    from ..vehicles.files import load_vehicle

    file = load_vehicle(vehicle, allow_outside=options[-1])
    if not file.bounds:
        raise ValueError(f"vehicle must be a file with bounds, got {checks.shown(vehicle)}")
    cases = [replace(case, vehicle=file.vehicle, roll_geometry=file.roll_geometry) for case in study.problem.cases]
    problem = study.problem.replace(
        cases=cases,
        bounds=file.bounds,
        kinds={},
        struts={name: value for name, value in file.setting.items() if name not in file.bounds},
        **_changes(study.problem, *options),
    )
    present = present_design(file.vehicle, file.setting, file.bounds)
    return replace(study, problem=problem, name=file.name or Path(vehicle).stem, present=present)


def folder_with(study: "StudyFile", out: Path | None) -> Path:
    """Make and return a results folder with the study in it."""
    folder = results.results_folder(out)
    save_resolved(folder, study)
    return folder


def save_resolved(folder: Path, study: "StudyFile") -> None:
    """Write the study into a results folder, where `--study` reads it again."""
    from ..desk.study_files import save_study

    save_study(folder / FILE, study)
