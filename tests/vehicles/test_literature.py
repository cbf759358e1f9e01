"""Vehicles of rigid bodies in the package: frequencies that their sources print, and energies written out here."""

import numpy as np
import pytest
from scipy.linalg import eigh

import suspension_ctrl as sc


def found(name, **changes):
    file = sc.load_vehicle(name)
    return file.vehicle.modes({**file.setting, **changes})["frequency [Hz]"].to_numpy()


def by_energies(masses, springs):
    """Frequencies [Hz] of kinetic energies m/2 (row z')^2 and elastic ones k/2 (row z)^2; rows by coordinate."""
    m, k = (sum(value * np.outer(row, row) for value, row in pairs) for pairs in (masses, springs))
    return np.sqrt(eigh(k, m, eigvals_only=True)) / (2 * np.pi)


def unit(n):
    return list(np.eye(n))


def test_truck_and_trailer_with_printed_frequencies():
    """Abaqus prints these for the same input, to within half a unit of the last digit."""
    printed = [
        "1.4010",
        "1.5923",
        "1.9731",
        "4.8321",
        "7.3248",
        "8.8112",
        "12.351",
        "12.367",
        "12.661",
        "13.422",
        "29.174",
        "29.775",
    ]
    for one, text in zip(found("cantero_2022_truck"), printed, strict=True):
        assert abs(one - float(text)) <= 0.5 * 10.0 ** -len(text.partition(".")[2])


def test_truck_and_trailer_from_energies():
    """The source's coordinates, x backward: y1, turn 1, turn 2, y3, turn 3, five axles, turns of the groups."""
    y1, t1, t2, y3, t3, *axles, g2, g3 = unit(12)
    y2 = y1 + 2 * t1 + 6 * t2  # of the trailer, by the pin
    bodies = [(5e3, y1), (4e3, t1), (30e3, y2), (20e3, t2), (20e3, y3), (10e3, t3), (200.0, g2), (300.0, g3)]
    masses = [*bodies, *zip([750.0, 1500.0, 2250.0, 750.0, 750.0], axles, strict=True)]
    tops = [y1 - t1, y1 + 3 * t1, y2 + 2 * t2, y3 - 2.5 * t3, y3 + 2.5 * t3]
    springs = [(k, top - low) for k, top, low in zip([5e5, 2e6, 3e6, 1e6, 1e6], tops, axles, strict=True)]
    tyres = [
        axles[0] / 2**0.5,
        axles[1] - g2,
        axles[1] + g2,
        *(axles[2] + e * g3 for e in (-1.2, 0.0, 1.2)),
        *axles[3:],
    ]
    mine = by_energies(masses, [*springs, *((3.5e6, row) for row in tyres)])
    np.testing.assert_allclose(found("cantero_2022_truck"), mine, rtol=1e-9)


def test_off_centre_full_car():
    """Without a bar, from stiffness and mass of another program, to six decimals; then energies with the bar."""
    known = [0.839216, 1.113826, 1.463380, 8.427188, 8.433388, 10.019027, 10.021885]
    np.testing.assert_allclose(found("jazar_full", front_antiroll=0.0), known, rtol=0, atol=5.1e-7)
    z, roll, pitch, *wheels = unit(7)
    places = [(1.4, 0.7), (1.4, -0.75), (-1.47, 0.7), (-1.47, -0.75)]
    travel = [z - x * pitch + y * roll - wheel for (x, y), wheel in zip(places, wheels, strict=True)]
    springs = list(zip([10e3, 10e3, 13e3, 13e3], travel, strict=True)) + [(200e3, wheel) for wheel in wheels]
    springs.append((10e3 / 1.45**2, travel[0] - travel[1]))
    masses = [(840.0, z), (820.0, roll), (1100.0, pitch), *zip([53.0, 53.0, 76.0, 76.0], wheels, strict=True)]
    np.testing.assert_allclose(found("jazar_full"), by_energies(masses, springs), rtol=1e-9)


