"""Statics and roll against the formulas of textbooks, and roll damping against python-control."""

import re
from dataclasses import replace
from functools import cached_property

import control
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from garage import (
    BENDING,
    DRIVER,
    FULL,
    HALF,
    PASSENGER,
    QUARTER,
    ROAD,
    axle_struts,
    axles,
    inertias,
    lengths,
    masses,
)
from suspension_ctrl import FullCar, Payload, RideProblem, RollGeometry, Seat
from suspension_ctrl.vehicles.assembly import GRAVITY, Assembly, Link
from suspension_ctrl.vehicles.handling import check_cornering, check_roll
from suspension_ctrl.vehicles.vehicle import AssembledVehicle, Vehicle

GEOMETRY = RollGeometry(roll_arm=0.5, front_roll_centre=0.05, rear_roll_centre=0.12, wheel_centre=0.31)
bars = st.floats(0, 4e4)
heights = st.floats(-0.2, 0.3)


def coefficients(vehicle: Vehicle, struts: dict) -> np.ndarray:
    return np.array([list(vehicle.coefficients(struts).values())])


def axle_stiffnesses(car: FullCar, axle: str, struts: dict) -> tuple[float, float]:
    """Roll stiffness [N m/rad] of an axle: springs k t^2/2 and bar, and tyres k_t t^2/2 in series with them."""
    half_square = getattr(car, f"{axle}_track") ** 2 / 2
    suspension = struts[axle][0] * half_square + struts[f"{axle}_antiroll"]
    return suspension, getattr(car, f"{axle}_tyre_stiffness") * half_square


def axle_stiffness(car: FullCar, axle: str, struts: dict) -> float:
    suspension, tyres = axle_stiffnesses(car, axle, struts)
    return 1 / (1 / suspension + 1 / tyres)


def cornering(
    car: FullCar, struts: dict, geometry: RollGeometry, mass: float, weights: dict[str, float]
) -> tuple[float, float]:
    """Roll [rad/g] and front share by hand, of a sprung mass [kg] whose weight [N] on each axle is known.

    An axle of springs K_s on tyres K_t carries M = weight times roll centre + 2 m_w g times wheel centre itself.
    It leans by psi, K_t psi = K_s (roll - psi) + M, and the body by K_s (roll - psi) summed = m g h (1 + roll); an
    axle's load transfer is K_t psi over its track (moments as by Milliken and Milliken, chapter 18).
    """
    moment = mass * GRAVITY * geometry.roll_arm
    held, turned, axle_moments = -moment, moment, {}
    for axle, weight in weights.items():
        k_s, k_t = axle_stiffnesses(car, axle, struts)
        wheels = 2 * getattr(car, f"{axle}_wheel_mass") * GRAVITY * geometry.wheel_centre
        axle_moments[axle] = weight * getattr(geometry, f"{axle}_roll_centre") + wheels
        held += k_s * k_t / (k_s + k_t)
        turned += k_s * axle_moments[axle] / (k_s + k_t)
    roll = turned / held
    transfer = {}
    for axle, m in axle_moments.items():
        k_s, k_t = axle_stiffnesses(car, axle, struts)
        transfer[axle] = k_t * (k_s * roll + m) / (k_s + k_t) / getattr(car, f"{axle}_track")
    return roll, transfer["front"] / sum(transfer.values())


@st.composite
def cars(draw: st.DrawFn) -> tuple[FullCar, dict, RollGeometry]:
    car = FullCar(
        body_mass=draw(masses), roll_inertia=draw(inertias), pitch_inertia=draw(inertias),
        front_track=draw(lengths), rear_track=draw(lengths), **draw(axles()),
    )  # fmt: skip
    struts = {**draw(axle_struts()), "front_antiroll": draw(bars), "rear_antiroll": draw(bars)}
    arm = draw(st.floats(0.01, 0.4)) * (
        sum(axle_stiffness(car, axle, struts) for axle in ("front", "rear")) / (car.body_mass * GRAVITY)
    )  # below where the body falls over
    geometry = RollGeometry(
        roll_arm=arm, front_roll_centre=draw(heights), rear_roll_centre=draw(heights), wheel_centre=0.31
    )
    return car, struts, geometry


