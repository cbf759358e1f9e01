"""puggles, compiled from Rust; it has no MOEA/D."""

from typing import Any

import numpy as np
import puggles as pg

from . import Job, Task


def nsga2(task: Task) -> Job:
    m = len(task.problem.objectives)
    problem = pg.Problem(
        len(task.bounds),
        m,
        [pg.Real(a, b) for a, b in task.bounds],
        batch_objective_function=lambda designs: task.problem.evaluate(np.array(designs)).tolist(),
        direction=[-1] * m,
    )
    search = pg.NSGAII(
        problem,
        population_size=task.population,
        seed=task.seed,
        crossover_config=pg.CrossoverConfig(
            real_crossover="sbx",
            sbx_probability=task.crossover_probability,
            sbx_distribution_index=task.eta,
        ),
        mutation_config=pg.MutationConfig(
            real_mutation="polynomial",
            probability=task.mutation_probability,
            polynomial_distribution_index=task.eta,
        ),
    )

    def objectives(_: None) -> Any:
        return np.array([solution.objectives for solution in search.get_population()])

    return Job(lambda: search.run(task.evaluations), objectives)


NSGA2: dict[str, Any] = {"puggles": nsga2}
MOEAD: dict[str, Any] = {}
