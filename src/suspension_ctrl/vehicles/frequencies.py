"""Ride frequencies and damping ratios of wheels and body in place of rates of springs, dampers and tyres.

A corner is the mass m that stands on a wheel by the static loads (the mean of left and right), its spring K and
damper C at the wheel, its tyre K_t and its wheel M_w. Spring and tyre in series give the ride frequency f,
K K_t/(K + K_t) = m (2 pi f)^2; the damping ratio of the body is C/(2 sqrt(K m)); the wheel hops between spring and
tyre, K + K_t = M_w (2 pi f_w)^2. Ride rate and hop rate, tyre in series and in parallel, are those of "Wheel Rate,
Ride Rate, and Hop Rate" in the help of Altair MotionView 2021.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real, Record
from .assembly import Assembly, Network, StrutCoefficient, joined
from .force_laws import ForceLaw
from .formulas import Sheet
from .parameters import TyreParameter, alike, parameters_of

RIDE, DAMPING, HOP = "ride_frequency", "damping_ratio", "wheel_hop_frequency"
_SAME = 1e-9  # relative difference of static loads on other springs
_SINGULAR = 1e12  # condition of a stiffness matrix that holds no load


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Derived(Record):
    """A frequency or a damping ratio, and the coefficient or the parameter in place of which it stands."""

    name: str
    unit: str
    kind: str
    corner: str
    replaces: str
    default = None

    def check(self, name: str, value: float) -> None:
        """Raise ValueError about `name` unless it is above zero."""
        checks.positive(name, value, self.unit)


class Corner(NamedTuple):
    """Wheels that are alike, with the strut over each; names are empty where there is none of its kind."""

    tyres: tuple[str, ...]
    spring: str  # coefficients
    damper: str
    springs: float  # square of the installation ratio
    dampers: float
    tyre: str  # parameter
    tyre_stiffness: float  # N/m
    mass: float  # kg, that stands on a wheel
    wheel: float  # kg


def corners_of(assembly: Assembly) -> dict[str, Corner]:
    """Return the corners by name, ``front``; none of a vehicle with static loads that depend on its springs."""
    parameters, found = parameters_of(assembly), dict[str, Corner]()
    tyres = [one for one in parameters.values() if isinstance(one, TyreParameter) and one.order == 0]
    for one in tyres:
        loads, strut = loads_on(assembly, one.tyres), _strut_over(assembly, one.tyres)
        mass = 0.0 if loads is None else float(loads @ _carried(assembly))
        if mass > 0 and strut:
            upper = next(link.upper for link in assembly.tyres if link.name == one.tyres[0])
            wheel = assembly.masses.get(str(upper), 0.0)
            name = one.name.removesuffix("tyre_stiffness").removesuffix("_")
            found[name] = Corner(one.tyres, *strut, one.name, one.default, mass, wheel)
    return found


def derived_of(assembly: Assembly) -> dict[str, Derived]:
    """Return the frequencies and damping ratios that a vehicle has by name."""
    found = []
    for name, corner in corners_of(assembly).items():
        dot = f"{name}." if name else ""
        if corner.spring:
            found.append(Derived(name=dot + RIDE, unit="Hz", kind=RIDE, corner=name, replaces=corner.spring))
            hop = joined(name, HOP)
            if corner.wheel:
                found.append(Derived(name=hop, unit="Hz", kind=HOP, corner=name, replaces=corner.tyre))
            if corner.damper:
                ratio = dot + DAMPING
                found.append(Derived(name=ratio, unit="", kind=DAMPING, corner=name, replaces=corner.damper))
    taken = {*(one.name for one in assembly.strut_coefficients), *parameters_of(assembly)}
    return {one.name: one for one in found if one.name not in taken}


def resolve(
    sheet: Sheet, one: Corner, mass: int, wheel: int, known: Mapping[str, int], given: Mapping[str, int]
) -> dict[str, int]:
    """Return the slots of what frequencies and ratios are `given` for: spring, damper and tyre of a corner.

    By slots of the masses on and of a wheel, and those `known` by name of what is not replaced.
    """
    slots: dict[str, int] = {}
    ride = [(4 * pi**2, {mass: 1.0, given[RIDE]: 2.0})] if RIDE in given else []
    if HOP in given:
        both = (4 * pi**2, {wheel: 1.0, given[HOP]: 2.0})
        if ride:  # K_t + K K_t/(K_t - K) = A at a ride rate K: K_t^2 - A K_t + A K = 0
            total, rate = sheet.sum(both), sheet.sum(*ride)
            root = sheet.sum((1.0, {total: 2.0}), (-4.0, {total: 1.0, rate: 1.0}))
            slots[one.tyre] = sheet.sum((0.5, {total: 1.0}), (0.5, {root: 0.5}))
        else:
            slots[one.tyre] = sheet.sum(both, (-one.springs, {known[one.spring]: 1.0}))
    if ride:
        rate = sheet.sum(*ride)
        tyre = slots[one.tyre] if HOP in given else known[one.tyre]
        compliance = sheet.sum((1.0, {rate: -1.0}), (-1.0, {tyre: -1.0}))
        slots[one.spring] = sheet.sum((1 / one.springs, {compliance: -1.0}))
    if DAMPING in given:
        spring = slots[one.spring] if ride else known[one.spring]
        critical = sheet.sum((4 * one.springs, {spring: 1.0, mass: 1.0}))
        slots[one.damper] = sheet.sum((1 / one.dampers, {given[DAMPING]: 1.0, critical: 0.5}))
    return slots


def _strut_over(assembly: Assembly, tyres: Sequence[str]) -> tuple[str, str, float, float] | None:
    """Return spring and damper of the struts over tyres and their squared ratios, if one spring carries alone."""
    names = [one.name for one in assembly.struts]
    if not set(tyres) <= set(names):
        return None
    ports = [names.index(name) for name in tyres]
    if any(network.share[port] for network in assembly.networks for port in ports if not _of_rate(network)):
        return None
    found = []
    for order in (0, 1):
        own = [
            one
            for one in assembly.strut_coefficients
            if one.order == order and one.ratio is not None and one.gain[ports, ports].any()
        ]
        alone = len(own) == 1 and _only(own[0], ports)
        laws = order == 1 and any(network.share[port] for network in assembly.networks for port in ports)
        found.append((own[0].name, float(own[0].gain[ports[0], ports[0]])) if alone and not laws else ("", 1.0))
    (spring, springs), (damper, dampers) = found
    return spring, damper, springs, dampers


def _of_rate(network: Network) -> bool:
    return all(isinstance(one, ForceLaw) and one.of_rate for one in network.strut.elements)


def _only(one: StrutCoefficient, ports: Sequence[int]) -> bool:
    """Whether a coefficient acts at these ports alone, at each by the same."""
    expected = np.zeros_like(one.gain)
    expected[ports, ports] = one.gain[ports[0], ports[0]]
    return bool(np.array_equal(one.gain, expected))


def unsprung(assembly: Assembly) -> set[str]:
    """Return the wheels and axles."""
    return {str(one.upper[0] if isinstance(one.upper, tuple) else one.upper) for one in assembly.tyres}


def _carried(assembly: Assembly) -> Real:
    """Return the weights (n,) of the coordinates by masses that wheels and axles carry."""
    wheels = unsprung(assembly)
    masses = [0.0 if name in wheels else assembly.masses.get(name, 0.0) for name in assembly.movements]
    weights = np.array(masses) @ assembly.displacements
    return np.asarray(weights + sum(mass * assembly.shape(place) for mass, place in assembly.payload))


def loads_on(assembly: Assembly, tyres: Sequence[str]) -> Real | None:
    """Return how much of the weight of each coordinate (n,) stands on a wheel, the mean over some, by its tyre.

    On other springs it is the same, or None.
    """
    if [one.name for one in assembly.tyres] != list(assembly.contacts):
        return None
    links = [*assembly.tyres, *assembly.supports]
    (e, _), (p, _) = assembly.elongations(links), assembly.elongations(assembly.struts)
    k = np.array([link.stiffness for link in links])[:, None]
    which = [list(assembly.contacts).index(name) for name in tyres]
    groups = list(alike(dict.fromkeys((one.name for one in assembly.struts), 0.0)).values())
    found = []
    for seed in range(2):
        drawn = np.random.default_rng(seed).uniform(0.1, 0.2, len(groups)) * k[: len(assembly.tyres)].mean()
        springs = {name: one for names, one in zip(groups, drawn, strict=True) for name in names}
        stiffness = e.T @ (k * e) + p.T @ (np.array([[springs[one.name]] for one in assembly.struts]) * p)
        if np.linalg.cond(stiffness) > _SINGULAR:
            return None
        found.append(((k * e)[: len(assembly.tyres)] @ np.linalg.inv(stiffness))[which].mean(axis=0))
    same = np.abs(found[0] - found[1]).max() <= _SAME * np.abs(found[0]).max()
    return found[0] if same else None
