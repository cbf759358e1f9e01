"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA."""

from .objectives import RideProblem
from .optimisers import MoeadDra, Nsga2, Run, minimise
from .problems import Problem
from .roads import PowerLawRoad
from .vehicles import QuarterCar
from .weightings import weighting

__all__ = [
    "MoeadDra",
    "Nsga2",
    "PowerLawRoad",
    "Problem",
    "QuarterCar",
    "RideProblem",
    "Run",
    "minimise",
    "weighting",
]
