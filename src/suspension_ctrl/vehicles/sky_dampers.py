"""Skyhook: struts on wheels that also act by the absolute velocity of the body above them."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..quantities import Record
from .assembly import Assembly, Link, StrutCoefficient, joined
from .vehicle import AssembledVehicle, Vehicle, assembled

SKY = "sky"
"""Name of the coefficient of a sky damper."""


@dataclass(frozen=True, eq=False, repr=False)
class SkyhookVehicle(Record, AssembledVehicle):
    """A vehicle with sky dampers in its struts on wheels, see `skyhook`."""

    vehicle: AssembledVehicle

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links: a port without strut measures the displacement of the body above each wheel strut."""
        base = self.vehicle.assembly
        wheels = [one for one in base.struts if one.name in self.vehicle.wheel_struts]
        places = {one.name: i for i, one in enumerate(base.struts)}
        q, more = len(base.struts), len(wheels)
        gains: dict[str, np.ndarray] = {}
        for i, wheel in enumerate(wheels):
            axle = wheel.name.removesuffix("_left").removesuffix("_right")
            gain = gains.setdefault(f"{axle}.{SKY}" if axle else SKY, np.zeros((q + more, q + more)))
            gain[places[wheel.name], q + i] = 1.0
        own = [replace(one, gain=np.pad(one.gain, (0, more))) for one in base.strut_coefficients]
        sky = [StrutCoefficient(name, "N s/m", gain, 1, 0.0) for name, gain in gains.items()]
        return replace(
            base,
            struts=(*base.struts, *(Link(joined(one.name, SKY), None, one.upper) for one in wheels)),
            strut_coefficients=(*own, *sky),
        )


def skyhook(vehicle: Vehicle) -> SkyhookVehicle:
    """Return a vehicle with a sky damper in each of its struts on wheels.

    A strut with an actuator pulls body and wheel together by the sky damper's coefficient times the absolute
    velocity of the body above it [1]_, beside the forces of its passive elements. Its coefficients are ``sky`` of
    a quarter car, ``front.sky`` and the like, zero by default [N s/m].

    Parameters
    ----------
    vehicle : Vehicle
        One of masses and links.

    Returns
    -------
    SkyhookVehicle
        For `ride`, `RideProblem` and ``closed`` as any other vehicle.

    Raises
    ------
    ValueError
        If the vehicle is not one of masses and links with springs, dampers and inerters in parallel alone.

    References
    ----------
    .. [1] D. Karnopp, M. J. Crosby, R. A. Harwood, "Vibration control using semi-active force generators",
       Journal of Engineering for Industry 96(2), 1974.

    Examples
    --------
    A sky damper calms the body without the price that the damper between body and wheel has:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> for damper, sky in ((1500.0, 0.0), (3000.0, 0.0), (1500.0, 1500.0)):
    ...     setting = {"spring": 22e3, "damper": damper, "sky": sky}
    ...     value = sc.ride(sc.skyhook(car), setting, sc.Iso8608Road("C"), speed=20.0)["value"]
    ...     print(f"ACC {value['ACC']:.2f} m/s^2, SWS {1e3 * value['SWS']:.1f} mm")
    ACC 1.19 m/s^2, SWS 11.1 mm
    ACC 1.58 m/s^2, SWS 7.8 mm
    ACC 1.16 m/s^2, SWS 9.1 mm
    """
    passive = assembled(vehicle)
    if passive.networks:
        needed = "struts of springs, dampers and inerters in parallel alone for sky dampers"
        raise ValueError(f"vehicle must have {needed}, got others")
    return SkyhookVehicle(passive)
