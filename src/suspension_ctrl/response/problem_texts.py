"""Texts of a ride problem: what varies, its limits, its load cases."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..quantities import wrapped
from ..tables.headers import shown_range, shown_unit

if TYPE_CHECKING:
    from .problem import RideProblem


def sentences(problem: "RideProblem") -> list[str]:
    """Return variables, limits and load cases in sentences, a line each."""
    lines = [f"Varied: {'; '.join(_readable(problem))}."]
    if problem.constraints:
        lines.append(f"Limits: {', '.join(one.describe() for one in problem.constraints)}.")
    if len(problem.cases) > 1:
        how = "their worst" if problem.worst_case else "their mean square by shares"
        lines.append(f"Objectives are over {len(problem.cases)} load cases, {how}; limits hold in each.")
    lines += [f"Scatter: {problem.scatter.describe()}."] if problem.scatter else []
    return lines + sentences_of_cases(problem)


def sentences_of_cases(problem: "RideProblem") -> list[str]:
    """Return the road and the speed of each load case, a line each; a road in common once."""
    first, *others = problem.cases
    if not others:
        return [f"Road: {first.describe()}."]
    common = all(case.road == first.road for case in others)
    told = (f"{case.speed:.4g} m/s" if common else case.describe() for case in problem.cases)
    lines = [
        f"Case {n}, share {case.share:g}: {text}."
        for n, (case, text) in enumerate(zip(problem.cases, told, strict=True), start=1)
    ]
    return [f"Road of all cases: {first.describe_road()}.", *lines] if common else lines


def representation(problem: "RideProblem") -> str:
    """Return the text of `repr`."""
    nodes = f"{problem.nodes} nodes"
    if problem.accuracy is not None:
        nodes = f"accuracy {problem.accuracy:g}"
    parts = [
        ", ".join(f"{name} [{problem.units[name]}]" for name in problem.objectives),
        *map(str, problem.constraints),
        *_in_units(problem),
        *([f"scatter {problem.scatter.describe()}"] if problem.scatter else []),
        *(f"{type(case.vehicle).__name__} at {case.speed:g} m/s" for case in problem.cases),
        f"{problem.band[0]:g} to {problem.band[1]:g} Hz, weighting {problem.weighting}, {nodes}",
    ]
    return wrapped(f"RideProblem({'; '.join(parts)})")


def _readable(problem: "RideProblem") -> Iterator[str]:
    """Yield the text of each variable in units to read: bounds and kind, or the values of a catalogue."""
    for name, (low, high) in problem.bounds.items():
        kind, unit = problem.kinds.get(name, ""), problem.units[name]
        if isinstance(kind, str):
            yield f"{name} {shown_range(low, high, unit)}" + (kind and f", {kind}")
        else:
            shown, factor = shown_unit(unit)
            yield f"{name} of {', '.join(f'{factor * value:.4g}' for value in kind)} {shown}".rstrip()


def _in_units(problem: "RideProblem") -> Iterator[str]:
    """Yield the text of each variable in its own unit: bounds and kind, or catalogue."""
    for name, (low, high) in problem.bounds.items():
        unit, kind = problem.units[name], problem.kinds.get(name, "")
        if isinstance(kind, str):
            yield f"{name} {low:g} to {high:g} {unit}".rstrip() + (kind and f", {kind}")
        else:
            yield f"{name} {', '.join(f'{value:g}' for value in kind)} {unit}"
