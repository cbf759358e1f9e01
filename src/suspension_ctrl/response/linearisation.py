"""Vehicles with force laws on a random road: working points, and equivalent springs and dampers."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..quantities import Bool, FrozenMapping, Real, Record
from ..vehicles.assembly import Assembly, Network, StrutCoefficient
from ..vehicles.elements import Damper, Spring
from ..vehicles.force_laws import ForceLaw
from ..vehicles.networks import has_force_laws
from ..vehicles.struts import Parallel, Strut
from ..vehicles.vehicle import AssembledVehicle, Setting, Vehicle, assembled
from . import any_struts, one_port
from .any_struts import AnyStruts
from .bands import band_of
from .load_case import LoadCase, Road
from .mean_squares import AnyCase, case_of, has_networks
from .measures.terms import Term
from .network_rows import DEVIATION, FORCE, MEAN, NETWORK, OF_RATE, SLOPE
from .one_port import OnePort
from .strut_data import apart
from .working_point import Points, room_for_points

if TYPE_CHECKING:
    import pandas as pd

_LEAST = 1e-9  # N/m or N s/m, of a law without slope such as a stop out of reach
_NODES = 1024


_NOISE = 1e-12  # mean force of an odd law by rounding, as a share of the root mean square of its force


class LinearisedLaw(NamedTuple):
    """A force law at its working point."""

    deviation: float  # standard deviation of its deflection [m] or rate [m/s]
    mean: float  # mean deflection [m], 0 of a rate
    equivalent: float  # mean slope [N/m or N s/m]
    force: float  # mean force [N]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LinearisedVehicle(Record, AssembledVehicle):
    """A vehicle with springs and dampers in place of its force laws, see `linearised`.

    Parameters
    ----------
    vehicle : AssembledVehicle
        With force laws.
    settled : Assembly
        Its masses and links, with an equivalent spring or damper for each force law. All coefficients have values
        by default.
    laws : mapping of str to LinearisedLaw
        By law its ``deviation`` and ``mean`` [m or m/s], its mean slope ``equivalent`` [N/m or N s/m] and mean
        ``force`` [N]. Where left and right are alike, one law stands for both, by the name of the axle or of the
        left strut.
    mean_travel : mapping of str to float
        Mean deflection of each strut [m], the change of ride height; NaN of dampers in series that are not odd:
        the end between them drifts.
    iterations : int
        Steps to the working point.
    """

    vehicle: AssembledVehicle
    settled: Assembly = field(repr=False)
    laws: Mapping[str, LinearisedLaw]
    mean_travel: Mapping[str, float]
    iterations: int

    @property
    def assembly(self) -> Assembly:
        """Its masses and links."""
        return self.settled

    def table(self) -> "pd.DataFrame":
        """Return the working point: a row for each force law, its equivalent in N/m or N s/m."""
        import pandas as pd

        rows = pd.DataFrame(self.laws.values(), columns=LinearisedLaw._fields, index=list(self.laws))
        noise = _NOISE * rows["equivalent"] * rows["deviation"]
        return rows.assign(force=rows["force"].where(rows["force"].abs() > noise, 0.0)).rename_axis("law")


def linearised(
    vehicle: Vehicle, setting: Setting, road: Road, speed: float, *, band: tuple[float, float] | None = None
) -> LinearisedVehicle:
    """Return a vehicle with springs and dampers in place of its force laws, as on a road at a speed.

    A law F of Gaussian deflection or rate x with the standard deviation s is replaced by its mean slope
    ``E[F'(x)] = E[(x - m) F(x)]/s^2`` and its mean force E[F], which moves the strut to a mean m (statistical
    linearisation). s depends on the slope: both belong to a fixed point. On one road a force law acts on root mean
    squares through this slope alone; peaks and ride height depend on the whole curve.

    Parameters
    ----------
    vehicle : Vehicle
    setting : mapping of str to float or (float, float)
        Coefficients of its struts, as for ``vehicle.coefficients``.
    road : Road
        Under one wheel any object with ``psd(f, speed)``.
    speed : float
        Vehicle speed V [m/s].
    band : (float, float), optional
        As of `RideProblem`: frequencies that make up the standard deviations [Hz].

    Returns
    -------
    LinearisedVehicle
        ``closed()``, ``modes()`` and `ride` work on it; ``laws``, ``mean_travel`` and ``iterations`` tell the
        working point.

    Raises
    ------
    ValueError
        If there is no working point, or about a coefficient, road or speed.

    Examples
    --------
    A damper with a knee is stiff on a smooth road and soft on a rough one:

    >>> import suspension_ctrl as sc
    >>> damper = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
    >>> car = sc.QuarterCar(
    ...     body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(sc.Spring(), damper)
    ... )
    >>> for road in "AD":
    ...     linear = sc.linearised(car, {"spring": 22e3}, sc.Iso8608Road(road), speed=20.0, band=(0.1, 20.0))
    ...     print(road, {name: round(law.equivalent) for name, law in linear.laws.items()})
    A {'damper': 3971}
    D {'damper': 1262}
    """
    car, values = assembled(vehicle).at(setting)
    case = LoadCase(vehicle=car, road=road, speed=speed)
    band = band_of(band, [(road, speed)])
    squares = case_of(case, [Term(car.responses[0])], values, list(values), band, _NODES)
    if has_networks(squares):
        points = working_points(squares, np.array([list(values.values())]))
        return at_working_point(car, values, points, 0, squares)
    still = dict.fromkeys(car.struts, 0.0)
    return LinearisedVehicle(
        vehicle=car, settled=_settled(car.assembly, values, []), laws={}, mean_travel=still, iterations=0
    )


def linear_at(case: LoadCase, setting: Setting, band: tuple[float, float]) -> tuple[Vehicle, Setting]:
    """Return the vehicle of a load case, its force laws linearised, and the setting with which it is closed."""
    if not has_force_laws(case.vehicle.networks):
        return case.vehicle.at(setting)
    return linearised(case.vehicle, setting, case.road, case.speed, band=band), {}


def working_points(case: AnyCase, designs: Real) -> Points:
    """Return the working points of designs (p, v); ValueError that names the first design without one."""
    points = room_for_points(case.networks, len(designs))
    if isinstance(case, AnyStruts):
        any_struts.solve(case, designs, points)
    else:
        one_port.solve(case if isinstance(case, OnePort) else case.port, designs, points)
    check_reached(points.iterations >= 0, designs)
    return points


def powers_of_laws(case: AnyCase, points: Points) -> Real:
    """Return the mean power (p, q) that the force laws of the rate take in at each strut: E[v F] = c s^2."""
    law, state = case.networks.law, points.state
    power = state[..., SLOPE] * state[..., DEVIATION] ** 2 * law[:, OF_RATE]
    return np.asarray(power @ case.networks.ports[law[:, NETWORK].astype(int)])


def check_reached(reached: Bool, designs: Real) -> None:
    """Raise ValueError that names the first of designs (p, v) without a working point."""
    if not reached.all():
        got = designs[int(reached.argmin())].tolist()
        raise ValueError(f"force laws must have a working point, got none for design {got}")


def at_working_point(
    car: AssembledVehicle, values: Mapping[str, float], points: Points, design: int, case: AnyCase
) -> LinearisedVehicle:
    """Return the vehicle at one of its working points; laws of left and right may have one point in the case."""
    state, networks, names = points.state[design], list[tuple[Network, str]](), list[str]()
    ports = case.networks.ports[:, : len(car.struts)]
    placed = [one for whole in car.networks for one in apart(whole, ports.T @ ports)]
    for network in placed:
        port = "" if len(placed) == len(car.networks) else car.struts[network.share.index(1.0)]
        networks.append((network, f"{port}." if port else network.prefix))
        names += [networks[-1][1] + one.name for one in network.strut.elements if isinstance(one, ForceLaw)]
    slopes = iter(state[:, SLOPE].tolist())
    linear = [(network._replace(strut=_linear(network.strut, slopes)), prefix) for network, prefix in networks]
    rows = state[:, [DEVIATION, MEAN, SLOPE, FORCE]].tolist()
    return LinearisedVehicle(
        vehicle=car,
        settled=_settled(car.assembly, values, linear),
        laws=FrozenMapping({name: LinearisedLaw(*row) for name, row in zip(names, rows, strict=True)}),
        mean_travel=FrozenMapping(dict(zip(car.struts, points.position[design].tolist(), strict=True))),
        iterations=int(points.iterations[design]),
    )


def linear_vehicles(
    vehicle: Vehicle, names: Sequence[str], case: AnyCase, designs: Real, coefficients: Real
) -> Iterator[LinearisedVehicle]:
    """Yield the vehicle at the working point of each of designs (p, v) with coefficients (p, c) of these names."""
    car, points = assembled(vehicle), working_points(case, designs)
    for p, row in enumerate(coefficients.tolist()):
        yield at_working_point(car, dict(zip(names, row, strict=True)), points, p, case)


def _linear(strut: Strut, slopes: Iterator[float]) -> Strut:
    """Return a strut with a spring or a damper of the next slope in place of each force law."""
    if isinstance(strut, Parallel):
        return replace(strut, parts=tuple(_linear(part, slopes) for part in strut.parts))
    if isinstance(strut, ForceLaw):
        kind = Damper if strut.of_rate else Spring
        return kind(strut.name, max(next(slopes), _LEAST), installation_ratio=strut.installation_ratio)
    return strut


def _settled(assembly: Assembly, values: Mapping[str, float], networks: Sequence[tuple[Network, str]]) -> Assembly:
    """Return an assembly with values by default, and networks with other prefixes in place of its own."""
    before = {n.prefix + one.name for n in assembly.networks for one in n.strut.coefficients}
    kept = [
        replace(one, default=values[one.name]) for one in assembly.strut_coefficients if one.name not in before
    ]
    nothing = np.zeros((len(assembly.struts), len(assembly.struts)))
    for network, prefix in networks:
        for one in network.strut.coefficients:
            value = values.get(network.prefix + one.name, one.default)
            kept.append(StrutCoefficient(prefix + one.name, one.unit, nothing, 0, value))
    moved = tuple(network._replace(prefix=prefix) for network, prefix in networks)
    return replace(assembly, strut_coefficients=tuple(kept), networks=moved)
