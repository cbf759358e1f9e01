"""A vehicle put together by hand of masses and links, against matrices written out."""

import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest

from garage import BENDING, FULL, HALF, from_roads
from suspension_ctrl.quantities import Record
from suspension_ctrl.vehicles.assembly import Assembly, Link, Response, joined, label
from suspension_ctrl.vehicles.elements import Damper, Spring
from suspension_ctrl.vehicles.networks import placed
from suspension_ctrl.vehicles.struts import parallel
from suspension_ctrl.vehicles.vehicle import AssembledVehicle, anti_roll_bar

STRUT = parallel(Spring(), Damper())


@dataclass(frozen=True, eq=False, repr=False)
class Cab(Record, AssembledVehicle):
    """A cab on a frame on a wheel: two struts over a damped tyre, a support to ground."""

    cab: float = 300.0

    @cached_property
    def assembly(self) -> Assembly:
        return Assembly(
            masses={"wheel": 50.0, "frame": 800.0, "body": self.cab},
            contacts={"axle": (0.0, 0.0)},
            tyres=[Link("axle", "axle_road", "wheel", 3e5, 200.0)],
            struts=[Link("axle", "wheel", "frame"), Link("cab", "frame", (0.0, 0.0))],
            supports=[Link("lead", None, "body", 500.0, 40.0)],
            strut_coefficients=[*placed(STRUT, "axle", [1.0, 0.0])[0], *placed(STRUT, "cab", [0.0, 1.0])[0]],
            responses={
                "frame_acceleration": Response("acceleration", "frame"),
                "cab_travel": Response("travel", "cab"),
                "axle_tyre_load": Response("load", "axle"),
            },
        )


def test_a_chain_of_masses_by_matrices_written_out():
    """(M s^2 + C s + K) z = tyre forces; a solution of 3 equations, to some hundred units of rounding."""
    f = np.geomspace(0.1, 40, 9)
    found = from_roads(Cab(), {"axle": (4e4, 3e3), "cab": (1e4, 800.0)}, Cab().responses, f)[:, :, 0]
    for s, h in zip(2j * np.pi * f, found, strict=True):
        tyre, axle, cab, lead = 3e5 + 200 * s, 4e4 + 3e3 * s, 1e4 + 800 * s, 500 + 40 * s
        impedance = np.diag([50 * s**2 + tyre + axle, 800 * s**2 + axle + cab, 300 * s**2 + cab + lead])
        impedance[[0, 1, 1, 2], [1, 0, 2, 1]] = -axle, -axle, -cab, -cab
        z = np.linalg.solve(impedance, [tyre, 0, 0])
        np.testing.assert_allclose(h, [s**2 * z[1], z[2] - z[1], tyre * (z[0] - 1)], rtol=1e-10)


def test_signals_bear_the_names_of_the_links():
    plant = Cab().plant(["cab_travel"])
    assert plant.input_labels == ["axle_road", "axle_road_rate", "axle_strut", "cab_strut"]
    assert plant.output_labels == [
        "cab_travel",
        *("axle_deflection", "cab_deflection", "axle_deflection_rate", "cab_deflection_rate"),
    ]
    assert plant.state_labels[:2] == ["wheel_displacement", "wheel_velocity"]
    assert label(("acceleration", 1.2, -0.4)) == "acceleration_at_1200_-400_mm"
    assert joined("", "road") == "road"


def test_weights_and_masses_count_what_is_carried():
    assembly = Cab(cab=250.0).assembly
    np.testing.assert_array_equal(assembly.mass_matrix, np.diag([50.0, 800.0, 250.0]))
    np.testing.assert_array_equal(assembly.weights, [50.0, 800.0, 250.0])
    assert assembly.sprung_mass == 1050.0


def test_deflections_are_those_of_a_rigid_body():
    """A strut over a corner of the full car: heave - x pitch + y roll - wheel, the road not at all."""
    e, road = FULL.assembly.elongations(FULL.assembly.struts)
    coordinates = FULL.assembly.coordinates
    for i, (corner, (x, y)) in enumerate(FULL.contacts.items()):
        row = dict(zip(coordinates, e[i], strict=True))
        assert (row["body"], row["pitch"], row["roll"], row[f"{corner}_wheel"]) == (1, -x, y, -1)
    assert not road.any()


def test_a_bar_resists_the_difference_of_travels():
    assert anti_roll_bar("bar", [1.0, -1.0], 2.0).gain.tolist() == [[0.25, -0.25], [-0.25, 0.25]]


BASE = {
    "masses": {"wheel": 40.0, "body": 300.0}, "contacts": {"": (0.0, 0.0)}, "responses": {},
    "tyres": [Link("", "road", "wheel", 2e5)], "struts": [Link("", "wheel", "body")], "strut_coefficients": [],
}  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"contacts": {"front": (0.0, 0.0)}},
         "tyres must be front, each from its road, got (Link(name='', lower='road', upper='wheel', "
         "stiffness=200000.0, damping=0.0),)"),
        ({"contacts": {"a": (0.0, 0.0)}, "tyres": [Link("a", "ground", "wheel")]},
         "tyres must be a, each from its road, got (Link(name='a', lower='ground', upper='wheel', stiffness=0.0, "
         "damping=0.0),)"),
        ({"tyres": []}, "tyres must be those of contacts, each from its road, got ()"),
        ({"struts": [Link("speed", "wheel", "body")]},
         "struts must not be called responses, road, speed, got 'speed'"),
        ({"bending": {(0.0, 0.0): {"bending_1": 0.1}}, "payload": [(10.0, (1.0, 0.0))]},
         "position must be one with known mode shapes, [(0.0, 0.0)], got (1.0, 0.0)"),
        ({"bending": {(0.0, 0.0): {"bending_1": 0.1}}, "struts": [Link("", "wheel", (0.5, 0.0))]},
         "position must be one with known mode shapes, [(0.0, 0.0)], got (0.5, 0.0)"),
    ],
)  # fmt: skip
def test_rejects_assemblies_that_do_not_fit(changes, message):
    assert Assembly(**BASE).coordinates == ("wheel", "body")
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Assembly(**BASE | changes)


@pytest.mark.parametrize(
    ("responses", "message"),
    [
        (
            ["roll_acceleration"],
            "response must be one of body_acceleration, .*pitch_acceleration, .* got 'roll_acceleration'",
        ),
        ([("velocity", 0.0, 0.0)], "response must be one of body_acceleration, pitch_acceleration"),
        (["body_acceleration"] * 2, "responses must differ, points by a millimetre or more, got "),
        ([("acceleration", 0.1, 0.0), ("acceleration", 0.1001, 0.0)], "responses must differ, points by a mill"),
    ],
)
def test_rejects_responses_that_it_does_not_have(responses, message):
    with pytest.raises(ValueError, match="^" + message):
        HALF.plant(responses)


def test_a_point_of_a_flexible_body_needs_mode_shapes():
    with pytest.raises(ValueError, match=r"^position must be one with known mode shapes, .*, got \(0\.7, 0\.0\)$"):
        BENDING.on(FULL).plant([("acceleration", 0.7, 0.0)])
