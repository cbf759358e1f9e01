"""suspension_ctrl itself."""

from dataclasses import replace
from functools import partial

from suspension_ctrl import MoeadDra, Nsga2, Problem, Run, minimise
from suspension_ctrl.search.neighbours import neighbourhoods

from . import OURS, Job, Task


def _job(task: Task, optimiser: Nsga2 | MoeadDra) -> Job:
    toolbox = optimiser.toolbox(task.problem)

    def run() -> Run:
        return minimise(task.problem, optimiser, evaluations=task.evaluations, seed=task.seed, toolbox=toolbox)

    return Job(run, lambda found: found.objectives, lambda found: found.evaluations)


def moead(task: Task, *, kernel: bool = True, update: str = "sequential") -> Job:
    """MOEA/D-DRA, with or without the problem's compiled kernel; neighbourhoods are found anew in every run.

    Weight vectors are at hand, as they are for the others.
    """
    problem = task.problem
    plain = Problem(
        evaluate=problem.evaluate, lower=problem.lower, upper=problem.upper, objectives=problem.objectives
    )
    job = _job(
        task if kernel else replace(task, problem=plain), MoeadDra(population=task.population, update=update)
    )

    def run() -> Run:
        neighbourhoods.cache_clear()
        return job.run()

    return job._replace(run=run)


NSGA2 = {OURS: lambda task: _job(task, Nsga2(population=task.population))}
MOEAD = {
    OURS: moead,
    f"{OURS} no kernel": partial(moead, kernel=False),
    f"{OURS} batch": partial(moead, update="batch"),
}
