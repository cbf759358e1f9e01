"""
A measured vehicle
==================

Frequency responses from a four-post rig make a vehicle; masses and stiffnesses need not be known. Here those
of a known half car stand for the measurement, and both give the same ride.
"""

import control
import numpy as np
import pandas as pd

import suspension_ctrl as sc

file = sc.load_vehicle("minaker_half")
omega = 2 * np.pi * np.arange(0.3, 20.05, 0.025)  # rad/s
plant = file.vehicle.plant()
rig = control.frd(
    plant.frequency_response(omega, squeeze=False).frdata,
    omega,
    inputs=plant.input_labels,
    outputs=plant.output_labels,
)

# %%
# The names of the signals tell roads, struts and responses apart. The points of contact give the delay from the
# front to the rear wheel.
print("inputs:", ", ".join(rig.input_labels))
contacts = {"front": (1.189, 0.0), "rear": (-1.696, 0.0)}  # m from the centre of gravity, forward and to the left
measured = sc.Plant(rig, contacts=contacts, struts=("front", "rear"))

rides = {
    name: sc.ride(vehicle, file.setting, sc.Iso8608Road("C"), speed=20.0, band=(0.5, 19.0))
    for name, vehicle in {"masses and links": file.vehicle, "measured": measured}.items()
}
table = pd.DataFrame({name: ride["value"] for name, ride in rides.items()}).loc[["ACC", "SWS", "DTL"]]
print(table.assign(unit=rides["measured"]["unit"]).round(4).to_string())
