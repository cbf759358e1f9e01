"""Engineering problems as formulas: from variables (d, n) to objectives and margins, each a tuple of (n,) arrays.

A margin is >= 0 where its constraint is met. Source of formulas and constants, and of their origins: R. Tanabe,
H. Ishibuchi, "An easy-to-use real-world multi-objective optimization problem suite", Applied Soft Computing 89,
2020, and its supplement, with the corrections of github.com/ryojitanabe/reproblems, commit 2884574.
"""

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Columns = tuple[Real, ...]
Answer = tuple[Columns, Columns]

BAR_AREAS = np.array([
    0.20, 0.31, 0.40, 0.44, 0.60, 0.62, 0.79, 0.80, 0.88, 0.93, 1.0, 1.20, 1.24, 1.32, 1.40, 1.55, 1.58, 1.60,
    1.76, 1.80, 1.86, 2.0, 2.17, 2.20, 2.37, 2.40, 2.48, 2.60, 2.64, 2.79, 2.80, 3.0, 3.08, 3.16, 3.41, 3.52,
    3.60, 3.72, 3.95, 3.96, 4.0, 4.03, 4.20, 4.34, 4.40, 4.65, 4.74, 4.80, 4.84, 5.0, 5.28, 5.40, 5.53, 5.72,
    6.0, 6.16, 6.32, 6.60, 7.11, 7.20, 7.80, 7.90, 8.0, 8.40, 8.69, 9.0, 9.48, 10.0, 10.27, 11.0, 11.06, 11.85,
    12.0, 13.0, 14.0, 15.0,
])  # fmt: skip
"""Of reinforcement in square inches; the suite has 3 and 10 where the original has 3.10, and so has its front."""

WIRES = np.array([
    0.009, 0.0095, 0.0104, 0.0118, 0.0128, 0.0132, 0.014, 0.015, 0.0162, 0.0173, 0.018, 0.02, 0.023, 0.025, 0.028,
    0.032, 0.035, 0.041, 0.047, 0.054, 0.063, 0.072, 0.08, 0.092, 0.105, 0.12, 0.135, 0.148, 0.162, 0.177, 0.192,
    0.207, 0.225, 0.244, 0.263, 0.283, 0.307, 0.331, 0.362, 0.394, 0.4375, 0.5,
])  # fmt: skip
"""Diameters of spring wire in inches."""


def nearest(values: Real, x: Real) -> Real:
    """Return the nearest of ascending `values` (k,) to each x (n,), the lower of two."""
    return values[np.searchsorted((values[1:] + values[:-1]) / 2, x)]


def four_bar_truss(x: Real) -> Answer:
    """Volume and displacement of a joint; areas of four bars."""
    force, length, modulus = 10.0, 200.0, 2e5
    a, b, c, d = x
    volume = length * (2 * a + np.sqrt(2) * b + np.sqrt(c) + d)
    root = 2 * np.sqrt(2)
    return (volume, force * length / modulus * (2 / a + root / b - root / c + 2 / d)), ()


def reinforced_beam(x: Real) -> Answer:
    """Cost of a concrete beam; area of reinforcement, width and depth."""
    area, width, depth = nearest(BAR_AREAS, x[0]), x[1], x[2]
    strength = area * depth - 7.735 * area**2 / width - 180
    return (29.4 * area + 0.6 * width * depth,), (strength, 4 - depth / width)


def pressure_vessel(x: Real) -> Answer:
    """Cost; thicknesses of shell and head in sixteenths of an inch, radius and length."""
    shell, head, radius, length = 0.0625 * np.round(x[0]), 0.0625 * np.round(x[1]), x[2], x[3]
    plates = 0.6224 * shell * radius * length + 1.7781 * head * radius**2
    welds = (3.1661 * length + 19.84 * radius) * shell**2
    volume = np.pi * radius**2 * (length + 4 / 3 * radius)
    return (plates + welds,), (shell - 0.0193 * radius, head - 0.00954 * radius, volume - 1_296_000)


