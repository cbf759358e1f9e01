"""A design as a document for JSON: numbers in SI units, with the unit beside them or in the key.

The matrices of a system have equivalent springs and dampers in place of force laws.
"""

from collections.abc import Mapping
from contextlib import suppress
from math import isnan
from typing import Any

import control

from ..documents import Mistakes
from ..quantities import key_of
from ..response.load_case import LoadCase
from ..response.problem import RideProblem
from ..schema.writing import toml
from ..vehicles.feedback import System
from ..vehicles.files import VehicleFile, read_vehicle, vehicle_table
from ..vehicles.matrices import LETTERS, labels_of, matrices_of
from ..vehicles.signals import units_of
from .designs import closed_at, setting_at, vehicle_file
from .parts import Part, parts_of
from .verdicts import judged
from .working_range import DISTANCE, UNITS, Motion, motions_of

FORMAT = 1
"""Version of the document: a larger one has other keys."""


def design_document(
    problem: RideProblem, design: Mapping[str, float], present: Mapping[str, float], name: str
) -> dict[str, Any]:
    """Return the document of a design; ``None`` stands where there is no value."""
    units = problem.units
    return {
        "format": "suspension_ctrl design",
        "version": FORMAT,
        "name": name,
        "design": {one: {"value": value, "unit": units[one]} for one, value in design.items()},
        "present": {one: {"value": value, "unit": units[one]} for one, value in present.items()},
        "measures": [_without_nan(one._asdict()) for one in judged(problem, design, present)],
        "weighting": problem.weighting if isinstance(problem.weighting, str) else None,
        "band_Hz": list(problem.band),
        "worst_case": problem.worst_case,
        "cases": [
            _case(problem, design, number, case, name) for number, case in enumerate(problem.cases, start=1)
        ],
    }


def can_be_written(file: VehicleFile) -> bool:
    """Whether a vehicle file can hold all of a vehicle."""
    with suppress(ValueError):
        return bool(toml(vehicle_table(file), file, lambda table: read_vehicle(table, Mistakes())))
    return False


def _case(
    problem: RideProblem, design: Mapping[str, float], number: int, case: LoadCase, name: str
) -> dict[str, Any]:
    file, setting = vehicle_file(problem, design, case=number, name=name), setting_at(problem, design)
    vehicle, values = case.vehicle.at(setting)
    return {
        "road": case.describe(),
        "speed_m_per_s": case.speed,
        "share": case.share,
        "vehicle": vehicle_table(file) if can_be_written(file) else None,
        "parts": [_part(one) for one in parts_of(vehicle, values)],
        "working_range": [_motion(one) for one in motions_of(case, setting, problem.band)],
        "largest_over_m": DISTANCE,
        "system": _system(closed_at(case, setting, problem.band)),
    }


def _part(part: Part) -> dict[str, Any]:
    values = {one.name: {"value": one.value, "unit": one.unit} for one in part.values}
    return {"name": part.name, "kind": part.kind, "pieces": part.pieces, "ratio": part.ratio, "values": values}


def _motion(one: Motion) -> dict[str, Any]:
    """Return a motion with the units in its keys."""
    units = dict(zip(Motion._fields[1:], UNITS, strict=True))
    return _without_nan({key_of(name, units.get(name, "")): value for name, value in one._asdict().items()})


def _system(system: "System | None") -> dict[str, Any] | None:
    """Return matrices and signals of a state space model."""
    if not isinstance(system, control.StateSpace):
        return None
    matrices = dict(zip(LETTERS, (matrix.tolist() for matrix in matrices_of(system)), strict=True))
    units = units_of(system)
    signals = {
        kind: [{"name": name, "unit": unit} for name, unit in zip(names, units[kind], strict=True)]
        for kind, names in labels_of(system).items()
    }
    return matrices | signals


def _without_nan(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values with None for NaN, which JSON does not know."""
    return {name: None if isinstance(one, float) and isnan(one) else one for name, one in values.items()}
