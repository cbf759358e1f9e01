"""Table 5: the reference car, the published optimum, and the best struts of the same suspension travel."""

from typing import TYPE_CHECKING

from . import options as o

if TYPE_CHECKING:
    import pandas as pd

    from ..desk.study_files import StudyFile

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
    from ..tables import write_csv
    from . import studies, terminal

    checks.positive("sws_limit", sws_limit, "m")
    search = SearchSettings(algorithms=("moead-dra",), populations=(4000,), iterations=(25,))
    chosen = studies.chosen_study(
        study=study, vehicle=vehicle, road=road, speed=speed, band=band, allow_outside=allow_outside, seed=seed,
        search=search, populations=population, iterations=iterations,
    )  # fmt: skip
    weightings = terminal.progress(WEIGHTINGS, len(WEIGHTINGS), "weightings")
    parts = [_part(chosen, weighting, sws_limit) for weighting in weightings]
    folder = studies.folder_with(chosen, out)
    write_csv(folder / "table5.csv", pd.concat(parts))
    for weighting, part in zip(WEIGHTINGS, parts, strict=True):
        _show(weighting, part)
    terminal.end(folder)


def _part(study: "StudyFile", weighting: str, limit: float) -> "pd.DataFrame":
    """Return Table 5 of a study with one weighting."""
    from ..paper.experiment import is_papers
    from ..paper.optimum import table5
    from ..search.driver import minimise
    from ..search.moead_dra import MoeadDra
    from . import terminal

    problem, search = study.problem.replace(weighting=weighting), study.search
    optimiser = MoeadDra(population=max(search.populations))
    with terminal.compiling():
        run = minimise(problem, optimiser, iterations=max(search.iterations), seed=search.seed)
    own = {} if is_papers(study.problem) else {"its own struts": tuple(study.present.values())}
    return table5(problem, run, limit, own)


def _show(weighting: str, part: "pd.DataFrame") -> None:
    """Print the table of one weighting."""
    from . import terminal

    shown = part.drop(columns="weighting").dropna(axis="columns", how="all")
    digits = {name: next((d for unit, d in DECIMALS.items() if unit in name), 4) for name in shown.columns[1:]}
    terminal.show(f"Table 5, ACC weighted by {weighting}", shown, digits)
