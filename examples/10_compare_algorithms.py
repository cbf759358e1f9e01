"""
Algorithms compared on a problem of your own
============================================

The welded beam of Deb (2000): cost against deflection under limits of shear, bending, weld and buckling. Two
algorithms, five seeds each, judged by the share of the reference front's hypervolume.

K. Deb, "An efficient constraint handling method for genetic algorithms", Computer Methods in Applied
Mechanics and Engineering 186, 2000, with two objectives.
"""

import numpy as np

import suspension_ctrl as sc


def beam(x: np.ndarray) -> np.ndarray:
    """Return cost [-], deflection [inch] and constraints (n, 4) of beams (n, 4): h, l, t, b [inch]."""
    h, length, t, b = x.T
    cost = 1.10471 * h**2 * length + 0.04811 * t * b * (14.0 + length)
    deflection = 2.1952 / (t**3 * b)
    primary = 6000 / (np.sqrt(2) * h * length)
    arm = np.sqrt(length**2 / 4 + ((h + t) / 2) ** 2)
    polar = 2 * (h * length / np.sqrt(2) * (length**2 / 12 + ((h + t) / 2) ** 2))
    secondary = 6000 * (14 + length / 2) * arm / polar
    shear = np.sqrt(primary**2 + secondary**2 + primary * secondary * length / arm)
    bending, buckling = 504000 / (t**2 * b), 64746.022 * (1 - 0.0282346 * t) * t * b**3
    limits = [shear / 13600 - 1, bending / 30000 - 1, h / b - 1, 6000 / buckling - 1]
    return np.column_stack([cost, deflection, *limits])


problem = sc.Problem(
    evaluate=beam,
    lower=(0.125, 0.1, 0.1, 0.125),
    upper=(5.0, 10.0, 10.0, 5.0),
    objectives=("cost", "deflection"),
    constraints=("shear", "bending", "weld", "buckling"),
    units={"deflection": "inch"},
)
study = sc.Study(
    problems={"beam": problem},
    algorithms={"nsga2": sc.Nsga2(population=60), "moead-dra": sc.MoeadDra(population=60)},
    seeds=range(5),
    budgets=[3000, 6000],
)
quality = study.run()

# %%
# Medians of the final populations by number of evaluations. Without a reference front of your own the non-
# dominated designs of the first seed's runs are taken.
final = quality[quality.set == "population"]
table = final.pivot_table("relative_hypervolume", "budget", "algorithm", "median")
print(table.round(3).to_string())
