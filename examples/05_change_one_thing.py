"""
Change one thing of a problem
=============================

Another speed, other bounds, another vehicle: `replace` changes one thing, and the rest stays as it was.
"""

from dataclasses import replace

import pandas as pd

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
problem = sc.RideProblem(
    car, sc.Iso8608Road("C"), speed=20.0, bounds={"spring": (10e3, 60e3), "damper": (500.0, 5e3)}
)
problems = {
    "as it is": problem,
    "30 m/s": problem.replace(speed=30.0),
    "other bounds": problem.replace(bounds={"spring": (40e3, 60e3), "damper": (500.0, 5e3)}),
    "laden": replace(problem, vehicle=replace(car, body_mass=400.0)),
}

# %%
# One design in all of them. Bounds do not change what a design is worth. At 30 m/s all values are larger by the
# root of 1.5, as the spectrum of a road of waviness 2 over frequency is proportional to the speed.
design = [[45e3, 2000.0]]
values = [one.evaluate(design)[0] for one in problems.values()]
table = pd.DataFrame(values, index=list(problems), columns=["ACC [m/s^2]", "SWS [m]", "DTL [N]"])
print(table.round(4).to_string())
