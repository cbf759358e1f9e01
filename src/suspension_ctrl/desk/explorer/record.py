"""The record of a study for a page: all that it shows, and all from which it computes other designs."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import tomlkit

from ... import escaping
from ...quantities import Complex, Integer, Real, column_headers
from ...response.certificates import Certificate
from ...response.kernel import Kernel
from ...response.mapped import Mapped
from ...response.problem import RideProblem
from ...search.problem import headers_of
from ...tables.headers import readable, shown_range, shown_unit, shown_value
from ...tables.rounding import rounded
from ...vehicles.files import coefficient_table
from ..candidate_table import PRESENT, reaching
from ..choosing import Front, front_of
from ..decision import Decision
from ..proofs import PRICE, RESIDUAL
from ..study_files import StudyFile, save_study
from .choice_texts import limited_by_case
from .functions import functions_of, why_not
from .layers import Layer
from .packing import packed
from .plant_matrices import plant_matrices
from .plant_ports import plant_ports

if TYPE_CHECKING:
    import pandas as pd

MOST = 2000
"""Designs of a front on a page, spread evenly over more."""


class Column(NamedTuple):
    """A number of a design: an objective, the measure of a limit, or a variable."""

    name: str
    csv: str  # header in a CSV file
    unit: str  # as engineers read it
    factor: float  # to that unit
    kind: str  # "objective", "limit" or "variable"
    place: int  # among the scores, or among the variables
    scale: float  # the score is scale times the measure plus offset
    offset: float
    computed: bool  # whether a page can compute it
    why_not: str  # if it cannot
    limits: tuple[float | None, float | None]  # least and largest value that is allowed, in SI units


class Variable(NamedTuple):
    """A variable with its bounds, its kind, and the values of a catalogue."""

    name: str
    unit: str
    factor: float
    low: float
    high: float
    kind: str
    values: tuple[float, ...]


class Designs(NamedTuple):
    """Designs (k, d) with their scores (k, m + c), their names, and what else is known: titles with texts."""

    designs: Real
    scores: Real
    names: tuple[str, ...] = ()
    known: tuple[Sequence[tuple[str, str]], ...] = ()


class OtherFront(NamedTuple):
    """Objectives (k, m) of a layer."""

    name: str
    kind: str
    shown: bool
    objectives: Real


def record_of(
    study: StudyFile, decision: Decision, layers: Sequence[Layer], certificates: Sequence[Certificate] = ()
) -> dict[str, Any]:
    """Return the record of a study and its decision for JSON, beside layers, and designs with certificates."""
    problem = decision.problem
    kernel, functions = problem.scores.kernel(problem.nodes), functions_of(problem)
    headers = column_headers(problem.objectives, problem.units)
    candidates = decision.table[decision.table.name != PRESENT]
    return packed(
        {
            "columns": list(columns_of(problem)),
            "variables": list(_variables(problem)),
            "front": _evenly(front_of(problem, decision.run)),
            "candidates": _designs(problem, candidates),
            "others": [_other(layer, headers) for layer in layers],
            "present": _present(problem, study.present),
            "certified": _certified(problem, certificates),
            "kernel": on_page(kernel),
            "functions": functions,
            **_cases(problem, kernel),
            "study": _text_of(study),
        }
    )


def on_page(kernel: Kernel) -> Kernel:
    """Return a kernel as pages compute it: a fraction as any other port."""

    def port_of(case: Any) -> Any:
        if isinstance(case, Mapped):
            return case._replace(case=port_of(case.case))
        return getattr(case, "port", case)

    return kernel._replace(cases=tuple(map(port_of, kernel.cases)))


def _cases(problem: RideProblem, kernel: Kernel) -> dict[str, Any]:
    """Return load cases by name with their ports and matrices, and the distinct responses of their plants."""
    scores, plants, cases = problem.scores, list[Complex](), list[dict[str, Any]]()
    for number, (case, squares) in enumerate(zip(scores.cases, kernel.cases, strict=True)):
        ports = plant_ports(scores, number, squares)
        alike = (k for k, one in enumerate(plants) if np.array_equal(one, ports.h))
        if (place := next(alike, len(plants))) == len(plants):
            plants.append(ports.h)
        matrices = plant_matrices(case.vehicle, scores.settings[number], scores.variables)
        name = f"{number + 1}: {escaping.terminal(case.describe())}"
        cases.append({"name": name, "ports": {**ports._asdict(), "h": place}, "matrices": matrices})
    return {"cases": cases, "plants": plants}


def columns_of(problem: RideProblem) -> Iterator[Column]:
    """Yield the columns of a problem's designs: objectives, measures of limits, variables."""
    functions = zip(problem.scores.scores, functions_of(problem), strict=True)
    flags = [not score.by_function or function is not None for score, function in functions]
    own = () if limited_by_case(problem) else problem.constraints  # of measures in the worst load case too
    limits = {one.measure: one for one in own}
    for i, measure in enumerate(problem.measures):
        limit = limits.pop(measure, None)
        allowed = (limit.minimum, limit.maximum) if limit else (None, None)
        yield Column(
            *_headed(measure.label, measure.unit), "objective", i, 1.0, 0.0, flags[i], why_not(measure), allowed
        )
    for i, limit in enumerate(problem.constraints, start=len(problem.measures)):
        if limit.measure in limits or not own:
            name = limit.measure.label + ", worst case" * (limit.measure in problem.measures)
            headed, allowed = _headed(name, limit.measure.unit), (limit.minimum, limit.maximum)
            why = why_not(limit.measure)
            yield Column(*headed, "limit", i, limit.scale, limit.offset, flags[i], why, allowed)
    for i, name in enumerate(problem.variables):
        yield Column(*_headed(name, problem.units[name]), "variable", i, 1.0, 0.0, True, "", (None, None))


