"""vamos: kernels compiled by numba, or ranking by moocore."""

from functools import partial
from typing import Any

import numpy as np
import vamos
from vamos.algorithms import MOEADConfig, NSGAIIConfig

from . import Job, Task, weights_in_file


class _Vectorised:
    encoding = "real"

    def __init__(self, task: Task) -> None:
        self.xl, self.xu = np.array(task.bounds).T
        self.n_var, self.n_obj = self.xl.size, task.objectives
        self.n_constraints, self._evaluate = len(task.problem.constraints), task.problem.evaluate

    def evaluate(self, designs: Any, out: dict[str, Any]) -> None:
        values = self._evaluate(designs)
        out["F"][:] = values[:, : self.n_obj]
        if self.n_constraints:
            out["G"] = values[:, self.n_obj :]


def _job(task: Task, algorithm: str, settings: Any, engine: str) -> Job:
    problem, settings = _Vectorised(task), settings.result_mode("population").build()

    def run() -> Any:
        return vamos.optimize(
            problem,
            algorithm=algorithm,
            algorithm_config=settings,
            termination=("max_evaluations", task.evaluations),
            engine=engine,
            seed=task.seed,
        )

    return Job(run, lambda found: np.asarray(found.F))


def _nsga2(task: Task, engine: str) -> Job:
    settings = (
        NSGAIIConfig.builder()
        .pop_size(task.population)
        .selection("tournament")
        .crossover("sbx", prob=task.crossover_probability, eta=task.eta)
        .mutation("pm", prob=task.mutation_probability, eta=task.eta)
    )
    return _job(task, "nsgaii", settings, engine)


def _moead(task: Task, batch: bool) -> Job:
    weights = weights_in_file(task)
    settings = (
        MOEADConfig.builder()
        .pop_size(task.population)
        .batch_size(task.population // 5 if batch else 1)
        .neighbor_size(task.neighbours)
        .delta(task.neighbour_probability)
        .replace_limit(task.replacements)
        .crossover("de", cr=1.0, f=task.scale_factor)
        .mutation("pm", prob=task.mutation_probability, eta=task.eta)
        .aggregation("tchebycheff")
        .weight_vectors(path=weights.name)
    )
    job = _job(task, "moead", settings, "numba")

    def run() -> Any:
        with weights:  # the folder goes with the run, which reads it
            return job.run()

    return job._replace(run=run)


NSGA2 = {f"vamos {engine}": partial(_nsga2, engine=engine) for engine in ("moocore", "numba")}
MOEAD = {"vamos": partial(_moead, batch=False), "vamos batch": partial(_moead, batch=True)}
