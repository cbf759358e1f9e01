"""The outcome of a comparison in a few sentences: times, hypervolume, and how often which algorithm is ahead."""

from collections.abc import Iterator

import pandas as pd

from ..study import timing
from ..study.comparison import CONFIGURATION
from ..study.findings import SETS, Findings
from ..study.inference import NO_DIFFERENCE


def outcome_texts(timed: pd.DataFrame, findings: Findings | None) -> list[str]:
    """Return the sentences about timed runs, judged or not, and about runs over many seeds if there are any."""
    told = [*_times(timed), *(_medians(timed) if "hypervolume" in timed else [])]
    if findings is None:
        return told
    return [*(_ahead(findings) if len(findings.verdict) else findings.words), *told]


def _times(timed: pd.DataFrame) -> Iterator[str]:
    """Yield a sentence for each algorithm but the first: how many times as long the first takes."""
    first = timed.algorithm.iloc[0]
    table = timing.compared(timed)
    for other, rows in table[table.algorithm != first].groupby("algorithm", sort=False):
        ratios = rows.groupby("budget", sort=False).ratio_percent.agg(["min", "max"]) / 100
        parts = (f"{_range(low, high)} times as long at equal {name}" for name, low, high in ratios.itertuples())
        yield f"{first} takes {' and '.join(parts)} as {other}."


def _range(low: float, high: float) -> str:
    return f"{low:.2f}" if f"{low:.2f}" == f"{high:.2f}" else f"{low:.2f} to {high:.2f}"


def _medians(timed: pd.DataFrame) -> Iterator[str]:
    """Yield a sentence about the hypervolume of the final populations of the longest configuration."""
    table = timing.quality(timed)
    last = table[table[CONFIGURATION].eq(table[CONFIGURATION].max()).all(axis=1)]
    size = "N = {} and {} iterations".format(*last[CONFIGURATION].iloc[0])
    for budget, rows in last.groupby("budget", sort=False):
        found = rows.set_index("algorithm").hypervolume
        values = ", ".join(f"{name} {found[name]:.4f}" for name in timed.algorithm.unique() if name in found)
        yield f"Hypervolume of the final populations, medians at equal {budget} for {size}: {values}."


def _ahead(findings: Findings) -> Iterator[str]:
    """Yield for each set of designs and each other algorithm in how many tests which one is ahead."""
    table, first = findings.verdict, findings.differences["first"].iloc[0]
    lenses = [name for name in table if name not in {"set", *CONFIGURATION, "other"}]
    names = {chosen: words for words, chosen in SETS.items()}
    for (chosen, other), rows in table.groupby(["set", "other"], sort=False):
        counts = rows[lenses].melt().value.value_counts()
        parts = (
            f"no difference in {count}" if name == NO_DIFFERENCE else f"{name} is ahead in {count}"
            for name, count in counts.items()
        )
        yield (
            f"Hypervolume of the {names[str(chosen)]}, {first} against {other}: {', '.join(parts)} "
            f"of {counts.sum()} tests, over configurations at equal iterations, evaluations and time."
        )
