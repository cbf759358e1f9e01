"""A weighting and a road of one's own: any python-control system, any object that has a spectrum."""

import control
import numpy as np

import suspension_ctrl as sc


class Cobbles:
    """Setts 0.15 m long over a smooth base: a spectrum with a hump at their wavenumber."""

    def psd(self, f: np.ndarray, speed: float) -> np.ndarray:
        """Return the one-sided elevation spectrum (n,) [m^2/Hz] at f (n,) [Hz], met at a speed [m/s]."""
        n = np.asarray(f) / speed  # cycle/m
        return (2e-7 * n**-2 + 4e-7 * np.exp(-(((n - 1 / 0.15) / 1.5) ** 2))) / speed


car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
first_order = control.tf([1], [1 / (2 * np.pi * 8), 1])  # passes what is below 8 Hz
for name, weighting in {"Wk": "Wk", "own": first_order, "none": None}.items():
    table = sc.ride(
        car, {"spring": 22e3, "damper": 1500.0}, Cobbles(), speed=8.0, weighting=weighting, band=(0.5, 60.0)
    )
    print(f"{name:4s} ACC {table.value['ACC']:.4f} m/s^2")
