"""The ride of one vehicle; spectra, phases and natural frequencies of single designs by hand."""

import re

import control
import numpy as np
import pytest

from garage import DRIVER, FULL, HALF, QUARTER, ROAD, mean_squares, struts_of
from suspension_ctrl import Iso8608Road, Plant, PowerLawRoad, QuarterCar, RideProblem, ride, weighting
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.response import responses
from suspension_ctrl.response.quadrature import frequency_nodes

DESIGN = (22e3, 1500.0)


class Spectrum:
    """A road of one wheel, known by its spectrum alone: G V^(p-1)/f^p."""

    def __init__(self, power: float) -> None:
        self.power = power

    def psd(self, f: np.ndarray, speed: float) -> np.ndarray:
        return 1e-6 * speed ** (self.power - 1) / f**self.power


@pytest.mark.parametrize(
    "vehicle", [QUARTER, HALF, FULL, DRIVER.on(FULL)], ids=["quarter", "half", "full", "seat"]
)
def test_the_ride_of_a_vehicle_is_the_value_of_a_problem_at_its_setting(vehicle):
    setting = vehicle.coefficients(struts_of(vehicle))
    free = [one.name for one in vehicle.strut_coefficients if one.default is None]
    problem = RideProblem(
        vehicle,
        ROAD,
        speed=20.0,
        band=(0.1, 20.0),
        bounds={name: (0.8 * setting[name], 1.1 * setting[name]) for name in free},
        struts={name: value for name, value in setting.items() if name not in free},
    )
    table = ride(vehicle, struts_of(vehicle), ROAD, 20.0, band=(0.1, 20.0))
    found = problem.evaluate([[setting[name] for name in free]])[0]
    np.testing.assert_allclose(table.value.iloc[:3], found, rtol=1e-12)
    assert table.index.tolist() == ["ACC", "SWS", "DTL", *vehicle.meanings]
    assert table.unit.iloc[:3].tolist() == ["m/s^2", "m", "N"]
    assert not table.note.any()


def test_the_ride_has_the_root_mean_square_of_every_response():
    """By python-control's closed model at the nodes of the quadrature."""
    vehicle = DRIVER.on(FULL)
    options = {"weighting": None, "band": (0.1, 20.0), "measures": ["ACC driver"]}
    table = ride(vehicle, struts_of(vehicle), ROAD, 20.0, **options)
    terms = [(name, None) for name in vehicle.meanings]
    expected = np.sqrt(mean_squares(vehicle, struts_of(vehicle), terms, (0.1, 20.0), 256))
    np.testing.assert_allclose(table.value.loc[list(vehicle.meanings)], expected, rtol=1e-9)
    assert table.value["ACC driver"] == table.value["driver_acceleration"]


def test_the_ride_of_a_car_is_that_of_others():
    """Values of another program to four or five digits: passive car of github samarthgupta128/PS2, 2000 N s/m."""
    car = QuarterCar(body_mass=290.0, wheel_mass=59.0, tyre_stiffness=190e3)
    value = ride(car, (16e3, 2000.0), Iso8608Road("C"), 20.0, band=(0.1, 20.0)).value
    expected = {
        "body_displacement": 24.508e-3, "body_velocity": 92.33e-3, "body_acceleration": 1.58698,
        "body_jerk": 77.90, "wheel_displacement": 23.059e-3, "wheel_acceleration": 11.040,
        "suspension_travel": 9.388e-3, "suspension_travel_rate": 217.5e-3, "strut_force": 460.22,
        "tyre_deflection": 4.1871e-3, "tyre_load": 795.55,
    }  # fmt: skip
    for name, one in expected.items():
        digits = len(f"{one:.6g}".replace(".", "").strip("0"))
        assert value[name] == pytest.approx(one, rel=0.6 * 10.0 ** (1 - digits)), name
    assert value["strut_force"] == pytest.approx(290.0 * value["body_acceleration"], rel=1e-9)  # Newton
    assert value["tyre_load"] == pytest.approx(190e3 * value["tyre_deflection"], rel=1e-9)


def test_the_ride_takes_spring_and_damper_of_a_quarter_car():
    by_name = ride(QUARTER, {"spring": 22e3, "damper": 1500.0}, ROAD, 20.0)
    assert ride(QUARTER, DESIGN, ROAD, 20.0).equals(by_name)


def test_the_ride_takes_any_system_as_weighting():
    """The filter of ISO 2631 as a transfer function, in state space, and as frequency responses at 4000 lines."""
    named = ride(QUARTER, DESIGN, ROAD, 20.0, weighting="Wk", band=(0.5, 20.0)).value["ACC"]
    filter_, lines = weighting("Wk"), 2 * np.pi * np.linspace(0.4, 21.0, 4000)
    measured = control.frd(filter_(1j * lines), lines)
    for system, rtol in ((filter_, 1e-14), (control.ss(filter_), 1e-9), (measured, 1e-9)):
        found = ride(QUARTER, DESIGN, ROAD, 20.0, weighting=system, band=(0.5, 20.0)).value["ACC"]
        assert found == pytest.approx(named, rel=rtol)


