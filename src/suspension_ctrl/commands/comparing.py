"""The steps of `suspension-ctrl compare`: timed runs, reference front, quality over seeds; files before prints."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import pandas as pd
import typer

from ..desk.known_front import finder
from ..desk.study_files import StudyFile, check_fits_file, load_study
from ..paper import experiment as paper
from ..quantities import column_headers
from ..response.problem import RideProblem
from ..search.indicators import ReferenceFront
from ..study import machine, reference, timing
from ..study.campaign import Campaign
from ..study.findings import findings, last_rows
from ..study.kept_fronts import KeptFronts
from ..study.reference import Reference
from ..study.reference_files import load_reference
from ..study.store import StoredRun, keeping
from ..study.workers import begun
from ..tables import write_csv, write_json, write_text
from . import quality, reports, results, stages, studies, terminal
from .comparison_page import Outcome, page
from .drawing import Drawing

QUICK_TOLERANCE = 1e-3
RECORD = "environment.json"
OF_STUDY = ("study", "vehicle", "road", "speed", "band", "weighting", "allow_outside")
OF_SEARCH = ("algorithms", "populations", "iterations", "repeats", "seeds", "seed", "target")
"""Options from which the study is made."""


@dataclass(frozen=True)
class Request:
    """A campaign with its study and all options of the command."""

    campaign: Campaign
    study: StudyFile
    options: Mapping[str, Any]
    reference: Reference | None = None  # given by an option
    figures: Drawing = field(default_factory=Drawing)

    @classmethod
    def of(cls, options: Mapping[str, Any], figures: Drawing) -> Self:
        """Return the request of these options, checked, and make its folder."""
        study = studies.chosen_study(**{name: options[name] for name in (*OF_STUDY, *OF_SEARCH)})
        comparison = study.search.comparison(study.problem)
        tolerance = QUICK_TOLERANCE if options["quick"] else reference.TOLERANCE
        given = options["reference"] and load_reference(options["reference"], study.problem)
        check_fits_file(study)
        folder = results.results_folder(options["out"], resumed_by=studies.FILE)
        search = {name: getattr(study.search, name) for name in OF_SEARCH}
        lists = {name: ",".join(map(str, value)) for name, value in search.items() if isinstance(value, tuple)}
        campaign = Campaign(comparison, folder, tolerance, stages.counted, KeptFronts.of_user())
        return cls(campaign, study, {**options, **search, **lists}, given, figures)

    @property
    def problem(self) -> RideProblem:
        """The problem of the study."""
        return self.study.problem

    @cached_property
    def of_paper(self) -> bool:
        """Whether the problem is the paper's, with any weighting."""
        return paper.is_papers(self.problem, band=True)

    def headers(self) -> dict[str, str]:
        """Return the headers of the objectives by name; a travel comes first, or else the last objective."""
        names, units = self.problem.objectives, self.problem.units
        across = next((name for name in names if units[name] == "m"), names[-1])
        ordered = [across, *(name for name in names if name != across)]
        return dict(zip(ordered, column_headers(ordered, units), strict=True))


def carry_out(request: Request, cluster: AbstractContextManager[Any] | None) -> None:
    """Make, write and print the timed runs; with a cluster, also the runs over many seeds."""
    campaign = request.campaign
    try:
        with keeping(campaign.folder):
            raised = _carried_out(request, cluster)
    except KeyboardInterrupt:
        kept, planned = campaign.kept(judged=cluster is not None)
        stages.say(f"{kept} of {planned} runs are kept in {campaign.folder}; go on with --out {campaign.folder}")
        raise
    terminal.end(campaign.folder)
    if raised:
        terminal.complain(f"{raised} runs raised: see the column error of {campaign.folder / 'runs.csv'}")
        raise typer.Exit(1)


