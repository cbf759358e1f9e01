"""The steps of `suspension-ctrl optimum`: searches, files, printed tables and sentences."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple, Self

import pandas as pd

from .. import checks
from ..desk import figures
from ..desk.active_beside import ActiveBeside
from ..desk.advice import Advice
from ..desk.candidate_scatter import parts_over_scatter
from ..desk.candidate_table import PRESENT
from ..desk.candidate_texts import decimals_of, markdown, parts_of
from ..desk.decision import Decision
from ..desk.explorer.layers import Layer, attainable_layers, exact_layers
from ..desk.explorer.page_file import page_of
from ..desk.exporting import save_candidates
from ..desk.study_files import SearchSettings, StudyFile, check_fits_file
from ..desk.study_texts import introduced
from ..paper import experiment as paper
from ..paper.optimum import KINDS, TRAVEL, table5
from ..quantities import column_headers
from ..response.measures.limits import Limit
from ..response.measures.vibration import SWS
from ..search.driver import minimise
from ..search.run import Optimiser
from ..study.comparison import optimiser
from ..tables import write_csv, write_figure, write_text
from ..tables.headers import name_and_unit, readable, shown_range
from . import results, studies, terminal

WEIGHTINGS = ("Wk", "Wb", "Wb-table")
"""Weightings of ACC in Table 5."""
SEARCH = SearchSettings(algorithms=("moead-dra",), populations=(4000,), iterations=(25,))
"""Settings of a search where a study has none."""
DECIMALS = {"mm": 1, "kN": 4, "kN/m": 4, "kN s/m": 4, "m/s^2": 4, "%": 2}
"""Decimals of Table 5 by unit, as in print."""


@dataclass(frozen=True)
class Request:
    """A study with its limits, and the travel of Table 5 [m], None of another problem than the paper's."""

    study: StudyFile
    travel: float | None = None

    def within(self, sws_limit: float | None) -> Self:
        """Return the request with this limit of SWS [m] in place of one that the study has, if given."""
        problem = self.study.problem
        others = [one for one in problem.constraints if one.measure != SWS()]
        given = [one.value for one in problem.constraints if one.measure == SWS()]
        papers = paper.is_papers(problem.replace(constraints=others) if given else problem)
        if sws_limit is None:
            sws_limit = next(iter(given), TRAVEL if papers else None)
        if sws_limit is None:
            return self
        checks.positive("sws_limit", sws_limit, "m")
        limited = problem.replace(constraints=[Limit(SWS(), sws_limit), *others])
        return replace(self, study=replace(self.study, problem=limited), travel=sws_limit if papers else None)

    @property
    def optimiser(self) -> Optimiser:
        """The first algorithm of the study; NSGA-II for MOEA/D-DRA where no kernel evaluates design by design."""
        name, search = self.study.search.algorithms[0], self.study.search
        if name.startswith("moead") and self.study.problem.kernel is None:
            name = "nsga2"
        return optimiser(name, max(search.populations))

    @property
    def budget(self) -> tuple[int, int]:
        """Iterations and seed of a search."""
        return max(self.study.search.iterations), self.study.search.seed

    def decide(self) -> Decision:
        """Search and choose."""
        (iterations, seed), study = self.budget, self.study
        settings: dict[str, Any] = {"iterations": iterations, "seed": seed, "present": study.present or None}
        return Decision.of(study.problem, self.optimiser, **settings)


class Findings(NamedTuple):
    """A decision, what is attainable beside it, tables of the candidates by title, and sentences."""

    decision: Decision
    beside: ActiveBeside
    exact: list[Layer]  # front of exact optima, empty where it is not cheap
    parts: Mapping[str, pd.DataFrame]
    said: list[str]

    @classmethod
    def of(cls, request: Request) -> Self:
        """Search, choose and compare."""
        study = request.study
        with terminal.compiling(), terminal.waiting("searching"):
            decision = request.decide()
            beside, exact = ActiveBeside.of(study.problem, study.present), exact_layers(study.problem)
            parts = parts_of(study.problem, decision.table) | parts_over_scatter(study.problem, decision.table)
        return cls(decision, beside, exact, parts, [*introduced(study), *decision.describe(), beside.text])

    def page(self, study: StudyFile) -> str:
        """Return the page for a browser."""
        headers = column_headers(study.problem.objectives, study.problem.units)
        passive = pd.concat([self.decision.run.front()[headers], self.decision.table[headers]])
        layers = [*self.exact, *attainable_layers(self.beside.by_controller(headers), passive)]
        return page_of(study, self.decision, self.said, {"Candidates": self.parts}, layers)


