"""How cost grows with nodes, struts, coordinates, load cases, designs, populations and variables.

``python benchmarks/growth.py`` writes every timing, the page and its picture to a folder, whose path is the last
line printed; `--docs` puts page and picture there too. `make bench` installs the other libraries first.
"""

import subprocess
import sys
import warnings
from pathlib import Path
from time import perf_counter
from typing import Annotated, Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from typer import Option

from peers import OURS, Contenders, contenders
from sections import growth, page_tables, searches, struts
from suspension_ctrl import tables as files
from suspension_ctrl.commands import results, terminal
from suspension_ctrl.study import machine as environment
from suspension_ctrl.study import workers
from suspension_ctrl.tables.atomic import write_whole

SETTINGS: dict[str, Any] = {
    "repeats": 3,
    "limit": 30.0,
    "nodes": (64, 128, 256, 512, 1024, 2048, 4096),
    "node_designs": {struts.QUARTER: 2000, struts.FULL: 200},
    "axles": (1, 2, 3, 4),
    "modes": (1, 3, 13, 43, 93, 193),
    "cases": (1, 2, 4, 8, 16, 32),
    "car_designs": 200,
    "designs": (1, 10, 100, 1000, 10_000, 100_000, 1_000_000),
    "populations": (100, 400, 1600, 6400, 25_600, 64_000),
    "generations": 10,
    "variables": (2, 4, 8, 16, 32, 64),
    "variables_population": 1000,
    "memory_designs": (1000, 100_000, 1_000_000, 4_000_000),
    "memory_populations": (1000, 16_000, 64_000),
    "tasks": 500,
}
QUICK = SETTINGS | {
    "repeats": 1,
    "limit": 1.0,
    "nodes": (64, 128),
    "node_designs": {struts.QUARTER: 20, struts.FULL: 2},
    "axles": (1, 2),
    "modes": (3, 13),
    "cases": (1, 2),
    "car_designs": 2,
    "designs": (1, 10),
    "populations": (100, 200),
    "generations": 1,
    "variables": (2, 4),
    "variables_population": 50,
    "memory_designs": (1000,),
    "memory_populations": (100,),
    "tasks": 10,
}
NAMES = (OURS, "genoxide", "vamos moocore", "pygmo", "pygmo moead_gen", "vamos batch", "pymoo")

MEMORY = """
from pathlib import Path
import numpy as np
import suspension_ctrl as sc
from sections.growth import quarter_car
problem, count = quarter_car(), {count}
if {search}:
    sc.minimise(problem, sc.Nsga2(population=count), iterations=2, seed=0)
else:
    problem.evaluate(np.random.default_rng(0).uniform(problem.lower, problem.upper, (count, 2)))
status = Path("/proc/self/status")
print(int(status.read_text().split("VmHWM:")[1].split()[0]) / 1e3 if status.exists() else "nan")
"""


def main(
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
    docs: Annotated[Path | None, Option(help="Folder that gets page and picture too.")] = None,
    quick: Annotated[bool, Option("--quick", help="Short form: small sizes, one repeat.")] = False,
) -> None:
    """Measure how the cost of this package and of other libraries grows."""
    if docs and not docs.is_dir():
        raise ValueError(f"docs must be a folder that exists, got {str(docs)!r}")
    settings, folder = QUICK if quick else SETTINGS, results.results_folder(out)
    warnings.filterwarnings("ignore", module="jmetal|pymoo|vamos")
    with environment.single_thread():
        machine = environment.describe(settings)
        timings = measure(settings, searches.working(contenders(), growth.quarter_car()))
        memory = pd.DataFrame(
            [(what, n, megabytes(n, what == SEARCH)) for what, counts in _memory_sizes(settings) for n in counts],
            columns=["of", "size", "MB"],
        )
        overhead = task_seconds(settings["tasks"])
    files.write_csv(folder / "growth.csv", timings)
    files.write_csv(folder / "memory.csv", memory)
    files.write_json(folder / "environment.json", machine | {"task_seconds": overhead})
    text, figure = page(timings, memory, overhead, machine, settings), picture(timings)
    for place in (folder, *([docs] if docs else [])):
        write_whole(place / "growth.md", lambda path: path.write_text(text, encoding="utf-8"))
        write_whole(place / "growth.png", lambda path: figure.savefig(path, dpi=110))
    terminal.show("Exponents of growth", exponent_table(timings))
    terminal.end(folder)


