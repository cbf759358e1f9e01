"""Change one thing of a problem: other bounds, another speed, another vehicle; the rest stays as it was."""

from dataclasses import replace

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
problem = sc.RideProblem(
    car, sc.Iso8608Road("C"), speed=20.0, bounds={"spring": (10e3, 60e3), "damper": (500.0, 5e3)}
)
faster = problem.replace(speed=30.0)
stiffer = problem.replace(bounds={"spring": (40e3, 60e3), "damper": (500.0, 5e3)})
laden = replace(problem, vehicle=replace(car, body_mass=400.0))

design = [[45e3, 2000.0]]
for name, one in {"as it is": problem, "30 m/s": faster, "other bounds": stiffer, "laden": laden}.items():
    acc, sws, dtl = one.evaluate(design)[0]
    print(f"{name:13s} ACC {acc:.3f} m/s^2, SWS {1e3 * sws:.2f} mm, DTL {dtl:.0f} N")
