"""
A Pareto front as a table with units
====================================

The designs of the paper's quarter car between which no improvement of comfort, travel and grip is free.
"""

import matplotlib.pyplot as plt

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
problem = sc.RideProblem(car, road, speed=20.0, bounds={"spring": (1e3, 30e3), "damper": (1e3, 5e3)})

run = sc.minimise(problem, sc.Nsga2(population=100), iterations=30, seed=1)
front = run.front()  # a DataFrame; front.to_csv("front.csv", index=False) keeps it
print(front.describe().loc[["min", "max"]].round(4).to_string())

# %%
# Less travel costs comfort: the firmer the damper, the less travel. A design that is worse in all three than
# another is not in the table.
axes = front.plot.scatter("SWS [m]", "ACC [m/s^2]", c="DTL [N]", colormap="viridis")
axes.set_title(f"{len(front)} designs after {run.evaluations} evaluations")
plt.show()
