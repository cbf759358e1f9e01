"""suspension_ctrl itself."""

from suspension_ctrl import MoeadDra, Nsga2, Run, minimise

from . import OURS, Job, Task


def _job(task: Task, optimiser: Nsga2 | MoeadDra) -> Job:
    def run() -> Run:
        return minimise(task.problem, optimiser, evaluations=task.evaluations, seed=task.seed)

    return Job(run, lambda found: found.objectives, lambda found: found.evaluations)


NSGA2 = {OURS: lambda task: _job(task, Nsga2(population=task.population))}
MOEAD = {OURS: lambda task: _job(task, MoeadDra(population=task.population))}
