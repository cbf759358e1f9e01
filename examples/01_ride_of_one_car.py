"""
Ride of one car
===============

Measures and root mean squares of a full car on a road of class C at 20 m/s. No search and no bounds are
needed.
"""

import suspension_ctrl as sc

car = sc.FullCar(
    body_mass=1300.0,
    roll_inertia=480.0,
    pitch_inertia=2400.0,
    front_wheel_mass=40.0,
    rear_wheel_mass=45.0,
    front_tyre_stiffness=192e3,
    rear_tyre_stiffness=200e3,
    cg_to_front=1.2,
    cg_to_rear=1.5,
    front_track=1.5,
    rear_track=1.46,
)
setting = {"front": (21e3, 1500.0), "rear": (23e3, 1600.0), "front_antiroll": 12e3}  # N/m, N s/m, N m/rad

# %%
# The first rows are the measures: weighted acceleration of the body, and the largest travel and tyre load of
# the four wheels. The other rows are the responses, unweighted. The band starts at 0.3 Hz because the tracks of
# left and right differ, and the difference of their elevations grows without limit towards 0 Hz.
table = sc.ride(car, setting, sc.Iso8608Road("C"), speed=20.0, band=(0.3, 20.0))
print(table[["value", "unit"]].round(4).to_string(index_names=False))
