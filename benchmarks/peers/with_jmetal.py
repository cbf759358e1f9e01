"""jMetalPy."""

import logging
import random
from typing import Any

import numpy as np
from jmetal.algorithm import multiobjective
from jmetal.core.problem import FloatProblem
from jmetal.operator.crossover import DifferentialEvolutionCrossover, SBXCrossover
from jmetal.operator.mutation import PolynomialMutation
from jmetal.util.aggregation_function import Tschebycheff
from jmetal.util.evaluator import Evaluator
from jmetal.util.termination_criterion import StoppingByEvaluations

from . import Job, Task, weights_in_file

logging.getLogger("jmetal.core.algorithm").setLevel(logging.WARNING)  # it reports every step of a run


class _Problem(FloatProblem):
    def __init__(self, task: Task) -> None:
        super().__init__()
        self.lower_bound, self.upper_bound = (list(bound) for bound in zip(*task.bounds, strict=True))
        self.task = task

    def number_of_objectives(self) -> int:
        return len(self.task.problem.objectives)

    def number_of_constraints(self) -> int:
        return 0

    def name(self) -> str:
        return "ride"

    def evaluate(self, solution: Any) -> Any:
        return _InOneCall().evaluate([solution], self)[0]


class _InOneCall(Evaluator[Any]):
    def evaluate(self, solution_list: list[Any], problem: Any) -> list[Any]:
        values = problem.task.problem.evaluate(np.array([s.variables for s in solution_list]))
        for solution, objectives in zip(solution_list, values.tolist(), strict=True):
            solution.objectives = objectives
        return solution_list


def _job(task: Task, search: Any) -> Job:
    def run() -> Any:
        random.seed(task.seed)
        search.run()

    return Job(run, lambda _: np.array([solution.objectives for solution in search.result()]))


def _common(task: Task) -> dict[str, Any]:
    return {
        "problem": _Problem(task),
        "population_size": task.population,
        "mutation": PolynomialMutation(task.mutation_probability, task.eta),
        "population_evaluator": _InOneCall(),
        "termination_criterion": StoppingByEvaluations(task.evaluations),
    }


def nsga2(task: Task) -> Job:
    crossover = SBXCrossover(task.crossover_probability, task.eta)
    return _job(
        task,
        multiobjective.NSGAII(offspring_population_size=task.population, crossover=crossover, **_common(task)),
    )


def moead(task: Task) -> Job:
    with weights_in_file(task) as folder:
        search = multiobjective.MOEAD(
            crossover=DifferentialEvolutionCrossover(CR=1.0, F=task.scale_factor),
            aggregation_function=Tschebycheff(len(task.problem.objectives)),
            neighbourhood_selection_probability=task.neighbour_probability,
            max_number_of_replaced_solutions=task.replacements,
            neighbor_size=task.neighbours,
            weight_files_path=folder,
            **_common(task),
        )
    return _job(task, search)


NSGA2, MOEAD = {"jMetalPy": nsga2}, {"jMetalPy": moead}
