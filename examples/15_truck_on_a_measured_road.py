"""
A truck on a measured road: frame, cab and driver
=================================================

A tractor with its cab on four mounts and its driver on a seat, on a road known by a profile of both wheel tracks:
what frame, mounts and seat pass on to the driver.
"""

import matplotlib.pyplot as plt

import suspension_ctrl as sc

file = sc.load_vehicle("trucksim_cab_over")
driver = sc.Seat(mass=75.0, spring=5e3, damper=500.0, position=(-0.1, 0.6), name="driver", stands_on="cab")
truck = driver.on(file.vehicle)
print(truck.modes(file.setting).iloc[:5, :2].round(2).to_string(index=False))

# %%
# A realisation of class C stands for the survey; `load_profile` reads one from a file:
survey = sc.Iso8608Road("C").profile(length=1000.0, step=0.1, seed=3, tracks=(0.98, -0.98))
road = sc.MeasuredRoad.from_profile(survey)
measures = {"frame": "ACC", "cab": "ACC cab", "driver": "ACC driver"}
ride = sc.ride(truck, file.setting, road, speed=20.0, measures=list(measures.values()))
weighted = [float(ride.value[measure]) for measure in measures.values()]
for place, value in zip(measures, weighted, strict=True):
    print(f"{place}: {value:.2f} m/s^2")
figure, ax = plt.subplots(figsize=(5, 3), layout="constrained")
ax.bar(list(measures), weighted)
ax.set(ylabel="weighted acceleration [m/s²]")
