"""
Over a speed bump: peaks against the damper
===========================================

A full car drives over a speed bump at 20 km/h. Peaks of the acceleration, of the compression of the front struts
and of the load that the rear tyres lose, over the coefficient of all dampers: a stiff damper spares the bump stop
and costs comfort.
"""

import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc

file = sc.load_vehicle("jian_2022_full")
problem = sc.RideProblem(
    file.vehicle,
    sc.Iso8608Road("C"),
    speed=20.0,
    events={"bump": (sc.SpeedBump(height=0.06, length=1.5), 20 / 3.6)},
    measures=["peak body_acceleration bump", "peak min front_travel bump", "peak max rear_tyre_load bump"],
    bounds={"front.damper": (500.0, 5e3), "rear.damper": (500.0, 5e3)},
    struts={name: value for name, value in file.setting.items() if not name.endswith("damper")},
)

# %%
# The peaks of all designs at once:
dampers = np.linspace(500.0, 5e3, 60)  # N s/m
peaks = problem.evaluate(np.column_stack([dampers, dampers]))
figure, axes = plt.subplots(1, 3, figsize=(10, 3), layout="constrained")
labels = ("body acceleration [m/s²]", "front compression [mm]", "rear tyre load lost [kN]")
for ax, values, scale, label in zip(axes, peaks.T, (1.0, 1e3, 1e-3), labels, strict=True):
    ax.plot(dampers / 1e3, scale * values)
    ax.set(xlabel="dampers [kN s/m]", ylabel=label)

# %%
# The same in time, for the dampers of the car:
history = sc.simulate(file.vehicle, file.setting, *problem.events["bump"])
print(f"body acceleration up to {history['body_acceleration [m/s^2]'].abs().max():.1f} m/s^2")
