"""
Drive over a profile and judge the ride
=======================================

A quarter car drives over 1 km of a class C road in time. ISO 2631-1 judges the history: root mean square,
maximum transient vibration value (MTVV) and vibration dose value (VDV).
"""

import matplotlib.pyplot as plt

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
profile = sc.Iso8608Road("C").profile(length=1000.0, step=0.05, seed=1)
print(f"roughness index {sc.international_roughness_index(profile).mean:.2f} m/km")

history = sc.simulate(car, {"spring": 22e3, "damper": 1500.0}, profile, speed=20.0)
time = history["time [s]"]
acceleration = history["body_acceleration [m/s^2]"]
judged = sc.exposure(acceleration, time[1], weighting="Wk")

# %%
# A crest factor above 9 would ask for MTVV or VDV in addition to the root mean square (ISO 2631-1, 6.2.1); a
# random road without shocks stays below.
print(f"a_w {judged.rms:.3f} m/s^2, MTVV {judged.mtvv:.3f} m/s^2, VDV {judged.vdv:.2f} m/s^1.75")
print(f"crest factor {judged.crest_factor:.2f}")
figure, (above, below) = plt.subplots(2, sharex=True)
above.plot(history["distance [m]"], acceleration, linewidth=0.5)
above.set_ylabel("body acceleration [m/s^2]")
below.plot(profile.distance, 1e3 * profile.height)
below.set(xlabel="distance [m]", ylabel="road [mm]")
plt.show()
