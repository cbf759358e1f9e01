"""Figures that are alike for bicycles, cars and trucks, and the bands that no real vehicle leaves.

A slip of units by a factor of 1000 moves a frequency by its root, 32, and a ratio by 1000. Each band holds real
vehicles with room to spare and is narrower than that. Masses, stiffnesses and forces are not judged by their size:
a model by unit of mass is sound.
"""

from collections.abc import Iterator, Mapping
from math import log
from typing import NamedTuple

import numpy as np

from ..quantities import Real
from .assembly import turning
from .vehicle import AssembledVehicle

_WIDE, _FREE = 0.03, 1e-10


class Figure(NamedTuple):
    """A figure of a vehicle, the band of real ones, and a usual value."""

    name: str
    value: float
    lowest: float
    highest: float
    usual: float
    unit: str = ""
    weight: float = 1.0  # of the distance, small where real vehicles differ widely

    @property
    def plausible(self) -> bool:
        """Whether the value lies in the band."""
        return self.lowest <= self.value <= self.highest

    @property
    def distance(self) -> float:
        """Distance from the usual value, the weighted square of a logarithm."""
        return self.weight * log(self.value / self.usual) ** 2 if self.value > 0 else np.inf

    def __str__(self) -> str:
        got = f"{self.value:.3g} {self.unit}".rstrip()
        return f"{self.name} of {got}, usual are {f'{self.lowest:g} to {self.highest:g} {self.unit}'.rstrip()}"


def figures_of(vehicle: AssembledVehicle, values: Mapping[str, float] | None = None) -> list[Figure]:
    """Return the figures of a vehicle, without values of its struts those of masses, lengths and tyres alone."""
    found = [*_of_lengths(vehicle), *_of_masses(vehicle), *_of_tyres(vehicle)]
    if values is not None:
        found += [*_of_modes(vehicle, values), *_of_dampers(vehicle, values)]
    return found


def _of_lengths(vehicle: AssembledVehicle) -> Iterator[Figure]:
    """Wheelbase and track, from models on a table to road trains."""
    for axis, name, highest, usual in ((0, "a wheelbase", 60.0, 2.8), (1, "a track", 10.0, 1.5)):
        if (span := _span(vehicle, axis)) > 0:
            yield Figure(name, span, 0.02, highest, usual, "m")


def _span(vehicle: AssembledVehicle, axis: int) -> float:
    places = [contact[axis] for contact in vehicle.contacts.values()]
    return max(places) - min(places)


def _of_masses(vehicle: AssembledVehicle) -> Iterator[Figure]:
    """Wheels over body, 0.02 of a bicycle with its rider to 0.6 of an empty trailer; radii of gyration."""
    assembly = vehicle.assembly
    unsprung = sum(assembly.masses[name] for name in assembly.unsprung)
    if unsprung > 0 and assembly.sprung_mass > 0:
        yield Figure("wheels over body in mass", unsprung / assembly.sprung_mass, 0.003, 3.0, 0.13)
    for axis, turn, over in ((0, "pitch", "wheelbase"), (1, "roll", "track")):
        span = _span(vehicle, axis)
        for body, mass in assembly.masses.items():
            inertia = assembly.inertias.get(turning(body, turn), 0.0)
            if mass > 0 and inertia > 0 and span > 0:
                # short are the beams of long trucks
                lowest, whose = (0.02, "") if body == "body" else (1e-3, f" of {body}")
                ratio = float(np.sqrt(inertia / mass) / span)
                yield Figure(f"a radius of gyration{whose} in {turn} over the {over}", ratio, lowest, 2.0, 0.4)


def _of_tyres(vehicle: AssembledVehicle) -> Iterator[Figure]:
    """Damping over stiffness, where a tyre has damping: some 0.3 to 3 ms."""
    ratios = [tyre.damping / tyre.stiffness for tyre in vehicle.assembly.tyres if tyre.damping and tyre.stiffness]
    if ratios:
        yield Figure("damping over stiffness of a tyre", min(ratios), 5e-6, 0.5, 2e-3, "s", _WIDE)
        yield Figure("damping over stiffness of a tyre", max(ratios), 5e-6, 0.5, 2e-3, "s", _WIDE)


def _of_modes(vehicle: AssembledVehicle, values: Mapping[str, float]) -> Iterator[Figure]:
    """Undamped frequencies without elastic modes: bodies 0.5 to 7 Hz, wheels of a bus 5 Hz, of a bicycle 45 Hz."""
    assembly = vehicle.assembly
    elastic = {mode for shares in assembly.bending.values() for mode in shares}
    rigid = [i for i, name in enumerate(assembly.coordinates) if name not in elastic]
    stiffness = vehicle.statics.stiffness_of(np.array([list(vehicle.coefficients(values).values())]))[0]
    squares = _squares(stiffness[np.ix_(rigid, rigid)], assembly.mass_matrix[np.ix_(rigid, rigid)])
    held = squares[squares > _FREE * squares[-1]]  # a strut without a spring carries nothing
    lowest, highest = np.sqrt(held[[0, -1]]) / (2 * np.pi)
    yield Figure("a lowest natural frequency", float(lowest), 0.25, 60.0, 1.3, "Hz")
    yield Figure("a highest natural frequency", float(highest), 0.25, 60.0, 12.0, "Hz")


def _squares(stiffness: Real, mass: Real) -> Real:
    root = np.linalg.inv(np.linalg.cholesky(mass))
    return np.asarray(np.linalg.eigvalsh(root @ stiffness @ root.T), dtype=float)


def _of_dampers(vehicle: AssembledVehicle, values: Mapping[str, float]) -> Iterator[Figure]:
    """Damper over spring of a strut: 1 ms of a truck with hardly any damping to 0.5 s."""
    ratios = []
    for one in vehicle.strut_coefficients:
        springs = [
            values[other.name]
            for other in vehicle.strut_coefficients
            if other.unit == "N/m" and other.prefix == one.prefix and values.get(other.name)
        ]
        if one.unit == "N s/m" and values.get(one.name) and springs:
            ratios.append(values[one.name] / springs[0])
    if ratios:
        yield Figure("a damper over its spring", min(ratios), 5.5e-4, 10.0, 0.07, "s", _WIDE)
        yield Figure("a damper over its spring", max(ratios), 5.5e-4, 10.0, 0.07, "s", _WIDE)