def test_motorcycle_from_the_points_of_its_source():
    """Four coordinates: body, pitch, front wheel, swing arm. The file rounds to 2e-4."""
    points = {
        "frame": (0.6779, 0.4724), "rider": (0.415, 1.14), "fork": (1.164, 0.77), "pivot": (0.549, 0.3608),
        "arm": (0.196, 0.3113), "wheel": (0.0, 0.297), "rod": (0.3722, 0.2748), "crank_rod": (0.4946, 0.1522),
        "crank": (0.539, 0.1878), "crank_spring": (0.4443, 0.1782), "top": (0.487, 0.4888),
    }  # fmt: skip
    p = {name: np.array(point) for name, point in points.items()}

    def moved(arm, turn):
        return turn * np.array([-arm[1], arm[0]])

    step = 1e-6  # of the swing arm: the crank turns until the rod has its length again
    rod = np.linalg.norm(p["rod"] - p["crank_rod"])
    along = (p["crank_rod"] - p["rod"]) / rod
    turn = along @ moved(p["rod"] - p["pivot"], step) / (along @ moved(p["crank_rod"] - p["crank"], 1.0))
    stretched = p["crank_spring"] + moved(p["crank_spring"] - p["crank"], turn) - p["top"]
    stretch = np.linalg.norm(stretched) - np.linalg.norm(p["crank_spring"] - p["top"])
    rear = stretch / moved(p["wheel"] - p["pivot"], step)[1]
    slope = np.hypot(0.068, 0.144) / 0.144  # of the fork
    parts = [(165.13, "frame", 22.013), (33.68, "rider", 1.347), (9.99, "fork", 1.548)]
    mass = sum(one for one, _, _ in parts)
    centre = sum(one * p[name] for one, name, _ in parts) / mass
    inertia = sum(own + one * ((p[name] - centre) ** 2).sum() for one, name, own in parts)
    z, pitch, wheel, arm = unit(4)

    def height(x):
        return z - (x - centre[0]) * pitch

    def on_arm(x):  # which turns by `arm` about the pivot
        return height(0.549) - (x - 0.549) * arm

    masses = [(mass, z), (inertia, pitch), (19.15, wheel), (8.0, on_arm(0.196)), (14.7, on_arm(0.0))]
    masses.append((0.259 + 8.0 * (0.3113 - 0.30204) ** 2 + 14.7 * (0.297 - 0.30204) ** 2, arm))
    springs = [(25e3 * slope**2, height(1.41) - wheel), (130e3, wheel)]
    springs += [(58570 * rear**2, height(0.0) - on_arm(0.0)), (141e3, on_arm(0.0))]
    np.testing.assert_allclose(found("minaker_motorcycle"), by_energies(masses, springs), rtol=2e-4)


def test_tractor_and_semitrailer_from_energies():
    """Sixteen coordinates; a fifth wheel makes heights and rolls equal. Axles as in the file."""
    file = sc.load_vehicle("kraz_semitrailer")
    z, roll, pitch, turn, *rest = unit(16)
    axles, rolls = rest[:6], rest[6:]
    trailer = z + 2.64 * pitch + 5.96 * turn  # height of its centre of gravity
    bodies = {body.name: body for body in file.vehicle.bodies}
    masses = [(10e3, z), (3441.0, roll), (28485.0, pitch), (20e3, trailer), (23904.0, roll), (322240.0, turn)]
    springs = []
    sizes = {"front": (592176, 0.529, 673874, 0.919), "drive": (1026439, 0.429, 1347749, 0.8491)}
    sizes["trailer"] = (710612, 0.729, 1225025, 1.0325)
    places = {"front": 2.0, "drive_front": -2.08, "drive_rear": -3.48}
    places |= {"trailer_front": -0.32, "trailer_middle": -1.63, "trailer_rear": -2.94}  # from its own centre
    for (name, x), height, tilt in zip(places.items(), axles, rolls, strict=True):
        spring, inner, tyre, outer = sizes[name.partition("_")[0]]
        axle = bodies[f"{name}_axle"]
        masses += [(axle.mass, height), (axle.roll_inertia, tilt)]
        top = trailer - x * turn if name.startswith("trailer") else z - x * pitch
        for side in (1, -1):
            springs.append((spring, top + side * inner * roll - height - side * inner * tilt))
            springs.append((tyre, height + side * outer * tilt))
    matrices = (
        file.vehicle.assembly.mass_matrix,
        file.vehicle.statics.stiffness_of(np.array([list(file.vehicle.coefficients(file.setting).values())]))[0],
    )
    mine = np.sqrt(eigh(*matrices[::-1], eigvals_only=True)) / (2 * np.pi)
    np.testing.assert_allclose(mine, by_energies(masses, springs), rtol=1e-5)


