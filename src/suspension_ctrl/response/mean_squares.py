"""Mean squares of a load case's responses over designs: one interface, in Python and in compiled code.

A case is a compiled function from designs (p, v) to mean squares (p, k): `OneStrut` for one spring and one damper,
`ManyStruts` for all others.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ..quantities import Real
from . import weightings
from .blocks import Pairs, Variables, in_blocks, pairs_of
from .load_case import LoadCase
from .many_struts import ManyStruts
from .measures.terms import Term
from .one_strut import OneStrut
from .ports import Ports
from .quadrature import frequency_nodes

Case = OneStrut | ManyStruts


def cases_of(
    load_cases: Sequence[LoadCase],
    terms: Sequence[Sequence[Term]],
    settings: Sequence[Mapping[str, float]],
    variables: Sequence[str],
    band: tuple[float, float],
    nodes: int,
) -> tuple[Case, ...]:
    """Return `case_of` each load case, all of one class for compiled loops."""
    each = zip(load_cases, terms, settings, strict=True)
    one_strut = all(fits_one_strut(case, variables) for case in load_cases)
    return tuple(case_of(*case, variables, band, nodes, one_strut=one_strut) for case in each)


def fits_one_strut(load_case: LoadCase, variables: Sequence[str]) -> bool:
    """Whether there is one wheel, and one strut of a spring and a damper that both vary."""
    names = [one.name for one in load_case.vehicle.strut_coefficients]
    return load_case.wheels == 1 and names == list(variables) == ["spring", "damper"]


def case_of(
    load_case: LoadCase,
    terms: Sequence[Term],
    setting: Mapping[str, float],
    variables: Sequence[str],
    band: tuple[float, float],
    nodes: int,
    pairs: Callable[[Sequence[str], Real], Pairs] = pairs_of,
    one_strut: bool = True,
) -> Case:
    """Return the mean squares (k,) of terms over the variables (v,), around a setting in the middle of the box."""
    if load_case.vehicle.networks:
        names = ", ".join(one.strut.elements[0].name for one in load_case.vehicle.networks)
        raise ValueError(f"struts must be of springs, dampers and inerters in parallel, got {names}")
    weights = [term.weighting and weightings.by_name(term.weighting) for term in terms]
    kinks = {f for weighting in weights if weighting for f in weighting.breakpoints}
    f, w = frequency_nodes(band, nodes, kinks.union(load_case.breakpoints))
    omega, vehicle = 2 * np.pi * f, load_case.vehicle
    densities = np.array(
        [
            w * omega**term.moment * (weighting.factor(f) ** 2 if weighting else 1.0)
            for term, weighting in zip(terms, weights, strict=True)
        ]
    ).reshape(len(terms), f.size)
    responses = [term.response for term in terms]
    if one_strut and fits_one_strut(load_case, variables):
        return OneStrut.around(Ports.of(vehicle, f, responses), omega, densities * load_case.psd(f))
    ports, roads = Ports.of(vehicle, f, responses, setting), load_case.cross_spectrum(f)
    varied = Variables.of(vehicle.strut_coefficients, {name: setting[name] for name in variables})
    return in_blocks(ports, omega, roads, densities, varied, pairs(vehicle.struts, vehicle.contact_points))