def _headed(name: str, unit: str) -> tuple[str, str, str, float]:
    """Return name, header in a CSV file, unit as engineers read it, and the factor to it."""
    shown, factor = _shown(unit)
    return escaping.terminal(name), escaping.csv(f"{name} [{shown}]" if shown else name), shown, factor


def _shown(unit: str) -> tuple[str, float]:
    return shown_unit("" if unit == "-" else unit)


def _variables(problem: RideProblem) -> Iterator[Variable]:
    for name, (low, high) in problem.bounds.items():
        kind, (unit, factor) = problem.kinds.get(name, ""), _shown(problem.units[name])
        values = () if isinstance(kind, str) else tuple(map(float, kind))
        yield Variable(name, unit, factor, low, high, kind if isinstance(kind, str) else "catalogue", values)


def _evenly(front: Front) -> Designs:
    """Return a front, of more than `MOST` designs every so many along the first objective."""
    rows = _spread(front.objectives)
    return Designs(front.designs[rows], np.hstack([front.objectives, front.constraints])[rows])


def _other(layer: Layer, headers: list[str]) -> OtherFront:
    objectives = layer.table[headers].to_numpy(dtype=float)
    return OtherFront(layer.name, layer.kind, layer.shown, objectives[_spread(objectives)])


def _spread(objectives: Real) -> Integer:
    """Return rows of objectives (k, m), at most `MOST`, evenly along the first."""
    order = np.argsort(objectives[:, 0], kind="stable")
    return order[np.linspace(0, len(order) - 1, min(MOST, len(order))).round().astype(int)]


def _designs(problem: RideProblem, table: "pd.DataFrame") -> Designs:
    """Return the candidates of a table, with names after their numbers."""
    headers = list(headers_of(problem))[: len(problem.variables)]
    designs = table[headers].to_numpy(dtype=float)
    names = tuple(f"{number} {name}" for number, name in zip(table.index, table.name, strict=True))
    return Designs(designs, problem.evaluate(designs), names, _known(table))


def _known(table: "pd.DataFrame") -> tuple[Sequence[tuple[str, str]], ...]:
    """Return of each row of candidates the active bounds, largest travel, residual and prices, by titles."""
    given = [str(one) for one in table]
    columns = [
        one for one in given if one in ("active", RESIDUAL) or one.startswith(PRICE) or " travel in " in one
    ]
    shown = readable(table[columns])
    texts = {str(header): rounded(shown[header].tolist(), alike=False) for header in shown}
    return tuple([(header, column[i]) for header, column in texts.items() if column[i]] for i in range(len(table)))


def _certified(problem: RideProblem, certificates: Sequence[Certificate]) -> Designs | None:
    """Return the designs of certificates with their simulated values, None without any."""
    if not certificates:
        return None
    designs = np.array([[one.design[name] for name in problem.variables] for one in certificates])
    names = tuple(f"certified {number}" for number in range(1, len(certificates) + 1))
    return Designs(designs, problem.evaluate(designs), names, tuple(list(_simulated(one)) for one in certificates))


def _simulated(certificate: Certificate) -> Iterator[tuple[str, str]]:
    """Yield the simulated value of each measure in each load case with its interval, by titles."""
    for row in certificate.rows:
        if np.isfinite(row.simulated):
            where = "" if len(certificate.cases) == 1 else f", case {row.case}"
            value = shown_value(row.simulated, row.unit)
            interval = f"95 % {shown_range(row.low, row.high, row.unit)}"
            yield f"{escaping.terminal(row.measure)} simulated{where}", f"{value} ({interval})"


def _present(problem: RideProblem, present: Mapping[str, float]) -> Designs | None:
    """Return the present design, None where it is unknown."""
    if not present:
        return None
    design = np.array([[present[name] for name in problem.variables]])
    return Designs(design, reaching(problem, design[0]).evaluate(design), (PRESENT,))


def _text_of(study: StudyFile) -> dict[str, Any] | None:
    """Return the file of a study without its present design, and the key of each variable; None if it has none."""
    vehicle, variables = study.problem.cases[0].vehicle, study.problem.variables
    keys = dict(_leaves(coefficient_table(vehicle, {name: float(i) for i, name in enumerate(variables)})))
    with TemporaryDirectory() as folder:
        file = Path(folder) / "study.toml"
        try:
            save_study(file, replace(study, present={}))
        except ValueError:  # of an object of a user's own
            return None
        content = tomlkit.parse(file.read_text(encoding="utf-8"))
        content.remove("present")
        return {"text": content.as_string(), "keys": [keys[float(i)] for i in range(len(variables))]}


def _leaves(table: Mapping[str, Any], above: str = "") -> Iterator[tuple[float, str]]:
    """Yield the values of nested tables, each with its dotted key."""
    for key, value in table.items():
        if isinstance(value, Mapping):
            yield from _leaves(value, f"{above}{key}.")
        else:
            yield value, f"{above}{key}"
