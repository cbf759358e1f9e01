"""The Pareto front of the paper's quarter car as a table with units, and the softest of its designs."""

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
problem = sc.RideProblem(car, road, speed=20.0, bounds={"spring": (1e3, 30e3), "damper": (1e3, 5e3)})

run = sc.minimise(problem, sc.Nsga2(population=100), iterations=30, seed=1)
front = run.front()
print(run)
print(front.describe().loc[["min", "max"]].round(4).to_string())
front.to_csv("front.csv", index=False)
