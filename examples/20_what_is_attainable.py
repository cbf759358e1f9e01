"""
What is attainable
==================

Springs and dampers, skyhook, and the optimal controller with full information on one car and road: how far is the
passive optimum from the best that any suspension could do?
"""

import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc

file = sc.load_vehicle("yuen_ramli_2010")
road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds)
shares = sc.attained(problem, file.setting)
print(shares.round(4).to_string())
passive = shares["share [%]"]["passive optimum"]
print(f"The passive optimum takes {passive:.0f} % of what is attainable at equal travel and tyre load.")

# %%
# Fronts: controllers with other weights, skyhook with other springs, dampers and sky dampers.
front = sc.minimise(problem, sc.Nsga2(population=300), iterations=30, seed=1).front()
table = sc.attainable(problem, present=file.setting, points=128)
print(f"shaping filter of the road off by {100 * table.attrs['spectrum error'][0][1]:.1f} % at most")
figure = sc.attainable_figure(table, front)

# %%
# No suspension force moves the invariant points: at the root of K_t/M_w the road accelerates the body by K_t/M_b,
# with skyhook as without. A sky damper calms the body resonance.
f = np.geomspace(0.3, 20.0, 400)  # Hz
curves, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for name, sky in {"passive": 0.0, "skyhook": 3e3}.items():
    closed = sc.skyhook(file.vehicle).closed({**file.setting, "sky": sky})
    ax.loglog(f, abs(closed["body_acceleration", "road"](2j * np.pi * f)), label=name)
invariant = np.sqrt(192e3 / 45.4) / (2 * np.pi), 192e3 / 317.5
ax.plot(*invariant, "ko", label="invariant point")
ax.set(xlabel="frequency [Hz]", ylabel="road to body acceleration [1/s²]")
ax.legend(frameon=False)
plt.show()
