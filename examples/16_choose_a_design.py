"""
Choose a design of a front
==========================

A car of today, its springs and dampers searched within a travel limit, and seven candidates beside the present
design: what each gains and loses, how the body swings, and which bounds it reaches.
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
    constraints=["SWS <= 8mm"],
)
run = sc.minimise(problem, sc.MoeadDra(population=1000), iterations=25, seed=1)
table = sc.candidates(problem, run, present=present)
changes = [f"{name} change [%]" for name in problem.objectives]
print(table[["name", *changes]].round(1).to_string())
print(table[["heave [Hz]", "heave damping [-]", "active"]].round(2).to_string())

# %%
# The knee is one of them. Other wishes pick another design: the least discomfort with no more travel and tyre load
# than today.
own = table.loc[0]
best = sc.pick(problem, run, minimise="ACC", within={"SWS": own["SWS [m]"], "DTL": own["DTL [N]"]})
print(f"same travel and tyre load: ACC {100 * (best['ACC [m/s^2]'] / own['ACC [m/s^2]'] - 1):.1f} %")
figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
front = run.front()
ax.plot(1e3 * front["SWS [m]"], front["ACC [m/s^2]"], ".", ms=3, color="0.7", label="front")
for number, row in table.iterrows():
    ax.plot(1e3 * row["SWS [m]"], row["ACC [m/s^2]"], "X" if number == 0 else "o", label=f"{number} {row['name']}")
ax.set(xlabel="SWS [mm]", ylabel="ACC [m/s²]")
ax.legend(frameon=False, fontsize=8)
plt.show()