@settings(max_examples=60)
@given(cars())
def test_roll_gradient_and_load_transfer_are_those_by_hand(case):
    """Solved directly to some 1e-13 of conditions up to 1e3; where it leans less than it falls over."""
    car, struts, geometry = case
    mechanics, values = car.statics, coefficients(car, struts)
    levers = {"front": car.cg_to_rear, "rear": car.cg_to_front}
    weights = {axle: car.body_mass * GRAVITY * lever / sum(levers.values()) for axle, lever in levers.items()}
    roll, share = cornering(car, struts, geometry, car.body_mass, weights)
    np.testing.assert_allclose(mechanics.roll_gradient(values, geometry), min(np.degrees(roll), 180), rtol=1e-9)
    np.testing.assert_allclose(mechanics.front_load_transfer(values, geometry), share, rtol=1e-8, atol=1e-8)


def test_with_stiff_tyres_and_low_roll_centres_the_gradient_is_the_textbook_s():
    """m g h over sum K - m g h."""
    car = replace(FULL, front_tyre_stiffness=1e12, rear_tyre_stiffness=1e12)
    struts = {"front": (2e4, 1500.0), "rear": (2e4, 1500.0), "front_antiroll": 1e4, "rear_antiroll": 0.0}
    stiffness = sum(axle_stiffness(car, axle, struts) for axle in ("front", "rear"))
    moment = car.body_mass * GRAVITY * GEOMETRY.roll_arm
    found = car.statics.roll_gradient(coefficients(car, struts), GEOMETRY)
    np.testing.assert_allclose(found, np.degrees(moment / (stiffness - moment)), rtol=1e-5)


def test_a_body_that_topples_leans_by_180_degrees():
    """Where springs do not hold its weight; not by a negative angle, which a limit from above would let pass."""
    car = replace(FULL, front_track=0.9, rear_track=0.9)
    struts = [{"front": (k, 1500.0), "rear": (k, 1500.0)} for k in (2e3, 8e4)]
    rows = np.vstack([coefficients(car, strut) for strut in struts])
    high = replace(GEOMETRY, roll_arm=1.0)
    soft, stiff = car.statics.roll_gradient(rows, high)
    assert soft == 180.0
    assert 0 < stiff < 180


@settings(max_examples=30)
@given(cars(), st.floats(20, 150), st.floats(-1, 1), st.floats(-0.5, 0.5), st.booleans())
def test_what_is_carried_counts_where_it_is(case, mass, x, y, seated):
    """A seat or a payload adds m g h to the moment; roll centres carry what the levers give them of it.

    Where it is across makes no difference: only heave, roll and pitch that it begins with do.
    """
    car, struts, geometry = case
    if seated:
        loaded = Seat(mass=mass, spring=1e4, damper=500.0, position=(x, y)).on(car)
    else:
        loaded = Payload(mass=mass, position=(x, y)).on(car)
    mechanics, values = loaded.statics, coefficients(loaded, struts)
    wheelbase = car.cg_to_front + car.cg_to_rear
    levers = {"front": (car.cg_to_rear, x + car.cg_to_rear), "rear": (car.cg_to_front, car.cg_to_front - x)}
    weights = {axle: GRAVITY * (car.body_mass * own + mass * of) / wheelbase for axle, (own, of) in levers.items()}
    roll, share = cornering(car, struts, geometry, car.body_mass + mass, weights)
    assume(0 < roll < 3)  # heavier, it may fall over
    np.testing.assert_allclose(mechanics.roll_gradient(values, geometry), np.degrees([roll]), rtol=1e-8)
    found = mechanics.front_load_transfer(values, geometry)
    np.testing.assert_allclose(found, [share], rtol=1e-7, atol=1e-7)


def test_a_bar_takes_load_transfer_to_its_axle():
    struts = {"front": (2e4, 1500.0), "rear": (2e4, 1500.0)}
    mechanics = FULL.statics

    def share(**bar: float) -> float:
        return float(mechanics.front_load_transfer(coefficients(FULL, struts | bar), GEOMETRY)[0])

    assert share(front_antiroll=2e4) > share() > share(rear_antiroll=2e4)
    gradients = [
        mechanics.roll_gradient(coefficients(FULL, struts | {"front_antiroll": bar}), GEOMETRY)[0]
        for bar in (0, 2e4)
    ]
    assert gradients[0] > gradients[1] > 0


VEHICLES = {
    "quarter": (QUARTER, {"spring": 2e4, "damper": 1500.0}, 317.5 + 45.4),
    "half": (HALF, {"front": (2e4, 1.0), "rear": (1e4, 1.0)}, 650 + 40 + 45),
    "full with seats": (
        PASSENGER.on(DRIVER.on(FULL)),
        {"front": (2e4, 1.0), "rear": (1e4, 1.0), "front_antiroll": 1e4},
        1300 + 2 * 40 + 2 * 45 + 80 + 60,
    ),
    "bending full": (BENDING.on(FULL), {"front": (2e4, 1.0), "rear": (1e4, 1.0)}, 1300 + 2 * 40 + 2 * 45),
}  # fmt: skip


