"""Vehicle with an actuator in place of each strut on a wheel, as linear equations relative to its roads.

With displacements z of the vehicle at rest on constant roads x the state is the change from Z x: only rates of the
roads act on it where the vehicle can follow all roads without deflection.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ...quantities import Real
from ...vehicles.assembly import ResponseName
from ...vehicles.feedback import Dynamics, System, gains_by_order, has_states
from ...vehicles.vehicle import Vehicle
from .. import weightings
from ..measures.terms import Term
from ..weightings import SystemWeighting
from .filters import Filter

_NOTHING = 1e-9  # share of the largest entry below which one is rounding


class Rows(NamedTuple):
    """Signals as sums of states, actuator forces, rates of the roads and roads."""

    state: Real  # (m, n)
    force: Real  # (m, q)
    rate: Real  # (m, r)
    road: Real  # (m, r)

    def of(self, rows: object) -> "Rows":
        """Return some of the rows."""
        return Rows(*(part[rows] for part in self))  # type: ignore[call-overload]


class Actuated(NamedTuple):
    """Rates of n states, k weighted terms, the k terms without weighting, q deflections, and sensors."""

    rates: Rows
    terms: Rows
    responses: Rows
    deflections: Rows
    sensors: Rows

    @classmethod
    def of(
        cls,
        vehicle: Vehicle,
        values: Mapping[str, float],
        terms: Sequence[Term],
        sensors: Sequence[ResponseName] = (),
    ) -> "Actuated":
        """Take out the struts on wheels; the others keep their values by coefficient. Sensors read responses.

        ValueError if the vehicle is no state space or has no such strut, or for a term that is no mean square of a
        response with a filter as weighting.
        """
        names = [term.response for term in terms]
        if list(vehicle.without_jerk(names)) != names or any(term.moment for term in terms):
            raise ValueError(f"measures must be without jerk and moments, got {', '.join(map(str, terms))}")
        distinct = list(dict.fromkeys([*names, *sensors]))
        rates, outputs = _relative(_bare(vehicle, values, vehicle.bare(distinct)), vehicle)
        responses = outputs.of([distinct.index(name) for name in names])
        q = rates.force.shape[1]
        read = outputs.of(np.array([distinct.index(name) for name in sensors], dtype=np.int64))
        whole = cls(rates, responses, responses, outputs.of(slice(-q, None)), read)
        return whole.filtered([_filter(term) for term in terms])

    @property
    def load_by_rate(self) -> bool:
        """Whether the rate of a road acts on a term at once, as by a damped tyre."""
        return bool(self.terms.rate.any())

    @property
    def by_road(self) -> bool:
        """Whether constant roads deflect the vehicle, as when four wheels stand on no plane."""
        return bool(self.rates.road.any() or self.terms.road.any())

    def filtered(self, filters: Sequence[Filter | None]) -> "Actuated":
        """Return the equations with a filter behind each term that has one."""
        n = len(self.rates.state)
        sizes = [len(one.b) if one else 0 for one in filters]
        more, start = sum(sizes), n
        rates = Rows(*(np.pad(part, ((0, more), (0, 0))) for part in self.rates))
        rates = rates._replace(state=np.pad(rates.state, ((0, 0), (0, more))))
        terms, responses, deflections, sensors = (
            part._replace(state=np.pad(part.state, ((0, 0), (0, more)))) for part in self[1:]
        )
        terms = Rows(*map(np.array, terms))
        for k, (one, size) in enumerate(zip(filters, sizes, strict=True)):
            if one:
                own = slice(start, start + size)
                for part, row in zip(rates, responses, strict=True):
                    part[own] = np.outer(one.b, row[k])
                rates.state[own, own] += one.a
                for part in terms:
                    part[k] *= one.d
                terms.state[k, own] += one.c
                start += size
        return Actuated(rates, terms, responses, deflections, sensors)


def wheel_struts(vehicle: Vehicle) -> list[int]:
    """Return the indices (q,) of the struts on wheels; ValueError if there is none."""
    found = [vehicle.struts.index(name) for name in vehicle.wheel_struts]
    if not found:
        raise ValueError(f"vehicle must have struts named like its tyres, got {', '.join(vehicle.struts)}")
    return found


def dynamics_of(vehicle: Vehicle, values: Mapping[str, float], ports: Sequence[int]) -> Dynamics:
    """Return the struts at some ports alone."""
    inside = np.isin(np.arange(len(vehicle.struts)), ports)
    gains = gains_by_order(vehicle.strut_coefficients, values, inside.size) * inside[:, None]
    networks = [one._replace(share=tuple(np.where(inside, one.share, 0.0).tolist())) for one in vehicle.networks]
    return Dynamics.of([one for one in networks if any(one.share)], values, gains)


def _bare(vehicle: Vehicle, values: Mapping[str, float], plant: System) -> System:
    """Return the plant with all struts but those on wheels; ValueError unless it is a state space."""
    if not has_states(plant):
        raise ValueError(f"vehicle must be a state space for a controller, got {type(plant).__name__}")
    ports = wheel_struts(vehicle)
    others = [i for i in range(len(vehicle.struts)) if i not in ports]
    return dynamics_of(vehicle, values, others).around(plant) if others else plant


def _relative(plant: System, vehicle: Vehicle) -> tuple[Rows, Rows]:
    """Return the rates of the states relative to the roads, and responses, then deflections of wheel struts."""
    q, r, ports = len(vehicle.struts), len(vehicle.tyres), np.array(wheel_struts(vehicle))
    m = plant.noutputs - 2 * q
    kept = [*range(m), *(m + ports)]
    tension = plant.ninputs - q + ports
    rates, outputs = (
        Rows(left, right[:, tension], right[:, r : plant.ninputs - q], right[:, :r])
        for left, right in ((plant.A, plant.B), (plant.C[kept], plant.D[kept]))
    )
    rates, outputs = (_with_rates(rows, r) for rows in (rates, outputs))
    z = _at_rest(rates, outputs.of(slice(m, None)))
    road = [_cleared(rows.state @ z + rows.road, rows.road) for rows in (rates, outputs)]
    return rates._replace(rate=rates.rate - z, road=road[0]), outputs._replace(road=road[1])


def _with_rates(rows: Rows, r: int) -> Rows:
    """Return rows with the rates of r roads, zeros where they do not act."""
    return rows if rows.rate.shape[1] else rows._replace(rate=np.zeros((len(rows.state), r)))


def _at_rest(rates: Rows, deflections: Rows) -> Real:
    """Return the states (n, r) at rest on constant roads of 1 m with the least deflections of the struts."""
    from scipy.linalg import null_space

    z = np.linalg.lstsq(rates.state, -rates.road, rcond=None)[0]
    free = null_space(rates.state)
    left = deflections.state @ z + deflections.road
    return np.asarray(z - free @ np.linalg.lstsq(deflections.state @ free, left, rcond=None)[0])


def _cleared(values: Real, size: Real) -> Real:
    """Return values that are not rounding beside others."""
    return np.where(np.abs(values) > _NOTHING * np.abs(size).max(initial=1.0), values, 0.0)


def _filter(term: Term) -> Filter | None:
    if term.weighting is None:
        return None
    weighting = weightings.by_name(term.weighting)
    if not isinstance(weighting, SystemWeighting) or weighting.is_measured:
        raise ValueError(f"weighting must be a filter such as Wk for a controller, got {term.weighting}")
    return Filter.of_quotient(*weighting.numbers) if weighting.is_quotient else Filter.of_system(weighting.system)
