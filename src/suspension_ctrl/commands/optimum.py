"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel.

For each of the weightings Wk, Wb and Wb-table: exact solutions on the curve SWS = limit, and designs picked
from a MOEA/D-DRA Pareto set. Of any other vehicle, road or speed: its own struts, the best designs up to the
limit, and designs picked. Writes table5.csv to a folder whose path is the last line printed.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd
from typer import Option

from .. import checks
from .. import tables as files
from ..paper import experiment as paper
from ..paper import optimum, tables
from ..quantities import column_headers
from ..response.problem import RideProblem
from ..search.driver import Run, minimise
from ..search.moead_dra import MoeadDra
from . import results, terminal

WEIGHTINGS = ("Wk", "Wb", "Wb-table")
STARTS = 8  # designs of the Pareto set from which a search goes downhill
SHOWN = {"SWS": 1.0, "ACC": 1.0, "DTL": 1e-3}  # in m, m/s^2, kN


def main(
    sws_limit: Annotated[
        float, Option(parser=terminal.number, help="Suspension working space [m].")
    ] = paper.SWS_LIMIT,
    vehicle: Annotated[str | None, Option(help=paper.VEHICLE_HELP)] = None,
    road: Annotated[str | None, Option(help=paper.ROAD_HELP)] = None,
    speed: Annotated[float | None, Option(parser=terminal.number, help="Speed [m/s].")] = None,
    population: Annotated[int, Option(parser=terminal.whole_number, help="Subproblems of MOEA/D-DRA.")] = 4000,
    iterations: Annotated[int, Option(parser=terminal.whole_number, help="Iterations of MOEA/D-DRA.")] = 25,
    band: Annotated[str | None, Option(help="Frequencies [Hz]: 0.1,20.")] = None,
    seed: Annotated[int, Option(parser=terminal.whole_number, help="Seed of MOEA/D-DRA.")] = 0,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
) -> None:
    """Find the best spring and damper within a limit of suspension travel."""
    checks.at_least("iterations", iterations, 1)
    checks.at_least("seed", seed, 0)
    checks.positive("sws_limit", sws_limit, "m")
    optimiser = MoeadDra(population=population)
    columns = paper.table5()
    published = {"reference car": columns["reference"], "published optimum": columns["optimised"]}
    parts, below = [], optimum.AT_LIMIT
    settings = terminal.band_of(band)
    for weighting in WEIGHTINGS:
        problem, struts = paper.chosen(vehicle, road, speed, weighting=weighting, **settings)
        run = minimise(problem, optimiser, iterations=iterations, seed=seed)
        if (vehicle, road, speed) == (None, None, None):
            designs = exact_designs(problem, run, sws_limit)
        else:
            designs = best_designs(problem, run, sws_limit, [struts[name] for name in problem.variables])
            published, below = {}, 1.0
        designs |= picked_designs(problem, run, sws_limit, below)
        parts.append(tables.beside_published(problem, designs, published))
    folder = results.results_folder(out)
    for weighting, part in zip(WEIGHTINGS, parts, strict=True):
        said = ": published / here" if published else ""
        terminal.show(f"Table 5, ACC weighted by {weighting}{said}", as_printed(problem, part))
    files.write_csv(folder / "table5.csv", pd.concat(parts))
    print(folder)


def exact_designs(problem: RideProblem, run: Run, limit: float) -> dict[str, tuple[float, ...]]:
    designs: dict[str, tuple[float, ...]] = {
        "reference car": paper.reference_design(),
        "published optimum": paper.optimised_design(),
    }
    for objective in ("ACC", "DTL"):
        starts = run.designs[np.abs(run.objectives[:, 1] - limit).argsort(kind="stable")[:STARTS]]
        best = optimum.least_within_limit(problem, limit, objective, starts, at_limit=True)
        designs[f"exact, least {objective}"] = best
    return designs


def best_designs(problem: RideProblem, run: Run, limit: float, own: list[float]) -> dict[str, tuple[float, ...]]:
    """Return the vehicle's own struts, and the least of each objective up to the limit."""
    designs = {"its own struts": tuple(own)}
    over = np.maximum(run.objectives[:, problem.objectives.index("SWS")] - limit, 0)
    for objective in ("ACC", "DTL"):
        best_first = np.lexsort((run.objectives[:, problem.objectives.index(objective)], over))
        starts = run.designs[best_first[:STARTS]]
        designs[f"least {objective} up to the limit"] = optimum.least_within_limit(
            problem, limit, objective, starts
        )
    return designs


def picked_designs(problem: RideProblem, run: Run, limit: float, below: float) -> dict[str, tuple[float, ...]]:
    return {
        f"picked, least {objective}": optimum.pick_at_limit(problem, run, limit, objective, below)
        for objective in ("ACC", "DTL")
    }


def as_printed(problem: RideProblem, table: pd.DataFrame) -> pd.DataFrame:
    """Kilo-units, and where there is a published value "published / here (deviation)"."""
    printed = {"design": table["design"]}
    for header in column_headers(problem.variables, problem.units):
        decimals = 3 if "spring" in header else 4
        name = header.replace("spring [N", "Ks [kN").replace("damper [N", "Cs [kN").replace("[N m", "[kN m")
        printed[name] = table[header].map(lambda value, decimals=decimals: f"{value / 1e3:.{decimals}f}")
    for name, scale in SHOWN.items():
        unit = problem.units[name]
        cells = table[[f"{name} [{unit}]", f"published {name} [{unit}]", f"{name} off [%]"]]
        printed[f"{name} [{'kN' if unit == 'N' else unit.replace('^2', '²')}]"] = [
            f"{here * scale:.4f}" if pd.isna(there) else f"{there * scale:.4f} / {here * scale:.4f} ({off:+.2f} %)"
            for here, there, off in cells.itertuples(index=False)
        ]
    shown = pd.DataFrame(printed)
    if len(problem.variables) == len(paper.reference_design()):
        return shown
    return shown.set_index("design").T.rename_axis("", axis=0).reset_index()  # more variables, down the page
