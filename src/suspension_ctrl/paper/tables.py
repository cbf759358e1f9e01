"""Tables of the comparison with measured and published values, as DataFrames."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from ..quantities import column_headers
from ..response.problem import RideProblem
from ..study import timing
from ..study.comparison import CONFIGURATION, EQUAL_ITERATIONS

ALGORITHMS = {2: "nsga2", 3: "moead-dra"}
"""Published algorithms by the number of the table with their times."""


def timed_tables(runs: pd.DataFrame, published: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return Tables 2 to 4 as ``"table2"`` to ``"table4"``, without tables of algorithms that did not run."""
    timed = {f"table{n}": seconds_by_repeat(runs, published, name) for n, name in ALGORITHMS.items()}
    timed["table4"] = comparison(runs, published)
    return {name: table for name, table in timed.items() if len(table)}


def seconds_by_repeat(runs: pd.DataFrame, published: pd.DataFrame, algorithm: str) -> pd.DataFrame:
    """Return Table 2 or 3: measured and published seconds of an algorithm, by runs from `timing.tidy`."""
    measured = runs[(runs.algorithm == algorithm) & (runs.budget == EQUAL_ITERATIONS)]
    keys = ["algorithm", *CONFIGURATION, "repeat"]
    table = measured.merge(published, on=keys, how="left")
    table["microseconds_per_evaluation"] = 1e6 * table.seconds / table.evaluations
    return table[[*keys, "published_seconds", "seconds", "evaluations", "microseconds_per_evaluation"]]


def as_printed(table: pd.DataFrame) -> pd.DataFrame:
    """Return Table 2 or 3 for printing: a column per configuration, a row "published / measured" per repeat."""
    columns: dict[str, list[str]] = {}
    for (population, iterations), part in table.groupby(CONFIGURATION):
        seconds = part[["published_seconds", "seconds"]]
        rows = [*seconds.itertuples(index=False), tuple(seconds.mean())]
        columns[f"N={population}, {iterations} iterations"] = [
            *("{} / {:.4f}".format("-" if pd.isna(p) else f"{p:.1f}", s) for p, s in rows),
            str(part.evaluations.iloc[0]),
            f"{part.microseconds_per_evaluation.mean():.2f}",
        ]
    labels = [*map(str, sorted(table.repeat.unique())), "mean", "evaluations", "µs per evaluation"]
    return pd.DataFrame({"repeat": labels, **columns})


def comparison(runs: pd.DataFrame, published: pd.DataFrame) -> pd.DataFrame:
    """Return Table 4: `timing.compared` with published means and their ratios."""
    table = timing.compared(runs)
    keys = ["algorithm", *CONFIGURATION]
    means = published.groupby(keys).published_seconds.mean().reset_index().assign(budget=EQUAL_ITERATIONS)
    table = table.merge(means, on=[*keys, "budget"], how="left")
    first = str(runs.algorithm.iloc[0])
    table["published_ratio_percent"] = timing.ratios_to_first(table, "published_seconds", first)
    columns = ["evaluations", "published_seconds", "seconds", "microseconds_per_evaluation"]
    ratios = ["published_ratio_percent", "ratio_percent"]
    return table[[*CONFIGURATION, "algorithm", "budget", *columns, *ratios]]


def beside_published(
    problem: RideProblem, designs: Mapping[str, tuple[float, ...]], published: Mapping[str, Mapping[str, float]]
) -> pd.DataFrame:
    """Return Table 5: objectives of designs by name, published values (NaN if none) and differences [%]."""
    values = np.array(list(designs.values()), dtype=float)
    objectives = problem.evaluate(values)
    headers = column_headers([*problem.variables, *problem.objectives], problem.units)
    table = pd.DataFrame(np.hstack([values, objectives]), columns=headers)
    table.insert(0, "design", list(designs))
    table.insert(0, "weighting", str(problem.weighting))
    for column, name in enumerate(problem.objectives):
        printed = np.array([published.get(design, {}).get(name, np.nan) for design in designs])
        table[f"published {name} [{problem.units[name]}]"] = printed
        table[f"{name} off [%]"] = 100 * (objectives[:, column] / printed - 1)
    return table
