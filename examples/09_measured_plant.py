"""A vehicle known by measured frequency responses: here those of a half car, as if from a four-post rig."""

import control
import numpy as np

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
contacts = {wheel: tuple(xy) for wheel, xy in zip(("front", "rear"), file.vehicle.contact_points, strict=True)}
measured = sc.Plant(rig, contacts=contacts, struts=("front", "rear"))

for name, vehicle in {"masses and links": file.vehicle, "measured": measured}.items():
    table = sc.ride(vehicle, file.setting, sc.Iso8608Road("C"), speed=20.0, band=(0.5, 19.0))
    print(f"{name:17s}", ", ".join(f"{m} {table.value[m]:.5g} {table.unit[m]}" for m in ("ACC", "SWS", "DTL")))
