"""Speed against other libraries in one process: evaluation, searches, processes, struts, derivatives.

Writes every timing, the tables as a page in Markdown and a picture to a folder, whose path is the last line
printed; `--docs` puts page and picture there too. `make bench` installs the other libraries first; those that
are missing are listed as absent.
"""

import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import pandas as pd
from scipy import signal
from typer import Option

from beside import in_turn
from peers import OURS, Contenders, contenders
from sections import (
    arithmetic,
    cold_start,
    derivatives,
    evaluation,
    full_car,
    moead_limits,
    page_tables,
    process,
    report,
    roofline,
    searches,
    struts,
    summary,
)
from suspension_ctrl import RideProblem
from suspension_ctrl import tables as files
from suspension_ctrl.commands import results, terminal
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import machine as environment
from suspension_ctrl.study.reference import grid_front
from suspension_ctrl.tables.atomic import write_whole

SETTINGS: dict[str, Any] = {
    "nodes": 200,
    "repeats": 5,
    "sample": 16,
    "designs": (1, 100, 1000, 10_000, 100_000),
    "evaluation_limit": 10.0,
    "memory_designs": 1_000_000,
    "strut_nodes": 256,
    "strut_designs": {struts.QUARTER: 4000, struts.FULL: 400, struts.TRUCK: 400},
    "roofline_designs": {struts.QUARTER: 10_000, struts.FULL: 10_000, struts.TRUCK: 2000},
    "roofline_population": 10_000,
    "roofline_repeats": 40,
    "derivative_cases": tuple(row.case for row in derivatives.ROWS),
    "populations": (500, 1000, 4000, 16_000),
    "generations": 20,
    "limit": 10.0,
    "repeat_limit": 5.0,
    "moead_population": 1000,
    "moead_generations": 4,  # 5,000 evaluations, those of MOEA/D-DRA in 20 iterations
    "uf1_evaluations": 300_000,
    "target_populations": (500, 640, 800, 1000, 1240, 1600),
    "target_repeats": 7,
    "target_share": 0.995,
    "target_limit": 1.0,
    "grid": 400,
    "car_population": 200,
    "car_generations": 80,
    "car_repeats": 5,
    "car_share": 0.95,
    "car_reference": (1000, 60),
    "car_usual_designs": 5,
    "compare": [],
    "import_repeats": 15,
    "cold_repeats": 5,
    "cold_programs": tuple(cold_start.PROGRAMS),
}
QUICK = SETTINGS | {
    "repeats": 1,
    "sample": 2,
    "designs": (1, 10, 1000),
    "evaluation_limit": 1.0,
    "strut_designs": {struts.QUARTER: 200, struts.FULL: 20, struts.TRUCK: 20},
    "roofline_designs": {struts.QUARTER: 200, struts.FULL: 20, struts.TRUCK: 20},
    "roofline_population": 200,
    "roofline_repeats": 1,
    "derivative_cases": ("quarter car", "full car"),  # others compile for long
    "populations": (100, 200),
    "generations": 2,
    "limit": 1.0,
    "repeat_limit": 1.0,
    "moead_population": 100,
    "uf1_evaluations": 0,  # it would compile for seconds
    "target_populations": (500,),
    "target_repeats": 1,
    "target_limit": 0.1,
    "grid": 100,
    "car_population": 20,
    "car_generations": 2,
    "car_repeats": 1,
    "car_reference": (40, 5),
    "car_usual_designs": 1,
    "compare": ["--quick"],
    "import_repeats": 1,
    "cold_repeats": 1,
    "cold_programs": ("import", "evaluate"),
}


def main(
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
    docs: Annotated[Path | None, Option(help="Folder that gets page and picture too.")] = None,
    other: Annotated[Path | None, Option(help="Checkout of another commit to time too.")] = None,
    quick: Annotated[bool, Option("--quick", help="Short form: small sizes, one repeat.")] = False,
) -> None:
    """Measure the speed of this package and of other libraries on the same work."""
    if docs and not docs.is_dir():
        raise ValueError(f"docs must be a folder that exists, got {str(docs)!r}")
    settings = QUICK if quick else SETTINGS
    folder = results.results_folder(out)
    warnings.filterwarnings("ignore", category=signal.BadCoefficients)  # zeros ahead of scipy's numerators
    warnings.filterwarnings("ignore", module="jmetal|pymoo|vamos")
    field = contenders()
    with environment.single_thread():
        machine = environment.describe(settings)
        machine["versions"] |= {name: version for name, version in field.versions.items() if name != OURS}
        field = searches.working(field, paper.ride_problem(nodes=settings["nodes"]))
        found = measure(settings, field, folder)
    if other:
        runs = pd.DataFrame(list(in_turn(other.resolve(), settings["compare"], settings["repeats"])))
        files.write_csv(folder / "beside.csv", runs)
        found = replace(found, beside=runs)
    beside = {"errors": found.errors, "megabytes": found.memory, "absent": found.absent}
    files.write_json(folder / "environment.json", machine | beside)
    write_page(folder, found, settings, machine)
    if docs:
        write_page(docs, found, settings, machine)
    terminal.show("In short", summary.goals(found), {"here": 3})
    terminal.show("NSGA-II, ms", page_tables.nsga2_table(found))
    terminal.show("NSGA-II, ratio to ours", page_tables.nsga2_ratios(found))
    terminal.show("MOEA/D", page_tables.moead_table(found))
    terminal.show("Time to the hypervolume", page_tables.target_table(found))
    for name, reason in field.absent.items():
        terminal.note(f"Absent: {name} ({reason})")
    terminal.end(folder)


