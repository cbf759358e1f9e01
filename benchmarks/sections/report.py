"""The page of results in Markdown, and the picture of time against population."""

from typing import Any

import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beside import compared
from peers import OURS
from sections import derivatives, moead_limits
from sections.page_tables import (
    cold_start_table,
    derivative_table,
    evaluation_table,
    full_car_table,
    goals_table,
    limits_table,
    markdown,
    moead_table,
    nsga2_ratios,
    nsga2_table,
    number,
    process_table,
    roofline_table,
    strut_table,
    target_table,
)
from sections.searches import GENERATIONS
from sections.summary import (
    GROWTH_FROM,
    Measurements,
    medians,
)


def page(found: Measurements, settings: dict[str, Any], machine: dict[str, Any]) -> str:
    """Return the page as Markdown, its picture being ``performance.png`` beside it."""
    parts = [
        *_opening(found, settings, machine),
        *_about_evaluation(found, settings),
        *_about_nsga2(found, settings),
        *_about_moead(found, settings),
        *_about_target(found, settings),
        *_about_full_car(found, settings),
        *_about_processes(found),
        *_about_struts(found, settings),
        *_about_derivatives(found, settings),
        *_about_roofline(found, settings),
    ]
    return "\n\n".join(parts) + "\n"


def _opening(found: Measurements, settings: dict[str, Any], machine: dict[str, Any]) -> list[str]:
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    return [
        "# Performance",
        f"Written by `make bench`. {machine['processor']}, {machine['cores']} cores, one thread each; "
        f"Python {machine['python']}; {versions}.",
        f"Table 1's problem, {settings['nodes']} nodes over frequency. Medians and quartiles of "
        f"{settings['repeats']} repeats, contenders taking turns in one process after a first run that is not "
        "counted. A ratio is a median over ours. What a library sets up before its run is not counted; of "
        "ours that is the toolbox, and the weight vectors of MOEA/D, which the others get too.",
        *[f"Absent: {name} ({reason})." for name, reason in found.absent.items()],
        "## In short",
        markdown(goals_table(found)),
    ]


def _about_evaluation(found: Measurements, settings: dict[str, Any]) -> list[str]:
    return [
        "## Evaluation",
        "Microseconds per design by number of designs, and the largest relative error against adaptive quadrature "
        f"at the corners of the box and {settings['sample']} designs in it. A method is left out where by its "
        f"time so far it would take more than {settings['evaluation_limit']:g} s.",
        markdown(evaluation_table(found)),
        f"A process that evaluates {settings['memory_designs']:,} designs in one call takes "
        f"{number(found.memory)} MB at its peak, imports and designs included.",
    ]


def _about_nsga2(found: Measurements, settings: dict[str, Any]) -> list[str]:
    return [
        "## NSGA-II",
        f"Milliseconds for {settings['generations']} generations: simulated binary crossover (probability 0.9, "
        "eta 20), polynomial mutation (1/d, eta 20), the same function evaluating a generation in one call. "
        f"A library is left out where in proportion to its time so far it would take more than "
        f"{settings['limit']:g} s; one that takes more than {settings['repeat_limit']:g} s runs once. Growth is "
        f"the exponent of time against N from {GROWTH_FROM:,} on. Evaluations are counted at the least N.",
        markdown(nsga2_table(found)),
        "Ratios:",
        markdown(nsga2_ratios(found)),
        "![Seconds against population, a line per library](performance.png)",
    ]


def _about_moead(found: Measurements, settings: dict[str, Any]) -> list[str]:
    return [
        "## MOEA/D",
        f"Microseconds per evaluation over {settings['moead_generations'] + 1} N evaluations, "
        f"N = {settings['moead_population']:,}: neighbourhoods of N/10, at most N/100 replacements, mates from "
        "the neighbourhood with probability 0.9, differential evolution (pymoo: crossover, and no limit to "
        "replacements), the same weight vectors (pygmo: its own). Objectives are scaled to the reference front: "
        "not every library normalises them. A batch evaluates a fifth of N, or all, in one call. Ours is "
        "MOEA/D-DRA, which does so by itself; it evaluates by the problem's compiled kernel, and without one by a "
        "call per design as the others do. Finding neighbours counts, for all but jMetalPy.",
        markdown(moead_table(found)),
        *_about_limits(found, settings),
    ]


