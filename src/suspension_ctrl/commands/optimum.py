"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from . import options as o

WEIGHTINGS = ("Wk", "Wb", "Wb-table")
DECIMALS = {"[m": 4, "[N]": 1, "[N": 0, "[%]": 2}


def optimum(
    sws_limit: o.SwsLimit = 0.0287,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
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
    from ..paper.experiment import chosen
    from ..paper.optimum import table5
    from ..search.driver import minimise
    from ..search.moead_dra import MoeadDra
    from ..tables import write_csv
    from . import results, terminal

    checks.at_least("iterations", iterations, 1)
    checks.at_least("seed", seed, 0)
    checks.positive("sws_limit", sws_limit, "m")
    optimiser = MoeadDra(population=population)
    of_paper = (vehicle, road, speed) == (None, None, None)
    parts = []
    for weighting in terminal.progress(WEIGHTINGS, len(WEIGHTINGS), "weightings"):
        problem, own = chosen(vehicle, road, speed, allow_outside=allow_outside, **o.settings(weighting, band))
        with terminal.compiling():
            run = minimise(problem, optimiser, iterations=iterations, seed=seed)
        designs = {} if of_paper else {"its own struts": tuple(own[name] for name in problem.variables)}
        parts.append(table5(problem, run, sws_limit, designs))
    folder = results.results_folder(out)
    write_csv(folder / "table5.csv", pd.concat(parts))
    for weighting, part in zip(WEIGHTINGS, parts, strict=True):
        shown = part.drop(columns="weighting").dropna(axis="columns", how="all")
        digits = {name: next((d for unit, d in DECIMALS.items() if unit in name), 4) for name in shown.columns[1:]}
        terminal.show(f"Table 5, ACC weighted by {weighting}", shown, digits)
    terminal.end(folder)
