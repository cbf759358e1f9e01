"""pymoo."""

from typing import Any

import numpy as np
from pymoo.algorithms.moo import moead as moead_
from pymoo.algorithms.moo import nsga2 as nsga2_
from pymoo.core.problem import Problem
from pymoo.decomposition.tchebicheff import Tchebicheff
from pymoo.operators.crossover.sbx import SBX
from pymoo.operators.mutation.pm import PM
from pymoo.optimize import minimize

from . import Job, Task


class _Vectorised(Problem):
    def __init__(self, task: Task) -> None:
        low, up = np.array(task.bounds).T
        limits = len(task.problem.constraints)
        super().__init__(n_var=low.size, n_obj=task.objectives, n_ieq_constr=limits, xl=low, xu=up)
        self.task = task

    def _evaluate(self, x: Any, out: dict[str, Any], *_: Any, **__: Any) -> None:
        values = self.task.problem.evaluate(x)
        out["F"], out["G"] = values[:, : self.task.objectives], values[:, self.task.objectives :]


def _job(task: Task, algorithm: Any) -> Job:
    problem, generations = _Vectorised(task), ("n_gen", task.generations + 1)
    return Job(lambda: minimize(problem, algorithm, generations, seed=task.seed), lambda found: found.pop.get("F"))


def _mutation(task: Task) -> PM:
    return PM(prob=1.0, prob_var=task.mutation_probability, eta=task.eta)


def nsga2(task: Task) -> Job:
    crossover = SBX(eta=task.eta, prob=task.crossover_probability)
    algorithm = nsga2_.NSGA2(
        task.population, crossover=crossover, mutation=_mutation(task), eliminate_duplicates=False
    )
    return _job(task, algorithm)


def moead(task: Task) -> Job:
    """MOEA/D with SBX; a child may replace all its neighbours: the library has no limit and no DE for it."""
    algorithm = moead_.MOEAD(
        task.weights,
        n_neighbors=task.neighbours,
        decomposition=Tchebicheff(),
        prob_neighbor_mating=task.neighbour_probability,
        crossover=SBX(eta=task.eta, prob=1.0),
        mutation=_mutation(task),
    )
    return _job(task, algorithm)


NSGA2, MOEAD = {"pymoo": nsga2}, {"pymoo": moead}
