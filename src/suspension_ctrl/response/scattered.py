"""Load cases with coefficients and parameters that scatter, and designs by samples."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..quantities import Real
from ..vehicles.altered import plain_sheet
from ..vehicles.formulas import Formulas
from ..vehicles.parameters import Place, parameters_of
from ..vehicles.varied import ported, setting_of
from ..vehicles.vehicle import AssembledVehicle, Vehicle
from .load_case import LoadCase
from .scatter import Scatter

_CORNERS = 64  # least number of corners with parameters at the ends of their ranges


class Scattered(NamedTuple):
    """Load cases with ports for what scatters; a design (d,) of the problem has a value (v,) for each name.

    Values are those of coefficients, of parameters over the nominal ones. Springs, dampers and tyres stand in
    place of frequencies and damping ratios: they are chosen for the nominal vehicle, then scatter.
    """

    cases: tuple[LoadCase, ...]
    names: tuple[str, ...]  # (v,), first the variables of the problem
    fixed: Mapping[str, float]
    formulas: Formulas  # nominal values (p, v) by designs (p, d)
    factors: Real  # (s, v), samples; 1 of what does not scatter
    ends: Real  # (2, v), least and largest factors
    relative: tuple[str, ...]  # the last names, of parameters over their nominal values

    @classmethod
    def of(
        cls, scatter: Scatter, cases: Sequence[LoadCase], variables: Sequence[str], fixed: Mapping[str, float]
    ) -> "Scattered":
        """Take the scatter of load cases with variables (d,) and `fixed` values; ValueError about its names."""
        vehicles = [case.vehicle for case in cases]
        sheet, slots, replaced = plain_sheet(vehicles[0], variables, fixed)
        known = _known(vehicles, variables, fixed, replaced)
        deviations = scatter.of([*known.own, *known.coefficients, *known.parameters])
        absolute = [*known.own, *(name for name in known.coefficients if name in deviations)]
        relative = [name for name in known.parameters if name in deviations]
        names = (*absolute, *relative)
        given = {name: value for name, value in fixed.items() if not {name, replaced.get(name)} & {*absolute}}
        nominal = [*(slots[name] for name in absolute), *(sheet.constant(1.0) for _ in relative)]
        varied = [ported(vehicle, absolute, given, vehicles[0], relative) for vehicle in vehicles]
        moving = [i for i, name in enumerate(names) if name in deviations]
        factors, ends = np.ones((scatter.samples, len(names))), np.ones((2, len(names)))
        factors[:, moving] = scatter.factors(deviations[names[i]] for i in moving)
        ends[:, moving] += np.array([deviations[names[i]] for i in moving]).reshape(-1, 2).T
        return cls(
            tuple(replace(case, vehicle=one) for case, one in zip(cases, varied, strict=True)),
            names,
            given,
            sheet.formulas(nominal),
            factors,
            ends,
            tuple(relative),
        )

    def designs(self, designs: Real) -> Real:
        """Return the samples (p s, v) of designs (p, d), design by design."""
        every = self.formulas.of(designs)[:, None, :] * self.factors
        return np.asarray(every.reshape(-1, len(self.names)))

    def settings(self, design: Real) -> list[dict[str, float]]:
        """Return the coefficients of each load case at a design (d,)."""
        values = dict(zip(self.names, self.formulas.of(design[None])[0].tolist(), strict=True))
        return [setting_of(case.vehicle, values, self.fixed) for case in self.cases]

    def corners(self, corners: Real, lower: Real, upper: Real) -> Real:
        """Return corners (k, v) of the box that samples reach beyond corners (c, d) of the problem's box.

        A variable at a bound has the factor that leads beyond it, all others either of their ends.
        """
        every = np.tile(corners, (-(-_CORNERS // len(corners)), 1))
        sides = np.random.default_rng(0).integers(0, 2, (len(every), len(self.names)))
        sides[:, : lower.size][:, lower < upper] = (2 * every > lower + upper)[:, lower < upper]
        return np.asarray(self.formulas.of(every) * np.take_along_axis(self.ends, sides, axis=0))


class _Known(NamedTuple):
    """Names that may scatter: first those of variables, and of what follows from frequencies and ratios."""

    own: list[str]
    coefficients: list[str]  # with one value above zero in all load cases
    parameters: list[str]


def names_of(cases: Sequence[LoadCase], variables: Sequence[str], fixed: Mapping[str, float]) -> list[str]:
    """Return the names that may scatter; arguments as of `Scattered.of`."""
    vehicles = [case.vehicle for case in cases]
    known = _known(vehicles, variables, fixed, plain_sheet(vehicles[0], variables, fixed)[2])
    return [*known.own, *known.coefficients, *known.parameters]


def _known(
    vehicles: Sequence[Vehicle], variables: Sequence[str], fixed: Mapping[str, float], replaced: Mapping[str, str]
) -> _Known:
    own = [replaced.get(name, name) for name in variables] + [replaced[name] for name in fixed if name in replaced]
    first, *others = (
        {one.name: fixed.get(one.name, one.default) for one in vehicle.strut_coefficients} for vehicle in vehicles
    )
    common = (name for name, value in first.items() if value and all(one.get(name) == value for one in others))
    coefficients = [name for name in common if name not in own]
    return _Known(own, coefficients, _parameters(vehicles, {*own, *coefficients}))


def _parameters(vehicles: Sequence[Vehicle], others: set[str]) -> list[str]:
    """Return the parameters beside `others` of which a vehicle has a value above zero: no places."""
    found: dict[str, None] = {}
    for vehicle in vehicles:
        if isinstance(vehicle, AssembledVehicle):
            for name, one in parameters_of(vehicle.assembly).items():
                if name not in others and not isinstance(one, Place) and one.default > 0:
                    found[name] = None
    return list(found)
