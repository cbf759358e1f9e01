"""
Scatter of production, load and age
===================================

No car is built as drawn, and its dampers lose force with age. A search over the nominal car puts designs on the
limit of travel, where every second car is beyond it. A search with scatter leaves the room that 95 % of the cars
need.
"""

import matplotlib.pyplot as plt

import suspension_ctrl as sc

car = sc.QuarterCar(body_mass=400.0, wheel_mass=45.0, tyre_stiffness=220e3)
scatter = sc.Scatter(
    {"spring": 0.05, "damper": (-0.25, 0.1), "tyre_stiffness": "10 %", "body_mass": (0.0, 0.2)},
    samples=256,
    seed=1,
)
robust = sc.RideProblem(
    car,
    sc.Iso8608Road("B"),
    speed=27.78,
    bounds={"spring": (10e3, 60e3), "damper": (1e3, 5e3)},
    measures=["mean ACC", "q95 DTL"],
    constraints=["q95 SWS <= 8mm"],
    scatter=scatter,
)

# %%
# The same search twice: of the nominal car, and of 128 cars per design. The designs with the least discomfort are
# then judged on 4096 cars that neither search has seen.
designs = {}
for name, problem in {"nominal": robust.nominal, "robust": robust}.items():
    run = sc.minimise(problem, sc.Nsga2(population=30), iterations=20, seed=1)
    best = sc.pick(problem, run, minimise=problem.objectives[0])
    designs[name] = best[["spring [N/m]", "damper [N s/m]"]].to_list()
    table = sc.robustness(robust, designs[name], samples=4096, seed=2)
    travel = table.loc["q95 SWS <= 0.008"]
    print(
        f"{name}: spring {designs[name][0] / 1e3:.1f} kN/m, damper {designs[name][1] / 1e3:.2f} kN s/m; "
        f"mean ACC {table['mean']['ACC']:.3f} m/s^2, q95 SWS {1e3 * travel['q95']:.2f} mm, "
        f"{travel['beyond limit [%]']:.0f} % beyond 8 mm"
    )

# %%
# Where the cars of the robust design are.
figure = sc.robustness_figure(robust, designs["robust"])
plt.show()
