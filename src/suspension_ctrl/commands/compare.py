"""The paper's experiment on any problem: timed runs of algorithms, and their quality over many seeds."""

from typing import Any

import typer

from . import options as o

QUICK: dict[str, Any] = {"populations": "60,100", "iterations": "5,10", "repeats": 2, "seeds": 3}


def compare(
    context: typer.Context,
    study: o.Study = None,
    populations: o.Populations = None,
    iterations: o.Iterations = None,
    repeats: o.Repeats = None,
    algorithms: o.Algorithms = None,
    weighting: o.Weighting = None,
    vehicle: o.Vehicle = None,
    road: o.Road = None,
    allow_outside: o.AllowOutside = False,
    speed: o.Speed = None,
    band: o.Band = None,
    reference: o.Reference = None,
    seed: o.Seed = None,
    out: o.Resumed = None,
    quick: o.Quick = False,
    quality: o.Quality = False,
    seeds: o.Seeds = None,
    target: o.Target = None,
    jobs: o.Jobs = None,
    scheduler: o.Scheduler = None,
) -> None:
    """Time NSGA-II against MOEA/D-DRA on any problem.

    The paper's has Tables 2 to 4 and Figure 5. With --quality the algorithms are also compared over many seeds, at
    equal iterations, evaluations and time, with statistics and a verdict; these runs are not timed and can be
    spread over processes and machines. Writes tables, figures, runs and fronts to a folder; its path is the last
    line printed. An interrupted command resumes with the same --out.
    """
    from . import drawing

    given = {"populations": populations, "iterations": iterations, "repeats": repeats, "seeds": seeds}
    if quick and any(value is not None for value in given.values()):
        raise ValueError("quick must stand without populations, iterations, repeats and seeds, got it with one")
    if not quality and (jobs is not None or scheduler):
        raise ValueError(f"jobs and scheduler must stand with quality, got {scheduler or jobs!r} without it")
    options = context.params | (QUICK if quick else {})
    with drawing.beside() as figures:  # begins to import while this process does
        from ..study.workers import cluster
        from . import comparing

        where = cluster(jobs, scheduler) if quality else None
        if scheduler:  # its errors come before the timed runs
            with cluster(scheduler=scheduler):
                pass
        comparing.carry_out(comparing.Request.of(options, figures), where)
