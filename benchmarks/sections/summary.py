"""What the timings say: medians, ratios, growth, and whether we are where we want to be."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from peers import OURS
from sections import cold_start, derivatives, evaluation, moead_limits, process, roofline, struts
from sections.arithmetic import Limits

GROWTH_FROM = 1000
"""Population from which on growth is fitted; below it what a run costs whatever its size weighs too much."""


@dataclass(frozen=True)
class Measurements:
    """The timings of all sections, one row each, and what was found beside them.

    Parameters
    ----------
    evaluation, nsga2, moead, target, process : DataFrame
        From `evaluation.measure`, `searches.by_population` (twice), `searches.to_target`, `process.measure`.
    cold_start, struts, derivatives, moead_limits, roofline : DataFrame
        From the function `measure` of these sections.
    full_car : DataFrame
        From `full_car.measure`.
    limits : Limits
        From `arithmetic.limits`.
    usual_seconds : float
        Of a design by the usual evaluator, from `full_car.seconds_of_usual_way` [s].
    errors : dict of str to float
        From `evaluation.errors`.
    memory : float
        From `evaluation.memory` [MB].
    absent : dict of str to str
        Why a library is not in the tables.
    beside : DataFrame or None
        From `beside.in_turn`, beside another commit.
    """

    evaluation: pd.DataFrame
    nsga2: pd.DataFrame
    moead: pd.DataFrame
    moead_limits: pd.DataFrame
    target: pd.DataFrame
    process: pd.DataFrame
    cold_start: pd.DataFrame
    struts: pd.DataFrame
    derivatives: pd.DataFrame
    roofline: pd.DataFrame
    limits: Limits
    full_car: pd.DataFrame
    usual_seconds: float
    errors: dict[str, float]
    memory: float
    absent: dict[str, str]
    beside: pd.DataFrame | None = None


def medians(timings: pd.DataFrame, size: str) -> pd.DataFrame:
    """Return for each contender and size: median, lower and upper quartile of seconds, and how many there are."""
    seconds = timings.groupby(["contender", size], sort=False).seconds
    quartiles = {name: seconds.quantile(q) for name, q in (("lower", 0.25), ("median", 0.5), ("upper", 0.75))}
    return pd.DataFrame({**quartiles, "repeats": seconds.count()}).reset_index()


def ratios(timings: pd.DataFrame, size: str, ours: str = OURS) -> pd.DataFrame:
    """Return `medians` with the column ``ratio``, the median over that of ours at the same size."""
    table = medians(timings, size)
    own = table[table.contender == ours].set_index(size)["median"]
    return table.assign(ratio=table["median"] / table[size].map(own))


def growth(timings: pd.DataFrame) -> pd.Series:
    """Return by contender the exponent b of seconds ~ N^b, fitted to the medians from N = 1000 on.

    NaN where there are fewer than two sizes.
    """
    table = medians(timings, "population")
    large = table[table.population >= GROWTH_FROM]

    def exponent(part: pd.DataFrame) -> float:
        if len(part) < 2:
            return np.nan
        return float(np.polyfit(np.log(part.population), np.log(part["median"]), 1)[0])

    return pd.Series({name: exponent(part) for name, part in large.groupby("contender", sort=False)}, dtype=float)


def best_to_target(timings: pd.DataFrame) -> pd.DataFrame:
    """Return for each search the population with which it is soonest at the target, soonest search first.

    Columns: contender, population, lower, median, upper [s], generations (median), repeats; NaN for who does
    not get there in every repeat.
    """
    reached = timings.groupby(["contender", "population"]).seconds.transform(lambda s: s.notna().all())
    timings = timings.assign(seconds=timings.seconds.where(reached))
    table = medians(timings, "population")
    generations = timings.groupby(["contender", "population"]).generations.median().rename("generations")
    table = table.join(generations, on=["contender", "population"])
    return table.sort_values("median").drop_duplicates("contender").reset_index(drop=True)


def best_of_others(table: pd.DataFrame, ours: str = OURS) -> tuple[str, float]:
    """Return the contender with the least median that is not ours, and that median; NaN if there is none."""
    others = table[~table.contender.str.startswith(ours)].dropna(subset="median").sort_values("median")
    return (others.contender.iloc[0], float(others["median"].iloc[0])) if len(others) else ("-", np.nan)


def import_seconds(found: Measurements) -> float:
    """Return what importing the package takes where control is imported already [s]."""
    return float(found.process.groupby("contender").seconds.median()[process.IMPORTS[1]])


def goals(found: Measurements) -> pd.DataFrame:
    """Return what we want to hold, the bar and what was measured; columns what, bar, here, against, holds."""
    rows: list[tuple[str, str, float, str, bool]] = []
    evaluated = ratios(found.evaluation, "designs", evaluation.OURS)
    loop = evaluated[(evaluated.contender == evaluation.LOOP) & (evaluated.designs == 1000)].ratio
    for ratio in loop:
        rows.append(("evaluate, 1,000 designs", ">= 2000 x", ratio, evaluation.LOOP, ratio >= 2000))
    table = medians(found.nsga2, "population")
    for population, bar in ((1000, 0.45), (16000, 0.30)):
        here = table[table.population == population]
        if len(here):
            rows.append(_against_best(f"NSGA-II, N = {population:,}: ours / fastest", here, bar))
    exponents = growth(found.nsga2)
    own, lowest = exponents.get(OURS, np.nan), exponents.idxmin() if exponents.notna().any() else "-"
    gentle = own < 1.6 and own <= exponents.min() + 0.05
    rows.append(
        ("NSGA-II, growth exponent", "< 1.6, lowest + 0.05", own, f"{lowest} {exponents.min():.2f}", gentle)
    )
    each = found.moead.assign(seconds=found.moead.seconds / found.moead.evaluations)
    rows.append(_against_best("MOEA/D, time per evaluation: ours / fastest", medians(each, "population"), 0.5))
    for what, bar, ratio, limit in moead_limits.goals(found.moead_limits):
        rows.append((f"{what}: ours / {limit}", f"<= {bar}", ratio, limit, ratio <= bar))
    rows.append(_against_best("time to the hypervolume: ours / fastest", best_to_target(found.target), 0.8))
    extra = import_seconds(found)
    rows.append(("import beyond `import control`", "<= 0.3 s", extra, "", extra <= 0.3))
    for what, bar, multiple in cold_start.goals(found.cold_start):
        rows.append((f"processor time, {what}", f"<= {bar}", multiple, "import control", multiple <= bar))
    for what, bar, ratio in struts.goals(found.struts):
        rows.append((what, f"<= {bar:g}", ratio, "spring and damper by default", ratio <= bar))
    for what, bar, ratio in derivatives.goals(found.derivatives):
        rows.append((what, f"<= {bar:g}", ratio, "values alone", ratio <= bar))
    for what, bar, share in roofline.goals(found.roofline):
        rows.append((what, f">= {bar:g}", share, "", share >= bar))
    return pd.DataFrame(rows, columns=["what", "bar", "here", "against", "holds"])


def _against_best(what: str, table: pd.DataFrame, bar: float) -> tuple[str, str, float, str, bool]:
    name, fastest = best_of_others(table)
    ours = table[table.contender.str.startswith(OURS)]["median"].min()
    return what, f"<= {bar}", float(ours / fastest), name, bool(ours / fastest <= bar)