def _carried_out(request: Request, cluster: AbstractContextManager[Any] | None) -> int:
    """Return the number of runs that raised."""
    campaign, record = request.campaign, request.campaign.folder / RECORD
    judged, resumed = cluster is not None, (campaign.folder / studies.FILE).exists()
    if resumed:
        campaign.check_judged(judged=judged)
    else:  # marks the folder as one to resume
        studies.save_resolved(campaign.folder, request.study)
    if not record.exists():  # written by the command that started the timed runs
        texts = {name: str(value) if isinstance(value, Path) else value for name, value in request.options.items()}
        with machine.single_thread():
            write_json(record, machine.describe(texts))
    request.figures.get_ready()  # before anything is timed
    with terminal.compiling():
        store = campaign.time()
    if resumed:  # by settings with which the runs in the folder agree
        studies.save_resolved(campaign.folder, settled(request, judged=judged))
    if cluster is None:
        return _told(request, store)
    with begun(cluster, request.problem) as client:  # its processes start beside the figures of the timed runs
        return _told(request, store, client)


def _told(request: Request, store: Mapping[str, StoredRun], client: Callable[[], Any] | None = None) -> int:
    """Write and print what came of the timed runs; with a client make those over many seeds. Return as above."""
    campaign = request.campaign
    timed = timing.tidy(campaign.comparison, store).assign(timing=True)
    reports.write_times(request, store, timed)
    origin = _origin(request)
    if not origin:  # it may take as long as the runs: their times are shown meanwhile
        reports.say_times(request, store, timed)
        terminal.say()
    with stages.stage("reference front", origin=origin):
        known = None if request.options["quick"] else finder(request.problem, float(timed.seconds.sum()))
        reference = campaign.reference(store, request.reference, known)
    if reference is None:
        write_page(request, store, Outcome(timed))
        terminal.note("Quality is not judged: no two designs found within the limits differ in every objective.")
        return 0
    timed = timing.judged(campaign.comparison, store, timed, reference.front)
    reports.write_quality(request, timed, reference)
    outcome = Outcome(timed, reference)
    write_page(request, store, outcome)
    if origin:
        reports.say_times(request, store, timed)
    reports.say_quality(request, timed, reference)
    terminal.say()
    return _judge(request, client, store, outcome, reference.front) if client else 0


def _origin(request: Request) -> str:
    """Return where the reference front is found without a search, in words; "" if it has to be sought."""
    campaign = request.campaign
    if campaign.has_reference:
        return f"found in {campaign.folder}"
    if request.reference:
        return "given"
    return "kept from an earlier comparison" if campaign.kept_front else ""


def write_page(request: Request, store: Mapping[str, StoredRun], outcome: Outcome) -> None:
    """Write the page of a comparison, if a run found a design within the limits."""
    with stages.stage("page"), machine.single_thread():  # matrices of a car are too small for threads
        if (text := page(request, store, outcome)) is not None:
            write_text(request.campaign.folder / "report.html", text)


def settled(request: Request, *, judged: bool) -> StudyFile:
    """Return the study of all results in a folder that is resumed: runs judged before keep seeds and target."""
    folder, study = request.campaign.folder, request.study
    if not judged and request.campaign.has_judged:
        with suppress(ValueError, OSError):  # of a file that was changed
            kept = load_study(folder / studies.FILE).search
            return replace(study, search=replace(study.search, seeds=kept.seeds, target=kept.target))
    return study


def _judge(
    request: Request,
    client: Callable[[], Any],
    store: Mapping[str, StoredRun],
    outcome: Outcome,
    front: ReferenceFront,
) -> int:
    """Make the runs over many seeds and write and print what came of them; return the number that raised."""
    campaign = request.campaign
    with terminal.compiling():
        table, judged = campaign.judge(front, client())
    write_csv(campaign.folder / "runs.csv", pd.concat([outcome.timed, last_rows(table)]))
    clock, target = timing.seconds_by_evaluations(campaign.comparison, store), request.study.search.target
    if results := findings(campaign.comparison, table, clock, target):
        quality.write(request, results, judged)
        write_page(request, store, outcome._replace(findings=results))
        quality.say(results, target)
    return int((table.error.ne("") & table.budget.isna()).sum())
