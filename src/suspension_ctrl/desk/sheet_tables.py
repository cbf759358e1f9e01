"""Tables and paragraphs of the supplier sheet, in units in which suppliers write."""

import re
from collections.abc import Mapping, Sequence
from math import isnan, nan, pi

from .. import checks
from ..response.problem import RideProblem
from ..vehicles.vehicle import AssembledVehicle
from .active import limit_text
from .curves import Curve
from .designs import setting_at
from .pages import Block
from .parts import Part
from .verdicts import judged
from .working_range import DISTANCE, UNITS, motions_of

_SHOWN = {"N/m": ("N/mm", 1e-3), "m": ("mm", 1e3), "N m/rad": ("N m/deg", pi / 180)}
_CASES = 4  # described on the page
_OF_PARTS = ["part", "kind", "pieces", "ratio", "value", "tolerance", "present", "unit"]
_ABOUT_PARTS = "Ratio: deflection of the part over that at the wheel; values are those of the part itself."
_CURVES = (  # whether over rate, title, unit and its size
    (True, "Dampers: tension [N] over rate in extension", "m/s", 1.0),
    (False, "Springs and stops: tension [N] over extension", "mm", 1e3),
)
_RANGE = "Working range of the struts: travel [mm], rate [m/s] and force [N]"
_OF_RANGE = [
    "strut",
    "case",
    "static",
    "mean",
    "travel rms",
    "largest",
    "rate rms",
    "largest",
    "force rms",
    "largest",
]
_ABOUT_RANGE = (
    "Over a wheel those at the wheel. Static: deflection from the free length. Mean: by force laws on the road. "
    f"Root mean squares and expected largest values of {DISTANCE / 1e3:g} km are about these."
)


def checked_tolerances(
    problem: RideProblem, design: Mapping[str, float], tolerances: Mapping[str, float]
) -> Mapping[str, float]:
    """Return tolerances; ValueError unless they are of coefficients and above zero."""
    checks.mapped("tolerances", tolerances)
    values = problem.cases[0].vehicle.at(setting_at(problem, design))[1]
    for name, share in tolerances.items():
        checks.one_of("tolerances", name, values)
        checks.positive(f"tolerance of {name}", share)
    return tolerances


def described(problem: RideProblem) -> list[str]:
    """Return paragraphs about vehicle, roads and band."""
    vehicle = problem.cases[0].vehicle
    mass = f", sprung mass {vehicle.assembly.sprung_mass:g} kg" if isinstance(vehicle, AssembledVehicle) else ""
    road = problem.describe_cases()
    low, high = problem.band
    return [
        f"Vehicle: {_words(type(vehicle).__name__)}{mass}. Frequencies from {low:g} to {high:g} Hz.",
        *road[:_CASES],
        *([f"And {len(road) - _CASES} more load cases."] if len(road) > _CASES else []),
    ]


def _words(name: str) -> str:
    """Return the name of a class in words."""
    return re.sub("(?<=.)(?=[A-Z])", " ", name).lower()


def part_block(parts: Sequence[Part], tolerances: Mapping[str, float], today: Mapping[str, float]) -> Block:
    """Return the table of parts, a row for each coefficient."""
    rows = [
        [
            one.name,
            part.kind,
            str(part.pieces),
            "" if part.ratio is None else f"{part.ratio:.4g}",
            _shown(one.value, one.unit),
            f"±{100 * tolerances[one.name]:g} %" if one.name in tolerances else "",
            _shown(today.get(one.name, nan), one.unit),
            _SHOWN.get(one.unit, (one.unit, 1.0))[0] or "-",
        ]
        for part in parts
        for one in part.values
    ]
    return _without_empty("Parts", _OF_PARTS, rows, _ABOUT_PARTS)


def _without_empty(title: str, header: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> Block:
    """Return a table without columns that are empty throughout."""
    kept = [i for i in range(len(header)) if any(row[i] for row in rows)]
    return Block(title, [header[i] for i in kept], [[row[i] for i in kept] for row in rows], note)


def _shown(value: float, unit: str, digits: int = 4) -> str:
    """Return a number of a unit as it is shown, "" of NaN."""
    return "" if isnan(value) else number(value * _SHOWN.get(unit, (unit, 1.0))[1], digits)


def number(value: float, digits: int = 4) -> str:
    """Return a number of so many significant digits, without exponent up to ten places."""
    return f"{float(f'{value:.{digits}g}'):.10g}"


def curve_blocks(curves: Sequence[Curve]) -> list[Block]:
    """Return tables of force over rate and over deflection."""
    found = []
    for of_rate, title, unit, scale in _CURVES:
        own = [one for one in curves if one.of_rate == of_rate]
        if own:
            header = [f"[{unit}]", *(f"{scale * x:+g}" for x in own[0].x)]
            found.append(
                Block(title, header, [[one.part, *(number(force) for force in one.force)] for one in own])
            )
    return found


def range_block(problem: RideProblem, design: Mapping[str, float]) -> Block:
    """Return the table of motions, a row for each strut and load case."""
    rows = []
    for n, case in enumerate(problem.cases, start=1):
        for one in motions_of(case, setting_at(problem, design), problem.band):
            numbers = [_shown(value, unit, 3) for value, unit in zip(one[1:], UNITS, strict=True)]
            rows.append([one.strut or "strut", str(n) if len(problem.cases) > 1 else "", *numbers])
    return _without_empty(_RANGE, _OF_RANGE, rows, _ABOUT_RANGE)


def measure_block(problem: RideProblem, design: Mapping[str, float], present: Mapping[str, float]) -> Block:
    """Return the table of measures and limits beside those of the present design."""
    limits = {str(one): one for one in problem.constraints}
    rows = [
        [
            limit_text(limits[one.name]) if one.limit else one.name,
            _shown(one.value, one.unit),
            _shown(one.present, one.unit),
            "" if isnan(one.change) else f"{one.change:+.1f} %",
            _SHOWN.get(one.unit, (one.unit, 1.0))[0],
            one.limit,
        ]
        for one in judged(problem, design, present)
    ]
    return _without_empty("Ride", ["measure", "value", "present", "change", "unit", "limit"], rows)
