"""The page of a comparison: fronts of the algorithms as layers, times, quality, and of the paper its tables."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import pandas as pd

from ..desk.attaining import optimal_controllers
from ..desk.candidate_table import candidates
from ..desk.candidate_texts import parts_of
from ..desk.decision import Decision
from ..desk.explorer.layers import Layer, attainable_layers
from ..desk.explorer.page_file import Opening, page_of
from ..desk.study_texts import introduced
from ..paper import experiment
from ..paper import tables as printed
from ..paper.optimum import table5_of_front
from ..quantities import column_headers
from ..response.problem import RideProblem
from ..search.indicators import non_dominated
from ..search.population import Population
from ..search.problem import headers_of
from ..study import timing
from ..study.comparison import CONFIGURATION
from ..study.findings import Findings
from ..study.judging import INDICATORS, POPULATION
from ..study.reference import Reference
from ..study.store import VIOLATION, StoredRun
from . import reports
from .comparison_texts import outcome_texts

if TYPE_CHECKING:
    from .comparing import Request

_CONTROLLERS = 32  # optimal ones, of which the attainable is shown
_PUBLISHED = {"published_seconds": "published [s]", "published_ratio_percent": "published ratio [%]"}
Tables = dict[str, pd.DataFrame]


class Outcome(NamedTuple):
    """What came of the timed runs and, if they were made, of the runs over many seeds."""

    timed: pd.DataFrame  # a row per timed run, with its quality where there is a reference
    reference: Reference | None = None
    findings: Findings | None = None


def page(request: "Request", store: Mapping[str, StoredRun], outcome: Outcome) -> str | None:
    """Return the page of a comparison, None if no run found a design within the limits."""
    problem = request.problem
    finals = timing.final_populations(request.campaign.comparison, store)
    feasible = finals[finals[VIOLATION] == 0] if VIOLATION in finals else finals
    if feasible.empty:
        return None
    front = _front(problem, feasible)
    table = candidates(problem, front, present=request.study.present or None)
    layers = [*_fronts(problem, feasible), *_reference(problem, outcome.reference)]
    layers += _attainable(request, pd.concat([front.front(), table])[_headers(problem)])
    decision = Decision(problem, front, front, table)
    said, sections = _said(request, outcome), _sections(request, decision, outcome)
    return page_of(request.study, decision, said, sections, layers, opening=_opening(request, outcome))


def _headers(problem: RideProblem) -> list[str]:
    return column_headers(problem.objectives, problem.units)


def _front(problem: RideProblem, feasible: pd.DataFrame) -> Population:
    """Return the best designs of final populations."""
    headers, d, m = list(headers_of(problem)), len(problem.variables), len(problem.objectives)
    best = feasible[non_dominated(feasible[headers[d:]].to_numpy())]
    designs = best[headers[:d]].to_numpy(dtype=float)
    constraints = problem.evaluate(designs)[:, m:]
    return Population(
        designs=designs, objectives=best[headers[d:]].to_numpy(dtype=float), constraints=constraints,
        headers=tuple(headers),
    )  # fmt: skip


def _fronts(problem: RideProblem, feasible: pd.DataFrame) -> Iterator[Layer]:
    """Yield the front of each algorithm at each configuration, those of the largest one shown at first."""
    headers, largest = _headers(problem), tuple(feasible[CONFIGURATION].max())
    for size, part in reversed(list(feasible.groupby(CONFIGURATION))):
        for algorithm, own in part.groupby("algorithm", sort=False):
            best = own[non_dominated(own[headers].to_numpy())]
            yield Layer("{}, N = {}, {} iterations".format(algorithm, *size), best, "run", size == largest)


def _reference(problem: RideProblem, reference: Reference | None) -> list[Layer]:
    if reference is None:
        return []
    table = pd.DataFrame(reference.front.objectives, columns=_headers(problem))
    return [Layer("reference front", table, "reference", shown=False)]


def _attainable(request: "Request", passive: pd.DataFrame) -> list[Layer]:
    """Return the front of optimal controllers, none where there is no controller or no present design."""
    with suppress(ValueError):
        nominal, present = request.problem.nominal.replace(constraints=()), request.study.present
        if present:
            table = optimal_controllers(nominal, present, _CONTROLLERS, {})
            return attainable_layers({"attainable, LQR": table}, passive)
    return []


def _said(request: "Request", outcome: Outcome) -> list[str]:
    """Return the study in words, the origin of fronts, and the verdict with its numbers."""
    said = [
        *introduced(request.study),
        "The front holds the best designs of the first timed runs; candidates are as these found them.",
    ]
    if outcome.reference is not None:
        said.append(f"The reference front is of {outcome.reference.origin}.")
    return [*said, *(outcome.findings.words if outcome.findings and len(outcome.findings.verdict) else [])]


def _opening(request: "Request", outcome: Outcome) -> Opening:
    """Return the comparison of the algorithms, which stands before the choice of a design."""
    said = outcome_texts(outcome.timed, outcome.findings)
    verdict = outcome.findings.verdict if outcome.findings else pd.DataFrame()
    title = "Verdict: which has more hypervolume, the first algorithm or the other"
    tables = {title: verdict} if len(verdict) else {}
    return Opening("Algorithms", said, tables | _times(request, outcome))


def _sections(request: "Request", decision: Decision, outcome: Outcome) -> dict[str, Tables]:
    """Return the tables after the design at hand."""
    sections = dict[str, Tables]()
    if outcome.findings:
        sections["Quality over seeds"] = _quality(outcome.findings, request.study.search.target)
    if request.of_paper:
        sections["Tables of the paper"] = _papers(decision, outcome)
    return sections | {"Candidates": parts_of(decision.problem, decision.table)}


def _times(request: "Request", outcome: Outcome) -> Tables:
    """Return times and quality of the timed runs."""
    first = request.campaign.comparison.algorithms[0]
    title = f"Times: the ratio is the time of {first} over that of the row"
    found = {title: timing.compared(outcome.timed).rename(columns=reports.HEADERS)}
    if outcome.reference is not None:
        title = "Quality of the final populations, medians: more hypervolume is better, and less IGD+"
        found[title] = timing.quality(outcome.timed).rename(columns=reports.HEADERS)
    return found


def _quality(findings: Findings, target: float) -> Tables:
    """Return medians by lens, effort to the target, and differences."""
    medians = findings.medians[findings.medians.set == POPULATION]
    kept = ["lens", *CONFIGURATION, "algorithm", "evaluations", *INDICATORS]
    found = {
        "Final populations, medians by lens": medians[kept],
        f"To {target:g} of the reference hypervolume, medians": findings.reached,
        "Differences, Mann-Whitney tests adjusted by Holm": findings.differences,
    }
    return {title: table for title, table in found.items() if len(table)}


def _papers(decision: Decision, outcome: Outcome) -> Tables:
    """Return Tables 1 to 5 of the paper beside what is found here."""
    tables = printed.timed_tables(outcome.timed, experiment.published_seconds())
    found = {"Table 1: vehicle, road and bounds": experiment.table1().rename(columns={"unit": "SI unit"})}
    for number, algorithm in printed.ALGORITHMS.items():
        if f"table{number}" in tables:
            title = f"Table {number}: {algorithm}, seconds published / here"
            found[title] = printed.as_printed(tables[f"table{number}"])
    title = (
        f"Table 5: ACC weighted by {decision.problem.weighting}, designs of the paper and picked from the front"
    )
    return found | {
        "Table 4: mean seconds and ratios of times": tables["table4"].rename(columns=reports.HEADERS | _PUBLISHED),
        title: table5_of_front(decision.problem, decision.run).drop(columns="weighting"),
    }
