"""Bode plot by python-control: the pitch of a half car over its front wheel, with stock and with firm dampers."""

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
for name, response in zip(("stock", "firm"), responses, strict=True):
    peak = response.magnitude.argmax()
    print(f"{name}: largest {response.magnitude[peak]:.1f} rad/s^2/m at {omega[peak] / (2 * np.pi):.2f} Hz")
control.bode_plot(responses, Hz=True, label=["stock", "firm"])
plt.savefig("pitch.png")
