"""Mean squares of load cases: spectral moments, inerters and further ports, by hand-made equations of motion."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from garage import FULL, QUARTER, ROAD, SPEED, from_roads, mean_squares, struts_of
from suspension_ctrl import LoadCase, PowerLawRoad, QuarterCar, Term
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.one_strut import OneStrut
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.vehicles.assembly import Assembly, Link, StrutCoefficient
from suspension_ctrl.vehicles.vehicle import AssembledVehicle, Vehicle

SETTING = {"spring": 22e3, "damper": 1500.0}
BAND = (0.1, 20.0)


@dataclass(frozen=True)
class Assembled(AssembledVehicle):
    """A vehicle that is put together by hand."""

    parts: Assembly

    @property
    def assembly(self) -> Assembly:
        return self.parts


def case(vehicle: Vehicle, terms: list[Term], setting: dict, variables: list[str], **changes):
    options = {"road": ROAD, "band": BAND, "nodes": 256} | changes
    load_case = LoadCase(vehicle=vehicle, road=options.pop("road"), speed=SPEED)
    return case_of(load_case, terms, setting, variables, **options)


@pytest.mark.parametrize("design", [(22e3, 1500.0), (12e3, 3000.0)])
def test_travel_crosses_its_mean_as_often_whatever_the_strut(design):
    """Under white road velocity sqrt(kt/M)/(2 pi) times a second upwards; the band to 2 kHz lacks 1e-7 of m2."""
    car = paper.ride_problem().vehicle
    terms = [Term("suspension_travel", moment=order) for order in (0, 2)]
    road = PowerLawRoad(roughness=1e-6, exponent=2.0)
    wide = case(car, terms, SETTING, ["spring", "damper"], road=road, band=(0.0, 2000.0), nodes=4096)
    assert isinstance(wide, OneStrut)
    zeroth, second = wide(np.array([design]))[0]
    expected = np.sqrt(car.tyre_stiffness / (car.body_mass + car.wheel_mass)) / (2 * np.pi)
    assert np.sqrt(second / zeroth) / (2 * np.pi) == pytest.approx(expected, rel=1e-6)
    assert expected == pytest.approx(3.66, abs=0.005)


@pytest.mark.parametrize("vehicle", [QUARTER, FULL])
def test_moments_are_those_of_the_spectrum(vehicle):
    """By python-control's closed model at the nodes of the quadrature."""
    name = next(name for name in vehicle.responses if name.endswith("suspension_travel"))
    setting = vehicle.coefficients(struts_of(vehicle))
    found = case(vehicle, [Term(name, moment=n) for n in (0, 2, 4)], setting, list(setting))
    f, w = frequency_nodes(BAND, 256)
    h = from_roads(vehicle, setting, [name], f)
    spectrum = np.einsum("nmi,nij,nmj->n", h, ROAD.cross_spectrum(f, SPEED, vehicle.contact_points), h.conj()).real
    expected = [((2 * np.pi * f) ** n * spectrum) @ w for n in (0, 2, 4)]
    np.testing.assert_allclose(found(np.array([list(setting.values())]))[0], expected, rtol=1e-9)


def inerter_car() -> Assembled:
    """The quarter car with an inerter beside its spring and damper."""
    assembly = QUARTER.assembly
    inerter = StrutCoefficient("inerter", "kg", np.eye(1), 2, 0.0)
    return Assembled(replace(assembly, strut_coefficients=(*assembly.strut_coefficients, inerter)))


def by_hand(inertance: float, f: np.ndarray) -> dict[str, np.ndarray]:
    """Responses to the road, from (-w^2 M + jw C + K) z = (kt, 0) x with the inertance in M."""
    m, k, c = QUARTER, SETTING["spring"], SETTING["damper"]
    apart = np.array([[1.0, -1.0], [-1.0, 1.0]])
    w = 2 * np.pi * f[:, None, None]
    mass = np.diag([m.wheel_mass, m.body_mass]) + inertance * apart
    stiffness = np.diag([m.tyre_stiffness, 0.0]) + k * apart
    z = np.linalg.solve(-(w**2) * mass + 1j * w * c * apart + stiffness, np.array([[m.tyre_stiffness], [0.0]]))
    wheel, body = z[:, 0, 0], z[:, 1, 0]
    return {
        "body_acceleration": -((2 * np.pi * f) ** 2) * body,
        "suspension_travel": body - wheel,
        "tyre_load": m.tyre_stiffness * (wheel - 1.0),
    }


@pytest.mark.parametrize("variables", [["inerter"], ["damper", "inerter", "spring"], ["spring"]])
def test_an_inerter_is_a_coefficient_of_second_order(variables):
    """It varies, or is in place already."""
    terms = [Term(name) for name in QUARTER.responses]
    f, w = frequency_nodes(BAND, 256)
    for inertance in (0.0, 15.0, 80.0):
        middle = {**SETTING, "inerter": 40.0 if "inerter" in variables else inertance}
        design = [{**SETTING, "inerter": inertance}[name] for name in variables]
        found = case(inerter_car(), terms, middle, variables)(np.array([design]))[0]
        responses = by_hand(inertance, f)
        expected = [(np.abs(responses[name]) ** 2 * ROAD.psd(f, SPEED)) @ w for name in QUARTER.responses]
        np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_a_change_of_a_mass_is_a_port():
    """A strut of second order between the inertial frame and the body is a further mass of the body."""
    assembly = QUARTER.assembly
    alone, load = (np.diag(share) for share in ([1.0, 0.0], [0.0, 1.0]))
    spring, damper = assembly.strut_coefficients
    car = Assembled(
        replace(
            assembly,
            struts=(*assembly.struts, Link("load", None, "body")),
            strut_coefficients=(
                replace(spring, gain=alone),
                replace(damper, gain=alone),
                StrutCoefficient("load", "kg", load, 2, 0.0),
            ),
        )
    )
    terms = [Term(name) for name in QUARTER.responses]
    found = case(car, terms, {**SETTING, "load": 0.0}, ["load"])(np.array([[0.0], [50.0], [-20.0]]))
    for change, row in zip((0.0, 50.0, -20.0), found, strict=True):
        changed: QuarterCar = replace(QUARTER, body_mass=QUARTER.body_mass + change)
        expected = mean_squares(changed, SETTING, [(name, None) for name in QUARTER.responses], BAND, 256)
        np.testing.assert_allclose(row, expected, rtol=1e-9)
