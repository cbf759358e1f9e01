"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA."""

from .feasibility import InfeasibleWarning
from .objectives import RideProblem
from .optimisers import Gamultiobj, MoeadDra, Nsga2, Run, Sampling, minimise
from .problems import Problem
from .roads import PowerLawRoad
from .vehicles import QuarterCar
from .weightings import weighting

__all__ = [
    "Gamultiobj",
    "InfeasibleWarning",
    "MoeadDra",
    "Nsga2",
    "PowerLawRoad",
    "Problem",
    "QuarterCar",
    "RideProblem",
    "Run",
    "Sampling",
    "minimise",
    "weighting",
]
