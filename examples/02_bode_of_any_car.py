"""
Bode plot of any car
====================

A vehicle with its struts is a python-control system with named signals: pitch acceleration of a half car over
the road under its front wheel, with stock and with firm dampers.
"""

import control
import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc

file = sc.load_vehicle("minaker_half")
stock = dict(file.setting)
firm = {name: 2 * value if name.endswith("damper") else value for name, value in stock.items()}

omega = 2 * np.pi * np.geomspace(0.2, 20, 400)  # rad/s
pitch = [file.vehicle.closed(setting)["pitch_acceleration", "front_road"] for setting in (stock, firm)]
responses = [control.frequency_response(system, omega) for system in pitch]

# %%
# Firm dampers lower the resonance of the body, near 1 Hz, and that of the wheels, near 13 Hz. Between the two
# they pass more of the road to the body.
for name, response in zip(("stock", "firm"), responses, strict=True):
    peak = response.magnitude.argmax()
    print(f"{name}: largest {response.magnitude[peak]:.1f} rad/s^2/m at {omega[peak] / (2 * np.pi):.2f} Hz")
control.bode_plot(responses, Hz=True, label=["stock", "firm"], title="Pitch acceleration over front road")
plt.gcf().axes[0].set_ylabel("magnitude [rad/s^2/m]")
plt.show()
