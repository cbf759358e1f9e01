"""
A vehicle and a road by name
============================

Published vehicles and the classes of ISO 8608 are known by name; a path names a file of your own. Natural
modes of a full car, and its discomfort over speed on three classes of road.
"""

import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc

file = sc.load_vehicle("jian_2022_full")  # or the path of a .toml file
print(file.vehicle.modes(file.setting)[["name", "frequency [Hz]", "damping ratio [-]"]].round(3).to_string())

# %%
# Discomfort doubles from class to class, as the spectrum of the road rises by a factor of four. It does not
# grow evenly with speed: the rear wheels meet the road of the front wheels later, and the delay filters heave
# and pitch.
speeds = np.arange(5.0, 36.0, 5.0)  # m/s
discomfort = {
    name: [
        sc.ride(file.vehicle, file.setting, sc.load_road(name), speed, band=(0.3, 20.0)).value["ACC"]
        for speed in speeds
    ]
    for name in ("A", "B", "C")
}
for name, values in discomfort.items():
    print(f"class {name}: {values[0]:.3f} m/s^2 at 5 m/s, {values[-1]:.3f} m/s^2 at 35 m/s")
    plt.plot(speeds, values, marker="o", label=f"class {name}")
plt.xlabel("speed [m/s]")
plt.ylabel("ACC, weighting Wk [m/s^2]")
plt.legend()
plt.show()
