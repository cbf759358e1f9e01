"""The page of a study in a browser."""

from . import options as o


def report(
    study: o.Study = None,
    allow_outside: o.AllowOutside = False,
    population: o.Population = None,
    iterations: o.Generations = None,
    seed: o.Seed = None,
    out: o.Out = None,
) -> None:
    """Make a page of a study that opens in any browser.

    Searches as `optimum` does. The page report.html needs no network: it shows the front, candidates and the
    present design; sliders of the variables move measures and curves. Writes the page and the resolved study to a
    folder; its path is the last line printed.
    """
    from ..desk.advice import Advice
    from ..tables import write_text
    from . import deciding, results, studies, terminal

    results.check(out)
    chosen = studies.chosen_study(
        study=study, allow_outside=allow_outside, seed=seed, populations=population, iterations=iterations,
        search=deciding.SEARCH,
    )  # fmt: skip
    found = deciding.Findings.of(deciding.Request(chosen))
    folder = studies.folder_with(chosen, out)
    write_text(folder / "report.html", found.page(chosen))
    for line in [*found.said, *Advice.of(chosen.problem, found.decision.table).said]:
        terminal.note(line)
    terminal.end(folder)
