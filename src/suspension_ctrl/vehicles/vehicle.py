"""What every vehicle can do: masses and tyres are the plant, struts are feedback around it.

Deflections are positive in extension, forces in tension, as in equations (7) and (11) of the paper.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING

import control
import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..quantities import Real, unit_of
from .assembly import Assembly, Response, ResponseName, StrutParameter
from .modes import Mode, modes_of

if TYPE_CHECKING:
    import pandas as pd


Settings = Mapping[str, float | tuple[float, float]]
"""Coefficients of struts: ``{"front.spring": 2e4, ...}``, or in pairs, ``{"front": (2e4, 1500.0), ...}``."""


class Vehicle(ABC):
    """What all vehicles have in common; each says how it is assembled."""

    @abstractmethod
    def assembly(self) -> Assembly:
        """Return the vehicle taken apart; ValueError if it was measured as a whole."""

    @property
    def meanings(self) -> Mapping[str, Response]:
        """What each response is, by name."""
        return self.assembly().responses

    @property
    def responses(self) -> tuple[str, ...]:
        """Names of the responses; accelerations ``("acceleration", x, y)`` can be asked for beside them."""
        return tuple(self.meanings)

    @property
    def tyres(self) -> tuple[str, ...]:
        """Names of the tyres; struts over them are called the same."""
        return tuple(tyre.name for tyre in self.assembly().tyres)

    @property
    def struts(self) -> tuple[str, ...]:
        """Names of the struts."""
        return tuple(strut.name for strut in self.assembly().struts)

    @property
    def contact_points(self) -> NDArray[np.float64]:
        """Where each road input touches the ground, x forward and y to the left [m], (r, 2)."""
        return np.array(list(self.assembly().contacts.values()))

    @property
    def parameters(self) -> tuple[StrutParameter, ...]:
        """Coefficients of the struts."""
        return tuple(self.assembly().parameters)

    def plant(self, responses: Sequence[ResponseName] | None = None) -> control.StateSpace:
        """Return the vehicle without its struts, each of which has a port here instead.

        Parameters
        ----------
        responses : sequence of str or ("acceleration", x, y), optional
            Its first outputs; all that have a name if not given.

        Returns
        -------
        control.StateSpace
            Inputs ``<wheel>_road`` [m], where a tyre is damped ``<wheel>_road_rate`` [m/s], and ``<strut>_strut``
            (its tension [N]); outputs the responses, then ``<strut>_deflection`` [m] and
            ``<strut>_deflection_rate`` [m/s]. A quarter car has nothing before the underscore.
        """
        plant = self.assembly().plant(self.responses if responses is None else responses)
        plant.update_names(name="plant")
        return plant

    def with_struts(
        self, settings: Settings, responses: Sequence[ResponseName] | None = None
    ) -> control.StateSpace:
        """Return the vehicle with its struts, from roads to responses.

        Parameters
        ----------
        settings : mapping
            The coefficients, each above zero but for anti-roll bars, which may have none.
        responses : sequence of str or ("acceleration", x, y), optional
            All that have a name if not given.

        Returns
        -------
        control.StateSpace
            From roads [m], and their rates [m/s] where a tyre is damped, to the responses.

        Raises
        ------
        ValueError
            If a coefficient is unknown, missing, or out of range.
        """
        plant = self.plant(responses)
        closed = around(plant, np.hstack(self.strut_gains(settings)))
        q = len(self.struts)
        return control.ss(
            closed.A,
            closed.B[:, :-q],
            closed.C[: -2 * q],
            closed.D[: -2 * q, :-q],
            states=plant.state_labels,
            inputs=plant.input_labels[:-q],
            outputs=plant.output_labels[: -2 * q],
            name="vehicle",
        )

    def strut_gains(self, settings: Settings) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return tensions of the struts by their deflections and by the rates of those, (q, q) each."""
        values = self.coefficients(settings)
        q = len(self.struts)
        gains = np.zeros((2, q, q))
        for parameter in self.parameters:
            gains[parameter.order] += values[parameter.name] * parameter.gain
        return gains[0], gains[1]

    def coefficients(self, settings: Settings) -> dict[str, float]:
        """Return every coefficient by its name, defaults included; ValueError where `settings` does not fit."""
        given: dict[str, float] = {}
        for name, value in settings.items():
            if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str):
                if len(value) != 2:
                    raise ValueError(f"struts must have two numbers, spring and damper, for {name}, got {value!r}")
                prefix = f"{name}." if name else ""
                pair = {f"{prefix}spring": value[0], f"{prefix}damper": value[1]}
            else:
                pair = {name: value}
            if twice := given.keys() & pair:
                raise ValueError(f"struts must have each coefficient once, got {min(twice)} twice")
            given |= pair
        known = {parameter.name: parameter for parameter in self.parameters}
        for name in given:
            checks.one_of("struts", name, known)
        missing = [name for name, parameter in known.items() if name not in given and parameter.default is None]
        if missing:
            raise ValueError(f"struts must have {', '.join(known)}, got none for {', '.join(missing)}")
        for name, value in given.items():
            check = checks.not_negative if known[name].default == 0 else checks.positive
            check(name, value, known[name].unit)
        return {name: given.get(name, p.default or 0.0) for name, p in known.items()}

    def modes(self, settings: Settings) -> "pd.DataFrame":
        """Return the modes of the vehicle with its struts, by rising frequency.

        Returns
        -------
        DataFrame
            ``name``, ``frequency [Hz]`` (undamped), ``damping ratio [-]``, and by coordinate the complex amplitude
            in the mode, the largest being 1 (metres, and radians for pitch and roll). A real pole, of what is
            damped too much to swing, is a row with damping ratio 1. The name is that of where most kinetic energy
            is.
        """
        assembly = self.assembly()
        found = modes_of(self.with_struts(settings), assembly.coordinates, np.diag(assembly.mass_matrix()))
        return Mode.table(found, assembly.coordinates)