def hatch_cover(x: Real) -> Answer:
    """Weight; thickness of the flange and height of the beam."""
    flange, height = x
    modulus = 700_000.0
    bending, shear = 4500 / (flange * height), 1800 / height
    deflection = 562_000 / (modulus * flange * height**2)
    buckling = modulus * flange**2 / 100
    margins = (1 - bending / 700, 1 - shear / 450, 1 - deflection / 1.5, 1 - bending / buckling)
    return (flange + 120 * height,), margins


def coil_spring(x: Real) -> Answer:
    """Volume of wire; number of coils, diameters of coil and wire."""
    coils, coil, wire = np.round(x[0]), x[1], nearest(WIRES, x[2])
    most, preload = 1000.0, 300.0
    index = coil / wire
    wahl = (4 * index - 1) / (4 * index - 4) + 0.615 / index
    rate = 11.5e6 * wire**4 / (8 * coils * coil**3)
    solid = 1.05 * (coils + 2) * wire
    stress = 8 * wahl * most * coil / (np.pi * wire**3)
    # A fourth of the suite's six margins, free length less solid one and both deflections, is always zero.
    margins = (
        189_000 - stress, 14 - most / rate - solid, index - 3, 6 - preload / rate, 1.25 - (most - preload) / rate,
    )  # fmt: skip
    return (np.pi**2 / 4 * coil * wire**2 * (coils + 2),), margins


def two_bar_truss(x: Real) -> Answer:
    """Volume and larger stress; areas of two bars and height."""
    first, second, height = x
    long, short = np.sqrt(16 + height**2), np.sqrt(1 + height**2)
    volume, stress = first * long + second * short, 20 * long / (first * height)
    return (volume, stress), (0.1 - volume, 1e5 - stress, 1e5 - 80 * short / (height * second))


def welded_beam(x: Real) -> Answer:
    """Cost and deflection; height and length of the weld, depth and width of the beam."""
    weld, seam, depth, width = x
    load, overhang, young, shear = 6000.0, 14.0, 30e6, 12e6
    cost = 1.10471 * weld**2 * seam + 0.04811 * depth * width * (14 + seam)
    deflection = 4 * load * overhang**3 / (young * width * depth**3)
    half = ((weld + depth) / 2) ** 2
    arm = np.sqrt(seam**2 / 4 + half)
    polar = 2 * np.sqrt(2) * weld * seam * (seam**2 / 12 + half)
    direct = load / (np.sqrt(2) * weld * seam)
    torsion = load * (overhang + seam / 2) * arm / polar
    stress = np.sqrt(direct**2 + direct * torsion * seam / arm + torsion**2)
    slender = 1 - depth / (2 * overhang) * np.sqrt(young / (4 * shear))
    buckling = 4.013 * young * depth * width**3 / (6 * overhang**2) * slender
    bending = 6 * load * overhang / (width * depth**2)
    return (cost, deflection), (13_600 - stress, 30_000 - bending, width - weld, buckling - load)


def disc_brake(x: Real) -> Answer:
    """Mass and stopping time; inner and outer radius, force and number of surfaces."""
    inner, outer, force, surfaces = x
    squares, cubes = outer**2 - inner**2, outer**3 - inner**3
    mass = 4.9e-5 * squares * (surfaces - 1)
    time = 9.82e6 * squares / (force * surfaces * cubes)
    margins = (
        outer - inner - 20, 0.4 - force / (3.14 * squares), 1 - 2.22e-3 * force * cubes / squares**2,
        2.66e-2 * force * surfaces * cubes / squares - 900,
    )  # fmt: skip
    return (mass, time), margins


