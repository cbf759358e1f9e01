"""The tables of the page: medians with quartiles, ratios, and what holds, as texts."""

import math
from collections.abc import Callable
from typing import Any

import pandas as pd

from peers import OURS
from sections import cold_start, derivatives, evaluation, full_car, roofline, struts
from sections.summary import Measurements, best_to_target, goals, growth, medians, ratios


def goals_table(found: Measurements) -> pd.DataFrame:
    """Return what is to hold, the bar, the figure here, and whether it holds."""
    table = goals(found)
    return table.assign(here=[number(v) for v in table.here], holds=["yes" if h else "no" for h in table.holds])


def evaluation_table(found: Measurements) -> pd.DataFrame:
    """Return microseconds per design by method and number of designs, and the error of each method."""
    table = ratios(found.evaluation, "designs", evaluation.OURS)
    wide = _wide(table, "designs", lambda row: spread(row, 1e6 / row.designs))
    wide["ratio at 1,000"] = _column(table[table.designs == 1000], "ratio")
    wide["error"] = pd.Series({name: f"{error:.1e}" for name, error in found.errors.items()})
    return _named(wide, "method")


def nsga2_table(found: Measurements) -> pd.DataFrame:
    """Return milliseconds by library and population, the exponent of growth, and evaluations at the least N."""
    wide = _wide(medians(found.nsga2, "population"), "population", lambda row: spread(row, 1e3))
    wide["growth"] = growth(found.nsga2).map(number)
    least = found.nsga2[found.nsga2.population == found.nsga2.population.min()]
    wide["evaluations"] = least.groupby("contender").evaluations.first().map("{:,.0f}".format)
    return _named(wide)


def nsga2_ratios(found: Measurements) -> pd.DataFrame:
    """Return each library's median over ours by population."""
    return _named(_wide(ratios(found.nsga2, "population"), "population", lambda row: number(row.ratio)))


def moead_table(found: Measurements) -> pd.DataFrame:
    """Return microseconds per evaluation, ratio and evaluations of every MOEA/D."""
    each = found.moead.assign(seconds=found.moead.seconds / found.moead.evaluations)
    table = ratios(each, "population").sort_values("median")
    evaluations = found.moead.groupby("contender").evaluations.first()
    return pd.DataFrame(
        {
            "library": table.contender,
            "µs per evaluation": [spread(row, 1e6) for row in table.itertuples()],
            "ratio": table.ratio.map(number),
            "evaluations": table.contender.map(evaluations).map("{:,.0f}".format),
        }
    )


def limits_table(found: Measurements) -> pd.DataFrame:
    """Return milliseconds of MOEA/D-DRA and of its limits, and the distance from the front where it is known."""
    table = found.moead_limits.groupby("contender", sort=False)
    return pd.DataFrame(
        {
            "what": list(table.groups),
            "ms": [number(1e3 * seconds) for seconds in table.seconds.median()],
            "IGD": [number(igd) for igd in table.igd.median()],
        }
    )


def target_table(found: Measurements) -> pd.DataFrame:
    """Return milliseconds to the target, population and generations of every search, soonest first."""
    table = best_to_target(found.target)
    ours = table[table.contender.str.startswith(OURS)]["median"].min()
    reached = table["median"].notna()
    return pd.DataFrame(
        {
            "search": table.contender,
            "ms": [
                spread(row, 1e3) if yes else "not reached"
                for row, yes in zip(table.itertuples(), reached, strict=True)
            ],
            "ratio": [number(r) for r in table["median"] / ours],
            "N": [f"{n:,}" if yes else "" for n, yes in zip(table.population, reached, strict=True)],
            "generations": [number(g) for g in table.generations],
        }
    )


def full_car_table(found: Measurements) -> pd.DataFrame:
    """Return seconds to the target, their ratio, generations and the whole run of each library, soonest first."""
    table = full_car.quartiles(found.full_car)
    own = table["median"][OURS]
    usual = full_car.usual_seconds(found.full_car, found.usual_seconds)
    reached = [not math.isnan(median) for median in table["median"]]
    rows = pd.DataFrame(
        {
            "library": table.index,
            "s": [
                spread(row, 1) if yes else "not in every run"
                for row, yes in zip(table.itertuples(), reached, strict=True)
            ],
            "ratio": [number(ratio) for ratio in table["median"] / own],
            "generations": [number(g) for g in table.generations],
            "whole run, s": [number(seconds) for seconds in table.whole],
        }
    )
    last = [full_car.LOOP, number(usual), number(usual / own), "", ""]
    return pd.concat([rows, pd.DataFrame([last], columns=rows.columns)])


