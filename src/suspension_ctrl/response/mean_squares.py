"""Mean squares of a load case's responses over designs: one interface, in Python and in compiled code.

A case is a named tuple of arrays with a compiled method ``mean_squares`` from designs (p, v) to mean squares
(p, k): `OneStrut` for a single spring and damper, `ManyStruts` for the rest.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numba import types
from numba.extending import overload_method

from ..quantities import Real
from . import weightings
from .blocks import Pairs, Variables, in_blocks
from .load_case import LoadCase
from .many_struts import ManyStruts
from .measures import Term
from .one_strut import OneStrut
from .ports import Ports
from .quadrature import frequency_nodes

Case = OneStrut | ManyStruts


@overload_method(types.BaseNamedTuple, "mean_squares", inline="always")
def _of_its_class(self: Any, designs: Any) -> Callable[..., Any]:  # noqa: ARG001  # numba matches names
    """Call the method of a case's class in compiled code, which knows no methods of named tuples."""
    method = self.instance_class.mean_squares

    def compiled(self: Any, designs: Any) -> Any:
        return method(self, designs)

    return compiled


def case_of(
    load_case: LoadCase,
    terms: Sequence[Term],
    setting: Mapping[str, float],
    variables: Sequence[str],
    band: tuple[float, float],
    nodes: int,
    pairs: Callable[[Sequence[str], Real], Pairs] = Pairs.of,
) -> Case:
    """Return a load case ready for the mean squares (k,) of terms over designs of the variables (v,).

    The `setting` has every coefficient, of the variables a value in the middle of its range; `pairs` tells by
    names of struts and contact points which to pair.
    """
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
    if load_case.wheels == 1 and [p.name for p in vehicle.parameters] == list(variables) == ["spring", "damper"]:
        return OneStrut.around(Ports.of(vehicle, f, responses), omega, densities * load_case.psd(f))
    ports, roads = Ports.of(vehicle, f, responses, setting), load_case.cross_spectrum(f)
    varied = Variables.of(vehicle.parameters, {name: setting[name] for name in variables})
    return in_blocks(ports, omega, roads, densities, varied, pairs(vehicle.struts, vehicle.contact_points))
