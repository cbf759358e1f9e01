"""Ride problems with sky dampers in the struts."""

from ..response.problem import RideProblem
from ..vehicles.sky_dampers import SKY, skyhook
from ..vehicles.vehicle import AssembledVehicle


def with_sky(problem: RideProblem) -> RideProblem:
    """Return the problem with sky dampers up to the largest bound of a damper."""
    dampers = [problem.bounds[name][1] for name in problem.variables if problem.units[name] == "N s/m"]
    if not dampers:
        raise ValueError(f"variables must hold a damper for skyhook, got {', '.join(problem.variables)}")
    vehicle = skyhook(problem.vehicle)
    names = [one.name for one in vehicle.strut_coefficients if one.name.rpartition(".")[2] == SKY]
    return problem.replace(
        vehicle=vehicle, bounds={**problem.bounds, **{name: (0.0, max(dampers)) for name in names}}
    )


def takes_sky(problem: RideProblem) -> bool:
    """Whether the vehicle can have sky dampers, see `skyhook`."""
    return isinstance(problem.vehicle, AssembledVehicle) and not problem.vehicle.networks