def process_table(found: Measurements) -> pd.DataFrame:
    """Return seconds of the main script and of imports."""
    table = medians(found.process.assign(size=1), "size")
    names = [f"`{name}`" for name in table.contender]
    return pd.DataFrame({"what": names, "s": [spread(row, 1) for row in table.itertuples()]})


def cold_start_table(found: Measurements) -> pd.DataFrame:
    """Return the median multiples by program, in the first process and in the second."""
    table = cold_start.medians(found.cold_start)
    first, second = ([number(x) for x in table[store]] for store in (cold_start.EMPTY, cold_start.FILLED))
    return pd.DataFrame({"program": [f"`{name}`" for name in table.index], "first": first, "second": second})


def strut_table(found: Measurements) -> pd.DataFrame:
    """Return microseconds per design by vehicle and strut, their ratio to the default strut, and its bar."""
    table = struts.ratios(found.struts)
    return pd.DataFrame(
        {
            "vehicle": table.vehicle,
            "strut": table.strut,
            "µs per design": [number(1e6 * seconds) for seconds in table.seconds],
            "ratio": table.ratio.map(number),
            "bar": [f"<= {bar:g}" for bar in table.bar],
        }
    )


def derivative_table(found: Measurements) -> pd.DataFrame:
    """Return microseconds per design of values and of values with derivatives by case, and their ratio."""
    table = derivatives.ratios(found.derivatives)
    return pd.DataFrame(
        {
            "case": table.case,
            "values, µs": [number(1e6 * seconds) for seconds in table["values"]],
            "values and derivatives, µs": [number(1e6 * seconds) for seconds in table.both],
            "ratio": table.ratio.map(number),
        }
    )


def roofline_table(found: Measurements) -> pd.DataFrame:
    """Return by what microseconds per design at the limit and of ours, the share, and one thread over two."""
    table = roofline.shares(found.roofline)
    return pd.DataFrame(
        {
            "what": table.what,
            "limit, µs": [number(1e6 * seconds) for seconds in table.limit],
            "ours, µs": [number(1e6 * seconds) for seconds in table.seconds],
            "share": table.share.map(number),
            "bar": [f">= {bar:g}" if bar else "" for bar in table.bar],
            "one thread / two": table.threads.map(number),
        }
    )


def spread(row: Any, scale: float) -> str:
    """Return a median with its quartiles, or alone where there was one call only."""
    if row.repeats < 2:
        return f"{number(row.median * scale)} (once)"
    return f"{number(row.median * scale)} ({number(row.lower * scale)} to {number(row.upper * scale)})"


def number(value: float) -> str:
    """Return three significant digits without an exponent; nothing for NaN."""
    if math.isnan(value):
        return ""
    digits = max(0, 2 - math.floor(math.log10(abs(value)))) if value else 0
    return f"{value:,.{digits}f}"


def _wide(table: pd.DataFrame, size: str, cell: Callable[[Any], str]) -> pd.DataFrame:
    """Return a row per contender, quickest first, and a column per size."""
    shown = table.assign(cell=[cell(row) for row in table.itertuples()])
    wide = shown.set_index(["contender", size]).cell.unstack(fill_value="")  # noqa: PD010 - text has no mean
    order = table.sort_values([size, "median"]).drop_duplicates("contender").contender
    return wide.loc[order].rename(columns=lambda n: f"{'N = ' if size == 'population' else ''}{n:,}")


def _column(table: pd.DataFrame, name: str) -> "pd.Series[str]":
    return table.set_index("contender")[name].map(number)


def _named(wide: pd.DataFrame, name: str = "library") -> pd.DataFrame:
    wide.columns.name = None
    return wide.fillna("").rename_axis(name).reset_index()


def markdown(table: pd.DataFrame) -> str:
    """Return a table in Markdown, its texts as they are."""
    return table.to_markdown(index=False, disable_numparse=True)
