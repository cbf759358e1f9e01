"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA."""

from .measured_roads import MeasuredRoad
from .objectives import RideProblem
from .optimisers import Gamultiobj, MoeadDra, Nsga2, Run, Sampling, minimise
from .problems import Problem
from .roads import Iso8608Road, PowerLawRoad, TwoSlopeRoad
from .vehicles import QuarterCar
from .weightings import weighting

__all__ = [
    "Gamultiobj",
    "Iso8608Road",
    "MeasuredRoad",
    "MoeadDra",
    "Nsga2",
    "PowerLawRoad",
    "Problem",
    "QuarterCar",
    "RideProblem",
    "Run",
    "Sampling",
    "TwoSlopeRoad",
    "minimise",
    "weighting",
]