def crashworthiness(x: Real) -> Answer:
    """Mass, acceleration and intrusion of a car's front; five thicknesses of sheet."""
    a, b, c, d, e = x
    mass = 1640.2823 + 2.3573285 * a + 2.3220035 * b + 4.5688768 * c + 7.7213633 * d + 4.4559504 * e
    acceleration = (
        6.5856 + 1.15 * a - 1.0427 * b + 0.9738 * c + 0.8364 * d - 0.3695 * a * d + 0.0861 * a * e
        + 0.3628 * b * d - 0.1106 * a**2 - 0.3437 * c**2 + 0.1764 * d**2
    )  # fmt: skip
    intrusion = (
        -0.0551 + 0.0181 * a + 0.1024 * b + 0.0421 * c - 0.0073 * a * b + 0.024 * b * c - 0.0118 * b * d
        - 0.0204 * c * d - 0.008 * c * e - 0.0241 * b**2 + 0.0109 * d**2
    )  # fmt: skip
    return (mass, acceleration, intrusion), ()


def speed_reducer(x: Real) -> Answer:
    """Weight and stress in a shaft; face width, module, teeth, lengths and diameters of two shafts."""
    face, module, teeth = x[0], x[1], np.round(x[2])
    (length, other_length), (shaft, other) = x[3:5], x[5:7]
    gears = 0.7854 * face * module**2 * (10 / 3 * teeth**2 + 14.933 * teeth - 43.0934)
    shafts = 7.477 * (shaft**3 + other**3) + 0.7854 * (length * shaft**2 + other_length * other**2)
    weight = gears - 1.508 * face * (shaft**2 + other**2) + shafts
    pitch = module * teeth
    stress = np.sqrt((745 * length / pitch) ** 2 + 1.69e7) / (0.1 * shaft**3)
    other_stress = np.sqrt((745 * other_length / pitch) ** 2 + 1.575e8) / (0.1 * other**3)
    bending = face * module**2 * teeth
    margins = (
        1 / 27 - 1 / bending, 1 / 397.5 - 1 / (bending * teeth), 40 - pitch, 12 - face / module,
        1 / 1.93 - length**3 / (pitch * shaft**4), 1 / 1.93 - other_length**3 / (pitch * other**4),
        face / module - 5, length - 1.5 * shaft - 1.9, other_length - 1.1 * other - 1.9, 1300 - stress,
        1100 - other_stress,
    )  # fmt: skip
    return (weight, stress), margins


def gear_train(x: Real) -> Answer:
    """Error of the ratio 6.931 and most teeth of a gear; teeth of four gears."""
    a, b, c, d = teeth = np.round(x)
    error = np.abs(6.931 - c / a * (d / b))
    return (error, teeth.max(axis=0)), (0.5 - error / 6.931,)


def rocket_injector(x: Real) -> Answer:
    """Two temperatures and a combustion length; angle, changes of two areas and thickness of the tip."""
    a, h, o, t = x
    face = (
        0.692 + 0.477 * a - 0.687 * h - 0.080 * o - 0.0650 * t - 0.167 * a**2 - 0.0129 * h * a + 0.0796 * h**2
        - 0.0634 * o * a - 0.0257 * o * h + 0.0877 * o**2 - 0.0521 * t * a + 0.00156 * t * h + 0.00198 * t * o
        + 0.0184 * t**2
    )  # fmt: skip
    length = (
        0.153 - 0.322 * a + 0.396 * h + 0.424 * o + 0.0226 * t + 0.175 * a**2 + 0.0185 * h * a - 0.0701 * h**2
        - 0.251 * o * a + 0.179 * o * h + 0.0150 * o**2 + 0.0134 * t * a + 0.0296 * t * h + 0.0752 * t * o
        + 0.0192 * t**2
    )  # fmt: skip
    tip = (
        0.370 - 0.205 * a + 0.0307 * h + 0.108 * o + 1.019 * t - 0.135 * a**2 + 0.0141 * h * a + 0.0998 * h**2
        + 0.208 * o * a - 0.0301 * o * h - 0.226 * o**2 + 0.353 * t * a - 0.0497 * t * o - 0.423 * t**2
        + 0.202 * h * a**2 - 0.281 * o * a**2 - 0.342 * h**2 * a - 0.245 * h**2 * o + 0.281 * o**2 * h
        - 0.184 * t**2 * a - 0.281 * h * a * o
    )  # fmt: skip
    return (face, length, tip), ()