@pytest.mark.parametrize("name", VEHICLES)
def test_static_loads_sum_to_the_weight(name):
    car, struts, mass = VEHICLES[name]
    loads = car.statics.static_loads(coefficients(car, struts))
    assert loads.sum() == pytest.approx(mass * GRAVITY, rel=1e-10)
    assert (loads > 0).all()


def test_static_loads_of_a_half_car_follow_the_lever_rule():
    loads = HALF.statics.static_loads(coefficients(HALF, {"front": (2e4, 1.0), "rear": (1e4, 1.0)}))
    expected = [(650 * 1.5 / 2.7 + 40) * GRAVITY, (650 * 1.2 / 2.7 + 45) * GRAVITY]
    np.testing.assert_allclose(loads, [expected], rtol=1e-10)


def test_static_loads_of_a_full_car_with_a_seat_balance_moments():
    """About both axes; what left and right carry of it depends on the springs."""
    car = DRIVER.on(FULL)
    struts = {"front": (2e4, 1.0), "rear": (1e4, 1.0), "front_antiroll": 5e3}
    loads = car.statics.static_loads(coefficients(car, struts))[0]
    wheels = GRAVITY * np.array([40, 40, 45, 45])
    x, y = FULL.contact_points.T
    assert loads @ x == pytest.approx(wheels @ x + 80 * GRAVITY * 0.3, rel=1e-9)
    assert (loads - wheels) @ y == pytest.approx(80 * GRAVITY * 0.4, rel=1e-9)


@settings(max_examples=25)
@given(cars())
def test_roll_damping_is_that_of_the_closed_model(case):
    """Of the modes of python-control, the one whose velocities have the most energy in roll."""
    car, struts, _ = case
    closed = car.closed(struts)
    found = car.statics.roll_damping(coefficients(car, struts))[0]
    energies = np.diag(car.assembly.mass_matrix)
    roll = car.assembly.coordinates.index("roll")
    poles, vectors = np.linalg.eig(closed.A)
    kinetic = energies[:, None] * np.abs(vectors[1::2]) ** 2
    pole = poles[(kinetic[roll] / kinetic.sum(axis=0)).argmax()]
    _, ratio, all_poles = control.damp(closed, doprint=False)
    assert found == pytest.approx(ratio[np.abs(all_poles - pole).argmin()], rel=1e-6)
    assert 0 < found <= 1


def test_roll_damping_on_stiff_tyres_is_that_of_one_mass():
    """sum of c t^2/2 over 2 sqrt(J sum of (k t^2/2 + bar)); tyres 1e6 times as stiff."""
    car = FullCar(
        body_mass=1300.0, roll_inertia=480.0, pitch_inertia=2400.0, front_wheel_mass=40.0, rear_wheel_mass=45.0,
        front_tyre_stiffness=2e10, rear_tyre_stiffness=2e10, cg_to_front=1.2, cg_to_rear=1.2,
        front_track=1.5, rear_track=1.5,
    )  # fmt: skip
    struts = {"front": (2e4, 800.0), "rear": (2e4, 800.0), "front_antiroll": 1e4, "rear_antiroll": 1e4}
    k, c = 4 * 2e4 * 0.75**2 + 2e4, 4 * 800.0 * 0.75**2
    found = car.statics.roll_damping(coefficients(car, struts))
    np.testing.assert_allclose(found, [c / (2 * np.sqrt(480.0 * k))], rtol=1e-5)


def test_roll_that_creeps_has_damping_1():
    struts = {"front": (2e3, 6e3), "rear": (2e3, 6e3)}
    assert FULL.statics.roll_damping(coefficients(FULL, struts)).tolist() == [1.0]


