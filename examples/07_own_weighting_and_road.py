"""
A weighting and a road of your own
==================================

Any python-control system with one input and one output is a weighting. Any object with a method `psd` is a
road of one wheel.
"""

import control
import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc


class Cobbles:
    """Setts 0.15 m long over a smooth base: a spectrum with a hump at their wavenumber."""

    def psd(self, f: np.ndarray, speed: float) -> np.ndarray:
        """Return the one-sided elevation spectrum (n,) [m^2/Hz] at f (n,) [Hz], met at a speed [m/s]."""
        n = np.asarray(f) / speed  # cycle/m
        return (2e-7 * n**-2 + 4e-7 * np.exp(-(((n - 1 / 0.15) / 1.5) ** 2))) / speed


car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
setting = {"spring": 22e3, "damper": 1500.0}
first_order = control.tf([1], [1 / (2 * np.pi * 8), 1])  # passes what is below 8 Hz
for name, weighting in {"Wk": "Wk", "first order": first_order, "none": None}.items():
    table = sc.ride(car, setting, Cobbles(), speed=8.0, weighting=weighting, band=(0.5, 80.0))
    print(f"{name:11s} ACC {table.value['ACC']:.4f} m/s^2")

# %%
# At 8 m/s the setts excite 53 Hz, far above the wheel hop. They make two thirds of the mean square of the tyre
# load, and less than a tenth of that of the body acceleration.
f = np.geomspace(0.5, 80, 500)  # Hz
road = Cobbles().psd(f, 8.0)
load = sc.response_psds(car.closed(setting), f, road)["tyre_load"]
figure, (above, below) = plt.subplots(2, sharex=True)
above.loglog(f, road)
above.set_ylabel("road [m^2/Hz]")
below.loglog(f, load)
below.set(xlabel="frequency [Hz]", ylabel="tyre load [N^2/Hz]")
plt.show()
