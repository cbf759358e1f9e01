"""Tables, verdict and figures of the quality over many seeds, written to a folder and printed."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pandas as pd

from .. import escaping
from ..study import figures, inference, lenses
from ..study.comparison import CONFIGURATION
from ..study.findings import Findings
from ..study.judging import CUT_ARCHIVE, INDICATORS, POPULATION
from ..study.store import StoredRun
from ..tables import write_csv, write_table, write_text
from . import stages, terminal

if TYPE_CHECKING:
    from .comparing import Request

PLAIN = {
    *("value", "lens", "population", "iterations", "set", "algorithm", "first", "second"),
    *("effect", "members", "runs", "runs_first", "runs_second", "reached"),
}
SHORT = {
    "population": "N", "iterations": "iter.", "evaluations": "evals", "relative_hypervolume": "HV / ref.",
    "igd_plus": "IGD+", "seconds": "time [s]",
}  # fmt: skip
DECIMALS = {"evals": 0, "HV / ref.": 4, "IGD+": 5, "epsilon": 4, "spread": 3, "time [s]": 4}


def write(request: "Request", results: Findings, store: Mapping[str, StoredRun]) -> None:
    """Write tables, verdict and figures."""
    folder = request.campaign.folder
    write_csv(folder / "quality.csv", results.course.drop(columns="seconds"))
    for name, table in {"equal": results.medians, "differences": results.differences}.items():
        named = table.rename(columns=_header)
        named.insert(0, "row", range(1, len(table) + 1))  # names a row in each block of columns
        write_table(folder / name, named)
    write_table(folder / "to_reach", results.reached.rename(columns=_header), keys=3)
    words = "\n\n".join(map(escaping.markdown, results.words))
    if len(results.verdict):
        write_table(folder / "verdict", results.verdict, keys=4)
        words = (folder / "verdict.md").read_text(encoding="utf-8") + "\n" + words
    write_text(folder / "verdict.md", words + "\n")
    with stages.stage("figures of quality"):
        for population in request.campaign.comparison.populations:
            _draw(request, results, store, population)
        request.figures.settle()


def _header(column: str) -> str:
    unit = {"seconds": "s"}.get(column, "-")
    return column if column in PLAIN else f"{column.replace('_', ' ')} [{unit}]"


def _draw(request: "Request", results: Findings, store: Mapping[str, StoredRun], population: int) -> None:
    """Begin the figures of a population."""
    comparison, folder, begin = request.campaign.comparison, request.campaign.folder, request.figures.begin
    course = results.course[results.course.population == population]
    sets = (POPULATION, CUT_ARCHIVE)
    begin(folder / f"anytime_n{population}", figures.anytime_panels, course, sets)
    equal = results.equal
    at_end = (equal.population == population) & (equal.iterations == max(comparison.iterations))
    last = equal[at_end & (equal.lens == lenses.EVALUATIONS) & (equal.set == POPULATION)]
    title = f"N = {population}, final populations at equal evaluations, {max(comparison.iterations)} iterations"
    begin(folder / f"boxes_n{population}", figures.box_panels, last, INDICATORS, title)
    names = comparison.algorithms[:2]
    finals = comparison.studies()[population].finals(store).rename(columns=request.headers())
    first, second = (finals[finals.algorithm == name] for name in (names[0], names[-1]))
    if len(names) == 2 and set(first.seed) & set(second.seed):
        objectives = list(request.headers().values())
        begin(folder / f"attainment_n{population}", figures.attainment_panels, first, second, objectives, names)


def say(results: Findings, target: float) -> None:
    """Print medians, evaluations and time to the target, and the verdict."""
    final = results.medians[results.medians.set == POPULATION]
    kept = ["lens", *CONFIGURATION, "algorithm", "evaluations", *INDICATORS]
    terminal.show("Final populations, medians", final[kept].rename(columns=SHORT), DECIMALS, keys=4)
    title = f"To {target:g} of the reference hypervolume, medians"
    terminal.show(title, results.reached.rename(columns=SHORT), DECIMALS, keys=3)
    if len(results.verdict):
        say_verdict(results.verdict, results.differences["first"].iloc[0])
    else:
        for paragraph in results.words:
            terminal.note(paragraph)


def say_verdict(verdict: pd.DataFrame, first: str) -> None:
    """Print which is ahead, the first algorithm or another."""
    title = f"Verdict: which has more hypervolume, {first} or the other"
    terminal.show(title, verdict.rename(columns=SHORT), keys=4)
    terminal.note(
        f"Ahead: p < {inference.SIGNIFICANCE:g} by two-sided Mann-Whitney tests, adjusted by Holm for all tests, "
        "and an effect that is not negligible (A12). verdict.md says it in words."
    )
