"""Vehicles as python-control models: masses and tyres are the plant, a strut is feedback around it.

Signs: deflections are positive in extension, forces positive in tension, as in equations (7) and (11).
"""

from dataclasses import dataclass
from typing import ClassVar

import control
import numpy as np

from . import checks


@dataclass(frozen=True, kw_only=True)
class QuarterCar:
    """Two-degree-of-freedom quarter vehicle model [1]_, equations (1) and (2).

    Parameters
    ----------
    body_mass : float
        Mass of the body on this wheel, M_b [kg].
    wheel_mass : float
        Mass of the wheel, M_w [kg].
    tyre_stiffness : float
        Vertical stiffness of the tyre, K_t [N/m].

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero.

    References
    ----------
    .. [1] T. J. Yuen and R. Ramli, "Comparison of computational efficiency of MOEA/D and NSGA-II for
       passive vehicle suspension optimization", 2010.
    """

    body_mass: float
    wheel_mass: float
    tyre_stiffness: float

    responses: ClassVar[tuple[str, ...]] = ("body_acceleration", "suspension_travel", "tyre_load")

    def __post_init__(self) -> None:
        checks.positive("body_mass", self.body_mass, "kg")
        checks.positive("wheel_mass", self.wheel_mass, "kg")
        checks.positive("tyre_stiffness", self.tyre_stiffness, "N/m")

    def plant(self) -> control.StateSpace:
        """Return the vehicle without its strut, which has a port here instead.

        Returns
        -------
        control.StateSpace
            Inputs ``road`` x_0 [m] and ``strut`` (its tension [N]); outputs ``body_acceleration`` [m/s^2],
            ``suspension_travel`` z_2 - z_1 [m], ``tyre_load`` K_t (z_1 - x_0) [N], and the strut's
            ``deflection`` [m] and ``deflection_rate`` [m/s].
        """
        m_b, m_w, k_t = self.body_mass, self.wheel_mass, self.tyre_stiffness
        # states z1, dz1/dt, z2, dz2/dt: wheel and body
        a = np.array([[0, 1, 0, 0], [-k_t / m_w, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
        b = np.array([[0, 0], [k_t / m_w, 1 / m_w], [0, 0], [0, -1 / m_b]])
        travel, travel_rate = [-1, 0, 1, 0], [0, -1, 0, 1]
        c = np.array([[0, 0, 0, 0], travel, [k_t, 0, 0, 0], travel, travel_rate])
        d = np.array([[0, -1 / m_b], [0, 0], [-k_t, 0], [0, 0], [0, 0]])
        return control.ss(
            a,
            b,
            c,
            d,
            states=["wheel_displacement", "wheel_velocity", "body_displacement", "body_velocity"],
            inputs=["road", "strut"],
            outputs=[*self.responses, "deflection", "deflection_rate"],
            name="quarter_car_plant",
        )

    def closed(self, spring: float, damper: float) -> control.StateSpace:
        """Return the vehicle with its strut.

        Parameters
        ----------
        spring : float
            Spring stiffness K_s [N/m].
        damper : float
            Damping coefficient C_s [N s/m].

        Returns
        -------
        control.StateSpace
            From ``road`` [m] to ``body_acceleration`` [m/s^2], ``suspension_travel`` [m] and
            ``tyre_load`` [N].

        Raises
        ------
        ValueError
            If a coefficient is not finite and above zero.
        """
        checks.positive("spring", spring, "N/m")
        checks.positive("damper", damper, "N s/m")
        plant, strut = self.plant(), control.ss([], [], [], [[spring, damper]])
        closed = plant.lft(strut)
        closed.update_names(
            states=plant.state_labels, inputs=["road"], outputs=list(self.responses), name="quarter_car"
        )
        return closed
