"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA."""

from .cars import FullCar, HalfCar, QuarterCar
from .cases import LoadCase
from .feasibility import InfeasibleWarning
from .handling import RollGeometry
from .measured_plants import MeasuredPlant
from .measured_roads import MeasuredRoad
from .mounted import FlexibleBody, Payload, Seat
from .objectives import RideProblem
from .optimisers import Gamultiobj, MoeadDra, Nsga2, Run, Sampling, minimise
from .problems import Problem
from .roads import Iso8608Road, PowerLawRoad, TwoSlopeRoad
from .simulation import simulate
from .weightings import weighting

__all__ = [
    "FlexibleBody",
    "FullCar",
    "Gamultiobj",
    "HalfCar",
    "InfeasibleWarning",
    "Iso8608Road",
    "LoadCase",
    "MeasuredPlant",
    "MeasuredRoad",
    "MoeadDra",
    "Nsga2",
    "Payload",
    "PowerLawRoad",
    "Problem",
    "QuarterCar",
    "RideProblem",
    "RollGeometry",
    "Run",
    "Sampling",
    "Seat",
    "TwoSlopeRoad",
    "minimise",
    "simulate",
    "weighting",
]
