"""Measures of modes: undamped natural frequencies and damping ratios, by the name of a motion.

Of all modes the one counts that has the largest share of its kinetic energy in the motion.
"""

import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import checks
from ...quantities import Real
from ...vehicles.assembly import Assembly
from ...vehicles.handling import Mechanics, weighted_sum
from ...vehicles.vehicle import assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import CaseMeasure

_SIDE = re.compile("_(left|right)_wheel$")


@dataclass(frozen=True, eq=False, repr=False)
class ModeFrequency(Measure, word="frequency", unit="Hz"):
    """Natural frequency of a mode without dampers, from stiffnesses and masses.

    Parameters
    ----------
    mode : str
        Its motion: ``"heave"``, ``"pitch"``, ``"roll"``, ``"front wheel hop"`` (in phase) and ``"tramp"``, or a
        seat by its name.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.ModeFrequency("heave"), 1.4))
    frequency heave <= 1.4
    """

    mode: str
    of_ride = False

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        return cls(rest, **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks the motion."""
        vehicle = assembled(case.vehicle)
        motions = motions_of(vehicle.assembly)
        checks.one_of(self.word, self.mode, motions)
        if vehicle.networks:
            others = ", ".join(one.name for network in vehicle.networks for one in network.strut.elements)
            raise ValueError(f"{self.word} must be of struts of springs and dampers in parallel, got {others}")
        return CaseMeasure(
            values=lambda designs: designs.by_vehicle(lambda one, given: self._of(one.statics, given))
        )

    def _of(self, statics: Mechanics, coefficients: Real) -> Real:
        """Return the measure (p,) at coefficients (p, c)."""
        mass, _, stiffness = matrices_of(statics, coefficients)
        root = np.linalg.cholesky(mass)
        half = np.linalg.solve(root, stiffness)
        values, vectors = np.linalg.eigh(np.linalg.solve(root, np.swapaxes(half, 1, 2)))
        shapes = np.linalg.solve(np.swapaxes(root, 1, 2), vectors)  # of unit modal mass
        chosen = self._share(statics.assembly, mass, shapes).argmax(axis=1)
        squares = np.take_along_axis(values, chosen[:, None], axis=1)[:, 0]
        return np.asarray(np.sqrt(np.maximum(squares, 0.0)) / (2 * np.pi))

    def _share(self, assembly: Assembly, mass: Real, shapes: Real) -> Real:
        """Return the share (p, k) of the motion in the kinetic energy of shapes (p, n, k)."""
        motion = motions_of(assembly)[self.mode]
        inertia = np.einsum("i,pij,j->p", motion, mass, motion)
        along = np.abs(np.einsum("i,pij,pjk->pk", motion, mass, shapes)) ** 2
        return np.asarray(
            along / inertia[:, None] / np.einsum("pik,pij,pjk->pk", shapes.conj(), mass, shapes).real
        )

    def _rest(self) -> str:
        return self.mode


class ModeDamping(ModeFrequency, word="damping_ratio", unit="-"):
    """Damping ratio of a mode, 1 if it is overdamped.

    Parameters
    ----------
    mode, name, maximise
        As of `ModeFrequency`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit.parse("damping_ratio wheel hop >= 0.2"))
    damping_ratio wheel hop >= 0.2
    """

    def _of(self, statics: Mechanics, coefficients: Real) -> Real:
        """Return the measure (p,) at coefficients (p, c)."""
        mass, damping, stiffness = matrices_of(statics, coefficients)
        n, p = mass.shape[1], len(coefficients)
        a = np.zeros((p, 2 * n, 2 * n))
        a[:, :n, n:], a[:, n:, :n] = np.eye(n), -np.linalg.solve(mass, stiffness)
        a[:, n:, n:] = -np.linalg.solve(mass, damping)
        poles, vectors = np.linalg.eig(a)
        chosen = self._share(statics.assembly, mass, vectors[:, n:]).argmax(axis=1)
        pole = np.take_along_axis(poles, chosen[:, None], axis=1)[:, 0]
        return np.asarray(-pole.real / np.abs(pole))


def matrices_of(statics: Mechanics, coefficients: Real) -> tuple[Real, Real, Real]:
    """Return mass, damping and stiffness (p, n, n) at coefficients (p, c) of springs, dampers and inerters."""
    assembly = statics.assembly
    ends, _ = assembly.elongations(assembly.struts)
    inertia = np.array([ends.T @ (one.gain * (one.order == 2)) @ ends for one in assembly.strut_coefficients])
    mass = assembly.mass_matrix + weighted_sum(coefficients, inertia)
    damping = statics.damping + weighted_sum(coefficients, statics.by_damping)
    return mass, damping, statics.stiffness_of(coefficients)


def motions_of(assembly: Assembly) -> dict[str, Real]:
    """Return motions (n,) of the coordinates by name: of wheels of an axle in phase and opposed."""
    found: dict[str, Real] = {}
    wheels = {str(one.upper) for one in assembly.tyres}
    for i, name in enumerate(assembly.coordinates):
        unit = np.eye(len(assembly.coordinates))[i]
        if name not in wheels:
            found["heave" if name == "body" else name.replace("_", " ")] = unit
            continue
        axle = f"{_SIDE.sub('_wheel', name)} hop".replace("_", " ")
        if axle in found:
            found[axle.replace("hop", "tramp")] = found[axle] - unit
        found[axle] = found.get(axle, 0.0) + unit
    return found
