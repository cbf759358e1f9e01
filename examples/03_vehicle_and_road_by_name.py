"""A vehicle and a road by name or by file: natural modes, and the ride on three classes of ISO 8608."""

import pandas as pd

import suspension_ctrl as sc

file = sc.load_vehicle("jian_2022_full")  # or the path of a .toml file
print(file.vehicle.modes(file.setting)[["name", "frequency [Hz]", "damping ratio [-]"]].round(3).to_string())

rides = {
    f"class {name}": sc.ride(file.vehicle, file.setting, sc.load_road(name), speed=20.0, band=(0.3, 20.0))["value"]
    for name in ("A", "B", "C")
}
print(pd.DataFrame(rides).loc[["ACC", "SWS", "DTL"]].round(4).to_string())
