"""
An exact optimum and the front around it
========================================

The least discomfort within a travel, with the price of that travel and the residual that proves the optimum; then
the whole front of discomfort and travel, point by point.
"""

import matplotlib.pyplot as plt

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=400.0, wheel_mass=45.0, tyre_stiffness=220e3)
present = {"spring": 25e3, "damper": 2e3}
problem = sc.RideProblem(
    car,
    sc.Iso8608Road("B"),
    speed=27.78,
    bounds={"spring": (10e3, 60e3), "damper": (500.0, 5e3)},
    measures=["ACC", "SWS"],
)
limited = problem.replace(constraints=["SWS <= 6mm"])
best = sc.refine(limited, present, minimise="ACC")
print(best)
print(best.prices().round(4))

# %%
# The price is the slope of the front: what a little more travel is worth in discomfort.
more = sc.refine(problem.replace(constraints=["SWS <= 6.1mm"]), best.design, minimise="ACC")
print(f"0.1 mm more travel: ACC {more.measures['ACC'] - best.measures['ACC']:+.5f} m/s^2")

# %%
# The front from end to end; every point has its own residual.
front = sc.pareto_front(problem, points=25)
print(front.iloc[::6].to_string(), f"largest residual {front['residual'].max():.0e}", sep="\n")
figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.plot(1e3 * front["SWS [m]"], front["ACC [m/s^2]"], ".-", label="front")
ax.plot(1e3 * best.measures["SWS"], best.measures["ACC"], "o", label="least ACC within 6 mm")
ax.plot(*[factor * sc.ride(car, present, sc.Iso8608Road("B"), 27.78).value[name] for name, factor in
          (("SWS", 1e3), ("ACC", 1.0))], "X", label="present design")  # fmt: skip
ax.set(xlabel="SWS [mm]", ylabel="ACC [m/s²]")
ax.legend(frameon=False)
plt.show()
