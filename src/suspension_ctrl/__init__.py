"""Ride optimisation of vehicle suspensions: linear ride models, ISO 2631 comfort, NSGA-II and MOEA/D-DRA.

Public names are imported when they are first used (PEP 562).
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .response.driving import simulate as simulate
    from .response.load_case import LoadCase as LoadCase
    from .response.problem import RideProblem as RideProblem
    from .response.weightings import weighting as weighting
    from .roads.measured import MeasuredRoad as MeasuredRoad
    from .roads.spectra import Iso8608Road as Iso8608Road
    from .roads.spectra import PowerLawRoad as PowerLawRoad
    from .roads.spectra import TwoSlopeRoad as TwoSlopeRoad
    from .search.constraints import InfeasibleWarning as InfeasibleWarning
    from .search.driver import Run as Run
    from .search.driver import minimise as minimise
    from .search.gamultiobj import Gamultiobj as Gamultiobj
    from .search.moead_dra import MoeadDra as MoeadDra
    from .search.nsga2 import Nsga2 as Nsga2
    from .search.problem import Problem as Problem
    from .search.sampling import Sampling as Sampling
    from .vehicles.cars import FullCar as FullCar
    from .vehicles.cars import HalfCar as HalfCar
    from .vehicles.cars import QuarterCar as QuarterCar
    from .vehicles.handling import RollGeometry as RollGeometry
    from .vehicles.mounted import FlexibleBody as FlexibleBody
    from .vehicles.mounted import Payload as Payload
    from .vehicles.mounted import Seat as Seat
    from .vehicles.plants import MeasuredPlant as MeasuredPlant

_HOMES = {
    "response.driving": ["simulate"],
    "response.load_case": ["LoadCase"],
    "response.problem": ["RideProblem"],
    "response.weightings": ["weighting"],
    "roads.measured": ["MeasuredRoad"],
    "roads.spectra": ["Iso8608Road", "PowerLawRoad", "TwoSlopeRoad"],
    "search.constraints": ["InfeasibleWarning"],
    "search.driver": ["Run", "minimise"],
    "search.gamultiobj": ["Gamultiobj"],
    "search.moead_dra": ["MoeadDra"],
    "search.nsga2": ["Nsga2"],
    "search.problem": ["Problem"],
    "search.sampling": ["Sampling"],
    "vehicles.cars": ["FullCar", "HalfCar", "QuarterCar"],
    "vehicles.handling": ["RollGeometry"],
    "vehicles.mounted": ["FlexibleBody", "Payload", "Seat"],
    "vehicles.plants": ["MeasuredPlant"],
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return list(__all__)
