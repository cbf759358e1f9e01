"""Sky dampers: transfer functions by hand, the plain vehicle without them, names and errors."""

from dataclasses import replace

import numpy as np
import pytest

from garage import DRIVER, FULL, HALF, QUARTER, struts_of
from suspension_ctrl import (
    Damper,
    Iso8608Road,
    Plant,
    RideProblem,
    Spring,
    load_vehicle,
    ride,
    series,
    skyhook,
)  # fmt: skip

ROAD = Iso8608Road("C")


def test_a_quarter_car_with_a_sky_damper_by_hand():
    """(M_b s^2 + (C + C_sky) s + K) z2 = (C s + K) z1, and the wheel gets the opposite force."""
    ms, mu, kt, k, c, sky = 317.5, 45.4, 192e3, 22e3, 1500.0, 1200.0
    s = 2j * np.pi * np.array([0.5, 1.4, 6.0, 15.0])
    body = np.array([ms * s**2 + (c + sky) * s + k, -(c * s + k)])
    wheel = np.array([-((c + sky) * s + k), mu * s**2 + c * s + k + kt])
    z2 = -body[1] * kt / (body[0] * wheel[1] - body[1] * wheel[0])
    closed = skyhook(QUARTER).closed({"spring": k, "damper": c, "sky": sky})
    np.testing.assert_allclose(closed["body_acceleration", "road"](s), s**2 * z2, rtol=1e-10)


@pytest.mark.parametrize("vehicle", [QUARTER, HALF, FULL, DRIVER.on(HALF)])
def test_without_sky_damper_it_is_the_vehicle(vehicle):
    plain, sky = (
        ride(one, struts_of(vehicle), ROAD, 20.0, band=(0.3, 20.0)) for one in (vehicle, skyhook(vehicle))
    )
    np.testing.assert_allclose(sky["value"][plain.index], plain["value"], rtol=1e-9)


def test_each_axle_has_its_own():
    names = [one.name for one in skyhook(FULL).strut_coefficients]
    assert names[-2:] == ["front.sky", "rear.sky"]
    assert [one.name for one in skyhook(DRIVER.on(HALF)).strut_coefficients][-2:] == ["front.sky", "rear.sky"]
    assert [one.name for one in skyhook(QUARTER).strut_coefficients] == ["spring", "damper", "sky"]
    both = {**struts_of(FULL), "front.sky": 800.0, "rear.sky": 900.0}
    forces = skyhook(FULL).closed(both, responses=["front_left_strut_force", "rear_right_strut_force"])
    assert np.linalg.eigvals(forces.A).real.max() < 0


@pytest.mark.parametrize("name", ["half", "quarter"])
def test_a_problem_searches_them_alone_or_beside_springs(name):
    """Mean squares of compiled loops, whatever varies, are those of one vehicle by `ride`."""
    vehicle = {"half": HALF, "quarter": QUARTER}[name]
    sky = {"half": ("front.sky", "rear.sky"), "quarter": ("sky",)}[name]
    fixed = vehicle.coefficients(struts_of(vehicle))
    design = [700.0 + 100.0 * i for i in range(len(sky))]
    alone = RideProblem(
        skyhook(vehicle),
        ROAD,
        speed=20.0,
        bounds=dict.fromkeys(sky, (0.0, 2000.0)),
        struts=fixed,
        band=(0.3, 20.0),
    )
    bounds = {one: (0.5 * value, 2 * value) for one, value in fixed.items()} | dict(alone.bounds)
    every = RideProblem(skyhook(vehicle), ROAD, speed=20.0, bounds=bounds, band=(0.3, 20.0))
    setting = fixed | dict(zip(sky, design, strict=True))
    table = ride(skyhook(vehicle), setting, ROAD, 20.0, band=(0.3, 20.0))
    expected = table["value"][["ACC", "SWS", "DTL"]]
    np.testing.assert_allclose(alone.evaluate([design])[0], expected, rtol=1e-6)
    np.testing.assert_allclose(every.evaluate([[*fixed.values(), *design]])[0], expected, rtol=1e-6)


def test_only_vehicles_of_masses_have_them():
    with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links.*, got a int$"):
        skyhook(3)
    with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links.*, got a Plant$"):
        skyhook(Plant(QUARTER.plant()))
    mount = series(Damper(), Spring("mount"))
    for vehicle in (load_vehicle("volvo_xc90_digressive").vehicle, replace(QUARTER, strut=mount)):
        with pytest.raises(ValueError, match=r"^vehicle must have struts of springs, dampers.*, got others$"):
            skyhook(vehicle)