def _about_limits(found: Measurements, settings: dict[str, Any]) -> list[str]:
    loop = (
        f"UF1 of CEC 2009 has 30 variables; {settings['uf1_evaluations']:,} evaluations at N = 600, T = 60, "
        "n_r = 6. The loop in C is `benchmarks/moead_dra.c`, for this problem and these sizes alone, by `cc -O3 "
        "-march=native`; IGD, the distance of the front from the final population, shows the same search."
        if moead_limits.LOOP in set(found.moead_limits.contender)
        else "The loop in C on UF1 is left out: no C compiler, or the short form."
    )
    return [
        "Beside its limits, in processor time, with weight vectors and neighbourhoods at hand, which depend on N "
        "alone and are kept. Arithmetic and evaluation alone are the same search in one compiled loop: mates, "
        "differences of designs, repair, mutation and random numbers for these, evaluation, comparison with all "
        "partners, and replacement. What it leaves out is bookkeeping: verbs that can be exchanged, choice of "
        f"subproblems by utility, spans of the objectives, checks, states and the history of the run. {loop}",
        markdown(limits_table(found)),
    ]


def _about_target(found: Measurements, settings: dict[str, Any]) -> list[str]:
    return [
        "## Time to a hypervolume",
        f"Milliseconds of the shortest run whose final population has {100 * settings['target_share']:g} % of the "
        f"reference front's hypervolume, with that N of {', '.join(map(str, settings['target_populations']))} "
        f"that gets there soonest; {settings['target_repeats']} repeats. Runs have up to {max(GENERATIONS)} "
        f"generations ({', '.join(map(str, GENERATIONS))}); a search is given up at an N where it fails once, or "
        f"where a run takes more than {settings['target_limit']:g} s and does not get there. "
        "Generations of MOEA/D are counted in N evaluations.",
        markdown(target_table(found)),
    ]


def _about_full_car(found: Measurements, settings: dict[str, Any]) -> list[str]:
    n, generations = settings["car_reference"]
    return [
        "## A full car",
        f"Seconds until the designs evaluated so far have {100 * settings['car_share']:g} % of the hypervolume of "
        f"a front of ours with N = {n:,} and {generations} generations, on the study `full_car`: eight variables, "
        f"three objectives, three load cases, two limits. NSGA-II of each library with N = "
        f"{settings['car_population']} and the same evaluator, {settings['car_repeats']} repeats of "
        f"{settings['car_generations']} generations; pygmo's bears no limits and gets a penalty in their place. "
        f"With python-control and numpy in place of the evaluator a design takes "
        f"{number(1e3 * found.usual_seconds)} ms: the last row is pymoo's run with that, by multiplication.",
        markdown(full_car_table(found)),
    ]


def _about_processes(found: Measurements) -> list[str]:
    return [
        "## Whole process",
        "Seconds. The package is imported where control is imported already.",
        markdown(process_table(found)),
        *_about_another_commit(found),
        "## Cold start",
        "Processor time of a process beyond `import control`, in multiples of it: the first process after "
        "installation, which compiles, and the second. Searches of N = 500, 10 iterations, on Table 1's problem.",
        markdown(cold_start_table(found)),
    ]


def _about_another_commit(found: Measurements) -> list[str]:
    """Return nothing if no other commit was timed."""
    if found.beside is None:
        return []
    return [
        "`python benchmarks/beside.py` times `python scripts/compare.py` and the same script of another commit in "
        "turn, numba's store filled: medians of whole processes. The other one is timed with the reference front "
        "of its earlier runs if it keeps that, and without it.",
        compared(found.beside).to_markdown(floatfmt=".2f"),
    ]


def _about_struts(found: Measurements, settings: dict[str, Any]) -> list[str]:
    sizes = " and ".join(
        f"{count:,} designs of a {vehicle}" for vehicle, count in settings["strut_designs"].items()
    )
    return [
        "## Struts",
        f"Least processor time per design of {settings['repeats']} calls: mean squares of {sizes} on one road at "
        f"{settings['strut_nodes']} nodes, and the ratio to the same vehicle without struts of its own. Each "
        "design has its own working point. Measured tables are those of `volvo_xc90_full`.",
        markdown(strut_table(found)),
    ]