SEARCH, CALL = "NSGA-II, population", "evaluate, designs in a call"


def _memory_sizes(settings: dict[str, Any]) -> list[tuple[str, tuple[int, ...]]]:
    return [(CALL, settings["memory_designs"]), (SEARCH, settings["memory_populations"])]


def measure(settings: dict[str, Any], field: Contenders) -> pd.DataFrame:
    """Carry out all curves; a row for each timed call."""
    chosen = {
        algorithm: {name: search for name, search in each.items() if name in NAMES}
        for algorithm, each in ((growth.NSGA2, field.nsga2), (growth.MOEAD, field.moead))
    }
    cars, generations = settings["car_designs"], settings["generations"]
    lines = {
        "nodes": growth.by_nodes(settings["nodes"], settings["node_designs"]),
        "struts": growth.by_struts(settings["axles"], cars),
        "coordinates": growth.by_coordinates(settings["modes"], cars),
        "cases": growth.by_cases(settings["cases"], cars),
        "designs": growth.by_designs(settings["designs"]),
        "population": growth.by_population(chosen, settings["populations"], generations),
        "variables": growth.by_variables(
            chosen, settings["variables"], settings["variables_population"], generations
        ),
    }
    how = settings["repeats"], settings["limit"]
    return pd.concat([growth.measure(each, curve, *how) for curve, each in lines.items()], ignore_index=True)


def megabytes(count: int, search: bool) -> float:
    """Return the peak memory [MB] of a process that evaluates so many designs, or searches with such an N."""
    program = MEMORY.format(count=count, search=search)
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, check=True, capture_output=True, text=True, cwd=Path(__file__).parent)
    return float(done.stdout)


def task_seconds(tasks: int) -> float:
    """Return what Dask takes for a task beside its work, on one process of this machine [s]."""
    with workers.local_cluster(1) as client:
        client.gather(client.map(abs, range(-tasks, 0)))
        start = perf_counter()
        client.gather(client.map(abs, range(tasks)))
        return (perf_counter() - start) / tasks


