"""
Hand a design on
================

A design leaves this library as files: a vehicle for commands, state space for MATLAB, Octave and python-control,
numbers in JSON, and one page for the supplier of springs and dampers. Other optimisers take the same problem.
"""

import json
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy import optimize

import suspension_ctrl as sc

car = sc.load_vehicle("minaker_half")
problem = sc.RideProblem(
    car.vehicle, sc.Iso8608Road("C"), speed=25.0, band=(0.3, 20.0), bounds=car.bounds, constraints=["SWS <= 25mm"]
)

# %%
# Least discomfort within the limit, by SciPy. Its numbers have no units; ``at`` gives the design and its measures.
least = sc.as_scipy(problem, "ACC")
best = least.at(optimize.minimize(**least).x)
design = {name: best[name] for name in problem.variables}
print(f"least ACC {best['ACC']:.3f} m/s^2, SWS {1e3 * best['SWS']:.1f} mm")

# %%
# Each file is the same design: the ride of the vehicle that is read again, the gain of the matrices at 1.5 Hz, and
# the measures in JSON.
with tempfile.TemporaryDirectory() as folder:
    files = sc.export(problem, design, folder, present=car.setting, name="least ACC")
    print(*(path.name for path in files), sep=", ")
    again = sc.load_vehicle(files[0])
    system = sc.load_system(Path(folder) / "least_ACC.mat")
    numbers = json.loads((Path(folder) / "least_ACC.json").read_text(encoding="utf-8"))
ride = sc.ride(again.vehicle, again.setting, problem.road, problem.speed, band=problem.band)["value"]
gain = abs(system["body_acceleration", "front_road"](2j * np.pi * 1.5))
for one in numbers["measures"]:
    print(f"{one['name']}: {one['value']:.4g} {one['unit']}, {one['change']:+.0f} % against today")
print(f"read again: ACC {ride['ACC']:.3f} m/s^2; gain at 1.5 Hz {gain:.1f} 1/s^2")

# %%
# The page for the supplier: values with tolerances, curves, how far and how fast the struts move.
tolerances = {"front.damper": 0.1, "rear.damper": 0.1}
sheet = sc.supplier_sheet(problem, design, present=car.setting, name="Half car: least ACC", tolerances=tolerances)
plt.show()