def _about_derivatives(found: Measurements, settings: dict[str, Any]) -> list[str]:
    return [
        "## Derivatives",
        f"Least processor time per design of {settings['repeats']} calls: values alone, and values with the "
        "derivatives of all objectives and limits by all variables, of the designs of the section above at "
        f"{settings['strut_nodes']} nodes; of the study `full_car` at its own. A ratio is to be at most "
        f"{derivatives.BAR:g}. The limit on roll has exact derivatives; one by a function of your own is "
        "evaluated four times by each variable.",
        markdown(derivative_table(found)),
    ]


def _about_roofline(found: Measurements, settings: dict[str, Any]) -> list[str]:
    machine = found.limits
    return [
        "## Roofline",
        f"In this run one thread makes {number(machine.multiply_adds / 1e9)} thousand million multiply-adds in a "
        f"second, or {number(machine.divisions / 1e9)} divisions, or moves {number(machine.bytes / 1e9)} GB "
        "beyond the cache. The limit is the time of the slowest of these for the operations that follow from the "
        "formulas, as if it hid the others. Least wall-clock times per design of "
        f"{settings['roofline_repeats']} calls of `evaluate` at {settings['strut_nodes']} nodes. A ranking is "
        "compared with the sorting of its objectives, one by one, by numpy: ours sorts evenly spread values by "
        "buckets. Multiply-adds alone, on two threads in the same way, tell how much there is of the second.",
        markdown(roofline_table(found)),
        "Operations by node. One strut: a denominator of 4 multiply-adds, 3 products and a division for two, and "
        "1 by each numerator. Of a damper on a mount, a ratio of polynomials, denominators have 6 rows and there "
        "are 10 numerators for 7. Two struts of a block, a complex product being 4: stiffnesses 5, the loop 16, "
        "its determinant 8, its reciprocal 4 and a division, stiffnesses by it 8; by source deflections and "
        "tensions 24, and by response of a source 10; two blocks make a full car of some 220. Two elements in "
        "series: 24 and a division, and 2 at each strut of a block; the gain of any other strut 13 and a "
        "division, and 1 by each numerator. Force laws, in each iteration for the working point: of one strut "
        "11.5 and half a division, of a block of two 31 and a division, 22 by source and 2 by law.",
        "Rows with force laws stay below half. By a profile of one strut with a table of 13 rows, half of its "
        "time is three linearisations of the curve, which the count leaves out: normal probabilities and "
        "densities at each knot, one after the other; a third is gains and numerators. There were five "
        "linearisations before the search for a working point began at the deviations of the setting; curves "
        "that no variable changes are filled in once for all designs.",
    ]


def picture(found: Measurements) -> Figure:
    """Draw seconds against population, a line per library, ours thick."""
    table = medians(found.nsga2, "population")
    names = sorted(table.contender.unique(), key=lambda name: (name != OURS, name))
    colours = ["black", *colormaps["tab10"](range(10))]
    figure = Figure(figsize=(8, 5), layout="constrained")
    ax = figure.subplots()
    for name, colour in zip(names, colours, strict=False):
        part = table[table.contender == name]
        ax.loglog(part.population, part["median"], "o-", color=colour, ms=4, lw=2.5 if name == OURS else 1.2)
    ends = table.sort_values("population").groupby("contender").tail(1)
    for name, colour in zip(names, colours, strict=False):
        _label_end(ax, ends, name, colour)
    sizes = sorted(table.population.unique())
    ax.set(xlabel="population N", ylabel="seconds", title="NSGA-II, the same evaluator in every library")
    ax.set_xticks(sizes, [f"{n:,}" for n in sizes])
    ax.minorticks_off()
    ax.set_xlim(right=2.6 * sizes[-1])
    ax.grid(alpha=0.3)
    return figure


def _label_end(ax: Axes, ends: pd.DataFrame, name: str, colour: Any) -> None:
    """Write a library's name beside its last point, out of the way of one that ends close by."""
    own = ends[ends.contender == name].iloc[0]
    others = ends[(ends.population == own.population) & (ends.contender != name)]["median"] / own["median"]
    below, above = others.between(1 / 1.3, 1).any(), others.between(1, 1.3).any()
    va = "bottom" if below and not above else "top" if above and not below else "center"
    ax.annotate(f" {name}", (own.population, own["median"]), color=colour, fontsize=8, va=va)