def test_designs_are_worked_out_together_as_alone():
    rng = np.random.default_rng(0)
    rows = np.vstack([coefficients(FULL, {"front": (k, 1500.0), "rear": (2e4, c)})
                      for k, c in rng.uniform((1e4, 1e3), (3e4, 3e3), (40, 2))])  # fmt: skip
    mechanics = FULL.statics
    for function in (
        mechanics.static_loads,
        mechanics.roll_damping,
        lambda x: mechanics.roll_gradient(x, GEOMETRY),
        lambda x: mechanics.front_load_transfer(x, GEOMETRY),
    ):
        np.testing.assert_array_equal(function(rows), np.concatenate([function(row[None]) for row in rows]))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"roll_arm": 0.0}, "roll_arm must be finite and > 0 m, got 0.0"),
        ({"wheel_centre": -0.3}, "wheel_centre must be finite and > 0 m, got -0.3"),
        ({"front_roll_centre": float("nan")}, "front_roll_centre must be a number from -10 to 10, got nan"),
        ({"rear_roll_centre": "low"}, "rear_roll_centre must be a number from -10 to 10, got 'low'"),
    ],
)
def test_rejects_bad_geometry(changes, message):
    known = {"roll_arm": 0.5, "front_roll_centre": 0.05, "rear_roll_centre": 0.12, "wheel_centre": 0.31}
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        RollGeometry(**known | changes)


class Renamed(AssembledVehicle):
    """A full car whose wheels are called otherwise."""

    @cached_property
    def assembly(self) -> Assembly:
        def new(name):
            return name.replace("front", "steered").replace("rear", "driven") if isinstance(name, str) else name

        car = FULL.assembly
        return replace(
            car,
            masses={new(name): mass for name, mass in car.masses.items()},
            contacts={new(name): position for name, position in car.contacts.items()},
            tyres=[Link(*map(new, tyre)) for tyre in car.tyres],
            struts=[Link(*map(new, strut)) for strut in car.struts],
        )


@pytest.mark.parametrize(
    ("car", "measure", "message"),
    [
        (HALF, "roll_damping", "roll_damping must be of a vehicle that rolls, got one with body, front_wheel, "
         "rear_wheel, pitch"),
        (QUARTER, "roll_gradient", "roll_gradient must be of a vehicle that rolls, got one with wheel, body"),
        (Renamed(), "front_load_transfer",
         "front_load_transfer must be of a vehicle with tyres front_left, front_right, "
         "rear_left, rear_right on wheels of these names, got tyres steered_left, steered_right, driven_left, "
         "driven_right"),
    ],
)  # fmt: skip
def test_measures_of_vehicles_that_do_not_have_them_are_one_line(car, measure, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        (check_roll if measure == "roll_damping" else check_cornering)(measure, car.assembly)


def test_a_problem_with_wheels_of_other_names_is_refused_at_birth_but_for_roll_damping():
    bounds = {name: (1e4, 2e4) if name.endswith("spring") else (1e3, 2e3) for name in struts_by_name(FULL)}
    known = {"vehicle": Renamed(), "road": ROAD, "speed": 20.0, "band": (0.5, 20.0), "bounds": bounds}
    assert RideProblem(**known, measures=["ACC", "- roll_damping"]).objectives == ("ACC", "- roll_damping")
    with pytest.raises(
        ValueError, match=r"^roll_gradient must be of a vehicle with tyres front_left, .*driven_right$"
    ):
        RideProblem(**known, measures=["ACC", "roll_gradient"])


def struts_by_name(car: Vehicle) -> list[str]:
    return [one.name for one in car.strut_coefficients if one.default is None]


def test_springs_that_are_laws_carry_the_vehicle():
    """Tables of one slope are springs: loads and roll as with these."""
    plain = sc.load_vehicle("jian_2022_full").vehicle
    own = {name: getattr(plain, name) for name in plain.__dataclass_fields__ if "strut" not in name}
    springs = {
        axle: sc.TableSpring(deflection=[-0.2, 0.0, 0.2], force=[-0.2 * k, 0.0, 0.2 * k])
        for axle, k in (("front", 10e3), ("rear", 13e3))
    }
    laws = sc.FullCar(
        **own,
        front_strut=sc.parallel(springs["front"], sc.Damper()),
        rear_strut=sc.parallel(springs["rear"], sc.Damper()),
    )
    setting = {"front.damper": 2e3, "rear.damper": 2e3, "front_antiroll": 25e3}
    values = [
        laws.coefficients(setting),
        plain.coefficients(setting | {"front.spring": 10e3, "rear.spring": 13e3}),
    ]
    payload = sc.Payload(mass=150.0, position=(-0.4, 0.3))
    for part in (lambda car: car, payload.on):
        found, expected = (
            part(car).statics.static_loads(np.array([list(row.values())]))
            for car, row in zip((laws, plain), values, strict=True)
        )
        np.testing.assert_allclose(found, expected, rtol=1e-12)
