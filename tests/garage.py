"""Vehicles to test with, and their mean squares by python-control's closed models."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from suspension_ctrl import FlexibleBody, FullCar, HalfCar, LoadCase, PowerLawRoad, QuarterCar, RollGeometry, Seat
from suspension_ctrl.response import weightings
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.vehicles.assembly import ResponseName
from suspension_ctrl.vehicles.vehicle import Setting, Vehicle

ROAD = PowerLawRoad(roughness=5e-6, exponent=2.5)
SPEED = 20.0

_AXLES = {
    "front_wheel_mass": 40.0, "rear_wheel_mass": 45.0, "front_tyre_stiffness": 192e3, "rear_tyre_stiffness": 200e3,
    "cg_to_front": 1.2, "cg_to_rear": 1.5,
}  # fmt: skip
_DAMPED = {"front_tyre_damping": 120.0, "rear_tyre_damping": 80.0}
QUARTER = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
HALF = HalfCar(body_mass=650.0, pitch_inertia=1200.0, **_AXLES)
FULL = FullCar(
    body_mass=1300.0, roll_inertia=480.0, pitch_inertia=2400.0, front_track=1.5, rear_track=1.46, **_AXLES
)
DAMPED_QUARTER = replace(QUARTER, tyre_damping=100.0)
DAMPED_HALF, DAMPED_FULL = replace(HALF, **_DAMPED), replace(FULL, **_DAMPED)
DRIVER = Seat(mass=80.0, spring=12e3, damper=700.0, position=(0.3, 0.4), name="driver")
PASSENGER = Seat(mass=60.0, spring=14e3, damper=600.0, position=(-0.9, -0.35), name="passenger")
CORNERS = [(1.2, 0.75), (1.2, -0.75), (-1.5, 0.73), (-1.5, -0.73)]
"""Where the struts of `FULL` stand."""

BENDING = FlexibleBody(
    frequencies=[7.0, 13.0],
    damping_ratios=[0.03, 0.05],
    shapes={
        **dict(zip(CORNERS, [(0.03, 0.02), (0.03, -0.02), (0.04, -0.025), (0.04, 0.025)], strict=True)),
        (0.0, 0.0): (-0.02, 0.0), (0.3, 0.4): (-0.015, 0.01), (1.2, 0.0): (0.03, 0.0), (-1.5, 0.0): (0.04, 0.0),
    },
)  # fmt: skip

VEHICLES: dict[str, Vehicle] = {
    "quarter": QUARTER,
    "half": HALF,
    "full": FULL,
    "damped quarter": DAMPED_QUARTER,
    "damped half": DAMPED_HALF,
    "damped full": DAMPED_FULL,
    "quarter with seat": DRIVER.on(QUARTER),
    "half with seat": DRIVER.on(HALF),
    "full with seat": DRIVER.on(FULL),
    "damped full with seats": PASSENGER.on(DRIVER.on(DAMPED_FULL)),
    "bending quarter": BENDING.on(DAMPED_QUARTER),
    "bending half": BENDING.on(HALF),
    "bending full with seat": DRIVER.on(BENDING.on(FULL)),
}

_VALUES = {"spring": 21e3, "damper": 1600.0, "front": (19e3, 1500.0), "rear": (23e3, 1700.0)}


def struts_of(vehicle: Vehicle) -> dict[str, float | tuple[float, float]]:
    """Return usual coefficients of those that have no default."""
    needed = {p.name for p in vehicle.strut_coefficients if p.default is None}
    return {name: value for name, value in _VALUES.items() if name in needed or f"{name}.spring" in needed}


GEOMETRY = RollGeometry(roll_arm=0.5, front_roll_centre=0.05, rear_roll_centre=0.12, wheel_centre=0.31)


def on_road(vehicle: Vehicle) -> LoadCase:
    """Return a load case with roll geometry."""
    return LoadCase(vehicle=vehicle, road=ROAD, speed=SPEED, roll_geometry=GEOMETRY)


def from_roads(
    vehicle: Vehicle, settings: Setting, responses: Sequence[ResponseName], f: np.ndarray
) -> np.ndarray:
    """Return the responses (n, m, r) to the displacement of the roads, by python-control's closed model."""
    s = 2j * np.pi * f[:, None, None]
    h = np.moveaxis(vehicle.closed(settings, responses=responses)(s[:, 0, 0], squeeze=False), 2, 0)
    r = len(vehicle.contact_points)
    return h[:, :, :r] + s * h[:, :, r:] if h.shape[2] > r else h


def mean_squares(
    vehicle: Vehicle,
    settings: Setting,
    terms: Sequence[tuple[ResponseName, str | None]],
    band: tuple[float, float],
    nodes: int,
    kinks: Sequence[float] = (),
    road: PowerLawRoad = ROAD,
    speed: float = SPEED,
) -> np.ndarray:
    """Return the mean square (m,) of responses, each with its weighting, at the nodes of the library."""
    f, w = frequency_nodes(band, nodes, kinks)
    responses = list(dict.fromkeys(response for response, _ in terms))
    h = from_roads(vehicle, settings, responses, f)[:, [responses.index(response) for response, _ in terms]]
    spectrum = road.cross_spectrum(f, speed, vehicle.contact_points)
    densities = np.einsum("nmi,nij,nmj->mn", h, spectrum, h.conj()).real
    factors = [1.0 if name is None else weightings.by_name(name).factor(f) ** 2 for _, name in terms]
    return np.array([(density * w * factor).sum() for density, factor in zip(densities, factors, strict=True)])


masses = st.floats(200, 3000)
wheel_masses = st.floats(20, 100)
tyre_stiffnesses = st.floats(1e5, 4e5)
tyre_dampings = st.floats(0, 500)
springs = st.floats(5e3, 8e4)
dampers = st.floats(300, 6e3)
lengths = st.floats(0.5, 2.5)
inertias = st.floats(200, 4000)


@st.composite
def axles(draw: st.DrawFn) -> dict[str, float]:
    """Parameters that a half and a full car share, of the axles."""
    return {
        "front_wheel_mass": draw(wheel_masses), "rear_wheel_mass": draw(wheel_masses),
        "front_tyre_stiffness": draw(tyre_stiffnesses), "rear_tyre_stiffness": draw(tyre_stiffnesses),
        "front_tyre_damping": draw(tyre_dampings), "rear_tyre_damping": draw(tyre_dampings),
        "cg_to_front": draw(lengths), "cg_to_rear": draw(lengths),
    }  # fmt: skip


@st.composite
def axle_struts(draw: st.DrawFn) -> dict[str, tuple[float, float]]:
    """Struts of a half or a full car."""
    return {"front": (draw(springs), draw(dampers)), "rear": (draw(springs), draw(dampers))}
