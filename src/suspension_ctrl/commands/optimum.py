"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from typing import TYPE_CHECKING

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

WEIGHTINGS = ("Wk", "Wb", "Wb-table")
DECIMALS = {"[m": 4, "[N]": 1, "[N": 0, "[%]": 2}


def optimum(
    sws_limit: o.SwsLimit = 0.0287,
    study: o.Study = None,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
    speed: o.Speed = None,
    population: o.Population = None,
    iterations: o.Generations = None,
    band: o.Band = None,
    seed: o.Seed = None,
    out: o.Out = None,
) -> None:
    """Find the best struts within a travel limit: Table 5.

    For ACC weighted by Wk, Wb and Wb-table: the least ACC and the least DTL within the limit, and designs picked
    from a Pareto set of MOEA/D-DRA. Writes table5.csv to a folder; its path is the last line printed.
    """
    import pandas as pd

    from .. import checks
    from ..desk.study_files import SearchSettings
    from ..paper.experiment import is_papers
    from ..paper.optimum import table5
    from ..search.driver import minimise
    from ..search.moead_dra import MoeadDra
    from ..tables import write_csv
    from . import results, studies, terminal

    checks.positive("sws_limit", sws_limit, "m")
    chosen = studies.chosen_study(
        study=study, vehicle=vehicle, road=road, speed=speed, band=band, allow_outside=allow_outside, seed=seed,
        search=SearchSettings(algorithms=("moead-dra",), populations=(4000,), iterations=(25,)),
        populations=population, iterations=iterations,
    )  # fmt: skip
    optimiser, iterations = MoeadDra(population=max(chosen.search.populations)), max(chosen.search.iterations)
    designs = {} if is_papers(chosen.problem) else {"its own struts": tuple(chosen.present.values())}
    parts = []
    for weighting in terminal.progress(WEIGHTINGS, len(WEIGHTINGS), "weightings"):
        problem = chosen.problem.replace(weighting=weighting)
        with terminal.compiling():
            run = minimise(problem, optimiser, iterations=iterations, seed=chosen.search.seed)
        parts.append(table5(problem, run, sws_limit, designs))
    folder = results.results_folder(out)
    studies.save_resolved(folder, chosen)
    write_csv(folder / "table5.csv", pd.concat(parts))
    for weighting, part in zip(WEIGHTINGS, parts, strict=True):
        _show(weighting, part)
    terminal.end(folder)


def _show(weighting: str, part: "pd.DataFrame") -> None:
    """Print the table of one weighting."""
    from . import terminal

    shown = part.drop(columns="weighting").dropna(axis="columns", how="all")
    digits = {name: next((d for unit, d in DECIMALS.items() if unit in name), 4) for name in shown.columns[1:]}
    terminal.show(f"Table 5, ACC weighted by {weighting}", shown, digits)
