"""genoxide, compiled from Rust."""

from typing import Any

import genoxide as gx
import numpy as np

from . import Job, Task


def _job(task: Task, search: Any) -> Job:
    def evaluate(designs: Any) -> Any:
        values = task.problem.evaluate(designs)
        return (values[:, : task.objectives], task.violation(values)) if task.problem.constraints else values

    def run() -> Any:
        return search.run(evaluate, generations=task.generations, batch=True)

    return Job(run, lambda found: np.array(found.front_objectives))


def _common(task: Task) -> dict[str, Any]:
    mutation = gx.PolynomialMutation(task.eta, rate=task.mutation_probability)
    return {"objectives": ["minimize"] * task.objectives, "mutation": mutation, "seed": task.seed}


def nsga2(task: Task) -> Job:
    search = gx.Nsga2(
        gx.Real(bounds=task.bounds),
        population_size=task.population,
        crossover=gx.SimulatedBinaryCrossover(task.eta),
        crossover_rate=task.crossover_probability,
        eliminate_duplicates=False,
        **_common(task),
    )
    return _job(task, search)


def moead(task: Task) -> Job:
    search = gx.Moead(
        gx.Real(bounds=task.bounds),
        weights=task.weights,
        neighbors=task.neighbours,
        neighbor_mating=task.neighbour_probability,
        max_replacements=task.replacements,
        crossover=gx.DifferentialEvolutionCrossover(task.scale_factor),
        **_common(task),
    )
    return _job(task, search)


NSGA2, MOEAD = {"genoxide": nsga2}, {"genoxide": moead}
