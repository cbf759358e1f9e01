"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from typing import TYPE_CHECKING

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

    from ..quantities import Real
    from ..response.problem import RideProblem
    from ..search.driver import Run

WEIGHTINGS = ("Wk", "Wb", "Wb-table")
STARTS = 8  # designs of the Pareto set from which a search goes downhill
SHOWN = {"SWS": 1.0, "ACC": 1.0, "DTL": 1e-3}  # in m, m/s^2, kN
Designs = dict[str, tuple[float, ...]]


def optimum(
    sws_limit: o.SwsLimit = 0.0287,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    speed: o.Speed = None,
    population: o.Population = 4000,
    iterations: o.Generations = 25,
    band: o.Band = None,
    seed: o.Seed = 0,
    out: o.Out = None,
) -> None:
    """Find the best struts within a travel limit: Table 5.

    For ACC weighted by Wk, Wb and Wb-table: the least ACC and the least DTL within the limit, and designs picked
    from a Pareto set of MOEA/D-DRA. Writes table5.csv to a folder; its path is the last line printed.
    """
    import pandas as pd

    from .. import checks
    from ..paper import experiment as paper
    from ..paper import tables
    from ..search.driver import minimise
    from ..search.moead_dra import MoeadDra
    from ..tables import write_csv
    from . import results, terminal

    checks.at_least("iterations", iterations, 1)
    checks.at_least("seed", seed, 0)
    checks.positive("sws_limit", sws_limit, "m")
    optimiser = MoeadDra(population=population)
    columns = paper.table5()
    published = {"reference car": columns["reference"], "published optimum": columns["optimised"]}
    of_paper = (vehicle, road, speed) == (None, None, None)
    problems, parts = [], []
    for weighting in terminal.progress(WEIGHTINGS, len(WEIGHTINGS), "weightings"):
        problem, own = paper.chosen(vehicle, road, speed, **o.settings(weighting, band))
        with terminal.compiling():
            run = minimise(problem, optimiser, iterations=iterations, seed=seed)
        values = None if of_paper else tuple(own[name] for name in problem.variables)
        designs = found_designs(problem, run, sws_limit, values)
        problems.append(problem)
        parts.append(tables.beside_published(problem, designs, published if of_paper else {}))
    folder = results.results_folder(out)
    write_csv(folder / "table5.csv", pd.concat(parts))
    for problem, part in zip(problems, parts, strict=True):
        said = ": published / here" if of_paper else ""
        terminal.show(f"Table 5, ACC weighted by {problem.weighting}{said}", as_printed(problem, part))
    print(folder)


def found_designs(problem: "RideProblem", run: "Run", limit: float, own: "tuple[float, ...] | None") -> Designs:
    """Return the best designs within the limit, and those picked, after the vehicle's own or the paper's two."""
    from ..paper import experiment as paper
    from ..paper import optimum

    of_paper = own is None
    papers = {"reference car": paper.reference_design(), "published optimum": paper.optimised_design()}
    designs: Designs = {"its own struts": own} if own is not None else dict(papers)
    for objective in ("ACC", "DTL"):
        found = starts(problem, run, limit, objective, of_paper)
        name = f"exact, least {objective}" if of_paper else f"least {objective} up to the limit"
        designs[name] = optimum.least_within_limit(problem, limit, objective, found, at_limit=of_paper)
    for objective in ("ACC", "DTL"):
        below = optimum.AT_LIMIT if of_paper else 1.0
        designs[f"picked, least {objective}"] = optimum.pick_at_limit(problem, run, limit, objective, below)
    return designs


def starts(problem: "RideProblem", run: "Run", limit: float, objective: str, at_limit: bool) -> "Real":
    """Return designs of a run from which to search on: nearest to the limit, or the best within it."""
    import numpy as np

    travel, value = (run.objectives[:, problem.objectives.index(name)] for name in ("SWS", objective))
    off = np.abs(travel - limit) if at_limit else np.maximum(travel - limit, 0)
    return run.designs[np.lexsort((value, off))[:STARTS]]


def as_printed(problem: "RideProblem", table: "pd.DataFrame") -> "pd.DataFrame":
    """Return Table 5 in kilo-units, and with "published / here (deviation)" where there is a published value."""
    import pandas as pd

    from ..quantities import column_headers

    printed = {"design": table["design"]}
    for header in column_headers(problem.variables, problem.units):
        decimals = 3 if "spring" in header else 4
        name = header.replace("spring [N", "Ks [kN").replace("damper [N", "Cs [kN").replace("[N m", "[kN m")
        printed[name] = table[header].map(lambda value, decimals=decimals: f"{value / 1e3:.{decimals}f}")
    for name, scale in SHOWN.items():
        unit = problem.units[name]
        cells = table[[f"{name} [{unit}]", f"published {name} [{unit}]", f"{name} off [%]"]]
        printed[f"{name} [{'kN' if unit == 'N' else unit.replace('^2', '²')}]"] = pd.Series(
            f"{here * scale:.4f}" if pd.isna(there) else f"{there * scale:.4f} / {here * scale:.4f} ({off:+.2f} %)"
            for here, there, off in cells.itertuples(index=False)
        )
    shown = pd.DataFrame(printed)
    if len(problem.variables) == 2:
        return shown
    return shown.set_index("design").T.rename_axis("", axis=0).reset_index()  # more variables, down the page
