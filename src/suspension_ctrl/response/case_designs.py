"""Designs in a load case as measures by a function get them: coefficients, spectra, mean travels, vehicles."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..quantities import Complex, Real
from ..vehicles.assembly import ResponseName
from ..vehicles.feedback import gains_by_order
from ..vehicles.varied import Varied
from ..vehicles.vehicle import Vehicle
from .linearisation import linear_vehicles, powers_of_laws, working_points
from .load_case import LoadCase
from .mapped import unmapped
from .mean_squares import Case, has_networks, quadrature_of, varying
from .measures.terms import Designs, Term
from .ports import Ports, dynamic_stiffness, paths
from .quadrature import Rule, middles


@dataclass(frozen=True, eq=False)
class EvaluatedCase:
    """A load case in which designs are evaluated; a `Case` beside it has their mean squares at some nodes."""

    case: LoadCase
    setting: Mapping[str, float]  # all coefficients, of those that vary a value in the middle of the range
    terms: tuple[Term, ...]  # those of the mean squares
    variables: Sequence[str]
    band: tuple[float, float]
    seen: int | None  # of the variables, the first that functions get

    def designs(self, squares_of: Case, designs: Real, squares: Real) -> Designs:
        """Return designs (p, v) with the mean squares (p, k) of their terms."""
        vehicle, (inner, linear) = self.case.vehicle, unmapped(squares_of, designs)
        coefficients = self._coefficients(linear)

        def mean_squares(terms: Sequence[Term]) -> Real:
            return np.asarray(squares[:, [self.terms.index(term.integral) for term in terms]])

        def mean_travels() -> Real:
            if has_networks(inner):
                return working_points(inner, linear).position
            return np.zeros((len(designs), len(vehicle.struts)))

        def law_powers() -> Real:
            if has_networks(inner):
                return powers_of_laws(inner, working_points(inner, linear))
            return np.zeros((len(designs), len(vehicle.struts)))

        def spectra() -> Iterator[tuple[Real, Mapping[str, Real]]]:
            return self._spectra(inner, linear, coefficients)

        def vehicles() -> Iterator[tuple[Vehicle, Real]]:
            if not isinstance(vehicle, Varied):
                yield vehicle, coefficients
                return
            for design in designs:
                own, setting = vehicle.with_design(design)
                yield own, np.array([list(setting.values())])

        return Designs(
            designs[:, : self.seen], coefficients, spectra, mean_squares, mean_travels, law_powers, vehicles
        )

    def summands(self, squares_of: Case, designs: Real, nodes: int) -> tuple[Rule, Real]:
        """Return a rule of n nodes and the summands (p k, n) of the mean squares of designs (p, v).

        Of a case without networks.
        """
        f, w, densities = quadrature_of(self.case, self.terms, self.band, nodes)
        _, linear = unmapped(squares_of, designs)
        names, several = [term.response for term in self.terms], self.case.wheels > 1
        roads = self.case.cross_spectrum(f) if several else self.case.psd(f)[:, None, None]
        h = self._paths(f, names, self._coefficients(linear))
        return Rule(f, w), np.concatenate([np.multiply(densities, _spectra(one, roads)) for one in h])

    @cached_property
    def places(self) -> list[int]:
        """Places of the coefficients that vary among all."""
        known = list(self.setting)
        return [known.index(name) for name in varying(self.case.vehicle, self.variables)]

    def _coefficients(self, linear: Real) -> Real:
        """Return all coefficients (p, c) by those that vary (p, w)."""
        coefficients = np.tile(list(self.setting.values()), (len(linear), 1))
        coefficients[:, self.places] = linear
        return coefficients

    def _spectra(
        self, inner: Case, designs: Real, coefficients: Real
    ) -> Iterator[tuple[Real, Mapping[str, Real]]]:
        """Yield frequencies (n,) [Hz] and the spectra of all responses for each of designs (p, w)."""
        vehicle, f = self.case.vehicle, middles(self.band)
        roads = self.case.cross_spectrum(f)
        if has_networks(inner):
            for one in linear_vehicles(vehicle, list(self.setting), inner, designs, coefficients):
                yield f, dict(zip(one.responses, _spectra(paths(one.closed(), f), roads), strict=True))
            return
        for h in self._paths(f, vehicle.responses, coefficients):
            yield f, dict(zip(vehicle.responses, _spectra(h, roads), strict=True))

    def _paths(self, f: Real, names: Sequence[ResponseName], coefficients: Real) -> Iterator[Complex]:
        """Yield frequency responses (n, m, r) of a case without networks for coefficients (p, c)."""
        vehicle, known = self.case.vehicle, self.setting
        ports = Ports.of(vehicle, f, names, known)
        for row in coefficients - np.array(list(known.values())):
            added = dict(zip(known, row.tolist(), strict=True))
            gains = gains_by_order(vehicle.strut_coefficients, added, len(vehicle.struts))
            yield ports.around(dynamic_stiffness(gains, 2 * np.pi * f)).h[:, : ports.m, : ports.r]


def _spectra(h: Complex, roads: Complex | Real) -> Real:
    """Return the spectra (m, n) of responses by frequency responses (n, m, r) to roads (n, r, r)."""
    return np.asarray(np.einsum("nmi,nij,nmj->mn", h, roads, h.conj()).real)
