"""DEAP as its users write it: a list of individuals, its own operators, evaluation in one call per generation."""

import random
from functools import partial
from typing import Any

import numpy as np
from deap import base, tools

from . import Job, Task


class _Minimised(base.Fitness):
    weights = (-1.0, -1.0, -1.0)


class _Individual(list[float]):
    def __init__(self, genes: list[float]) -> None:
        super().__init__(genes)
        self.fitness = _Minimised()

    def copy(self) -> "_Individual":
        twin = _Individual(self)
        twin.fitness.values = self.fitness.values
        return twin


def _nsga2(task: Task, nd: str) -> Job:
    low, up = (list(bound) for bound in zip(*task.bounds, strict=True))
    limits = {"eta": task.eta, "low": low, "up": up}

    def evaluate(individuals: list[_Individual]) -> None:
        for individual, values in zip(individuals, task.problem.evaluate(np.array(individuals)), strict=True):
            individual.fitness.values = values

    def children(parents: list[_Individual]) -> list[_Individual]:
        offspring = [parent.copy() for parent in parents]
        for first, second in zip(offspring[::2], offspring[1::2], strict=True):
            if random.random() <= task.crossover_probability:
                tools.cxSimulatedBinaryBounded(first, second, **limits)
        for child in offspring:
            tools.mutPolynomialBounded(child, **limits, indpb=task.mutation_probability)
        return offspring

    def run() -> list[_Individual]:
        random.seed(task.seed)
        population = [_Individual([random.uniform(a, b) for a, b in task.bounds]) for _ in range(task.population)]
        evaluate(population)
        population = tools.selNSGA2(population, task.population, nd=nd)
        for _ in range(task.generations):
            offspring = children(tools.selTournamentDCD(population, task.population))
            evaluate(offspring)
            population = tools.selNSGA2(population + offspring, task.population, nd=nd)
        return population

    def objectives(population: list[_Individual]) -> Any:
        return np.array([individual.fitness.values for individual in population])

    return Job(run, objectives)


NSGA2 = {f"DEAP {nd}": partial(_nsga2, nd=nd) for nd in ("standard", "log")}
MOEAD: dict[str, Any] = {}