def exponent_table(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by curve and line the sizes, the cost at the largest and the exponent of growth."""
    found, rows = growth.exponents(timings), []
    for curve in growth.CURVES:
        part = timings[timings.curve == curve.name]
        for line, own in part.groupby("line", sort=False):
            least, most = own["size"].min(), own["size"].max()
            cost = own[own["size"] == most].seconds.median()
            rows.append(
                (
                    f"{curve.size}, per {curve.of}",
                    line,
                    f"{least:,} to {most:,}",
                    f"{page_tables.number(1e6 * cost)} µs"
                    if curve.of == "design"
                    else f"{page_tables.number(cost)} s",
                    "" if np.isnan(b := found[curve.name, line]) else f"{round(b, 2) + 0.0:.2f}",
                )
            )
    return pd.DataFrame(rows, columns=["against", "of", "sizes", "at the largest", "exponent"])


def picture(timings: pd.DataFrame) -> Figure:
    """Draw a plot for each curve, seconds against size, both logarithmic, ours thick; then the legend of runs."""
    figure = Figure(figsize=(11, 13), layout="constrained")
    *axes, legend = figure.subplots(4, 2).ravel()
    for ax, curve in zip(axes, growth.CURVES, strict=True):
        part = timings[timings.curve == curve.name]
        for line, own in part.groupby("line", sort=False):
            medians, thick = own.groupby("size").seconds.median(), OURS in str(line) or curve.of == "design"
            ax.loglog(medians.index, medians, "o-", ms=4, lw=2.2 if thick else 1.0, label=line)
        sizes = sorted(part["size"].unique())
        ax.set_xticks(sizes, [f"{size:,}" for size in sizes], fontsize=8)
        ax.minorticks_off()
        _show_a_decade(ax)
        ax.set(xlabel=curve.size, ylabel=f"seconds per {curve.of}")
        ax.grid(alpha=0.3)
        if len(part) and curve.of == "design":
            ax.legend(fontsize=8)
    legend.axis("off")
    legend.legend(*axes[-1].get_legend_handles_labels(), loc="center", title="per run")
    return figure


def _show_a_decade(ax: Axes) -> None:
    """Widen the vertical axis to a factor of ten: scatter is not to look like growth."""
    low, high = ax.get_ylim()
    if high < 10 * low:
        middle = np.sqrt(low * high)
        ax.set_ylim(middle / 10**0.5, middle * 10**0.5)


def page(
    timings: pd.DataFrame,
    memory: pd.DataFrame,
    overhead: float,
    machine: dict[str, Any],
    settings: dict[str, Any],
) -> str:
    """Return the page as Markdown, its picture being ``growth.png`` beside it."""
    peaks = memory.assign(size=memory["size"].map("{:,}".format), MB=memory.MB.map(page_tables.number))
    parts = [
        "# How cost grows",
        f"Written by `python benchmarks/growth.py --docs docs`. {machine['processor']}, one thread; Python "
        f"{machine['python']}. Medians of {settings['repeats']} repeats. An exponent is b of seconds ~ size^b, "
        "fitted to the upper half of the sizes: 0 costs nothing more, 1 grows in proportion.",
        "![Seconds against each size](growth.png)",
        page_tables.markdown(exponent_table(timings)),
        f"Designs are those of a quarter car and of `jian_2022_full` with springs and dampers of both axles, 256 "
        "nodes unless they vary. Struts are those of `kraz_semitrailer`, two of each axle that varies, in two "
        "tracks. Coordinates are seven of the rigid full car and modes of its bending body, imported as a plant. "
        f"Runs have {settings['generations']} generations; against N on the quarter car, against the variables on "
        f"DTLZ2 with three objectives and N = {settings['variables_population']:,}. A line ends where a run would "
        f"take more than {settings['limit']:g} s. MOEA/D takes neighbourhoods of N/10: to find them "
        "takes N^2.",
        "## Memory",
        "Peak of a process, imports included.",
        page_tables.markdown(peaks),
        *projection(timings, overhead),
    ]
    return "\n\n".join(parts) + "\n"


def projection(timings: pd.DataFrame, overhead: float) -> list[str]:
    """Return what 10^9 designs would take on a cluster, from the figures of one machine, with what is assumed."""
    own = {}
    for name, curve in ((struts.QUARTER, "designs"), (struts.FULL, "cases")):
        part = timings[(timings.curve == curve) & (timings.line == name)]
        size = part["size"].max() if curve == "designs" else part["size"].min()
        own[name] = part[part["size"] == size].seconds.median()
    rows = []
    for cores in (2, 64, 1024):
        row = [f"{cores:,}"]
        for seconds in own.values():
            tasks = DESIGNS // BATCH
            row.append(_duration(max(DESIGNS * seconds / cores, tasks * overhead) + BATCH * seconds))
        rows.append(row)
    table = pd.DataFrame(rows, columns=["cores", *own])
    return [
        f"## {DESIGNS:,} designs",
        "On paper: what a Dask cluster would take, from the seconds per design above and the "
        f"{1e3 * overhead:.2g} ms of its scheduler per task that were measured here with one process.",
        page_tables.markdown(table),
        f"It is assumed that a task evaluates {BATCH:,} designs drawn from its number as seed and returns its "
        "non-dominated ones, so that no designs travel; that cores are like this one and each has memory for a "
        "task; that the scheduler hands out one task after the other and so bounds the whole; that the last task "
        "runs alone; and that no core fails. Nothing of this was run on a cluster.",
    ]


DESIGNS, BATCH = 1_000_000_000, 1_000_000


def _duration(seconds: float) -> str:
    for size, unit in ((86_400, "days"), (3600, "h"), (60, "min")):
        if seconds >= size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"


if __name__ == "__main__":
    terminal.run_script(main)
