"""
The curve of a damper
=====================

A damper's table becomes four coefficients that a search can vary. On a road a damper acts by its equivalent
damping, the mean slope of its curve under the Gaussian of its rate; its mean force lowers the car. The digressive
damper found here has the damping of the supplier's table within 5 % from smooth to rough roads.
"""

import numpy as np
import pandas as pd
from scipy.optimize import least_squares

import suspension_ctrl as sc

car = sc.load_vehicle("volvo_xc90_full").vehicle
supplier = next(one for one in car.front_strut.elements if one.name == "damper")
mass = car.body_mass * car.cg_to_rear / (car.cg_to_front + car.cg_to_rear) / 2  # on a front wheel [kg]
corner = sc.QuarterCar(body_mass=mass, wheel_mass=car.front_wheel_mass, tyre_stiffness=car.front_tyre_stiffness)
z = np.linspace(-8.0, 8.0, 8001)  # rate in standard deviations
weight = np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi) * (z[1] - z[0])


def equivalent(damper: sc.TableDamper | sc.DigressiveDamper, s: float) -> tuple[float, float]:
    """Return equivalent damping [N s/m] and mean force [N] at a standard deviation of the rate [m/s]."""
    force = damper.tension(s * z)
    return weight @ (z * force) / s, weight @ force


# %%
# The rate depends on the damping and the damping on the rate: a few steps find both, on each road at 20 m/s.
columns = ["road", "rate [m/s]", "damping [N s/m]", "mean force [N]"]
table = pd.DataFrame(columns=columns[1:], index=pd.Index(list("ABCD"), name=columns[0]), dtype=float)
for road in table.index:
    damping = 3000.0
    for _ in range(12):
        ride = sc.ride(corner, {"spring": 55e3, "damper": damping}, sc.Iso8608Road(road), speed=20.0)
        s = ride["value"]["suspension_travel_rate"]
        damping, mean = equivalent(supplier, s)
    table.loc[road] = s, damping, mean


def digressive(x: np.ndarray) -> sc.DigressiveDamper:
    """Return a damper by the logarithms of its coefficients."""
    low, high, knee, ratio = np.exp(x)
    return sc.DigressiveDamper(low_speed=low, high_speed=high, knee=knee, rebound_over_bump=ratio)


rates, wanted = table["rate [m/s]"], table[columns[2:]].to_numpy()
scale = wanted[:, :1] * np.stack([np.ones(4), rates], axis=1)
fit = least_squares(
    lambda x: ((np.array([equivalent(digressive(x), s) for s in rates]) - wanted) / scale).ravel(),
    np.log([4000.0, 1000.0, 0.1, 2.0]),
)
found = digressive(fit.x)
table["digressive [N s/m]"] = [equivalent(found, s)[0] for s in rates]
print(found, table.round(3).to_string(), sep="\n")
sc.damper_figure({"supplier": supplier, "digressive": found}, {f"class {road}": s for road, s in rates.items()})