class Car(Vehicle):
    """A vehicle with more than one strut, whose coefficients are given by name."""

    def closed(self, settings: Settings, responses: Sequence[ResponseName] | None = None) -> control.StateSpace:
        """Return the vehicle with its struts, as `with_struts`: ``{"front": (spring, damper), ...}``."""
        return self.with_struts(settings, responses)


def check_parameters(vehicle: Vehicle) -> None:
    """Raise ValueError unless all fields of a dataclass are finite and above zero; tyres may have no damping."""
    for field in fields(vehicle):  # type: ignore[arg-type]
        check = checks.not_negative if field.name.endswith("tyre_damping") else checks.positive
        check(field.name, getattr(vehicle, field.name), unit_of(field.name))


def spring_and_damper(
    name: str, share: Sequence[float], defaults: tuple[float | None, float | None] = (None, None)
) -> list[StrutParameter]:
    """Return the two coefficients called `name`, of those struts whose `share` (q,) is 1."""
    gain, prefix = np.diag(share), f"{name}." if name else ""
    return [
        StrutParameter(f"{prefix}spring", "N/m", gain, 0, defaults[0]),
        StrutParameter(f"{prefix}damper", "N s/m", gain, 1, defaults[1]),
    ]


def anti_roll_bar(name: str, difference: Sequence[float], track: float) -> StrutParameter:
    """Return the stiffness of a bar that resists a `difference` (q,) of travels, none if it is not given."""
    return StrutParameter(name, "N m/rad", np.outer(difference, difference) / track**2, 0, 0.0)


def check_measured(omega: Real, lines: Real) -> None:
    """Raise ValueError unless angular frequencies [rad/s] lie within the ascending `lines` of a table."""
    found, known = (np.array([x.min(), x.max()]) / (2 * np.pi) for x in (omega, lines))
    if not known[0] <= found[0] <= found[1] <= known[1]:
        raise ValueError(
            "band must lie within what was measured, {:g} to {:g} Hz, got frequencies from {:g} to {:g} Hz".format(
                *known, *found
            )
        )


def around(
    plant: control.StateSpace | control.FrequencyResponseData, gain: Real
) -> control.StateSpace | control.FrequencyResponseData:
    """Return the plant with a static `gain` (q, 2 q) from its last outputs to its last inputs, which all stay.

    `control.StateSpace.lft` is the same but for its check, which refuses gains above some 1e7.
    """
    q = len(gain)
    if isinstance(plant, control.StateSpace):
        b, c, d = plant.B[:, -q:], plant.C[-2 * q :], plant.D[:, -q:]  # no strut moves at once by its tension
        return control.ss(plant.A + b @ gain @ c, plant.B, plant.C + d @ gain @ c, plant.D)
    h = np.moveaxis(plant.frdata, 2, 0)
    loop = np.eye(q) - gain @ h[:, -2 * q :, -q:]
    closed = h + h[:, :, -q:] @ np.linalg.solve(loop, gain @ h[:, -2 * q :])
    return control.frd(np.moveaxis(closed, 0, 2), plant.omega)
