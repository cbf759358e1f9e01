"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel.

For each of the weightings Wk, Wb and Wb-table: exact solutions on the curve SWS = limit, and designs picked
from a MOEA/D-DRA Pareto set. Writes table5.csv to a folder whose path is the last line printed.
"""

from pathlib import Path
from typing import Annotated

import pandas as pd
from typer import Option

from suspension_ctrl import MoeadDra, RideProblem, Run, checks, files, minimise, optimum, paper, tables, terminal

WEIGHTINGS = ("Wk", "Wb", "Wb-table")


def main(
    sws_limit: Annotated[
        float, Option(parser=terminal.number, help="Suspension working space [m].")
    ] = paper.SWS_LIMIT,
    population: Annotated[int, Option(parser=terminal.whole_number, help="Subproblems of MOEA/D-DRA.")] = 4000,
    iterations: Annotated[int, Option(parser=terminal.whole_number, help="Iterations of MOEA/D-DRA.")] = 25,
    low_frequency: Annotated[
        float, Option(parser=terminal.number, help="Lower end of the frequency band [Hz].")
    ] = 0.0,
    seed: Annotated[int, Option(parser=terminal.whole_number, help="Seed of MOEA/D-DRA.")] = 0,
    out: Annotated[Path | None, Option(help="Folder for the results, absent or empty.")] = None,
) -> None:
    """Find the best spring and damper within a limit of suspension travel."""
    checks.at_least("iterations", iterations, 1)
    checks.at_least("seed", seed, 0)
    optimiser = MoeadDra(population=population)
    columns = paper.table5()
    published = {"reference car": columns["reference"], "published optimum": columns["optimised"]}
    parts = []
    for weighting in WEIGHTINGS:
        problem = paper.ride_problem(weighting=weighting, band=(low_frequency, paper.ride_problem().band[1]))
        designs = exact_designs(problem, sws_limit)
        run = minimise(problem, optimiser, iterations=iterations, seed=seed)
        designs |= picked_designs(problem, run, sws_limit)
        parts.append(tables.beside_published(problem, designs, published))
    folder = files.results_folder(out)
    for weighting, part in zip(WEIGHTINGS, parts, strict=True):
        terminal.show(f"Table 5, ACC weighted by {weighting}: published / here", as_printed(part))
    files.write_csv(folder / "table5.csv", pd.concat(parts))
    print(folder)


def exact_designs(problem: RideProblem, limit: float) -> dict[str, tuple[float, float]]:
    designs = {"reference car": paper.reference_design(), "published optimum": paper.optimised_design()}
    for objective in ("ACC", "DTL"):
        designs[f"exact, least {objective}"] = optimum.best_at_limit(problem, limit, objective)
    return designs


def picked_designs(problem: RideProblem, run: Run, limit: float) -> dict[str, tuple[float, float]]:
    return {
        f"picked, least {objective}": optimum.pick_at_limit(problem, run, limit, objective)
        for objective in ("ACC", "DTL")
    }


def as_printed(table: pd.DataFrame) -> pd.DataFrame:
    """Kilo-units, and where there is a published value "published / here (deviation)"."""
    printed = {
        "design": table["design"],
        "Ks [kN/m]": table["spring [N/m]"].map(lambda k: f"{k / 1e3:.3f}"),
        "Cs [kN s/m]": table["damper [N s/m]"].map(lambda c: f"{c / 1e3:.4f}"),
    }
    for name, unit, shown, scale in (
        ("SWS", "m", "m", 1),
        ("ACC", "m/s^2", "m/s²", 1),
        ("DTL", "N", "kN", 1e-3),
    ):
        cells = table[[f"{name} [{unit}]", f"published {name} [{unit}]", f"{name} off [%]"]]
        printed[f"{name} [{shown}]"] = [
            f"{here * scale:.4f}" if pd.isna(there) else f"{there * scale:.4f} / {here * scale:.4f} ({off:+.2f} %)"
            for here, there, off in cells.itertuples(index=False)
        ]
    return pd.DataFrame(printed)


if __name__ == "__main__":
    terminal.run_script(main)