def test_axles_of_the_semitrailer_are_those_of_its_source():
    """Tube, spindles, knuckles, tie rod, wheels and tyres in kg and m, the rest by Steiner; a load index in kg."""
    bodies = {body.name: body for body in sc.load_vehicle("kraz_semitrailer").vehicle.bodies}
    assert bodies["front_axle"].mass == pytest.approx(581 + 5 + 2 * (14.705 + 68 + 30 + 90))
    assert bodies["trailer_front_axle"].mass == pytest.approx(500 + 2 * (14.705 + 30 + 69.3))
    outside = 2 * (14.705 + 99.3) * 1.0325**2 + 2 * (0.04117 + 0.6 + 9.41035)
    assert bodies["trailer_front_axle"].roll_inertia == pytest.approx(178.4760417 + outside, abs=5e-3)
    wheels = {wheel.name: wheel for wheel in sc.load_vehicle("kraz_semitrailer").vehicle.wheels}
    assert wheels["front_left"].tyre_stiffness == pytest.approx(3350 * 9.81 / (0.16 * 0.3048), abs=0.5)
    assert wheels["front_left"].tyre_damping == pytest.approx((673874 * 90) ** 0.5, abs=0.5)
    assert wheels["trailer_front_left"].tyre_damping == pytest.approx((1225025 * 69.3) ** 0.5, abs=0.5)
    assert wheels["trailer_front_left"].tyre_stiffness == pytest.approx(
        5000 * 9.81 / (0.16 * 0.385 * 0.65), abs=0.5
    )


def test_cab_over_tractor_with_printed_loads_and_roll_stiffness():
    """The source prints both: loads of wheels [N], and N m/deg of springs and auxiliary stiffness of an axle."""
    file = sc.load_vehicle("trucksim_cab_over")
    values = np.array([list(file.vehicle.coefficients(file.setting).values())])
    loads = dict(zip(file.vehicle.wheels, file.vehicle.statics.static_loads(values)[0], strict=True))
    printed = {"front": 18449.92485, "rear": 11175.9648}
    for wheel, load in loads.items():
        assert load == pytest.approx(printed[wheel.name.partition("_")[0]], rel=1e-8)
    stiffness, at = file.vehicle.statics.stiffness_of(values)[0], file.vehicle.assembly.coordinates.index
    for axle, roll in {"front": 10228.09413, "rear": 7608.652382}.items():
        between = -stiffness[at("roll"), at(f"{axle}_axle_roll")]
        assert between * np.pi / 180 == pytest.approx(roll, rel=1e-5)  # bars in the file rounded to 1 N m/rad


def test_cab_over_tractor_from_energies():
    """The frame by what the cab leaves of the sprung mass; an axle's wheels and tyres by their places."""
    whole, cab = np.array([-1.110, 1.175]), np.array([0.5, 1.8])  # centres of gravity: forward, upward
    frame = (4455 * whole - 1000 * cab) / 3455
    pitch = 35402.8 - 100 - 3455 * ((frame - whole) ** 2).sum() - 1000 * ((cab - whole) ** 2).sum()
    roll = 2283.9 - 100 - 3455 * (frame - whole)[1] ** 2 - 1000 * (cab - whole)[1] ** 2
    z, r, p, zc, rc, pc, front, front_roll, rear, rear_roll = unit(10)
    twin = (1.863 / 2) ** 2 + (0.310 / 2) ** 2  # mean square place of two tyres
    masses = [(3455, z), (roll, r), (pitch, p), (1000, zc)]
    masses += [(100 + 1000 * (1.8 - 0.8) ** 2, rc), (100 + 1000 * (1.8 - 0.875) ** 2, pc)]
    masses += [(290 + 2 * (36 + 91), front), (80 + 2 * (36 + 91) * 1.015**2, front_roll)]
    masses += [(679 + 4 * 91, rear), (215 + 4 * 91 * twin, rear_roll)]

    def height(x, y):
        return z - (x - frame[0]) * p + y * r

    springs = [(487014, r - front_roll), (85944, r - rear_roll)]
    for side in (1, -1):
        springs.append((250e3, height(0.0, side * 0.445) - front - side * 0.445 * front_roll))
        springs.append((700e3, height(-4.0, side * 0.5) - rear - side * 0.5 * rear_roll))
        springs.append((980e3, front + side * 1.015 * front_roll))
        springs.append((1.96e6, rear + side * twin**0.5 * rear_roll))
        for x, y in ((1.4, 0.5), (0.0, 0.8)):
            springs.append((100e3, zc - (x - 0.5) * pc + side * y * rc - height(x, side * y)))
    np.testing.assert_allclose(found("trucksim_cab_over"), by_energies(masses, springs), rtol=2e-5)
