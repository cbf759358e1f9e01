"""Drive a car over a profile in time and judge the ride by ISO 2631-1: r.m.s., MTVV and vibration dose value."""

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
road = sc.Iso8608Road("C")
profile = road.profile(length=1000.0, step=0.05, seed=1)
print(f"roughness index {sc.international_roughness_index(profile).mean:.2f} m/km")

history = sc.simulate(car, {"spring": 22e3, "damper": 1500.0}, profile, speed=20.0)
time_step = history["time [s]"].iloc[1]
judged = sc.exposure(history["body_acceleration [m/s^2]"], time_step, weighting="Wk")
print(f"a_w {judged.rms:.3f} m/s^2, MTVV {judged.mtvv:.3f} m/s^2, VDV {judged.vdv:.2f} m/s^1.75")
print(f"crest factor {judged.crest_factor:.2f}")