def carry_out(request: Request, out: Path | None) -> None:
    """Search, write all files, then print."""
    results.check(out)
    study = request.study
    check_fits_file(study)
    found = Findings.of(request)
    decision, beside, _, parts, said = found
    advice = Advice.of(study.problem, decision.table).said
    printed = [] if request.travel is None else tables5(request, request.travel)
    said += without_designs(decision, printed)
    folder = studies.folder_with(study, out)
    if printed:
        write_csv(folder / "table5.csv", pd.concat(printed))
    write_csv(folder / "candidates.csv", decision.table.reset_index())
    write_text(folder / "candidates.md", markdown(study.name, parts, [*advice, *said]))
    save_candidates(study.problem, decision.table, folder / "candidates", study.name)
    write_csv(folder / "front.csv", decision.run.front())
    if beside.shares is not None and beside.fronts is not None:
        write_csv(folder / "attained.csv", beside.shares.reset_index())
        write_csv(folder / "attainable.csv", beside.fronts)
    write_text(folder / "report.html", found.page(study))
    with terminal.waiting("drawing"):
        draw(folder, decision, beside, study.name)
    show([*said, *advice], printed, parts)
    terminal.end(folder)


def tables5(request: Request, travel: float) -> list[pd.DataFrame]:
    """Return Table 5 with each of its weightings."""
    free = request.study.problem.replace(constraints=())
    iterations, seed = request.budget
    parts = []
    for weighting in terminal.progress(WEIGHTINGS, len(WEIGHTINGS), "weightings of Table 5"):
        problem = free.replace(weighting=weighting)
        run = minimise(problem, request.optimiser, iterations=iterations, seed=seed)
        parts.append(table5(problem, run, travel))
    return parts


def without_designs(decision: Decision, printed: Sequence[pd.DataFrame]) -> list[str]:
    """Return a sentence about rows that Table 5 lacks, if it does; `printed` are its parts by weighting."""
    missing = {kind for part in printed for kind in KINDS if not part.design.str.startswith(kind).any()}
    if not missing:
        return []
    travel = decision.free.front()[f"{SWS().label} [m]"]
    have, rows = shown_range(travel.min(), travel.max(), "m"), " and ".join(sorted(missing))
    return [f"Table 5 lacks designs {rows}: none is at the limit; the front has SWS of {have}."]


def draw(folder: Path, decision: Decision, beside: ActiveBeside, title: str) -> None:
    """Write the front, before fronts of active suspensions if there are any, and with a present design changes."""
    problem, table = decision.problem, decision.table
    headers = dict(zip(problem.objectives, column_headers(problem.objectives, problem.units), strict=True))
    across = next((name for name in headers if problem.units[name] == "m"), next(reversed(headers)))
    ordered = [headers[across], *(header for name, header in headers.items() if name != across)]
    drawn = (
        problem.constraints if len(problem.cases) == 1 or problem.worst_case else ()
    )  # a limit is of the worst case
    limits = {headers[one.measure.label]: one.value for one in drawn if one.measure.label in headers}
    free = decision.free.front() if problem.constraints else pd.DataFrame()
    behind = beside.fronts if beside.by_controller(ordered) else None
    front = figures.front_figure(decision.run.front(), free, table, ordered, limits, title, behind)
    write_figure(folder / "front", front)
    if PRESENT in table.name.to_numpy():
        write_figure(folder / "changes", figures.changes_figure(table, problem.objectives, title))


def show(said: Sequence[str], printed: Sequence[pd.DataFrame], parts: Mapping[str, pd.DataFrame]) -> None:
    """Print Table 5 if there is one, then the problem, the parts of the table, and what limits and bounds do."""
    for part in printed:
        shown = part.drop(columns="weighting")
        units = {header: name_and_unit(header)[1] for header in map(str, readable(shown))}
        digits = {header: DECIMALS[unit] for header, unit in units.items() if unit}
        terminal.show(f"Table 5, ACC weighted by {part.weighting.iloc[0]}", shown, digits, readable=True)
    for title, table in parts.items():
        terminal.show(title, table, decimals_of(table), readable=True)
    for line in said:
        terminal.note(line)