def test_a_road_of_one_wheel_is_any_object_with_a_spectrum():
    road = PowerLawRoad(roughness=1e-6, exponent=2.0)
    found, expected = (ride(QUARTER, DESIGN, one, 20.0).value for one in (Spectrum(2.0), road))
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_a_diverging_integral_is_none_and_gives_its_reason():
    """Of a response that falls as f^k the spectrum falls or rises as f^(2 k - p), on roads of p from 0.5 to 5."""
    rises = {"displacement": 0, "velocity": 1, "rate": 3, "jerk": 3}
    for exponent in (0.5, 1.2, 2.5, 3.2, 4.5, 5.2):
        table = ride(QUARTER, DESIGN, Spectrum(exponent), 20.0)
        power = [2 * rises.get(name.rpartition("_")[2], 2) - exponent for name in table.index]
        assert table.value.isna().tolist() == [one <= -1 for one in power]
        assert set(table.note) <= {"", "diverges towards 0 Hz: begin the band above"}
        assert (table.note != "").tolist() == table.value.isna().tolist()
    assert ride(QUARTER, DESIGN, Spectrum(5.2), 20.0, band=(0.1, 20.0)).value.notna().all()


def test_a_plant_whose_body_follows_the_road_has_no_displacement_from_zero_hertz():
    """The displacement of the body, an output of its own: from 0.1 Hz on it is by hand, the rest is from 0 Hz."""
    assembled = QUARTER.plant()
    states = [*assembled.state_labels]
    row = np.zeros((1, len(states)))
    row[0, states.index("body_displacement")] = 1.0
    system = control.ss(
        assembled.A, assembled.B, np.vstack([row, assembled.C]), np.vstack([0 * assembled.D[:1], assembled.D]),
        inputs=assembled.input_labels, outputs=["body_displacement", *assembled.output_labels],
    )  # fmt: skip
    plant = Plant(system, contacts={"": (0.0, 0.0)})
    table, above = (ride(plant, DESIGN, ROAD, 20.0, band=band) for band in ((0.0, 20.0), (0.1, 20.0)))
    assert table.note["body_displacement"] == "diverges towards 0 Hz: begin the band above"
    assert np.isnan(table.value["body_displacement"])
    rest = table.drop("body_displacement")
    assert not rest.note.any()
    np.testing.assert_allclose(rest.value[:3], ride(QUARTER, DESIGN, ROAD, 20.0).value[:3], rtol=1e-9)
    f, w = frequency_nodes((0.1, 20.0), 256)
    h = plant.closed(DESIGN, responses=["body_displacement"])
    expected = np.sqrt((np.abs(h(2j * np.pi * f)) ** 2 * ROAD.psd(f, 20.0)) @ w)
    assert above.value["body_displacement"] == pytest.approx(float(expected), rel=1e-9)
    assert (above.unit["body_displacement"], above.note["body_displacement"]) == ("m", "")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"band": (1.0, 0.5)}, "band must be finite with 0 <= lower < upper [Hz], got (1.0, 0.5)"),
        ({"measures": "ACC"}, "measures must be a list, got 'ACC'"),
        ({"measures": ["SWS front"]}, "SWS must be of one of all wheels, got 'front'"),
        ({"speed": 0.0}, "speed must be finite and > 0 m/s, got 0.0"),
        (
            {"weighting": control.rss(2, 2, 1)},
            "weighting must have one input and one output in ",
        ),
        (
            {"weighting": control.tf([1], [1, 1], 0.1)},
            "weighting must have one input and one output in ",
        ),
        ({"weighting": control.frd([1, 1, 1, 1], [10, 20, 30, 40])}, "band must lie within what was measured, "),
        ({"vehicle": HALF, "road": Spectrum(2.0)}, "road must have a cross_spectrum for 2 wheels, got "),
        ({"road": "C"}, "road must be a road such as Iso8608Road('C'), got 'C'"),
        ({"setting": {"spring": 1e4}}, "setting must have spring, damper, got none for damper"),
    ],
)
def test_the_ride_rejects(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        ride(**{"vehicle": QUARTER, "setting": DESIGN, "road": ROAD, "speed": 20.0} | changes)
    assert "\n" not in str(caught.value)


def test_a_spectrum_of_another_shape_is_refused():
    class Flat(Spectrum):
        def psd(self, f, speed):
            return -f[:1]

    with pytest.raises(ValueError, match=r"^psd of the road must return 2 finite values >= 0 m\^2/Hz, got shape"):
        ride(QUARTER, DESIGN, Flat(1.0), 20.0)


def test_spectra_integrate_to_the_objectives():
    """Equations (3), (9), (10), (12), (13) by python-control's closed model; 256 nodes give 1e-9."""
    p = paper.ride_problem(weighting=None)
    f, w = frequency_nodes(p.band, 256)
    spectra = responses.response_psds(p.vehicle.closed(*DESIGN), f, p.road.psd(f, p.speed))
    found = [np.sqrt((spectra[name] * w).sum()) for name in p.vehicle.responses]
    np.testing.assert_allclose(found, p.evaluate([DESIGN])[0], rtol=1e-9)


def test_phases_begin_as_the_signs_say_and_go_on_without_jumps():
    """At low frequency body acceleration is -w^2 times the road, so opposite; both deflections begin with it.

    The body's inertia makes it overshoot: z2 - z1 = w^2 m_b/k z2, and likewise z1 - x0 for both masses.
    """
    f = np.geomspace(0.01, 20, 2000)
    h = responses.frequency_responses(paper.ride_problem().vehicle.closed(*DESIGN), f)
    phases = {name: responses.phase_degrees(response) for name, response in h.items()}
    assert phases["body_acceleration"][0] == pytest.approx(180, abs=1)
    assert phases["suspension_travel"][0] == pytest.approx(0, abs=1)
    assert phases["tyre_load"][0] == pytest.approx(0, abs=1)
    for phase in phases.values():
        assert np.abs(np.diff(phase)).max() < 10
        assert phase[-1] < phase[0] - 150  # it lags more and more
    np.testing.assert_allclose(responses.phase_degrees(np.array([-1 - 1e-9j, -1 + 1e-9j])), [180, 180], atol=1e-6)
