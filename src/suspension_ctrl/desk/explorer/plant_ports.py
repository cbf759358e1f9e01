"""Responses of a vehicle's plant at its strut ports over frequency, around which a page closes struts."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...quantities import Bool, Complex, Integer, Real, signal_unit
from ...response import weightings
from ...response.any_struts import AnyStruts
from ...response.blocks import Variables
from ...response.curves import frequencies
from ...response.mapped import Mapped
from ...response.mean_squares import Case, has_networks, varying
from ...response.measures.terms import Term
from ...response.network_rows import Networks
from ...response.ports import Ports
from ...response.scores import Scores
from ...response.strut_data import apart, networks_of
from ...tables.headers import shown_unit
from ...vehicles.assembly import ResponseName, label
from ...vehicles.force_laws import ForceLaw
from ...vehicles.vehicle import Vehicle

POINTS = 200
"""Frequencies of a curve."""


class PlantPorts(NamedTuple):
    """A load case at n frequencies: m responses and q deflections by r roads and q tensions, around an origin."""

    responses: tuple[str, ...]
    units: tuple[tuple[str, float], ...]  # as engineers read them, with the factor
    f: Real  # (n,) [Hz]
    omega: Real  # (n,) [rad/s]
    m: int
    r: int
    q: int
    h: Complex  # (n, m + q, r + q)
    roads: Complex  # (n, r, r), cross-spectra [m^2/Hz]
    delays: Real  # (r,), of the wheels behind the first [s]
    weights: Real  # (m, n), squared weighting of each response, 1 without
    gain: Real  # (v, q, q), tensions of each coefficient at 1 by deflections or their derivatives of its order
    order: Integer  # (v,)
    origin: Real  # (v,), values of the coefficients that are in h already
    struts: tuple[str, ...]  # (q,)
    laws: tuple[str, ...]  # names of the force laws; one stands for left and right where they are alike
    networks: Networks | None
    nominal: Real  # (t, 2), stiffness and damping in place of each network in h


def plant_ports(scores: Scores, number: int, case: Case, points: int = POINTS) -> PlantPorts:
    """Return the ports of a load case of scores, with its mean squares, for the responses of its terms."""
    load_case, setting = scores.cases[number], scores.settings[number]
    vehicle, names = load_case.vehicle, varying(load_case.vehicle, scores.variables)
    weighted = _weightings(scores.terms[number])
    f, responses = frequencies(scores.band, points), list(weighted)
    inner = case.case if isinstance(case, Mapped) else case
    networks, nominal = _networks(vehicle, setting, names, inner, f)
    gains = None
    if networks is not None:
        gains = np.array([np.diag(one @ networks.ports) for one in (*nominal.T, np.zeros(len(nominal)))])
    ports = Ports.of(vehicle, f, responses, setting, gains)
    variables = Variables.of(vehicle.strut_coefficients, {name: setting[name] for name in names})
    x = vehicle.contact_points[:, 0]
    factors = [np.ones_like(f) if one is None else weightings.by_name(one).factor(f) for one in weighted.values()]
    return PlantPorts(
        responses=tuple(map(label, responses)),
        units=tuple(shown_unit(signal_unit(label(one))) for one in responses),
        f=f,
        omega=2 * np.pi * f,
        m=ports.m,
        r=ports.r,
        q=len(vehicle.struts),
        h=ports.h,
        roads=load_case.cross_spectrum(f),
        delays=(x.max() - x) / load_case.speed,
        weights=np.square(factors),
        gain=variables.gain,
        order=variables.order,
        origin=variables.origin,
        struts=tuple(vehicle.struts),
        laws=tuple(_law_names(vehicle, inner.networks)) if has_networks(inner) else (),
        networks=networks,
        nominal=nominal,
    )


def _weightings(terms: Sequence[Term]) -> dict[ResponseName, Any]:
    """Return the responses of terms, each once, with the first weighting that one has."""
    found: dict[ResponseName, Any] = {}
    for term in terms:
        found[term.response] = found.get(term.response) or term.weighting
    return found


def _networks(
    vehicle: Vehicle, setting: Mapping[str, float], names: Sequence[str], case: Case, f: Real
) -> tuple[Networks | None, Real]:
    """Return networks at frequencies (n,), whose laws are those of the case, and what stands for them."""
    if not has_networks(case):
        return None, np.zeros((0, 2))
    networks = networks_of(vehicle, setting, names, f, _partners(case.networks))
    return networks, case.nominal if isinstance(case, AnyStruts) else np.zeros((len(networks.root), 2))


def _partners(networks: Networks) -> Bool:
    """Return which ports (q, q) have a network in common."""
    ports = networks.ports.astype(int)
    return np.asarray(ports.T @ ports > 0)


def _law_names(vehicle: Vehicle, networks: Networks) -> Iterator[str]:
    """Yield the names of force laws, after the strut where the networks of the vehicle stand at several."""
    partners = _partners(networks)
    for network in vehicle.networks:
        placed = apart(network, partners)
        for one in placed:
            prefix = f"{vehicle.struts[one.share.index(1.0)]}." if len(placed) > 1 else network.prefix
            yield from (prefix + law.name for law in one.strut.elements if isinstance(law, ForceLaw))
