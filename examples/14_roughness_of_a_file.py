"""
Roughness of a file: segments, class and a ride
===============================================

A profile in feet and inches, with semicolons, as a profilometer may write it: its International Roughness Index
by segments of 20 m, and the ride of a full car on the measured road. Without a band the ride is over the
frequencies in which the road is known.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import suspension_ctrl as sc

# %%
# A realisation of class B stands for the survey:
survey = sc.Iso8608Road("B").profile(length=500.0, step=0.1, seed=1, tracks=(0.75, -0.75))
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "survey.txt"
    rows = zip(survey.distance / 0.3048, *survey.height.T / 0.0254, strict=True)
    lines = ["Station (ft);LWP (in);RWP (in)", *(f"{x:.6f};{left:.6f};{right:.6f}" for x, left, right in rows)]
    path.write_text("\n".join(lines))
    profile = sc.load_profile(path, track_width=1.5)

# %%
# The car drives on from segment to segment:
index = sc.international_roughness_index(profile)
segments = index.by_segment(20.0)
print(f"IRI {index.mean:.2f} mm/m, worst 20 m {segments.iloc[:, 2:].max(axis=None):.2f} mm/m")
figure, ax = plt.subplots(figsize=(7, 3), layout="constrained")
ax.step(segments["start [m]"], segments.iloc[:, 2:], where="post")
ax.set(xlabel="distance [m]", ylabel="IRI [mm/m]", ylim=(0, None))

# %%
# The ride on it:
car = sc.load_vehicle("jian_2022_full")
ride = sc.ride(car.vehicle, car.setting, sc.MeasuredRoad.from_profile(profile), speed=20.0)
print(ride.loc[["ACC", "SWS", "DTL"], ["value", "unit"]])
