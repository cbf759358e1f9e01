"""pygmo, compiled from C++."""

from typing import Any

import numpy as np
import pygmo as pg

from . import Job, Task

PENALTY = 1e3  # of a limit violated by its own size, in objectives that are about 1


class _Vectorised:
    """A problem; its multi-objective searches bear no limits, so a violation is added to every objective."""

    def __init__(self, task: Task) -> None:
        self.task = task

    def fitness(self, x: Any) -> Any:
        return self._penalised(x[np.newaxis])[0]

    def batch_fitness(self, designs: Any) -> Any:
        return self._penalised(designs.reshape(-1, len(self.task.bounds))).ravel()

    def _penalised(self, designs: Any) -> Any:
        values = self.task.problem.evaluate(designs)
        if not self.task.problem.constraints:
            return values
        return values[:, : self.task.objectives] + PENALTY * self.task.violation(values)[:, None]

    def get_bounds(self) -> Any:
        return tuple(np.array(self.task.bounds).T.tolist())

    def get_nobj(self) -> int:
        return self.task.objectives


def _job(task: Task, algorithm: Any, *, batch: bool) -> Job:
    if batch:
        algorithm.set_bfe(pg.bfe(pg.member_bfe()))
    search, problem = pg.algorithm(algorithm), pg.problem(_Vectorised(task))

    def run() -> Any:
        start = pg.population(problem, task.population, seed=task.seed, b=pg.bfe(pg.member_bfe()))
        return search.evolve(start)

    return Job(run, lambda found: found.get_f(), lambda found: found.problem.get_fevals())


def nsga2(task: Task) -> Job:
    algorithm = pg.nsga2(
        gen=task.generations, cr=task.crossover_probability, eta_c=task.eta,
        m=task.mutation_probability, eta_m=task.eta, seed=task.seed,
    )  # fmt: skip
    return _job(task, algorithm, batch=True)


def _moead(task: Task, kind: Any, *, batch: bool) -> Job:
    """Weights are the library's own, those it can make for any population."""
    algorithm = kind(
        gen=task.generations, weight_generation="low discrepancy", decomposition="tchebycheff",
        neighbours=task.neighbours, CR=1.0, F=task.scale_factor, eta_m=task.eta,
        realb=task.neighbour_probability, limit=task.replacements, seed=task.seed,
    )  # fmt: skip
    return _job(task, algorithm, batch=batch)


NSGA2 = {"pygmo": nsga2}
MOEAD = {
    "pygmo moead": lambda task: _moead(task, pg.moead, batch=False),
    "pygmo moead_gen": lambda task: _moead(task, pg.moead_gen, batch=True),
}
