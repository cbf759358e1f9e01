"""
Somebody else's A, B, C, D
==========================

The quarter car of MATLAB's guide to active suspensions (mathworks.com/help/robust, "Active Suspension Control
Design") is known by its matrices. Its actuator pushes body and wheel apart, in kN; a spring and a damper are in
place. Without these it is a vehicle like any other: its struts are optimised for comfort and travel.
"""

import control
import numpy as np

import suspension_ctrl as sc

body_mass, wheel_mass, damper, spring, tyre = 300.0, 60.0, 1000.0, 16000.0, 190000.0  # kg, N s/m, N/m
body = np.array([-spring, -damper, spring, damper]) / body_mass
wheel = np.array([spring, damper, -spring - tyre, -damper]) / wheel_mass
A = np.array([[0, 1, 0, 0], body, [0, 0, 0, 1], wheel])
B = np.array([[0, 0], [0, 1e3 / body_mass], [0, 0], [tyre / wheel_mass, -1e3 / wheel_mass]])
C = np.array([[1, 0, 0, 0], [1, 0, -1, 0], A[1]])  # body travel, suspension travel, body acceleration
D = np.array([[0, 0], [0, 0], B[1]])

# %%
# Signals get names, units and signs; "" leaves one out. A file of MATLAB or MotionSolve is read by `load_system`.
outputs = ["", "deflection [m]", "body_acceleration [m/s^2]"]
plant = sc.Plant.named(control.ss(A, B, C, D), inputs=["road [m]", "-strut [kN]"], outputs=outputs)
vehicle = plant.without({"spring": spring, "damper": damper})

problem = sc.RideProblem(
    vehicle, sc.Iso8608Road("C"), speed=20.0, measures=["ACC", "SWS"],
    bounds={"spring": (8e3, 40e3), "damper": (400.0, 5e3)},
)  # fmt: skip
run = sc.minimise(problem, sc.Nsga2(population=100), iterations=30, seed=1)
here = problem.evaluate([[spring, damper]])[0]
better = run.front()
same_travel = better[better["SWS [m]"] <= here[1]].sort_values("ACC [m/s^2]").iloc[0]
print(f"as it is: ACC {here[0]:.2f} m/s^2, SWS {1e3 * here[1]:.1f} mm")
print(f"with no more travel: ACC {same_travel['ACC [m/s^2]']:.2f} m/s^2")
print(same_travel[["spring [N/m]", "damper [N s/m]"]].round(-2).to_dict())
