"""Mean squares of a load case's responses over designs: one interface, in Python and in compiled code.

A case is a compiled function from designs (p, v) to mean squares (p, k): `OneStrut` for one spring and one damper,
`OneFraction` and `OnePort` for one strut with a network, `ManyStruts` and `AnyStruts` for others without and with.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard

import numpy as np

from ..quantities import Real
from ..vehicles.varied import Varied
from ..vehicles.vehicle import Vehicle
from . import weightings
from .any_struts import AnyStruts
from .blocks import Pairs, Variables, in_blocks, pairs_of
from .load_case import LoadCase
from .many_struts import ManyStruts
from .mapped import Mapped
from .measures.terms import Term
from .one_port import OnePort
from .one_strut import OneDesign, OneStrut
from .placed_nodes import Placed
from .ports import Ports
from .quadrature import Rule, frequency_nodes, in_lanes
from .strut_data import any_struts, networks_of

if TYPE_CHECKING:
    from .one_fraction import OneFraction

AnyCase: TypeAlias = "OnePort | OneFraction | AnyStruts"
Case: TypeAlias = "OneStrut | ManyStruts | AnyCase | Mapped"
Nodes = int | Placed
"""A number of nodes, or those that are placed for a box."""


def cases_of(
    load_cases: Sequence[LoadCase],
    terms: Sequence[Sequence[Term]],
    settings: Sequence[Mapping[str, float]],
    variables: Sequence[str],
    band: tuple[float, float],
    nodes: Nodes,
) -> tuple[Case, ...]:
    """Return `case_of` each load case, all of one class for compiled loops."""
    rules: Sequence[int | Rule] = nodes.rules if isinstance(nodes, Placed) else [nodes] * len(load_cases)
    each, kind = zip(load_cases, terms, settings, rules, strict=True), kind_of(load_cases, variables)
    return tuple(
        _mapped(case.vehicle, case_of(case, some, setting, variables, band, rule, kind=kind))
        for case, some, setting, rule in each
    )


def _mapped(vehicle: Vehicle, case: Case) -> Case:
    """Return a case over the variables of a vehicle."""
    return Mapped(vehicle.formulas, case) if isinstance(vehicle, Varied) else case


def has_networks(case: Case) -> TypeGuard[AnyCase]:
    """Whether a case has networks beside plain springs and dampers."""
    return hasattr(case, "networks")


def one_by_one(case: Any) -> Any:
    """Return a case for compiled loops that have one design after the other."""
    if isinstance(case, Mapped):
        return Mapped(case.formulas, one_by_one(case.case))
    return OneDesign(case) if isinstance(case, OneStrut) else case


def varying(vehicle: Vehicle, variables: Sequence[str]) -> Sequence[str]:
    """Return the coefficients that vary with the variables."""
    return vehicle.varying if isinstance(vehicle, Varied) else variables


def kind_of(load_cases: Sequence[LoadCase], variables: Sequence[str]) -> type[Case]:
    """Return the quickest class for all load cases."""
    vehicles = [case.vehicle for case in load_cases]
    one_port = all(len(one.contact_points) == len(one.struts) == 1 for one in vehicles)
    if any(vehicle.networks for vehicle in vehicles):
        return _kind_of_port(vehicles) if one_port else AnyStruts
    names = {tuple(one.name for one in vehicle.strut_coefficients) for vehicle in vehicles}
    own = {tuple(varying(vehicle, variables)) for vehicle in vehicles}
    return OneStrut if one_port and names == own == {("spring", "damper")} else ManyStruts


def _kind_of_port(vehicles: Sequence[Vehicle]) -> type[Case]:
    """Return the quickest class for vehicles with a network at one strut."""
    from .network_fractions import at_port
    from .one_fraction import OneFraction

    return OneFraction if all(at_port(vehicle).few for vehicle in vehicles) else OnePort


def _fraction_of(port: OnePort, vehicle: Vehicle) -> "OneFraction":
    """Return a port whose strut is a fraction."""
    from .network_fractions import at_port
    from .one_fraction import OneFraction

    return OneFraction.of(port, at_port(vehicle))


def case_of(
    load_case: LoadCase,
    terms: Sequence[Term],
    setting: Mapping[str, float],
    variables: Sequence[str],
    band: tuple[float, float],
    nodes: int | Rule,
    pairs: Callable[[Sequence[str], Real], Pairs] = pairs_of,
    kind: type[Case] | None = None,
) -> Case:
    """Return the mean squares (k,) of terms over the variables (v,), around a setting in the middle of the box."""
    kind = kind or kind_of([load_case], variables)
    variables = varying(load_case.vehicle, variables)
    f, w, densities = quadrature_of(load_case, terms, band, nodes)
    vehicle = load_case.vehicle
    responses = [term.response for term in terms]
    if kind is OneStrut:
        return OneStrut.around(Ports.of(vehicle, f, responses), 2 * np.pi * f, densities * load_case.psd(f))
    if kind is not AnyStruts and load_case.vehicle.networks:
        ports, excitation = Ports.of(vehicle, f, responses), w * load_case.psd(f)
        networks = networks_of(vehicle, setting, variables, f, np.eye(1, dtype=bool))
        port = OnePort.around(networks, ports, f, excitation, densities * load_case.psd(f))
        return port if kind is OnePort else _fraction_of(port, vehicle)
    f, w, densities = in_lanes(f, w, densities)
    omega, apart = 2 * np.pi * f, pairs(vehicle.struts, vehicle.contact_points)
    if kind is AnyStruts:
        return any_struts(load_case, responses, setting, variables, f, w, densities, apart)
    ports, roads = Ports.of(vehicle, f, responses, setting), load_case.cross_spectrum(f)
    varied = Variables.of(vehicle.strut_coefficients, {name: setting[name] for name in variables})
    return in_blocks(ports, omega, roads, densities, varied, apart)


def quadrature_of(
    load_case: LoadCase, terms: Sequence[Term], band: tuple[float, float], nodes: int | Rule
) -> tuple[Real, Real, Real]:
    """Return nodes f (n,) [Hz], weights (n,), and densities (k, n): weights times squared factors of terms."""
    weights = [term.weighting and weightings.by_name(term.weighting) for term in terms]
    kinks = {f for weighting in weights if weighting for f in weighting.breakpoints}
    breakpoints = kinks.union(load_case.breakpoints)
    f, w = nodes if isinstance(nodes, Rule) else frequency_nodes(band, nodes, breakpoints)
    densities = np.array(
        [
            w * (2 * np.pi * f) ** term.moment * (weighting.factor(f) ** 2 if weighting else 1.0)
            for term, weighting in zip(terms, weights, strict=True)
        ]
    )
    return f, w, densities.reshape(len(terms), f.size)
