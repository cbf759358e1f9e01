"""Vehicles: masses and tyres are the plant, struts are feedback around it.

Deflections are positive in extension, forces in tension, as in equations (7) and (11) of Yuen and Ramli (2010).
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import checks
from ..quantities import Real, frozen_array
from .assembly import Assembly, Network, Position, Response, ResponseName, StrutCoefficient, label
from .feedback import Dynamics, System, gains_by_order, selected, with_rates
from .handling import Mechanics
from .modes import modes_of
from .motion import plant_of
from .state_matrices import StateMatrices
from .static import static_of

if TYPE_CHECKING:
    import control
    import pandas as pd

Pair = tuple[float, float]  # spring [N/m] and damper [N s/m] of a strut
Struts = Mapping[str, float | Pair]
"""Coefficients by name, ``{"front.spring": 2e4, ...}``, or in pairs, ``{"front": (2e4, 1500.0)}``."""
Setting = Struts | Pair  # the pair of the one strut of a quarter car


class Vehicle(ABC):
    """A plant with a port for every strut, and the coefficients of the struts."""

    @property
    @abstractmethod
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of each response, by name."""

    @property
    @abstractmethod
    def contacts(self) -> Mapping[str, Position]:
        """Point (x, y) by tyre where it touches its road, x forward and y to the left [m]."""

    @property
    @abstractmethod
    def struts(self) -> tuple[str, ...]:
        """Names of the struts; one over a tyre has its name."""

    @property
    def wheel_struts(self) -> tuple[str, ...]:
        """Names of the struts on wheels: those named like a tyre."""
        return tuple(name for name in self.struts if name in self.contacts)

    @property
    @abstractmethod
    def strut_coefficients(self) -> tuple[StrutCoefficient, ...]:
        """Coefficients of the struts."""

    @property
    def networks(self) -> tuple[Network, ...]:
        """Parts of the struts beside springs and dampers in parallel."""
        return ()

    @property
    def variables(self) -> Mapping[str, Any]:
        """What may vary, by name, each with a ``unit``: coefficients, then parameters and frequencies."""
        return {one.name: one for one in self.strut_coefficients}

    @abstractmethod
    def plant(self, responses: Sequence[ResponseName] | None = None) -> System:
        """Return the vehicle without its struts, with a port for each.

        Parameters
        ----------
        responses : sequence of str or ("acceleration", x, y), optional
            The first outputs, of `meanings` any but a jerk; `responses` if not given.

        Returns
        -------
        control.StateSpace or control.FrequencyResponseData
            Inputs ``<wheel>_road`` [m], for a damped tyre ``<wheel>_road_rate`` [m/s], and ``<strut>_strut``
            (tension [N]); outputs the responses, then ``<strut>_deflection`` [m] and
            ``<strut>_deflection_rate`` [m/s]. Names of a quarter car have nothing before the underscore.

        Raises
        ------
        ValueError
            If `responses` is no list, or one of them is unknown or given twice.
        """

    def bare(self, responses: Sequence[ResponseName] | None = None) -> System:
        """Return `plant` as the library computes with it: `StateMatrices` of masses and links."""
        return self.plant(responses)

    @property
    @abstractmethod
    def responses(self) -> tuple[str, ...]:
        """Names of the responses that `plant` and `closed` have if not told others; `meanings` has all."""

    @property
    def tyres(self) -> tuple[str, ...]:
        """Names of the tyres."""
        return tuple(self.contacts)

    @property
    def contact_points(self) -> Real:
        """Points (r, 2) where the tyres touch their roads, x forward and y to the left [m]."""
        return frozen_array(list(self.contacts.values()))

    def closed(
        self,
        setting: Setting | None = None,
        /,
        *others: Any,
        responses: Sequence[ResponseName] | None = None,
        **struts: Any,
    ) -> System:
        """Return the vehicle with its struts.

        Parameters
        ----------
        setting : mapping of str to float or (float, float), or (float, float)
            Coefficients by name, ``{"front.spring": 10e3, ...}``, or springs and dampers by strut,
            ``{"front": (10e3, 2000.0), ...}``, of a quarter car the pair alone; each > 0, an anti-roll bar >= 0.
            Keywords are a setting too: ``closed(front=(10e3, 2000.0), rear=(13e3, 2000.0))``. More of
            `variables` may stand beside them, ``"body_mass"``, or in their place, ``"front.ride_frequency"``.
        responses : sequence of str or ("acceleration", x, y), optional
            The outputs, any of `meanings`; `responses` if not given.

        Returns
        -------
        control.StateSpace or control.FrequencyResponseData
            From roads [m], and their rates [m/s] where a tyre is damped, to the responses.

        Raises
        ------
        ValueError
            If a coefficient is unknown, missing or out of range; about responses as `plant`.
        """
        if others:
            got = checks.shown((setting, *others))
            raise ValueError(f"setting must be one mapping, or keywords by strut or coefficient, got {got}")
        vehicle, values = self.at(setting, **struts)
        closed = _closed(vehicle, values, self.responses if responses is None else responses)
        return closed.system() if isinstance(closed, StateMatrices) else closed

    def at(self, setting: Setting | None = None, /, **struts: Any) -> "tuple[Vehicle, dict[str, float]]":
        """Return the vehicle with the parameters of a setting, and every coefficient by its name, see `closed`."""
        return self, _complete(self, coefficients_by_name(setting, struts))

    def without_jerk(self, responses: Sequence[ResponseName]) -> list[ResponseName]:
        """Return the responses with the acceleration in place of each jerk."""
        checks.listed("responses", responses)
        for one in responses:
            if not isinstance(one, str | tuple):
                checks.one_of("response", one, self.meanings)
        jerks = {name for name, meaning in self.meanings.items() if meaning.kind == "jerk"}
        return [str(one).replace("jerk", "acceleration") if one in jerks else one for one in responses]

    def coefficients(self, setting: Setting | None = None, /, **struts: Any) -> dict[str, float]:
        """Return every coefficient by its name, defaults included; arguments and errors as of `closed`."""
        return self.at(setting, **struts)[1]

    def linearised(
        self, setting: Setting, road: Any, speed: float, *, band: tuple[float, float] | None = None
    ) -> "Vehicle":
        """Return the vehicle with linear struts in place of force laws, as on a road; see `linearised`."""
        import suspension_ctrl  # the package's top: a vehicle knows no response

        found: Vehicle = suspension_ctrl.linearised(self, setting, road, speed, band=band)
        return found

    def modes(self, setting: Setting | None = None, /, **struts: Any) -> "pd.DataFrame":
        """Return the modes with struts; arguments and errors as of `closed`, but that a damper may be 0.

        Returns
        -------
        DataFrame
            By rising ``frequency [Hz]``, of masses and springs without any damper. ``damped frequency [Hz]`` and
            ``damping ratio [-]`` are those of the pair of poles to which the mode leads if all dampers rise
            from 0 to their values: of an overdamped mode 0 Hz and a ratio of 1 or more, ``-(p1 + p2)/(2 (p1
            p2)^0.5)`` of two real poles. ``name`` is that of the motion with most of the kinetic energy,
            different for each mode; by motion follows the complex amplitude with dampers, the largest being 1
            (metres, and radians for pitch and roll), of two real poles at the slower one.
        """
        given = coefficients_by_name(setting, struts)
        dampers = {one.name for one in self.strut_coefficients if one.unit == "N s/m"}
        without = [name for name in dampers if given.get(name, 1.0) == 0]
        vehicle, values = assembled(self).at({**given, **dict.fromkeys(without, 1.0)})
        return modes_of(vehicle.assembly, {**values, **dict.fromkeys(without, 0.0)})

    def static(self, setting: Setting | None = None, /, **struts: Any) -> "pd.DataFrame":
        """Return the static position on level ground; arguments and errors as of `closed`, masses needed.

        Returns
        -------
        DataFrame
            By ``name`` the ``value`` and its ``unit``: ``<wheel>_wheel_load``, positive on the ground;
            ``<wheel>_tyre_deflection`` and ``<strut>_deflection`` from the free length, negative in compression;
            ``body_displacement`` and the like, how far bodies and wheels sink from where nothing is loaded: the
            difference of two vehicles is that of their ride heights. A spring that is a force law counts from the
            position without payload: down to there it has its slope there, and a payload moves it along its curve.

        Examples
        --------
        A load reaches the bump stop after 20 mm and then sinks the body less:

        >>> import suspension_ctrl as sc
        >>> stop = sc.BumpStop(gap=0.02, stiffness=80e3)
        >>> strut = sc.parallel(sc.Spring(value=20e3), sc.Damper(value=1500.0), stop)
        >>> car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=200e3, strut=strut)
        >>> for mass in (1.0, 41.0, 81.0):
        ...     laden = sc.Payload(mass=mass).on(car)
        ...     print(laden.static({})["value"].round(4)["deflection"])
        -0.1476
        -0.1672
        -0.1719
        """
        vehicle, values = assembled(self).at(setting, **struts)
        return static_of(vehicle.statics, values)


