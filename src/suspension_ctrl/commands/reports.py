"""What follows from the runs of a comparison: tables, the verdict, figures."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from .. import tables as files
from ..study import inference as statistics
from ..study import inference as verdicts
from ..study import lenses, study
from ..study.comparison import Comparison
from ..study.store import StoredRun
from ..study.study import INDICATORS
from . import results, terminal
from .pictures import draw

VALUE = "relative_hypervolume"
CONFIGURATION = ["lens", "population", "iterations"]


def last_rows(quality: pd.DataFrame) -> pd.DataFrame:
    """Return one row per run, as in the table of timed runs: its population at the end, or its error."""
    ends = quality[quality.error.ne("") | quality.set.eq(study.POPULATION)]
    return (
        ends.groupby(["population", "algorithm", "seed"], sort=False)
        .tail(1)
        .drop(columns=["set", "members", "budget"])
    )


def report(
    comparison: Comparison,
    quality: pd.DataFrame,
    store: Mapping[str, StoredRun],
    clock: pd.DataFrame,
    target: float,
    folder: Path,
) -> None:
    """Write and print what follows from the runs that ended, if any: tables, verdict, figures."""
    ended = quality[quality.error.eq("")].drop(columns="error")
    if ended.empty:
        return
    timed = lenses.with_seconds(ended, clock)
    files.write_csv(folder / "quality.csv", timed.drop(columns="seconds"))
    equal = lenses.at_equal(timed, comparison.algorithms, comparison.iterations, comparison.cost())
    by = [*CONFIGURATION, "set", "algorithm"]
    spent = equal.groupby(by, sort=False)[["evaluations", "seconds"]].median().reset_index()
    summary = spent.merge(statistics.quartiles(equal, by, INDICATORS), on=by)
    compared = statistics.pairwise(equal, [*CONFIGURATION, "set"], INDICATORS, comparison.algorithms)
    reached = lenses.reached_by(lenses.to_reach(timed, target))
    for name, table in (("equal", summary), ("differences", compared), ("to_reach", reached)):
        results.write_table(folder / name, table.rename(columns=_headers(table.columns)))
    judged = {"final population": study.POPULATION, "archive cut to N": study.CUT_ARCHIVE}
    words = [
        verdicts.verdict(
            compared[(compared.set == chosen) & (compared.value == VALUE)],
            *comparison.algorithms[:2],
            f"Hypervolume of the {what}",
        )
        for what, chosen in judged.items()
        if len(compared)
    ]
    files.write_text(folder / "verdict.md", "\n\n".join(words) + "\n")
    _show(summary, reached, words, target)
    draw(comparison, timed, equal, store, folder)


def _headers(columns: Sequence[str]) -> dict[str, str]:
    units = {"seconds": "s"}
    plain = {
        "value",
        "lens",
        "population",
        "iterations",
        "set",
        "algorithm",
        "first",
        "second",
        "effect",
        "members",
        "runs",
        "reached",
    }
    return {c: c if c in plain else f"{c.replace('_', ' ')} [{units.get(c, '-')}]" for c in columns}


def _show(summary: pd.DataFrame, reached: pd.DataFrame, words: Sequence[str], target: float) -> None:
    final = summary[summary.set == study.POPULATION]
    kept = [*CONFIGURATION, "algorithm", "evaluations", *INDICATORS]
    short = {
        "population": "N",
        "iterations": "iter.",
        "evaluations": "evals",
        VALUE: "HV / ref.",
        "igd_plus": "IGD+",
    }
    digits = {"evals": 0, "HV / ref.": 4, "IGD+": 5, "epsilon": 4, "spread": 3}
    terminal.show("Final populations, medians", final[kept].rename(columns=short), digits)
    terminal.show(
        f"To {target:g} of the reference hypervolume, medians",
        reached.rename(columns={"population": "N", "evaluations": "evals", "seconds": "time [s]"}),
        {"evals": 0, "time [s]": 4},
    )
    for paragraph in words:
        terminal.note(paragraph)
