"""Candidates of a front within limits, of any vehicle; of the paper's problem Table 5 too."""

from . import options as o


def optimum(
    sws_limit: o.SwsLimit = None,
    study: o.Study = None,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
    speed: o.Speed = None,
    band: o.Band = None,
    weighting: o.Weighting = None,
    population: o.Population = None,
    iterations: o.Generations = None,
    seed: o.Seed = None,
    out: o.Out = None,
) -> None:
    """Choose from the best struts within limits.

    Prints candidates along the front: the least of each measure, knee, compromise and others between them, with
    changes against the present design, modes and travel; and what limits and bounds do. Of the paper's problem
    Table 5 too. Writes candidates (CSV, Markdown, a folder of vehicle files), front.csv, front and changes (PNG,
    PDF), and report.html for a browser to a folder; its path is the last line printed.
    """
    from . import deciding, studies

    chosen = studies.chosen_study(
        study=study, vehicle=vehicle, road=road, speed=speed, band=band, weighting=weighting,
        allow_outside=allow_outside, seed=seed, populations=population, iterations=iterations,
        search=deciding.SEARCH,
    )  # fmt: skip
    deciding.carry_out(deciding.Request(chosen).within(sws_limit), out)