def side_impact(x: Real) -> Answer:
    """Mass, force on the pubis and mean velocity of pillar and door; seven thicknesses of sheet."""
    a, b, c, d, e, f, g = x
    mass = 1.98 + 4.9 * a + 6.67 * b + 6.98 * c + 4.01 * d + 1.78 * e + 1e-5 * f + 2.73 * g
    force = 4.72 - 0.5 * d - 0.19 * b * c
    pillar, door = 10.58 - 0.674 * a * b - 0.67275 * b, 16.45 - 0.489 * c * g - 0.843 * e * f
    abdomen = 1.16 - 0.3717 * b * d - 0.0092928 * c
    viscous = (
        0.261 - 0.0159 * a * b - 0.06486 * a - 0.019 * b * g + 0.0144 * c * e + 0.0154464 * f,
        0.214 + 0.00817 * e - 0.0587118 * a + 0.03099 * b * f - 0.018 * b * g + 0.030408 * c - 0.00364 * e * f
        - 0.018 * b**2,
        0.74 - 0.61 * b - 0.031296 * c - 0.031872 * g + 0.227 * b**2,
    )  # fmt: skip
    ribs = (
        28.98 + 3.818 * c - 4.2 * a * b + 1.27296 * f - 2.68065 * g,
        35.31728 + 2.95 * c - 5.057 * a * b - 3.795 * b - 3.4431 * g,
        46.36 - 9.9 * b - 4.4505 * a,
    )
    margins = (1 - abdomen, *(0.32 - v for v in viscous), *(32 - r for r in ribs), 4 - force, 9.9 - pillar)
    return (mass, force, (pillar + door) / 2), (*margins, 15.7 - door)


def bulk_carrier(x: Real) -> Answer:
    """Cost of transport, light weight and cargo a year, negative; length, beam, depth, draught, speed, block.

    Days at sea are 5000 / 24 times the speed, as in the suite, not over it.
    """
    length, beam, depth, draught, knots, block = x
    displacement = 1.025 * length * beam * draught * block
    froude = 0.5144 * knots / np.sqrt(9.8065 * length)
    a, b = 4977.06 * block**2 - 8105.61 * block + 4456.51, -10847.2 * block**2 + 12817.0 * block - 6960.32
    power = displacement ** (2 / 3) * knots**3 / (a + b * froude)
    outfit = length**0.8 * beam**0.6 * depth**0.3 * block**0.1
    steel = 0.034 * length**1.7 * beam**0.7 * depth**0.4 * block**0.5
    light = steel + outfit + 0.17 * power**0.9
    dead = displacement - light
    sea_days = 5000 / 24 * knots
    consumption = 0.19 * 24 / 1000 * power + 0.2
    cargo = dead - consumption * (sea_days + 5) - 2 * np.sqrt(dead)
    trips = 350 / (sea_days + 2 * (cargo / 8000 + 0.5))
    capital = 0.26 * (2000 * steel**0.85 + 3500 * outfit + 2400 * power**0.8)
    voyages = (105 * consumption * sea_days + 6.3 * dead**0.8) * trips
    metacentric = 0.53 * draught + (0.085 * block - 0.002) * beam**2 / (draught * block) - 1 - 0.52 * depth
    margins = (
        length / beam - 6, 15 - length / depth, 19 - length / draught, 0.45 * dead**0.31 - draught,
        0.7 * depth + 0.7 - draught, 500_000 - dead, dead - 3000, 0.32 - froude, metacentric - 0.07 * beam,
    )  # fmt: skip
    return ((capital + 40_000 * dead**0.3 + voyages) / (cargo * trips), light, -cargo * trips), margins
