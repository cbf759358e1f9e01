"""One design of a problem: its values by name, and its vehicles with all values in place."""

from collections.abc import Mapping

from .. import checks
from ..response.curves import setting_of
from ..response.linearisation import linear_at
from ..response.load_case import LoadCase
from ..response.problem import RideProblem
from ..vehicles.elements import MeasuredStiffness, Rubber
from ..vehicles.feedback import System
from ..vehicles.files import VehicleFile
from ..vehicles.unit_slips import slip_of
from .candidate_table import Present, design_of


def values_of(name: str, problem: RideProblem, given: Present) -> dict[str, float]:
    """Return the values of a design by variable; ValueError about `name` unless a vehicle can have them."""
    checks.of_kind("problem", problem, RideProblem)
    values = dict(zip(problem.variables, design_of(problem, given, name).tolist(), strict=True))
    known = problem.cases[0].vehicle.variables
    for one, value in values.items():
        known[one].check(f"{name}: {one}", value)
    return values


def present_of(problem: RideProblem, given: Present | None) -> dict[str, float]:
    """Return the values of the present design by variable, none if none are given."""
    if given is None or (isinstance(given, Mapping) and not given):
        return {}
    return values_of("present", problem, given)


def setting_at(problem: RideProblem, design: Mapping[str, float]) -> dict[str, float]:
    """Return the values of a design by name, with those that do not vary."""
    return setting_of(problem, list(design.values()))


def case_of(problem: RideProblem, number: int) -> LoadCase:
    """Return a load case by its number from 1; ValueError if there is none."""
    if checks.at_least("case", number, 1) > len(problem.cases):
        raise ValueError(f"case must be one of {len(problem.cases)} load cases, got {number}")
    return problem.cases[number - 1]


def vehicle_file(problem: RideProblem, design: Present, *, case: int = 1, name: str = "") -> VehicleFile:
    """Return the vehicle of a load case with a design in place, for `save_vehicle`, commands and others.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like, or mapping of str to float
        Variables of the design.
    case : int
        Number of the load case, from 1.
    name : str
        Name of the vehicle, or of the design.

    Returns
    -------
    VehicleFile
        Its setting is the design with the coefficients that do not vary; the bounds are those of the problem.

    Raises
    ------
    ValueError
        If a variable is missing, unknown or out of range, or there is no such load case.

    Examples
    --------
    The softest front and the firmest damper, as a file from which commands take the same ride:

    >>> import suspension_ctrl as sc
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(car.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=car.bounds)
    >>> file = sc.vehicle_file(problem, [12.389e3, 1616.3], name="published optimum")
    >>> sc.save_vehicle("optimum.toml", file)
    >>> sc.load_vehicle("optimum.toml").setting
    {'spring': 12389.0, 'damper': 1616.3}
    """
    values, chosen = values_of("design", problem, design), case_of(problem, case)
    return VehicleFile(
        vehicle=chosen.vehicle,
        setting=setting_at(problem, values),
        bounds=problem.bounds,
        roll_geometry=chosen.roll_geometry,
        name=name,
        unusual=slip_of(chosen.vehicle) is not None,
    )


def closed_at(case: LoadCase, setting: Mapping[str, float], band: tuple[float, float]) -> "System | None":
    """Return the closed vehicle of a load case, with equivalent springs and dampers in place of force laws.

    None with an element that is known in the frequency domain alone.
    """
    elements = (one for network in case.vehicle.networks for one in network.strut.elements)
    if any(isinstance(one, Rubber | MeasuredStiffness) for one in elements):
        return None
    vehicle, own = linear_at(case, setting, band)
    return vehicle.closed(own)