def measure(settings: dict[str, Any], field: Contenders, folder: Path) -> summary.Measurements:
    """Carry out all sections, each of which leaves its timings in `folder` as soon as it is done."""
    problem, repeats = paper.ride_problem(nodes=settings["nodes"]), settings["repeats"]

    def kept(name: str, timings: pd.DataFrame) -> pd.DataFrame:
        files.write_csv(folder / f"{name}.csv", timings)
        return timings

    return summary.Measurements(
        process=kept(
            "process", process.measure(COMPARE, settings["compare"], repeats, settings["import_repeats"])
        ),
        cold_start=kept("cold_start", cold_start.measure(settings["cold_repeats"], settings["cold_programs"])),
        errors=evaluation.errors(problem, settings["sample"], seed=0),
        memory=evaluation.memory(settings["memory_designs"], settings["nodes"]),
        evaluation=kept(
            "evaluation", evaluation.measure(problem, settings["designs"], repeats, settings["evaluation_limit"])
        ),
        struts=kept("struts", struts.measure(settings["strut_nodes"], settings["strut_designs"], repeats)),
        derivatives=kept(
            "derivatives",
            derivatives.measure(
                settings["strut_nodes"], settings["strut_designs"], repeats, settings["derivative_cases"]
            ),
        ),
        limits=arithmetic.limits(),
        roofline=kept(
            "roofline",
            roofline.measure(
                settings["strut_nodes"],
                settings["roofline_designs"],
                settings["roofline_population"],
                settings["roofline_repeats"],
            ),
        ),
        **measure_searches(settings, field, problem, kept),
        full_car=kept("full_car", measure_full_car(settings, field)),
        usual_seconds=full_car.seconds_of_usual_way(full_car.problem(), settings["car_usual_designs"]),
        absent=field.absent,
    )


def measure_searches(
    settings: dict[str, Any],
    field: Contenders,
    problem: RideProblem,
    kept: Callable[[str, pd.DataFrame], pd.DataFrame],
) -> dict[str, pd.DataFrame]:
    """Carry out the sections of searches, by name."""
    reference = ReferenceFront.of(grid_front(problem, settings["grid"]))
    scaled, front = searches.scaled_problem(problem, reference), searches.scaled_front(reference)
    both = {f"{name}, NSGA-II": search for name, search in field.nsga2.items()}
    both |= {f"{name}, MOEA/D": search for name, search in field.moead.items()}
    sizes, target = settings["target_populations"], settings["target_share"] * front.volume
    how = settings["repeats"], settings["limit"], settings["repeat_limit"]
    moead = [settings["moead_population"]], settings["moead_generations"]
    nsga2 = settings["populations"], settings["generations"]
    limits = settings["moead_population"], settings["moead_generations"], settings["uf1_evaluations"]
    to_target = settings["target_repeats"], settings["target_limit"]
    return {
        "moead": kept("moead", searches.by_population(field.moead, scaled, *moead, *how)),
        "moead_limits": kept("moead_limits", moead_limits.measure(scaled, *limits, settings["repeats"])),
        "target": kept("target", searches.to_target(both, scaled, front, target, sizes, *to_target)),
        "nsga2": kept("nsga2", searches.by_population(field.nsga2, problem, *nsga2, *how)),
    }


def measure_full_car(settings: dict[str, Any], field: Contenders) -> pd.DataFrame:
    """Carry out the section of the full car's study."""
    ride = full_car.problem()
    searches = {name: search for name, search in field.nsga2.items() if name in full_car.CONTENDERS}
    front = full_car.reference(ride, *settings["car_reference"])
    sizes = settings["car_population"], settings["car_generations"], settings["car_repeats"]
    return full_car.measure(searches, ride, front, settings["car_share"], *sizes)


COMPARE = Path(__file__).parents[1] / "scripts" / "compare.py"


def write_page(
    folder: Path, found: summary.Measurements, settings: dict[str, Any], machine: dict[str, Any]
) -> None:
    """Write page and picture."""
    text = report.page(found, settings, machine)
    write_whole(folder / "performance.md", lambda path: path.write_text(text, encoding="utf-8"))
    figure = report.picture(found)
    write_whole(folder / "performance.png", lambda path: figure.savefig(path, dpi=160))


if __name__ == "__main__":
    terminal.run_script(main)
