"""Measures of modes: undamped natural frequencies and damping ratios, by the name of a motion.

Of all modes the one counts that has the largest share of its kinetic energy in the motion.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import checks
from ...quantities import Real
from ...vehicles.assembly import Assembly
from ...vehicles.handling import Mechanics, weighted_sum
from ...vehicles.modes import energy_along, motions_of
from ...vehicles.vehicle import assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import CaseMeasure


@dataclass(frozen=True, eq=False, repr=False)
class ModeFrequency(Measure, word="frequency", unit="Hz"):
    """Natural frequency of a mode without dampers, from stiffnesses and masses.

    Of all modes the one counts that has the largest share of its kinetic energy in the motion. Two motions that
    mix in it may have the same mode; the table of `Vehicle.modes` names each mode once.

    Parameters
    ----------
    mode : str
        Its motion as in the table of `Vehicle.modes`: ``"heave"``, ``"pitch"``, ``"roll"``, ``"front wheel hop"``
        (in phase) and ``"front wheel tramp"``, a seat by its name, of further bodies ``"cab heave"``.
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
            others = checks.listing(one.name for network in vehicle.networks for one in network.strut.elements)
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
        moved = assembly.displacements @ shapes
        along = energy_along(motions_of(assembly)[self.mode], assembly.inertia, moved)
        return np.asarray(along / np.einsum("pik,pij,pjk->pk", shapes.conj(), mass, shapes).real)

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