class AssembledVehicle(Vehicle):
    """A vehicle of masses and links."""

    @property
    @abstractmethod
    def assembly(self) -> Assembly:
        """Masses and links."""

    @property
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of each response, by name; accelerations ``("acceleration", x, y)`` are known beside these."""
        return self.assembly.meanings

    @property
    def responses(self) -> tuple[str, ...]:
        """Names of the responses of `plant` and `closed`: accelerations, travels and tyre loads."""
        return tuple(self.assembly.responses)

    @property
    def contacts(self) -> Mapping[str, Position]:
        """Point (x, y) by tyre where it touches its road, x forward and y to the left [m]."""
        return self.assembly.contacts

    @property
    def struts(self) -> tuple[str, ...]:
        """Names of the struts; one over a tyre has its name."""
        return tuple(strut.name for strut in self.assembly.struts)

    @property
    def wheel_struts(self) -> tuple[str, ...]:
        """Names of the struts on wheels, axles and beams."""
        return self.assembly.wheel_struts

    @property
    def strut_coefficients(self) -> tuple[StrutCoefficient, ...]:
        """Coefficients of the struts."""
        return self.assembly.strut_coefficients

    @property
    def networks(self) -> tuple[Network, ...]:
        """Parts of the struts beside springs and dampers in parallel."""
        return self.assembly.networks

    @property
    def variables(self) -> Mapping[str, Any]:
        """What may vary, by name, each with a ``unit``: coefficients, then parameters and frequencies."""
        from .altered import further_variables  # of vehicles of this class

        return {**super().variables, **further_variables(self.assembly)}

    def at(self, setting: Setting | None = None, /, **struts: Any) -> "tuple[AssembledVehicle, dict[str, float]]":
        """Return the vehicle with the parameters of a setting, and every coefficient by its name, see `closed`."""
        given = coefficients_by_name(setting, struts)
        if given.keys() <= {one.name for one in self.strut_coefficients}:
            return self, _complete(self, given)
        from .altered import altered  # of vehicles of this class

        vehicle, coefficients = altered(self, given)
        return vehicle, _complete(vehicle, coefficients)

    @cached_property
    def statics(self) -> Mechanics:
        """Matrices for static loads and roll."""
        return Mechanics.of(self.assembly)

    def plant(self, responses: Sequence[ResponseName] | None = None) -> "control.StateSpace":
        """Return the vehicle without its struts, see `Vehicle.plant`."""
        return self.bare(responses).system()

    def bare(self, responses: Sequence[ResponseName] | None = None) -> StateMatrices:
        """Return `plant` as matrices."""
        return plant_of(self.assembly, self.responses if responses is None else responses)


def _closed(vehicle: Vehicle, values: Mapping[str, float], names: Sequence[ResponseName]) -> System:
    """Return a vehicle with coefficients of struts, from roads to responses."""
    q = len(vehicle.struts)
    integrals = vehicle.without_jerk(names)
    dynamics = Dynamics.of(vehicle.networks, values, gains_by_order(vehicle.strut_coefficients, values, q))
    closed = dynamics.around(vehicle.bare(list(dict.fromkeys(integrals))))
    closed = selected(closed, closed.output_labels[: -2 * q], closed.input_labels[:-q], "vehicle")
    rates = {str(name): str(one) for name, one in zip(names, integrals, strict=True) if name != one}
    return selected(with_rates(closed, rates), [*map(label, names)], closed.input_labels, "vehicle")


def _complete(vehicle: Vehicle, given: Mapping[str, float]) -> dict[str, float]:
    """Return every coefficient by its name."""
    known = {one.name: one for one in vehicle.strut_coefficients}
    for name in given:
        checks.one_of("setting", name, known)
    missing = [name for name, one in known.items() if name not in given and one.default is None]
    if missing:
        needed = checks.listing(known, missing[0])
        raise ValueError(f"setting must have {needed}, got none for {checks.listing(missing)}")
    for name, value in given.items():
        known[name].check(name, value)
    return {name: given.get(name, p.default or 0.0) for name, p in known.items()}


def assembled(vehicle: Vehicle) -> AssembledVehicle:
    """Return the vehicle; ValueError unless it is one of masses and links."""
    if not isinstance(vehicle, AssembledVehicle):
        needed = "one of masses and links for static loads, roll, modes and seats"
        raise ValueError(f"vehicle must be {needed}, got a {type(vehicle).__name__}")
    return vehicle


def anti_roll_bar(name: str, difference: Sequence[float], track: float) -> StrutCoefficient:
    """Return the stiffness, 0 by default, of a bar that resists a `difference` (q,) of travels."""
    return StrutCoefficient(name, "N m/rad", np.outer(difference, difference) / track**2, 0, 0.0)


def coefficients_by_name(setting: Setting | None, struts: Mapping[str, Any]) -> dict[str, float]:
    """Return the coefficients of a setting, or of `struts` without one, each by its own name."""
    if setting is not None and struts:
        raise ValueError(f"setting must be one mapping or keywords, got both and {checks.listing(struts)}")
    if isinstance(setting, Sequence | np.ndarray) and not isinstance(setting, str):
        setting = {"": setting}  # of the one strut that has no name
    if not isinstance(setting, Mapping | None):
        raise ValueError(f"setting must be a mapping of values by name, got {checks.shown(setting)}")
    given: dict[str, float] = {}
    for name, value in (struts if setting is None else setting).items():
        pair: dict[str, Any] = {name: value}
        if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str):
            if len(value) != 2:
                got = checks.shown(value)
                raise ValueError(f"setting must have two numbers, spring and damper, for {name}, got {got}")
            prefix = f"{name}." if name else ""
            pair = {f"{prefix}spring": value[0], f"{prefix}damper": value[1]}
        if twice := given.keys() & pair:
            raise ValueError(f"setting must have each coefficient once, got {min(twice)} twice")
        given |= pair
    return given
