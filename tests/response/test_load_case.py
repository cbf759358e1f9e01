"""Load cases, limits and bad settings of the ride problem, by hand from problems of one case each."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DRIVER, FULL, HALF, QUARTER, ROAD
from suspension_ctrl import LoadCase, Payload, PowerLawRoad, RideProblem, RollGeometry, TwoSlopeRoad
from suspension_ctrl.compiled_verbs import call_compiled

STRUTS = {"front": (19e3, 1500.0), "rear.spring": 23e3}
SETTINGS = {
    "bounds": {"rear.damper": (1.2e3, 2.2e3), "front_antiroll": (0.0, 2e4)},
    "struts": STRUTS,
    "nodes": 256,
}
GEOMETRY = RollGeometry(roll_arm=0.5, front_roll_centre=0.05, rear_roll_centre=0.12, wheel_centre=0.31)
LADEN = Payload(mass=300.0, position=(-1.0, 0.1)).on(FULL)
ROUGH = PowerLawRoad(roughness=2e-5, exponent=2.2)
CASES = [
    LoadCase(vehicle=FULL, road=ROAD, speed=30.0, share=3.0, roll_geometry=GEOMETRY),
    LoadCase(vehicle=LADEN, road=ROUGH, speed=12.0, share=1.0, roll_geometry=replace(GEOMETRY, roll_arm=0.6)),
    LoadCase(vehicle=DRIVER.on(FULL), road=ROAD, speed=22.0, share=2.0, roll_geometry=GEOMETRY),
]
MEASURES = (
    *("ACC", "SWS", "DTL front", "DLC", "both = Wk body_acceleration + 0.4 We pitch_acceleration"),
    *("roll_gradient", "-roll_damping"),
)
DESIGNS = np.array([[1.3e3, 5e3], [2.1e3, 1.5e4]])


def apart(cases: list[LoadCase], measures: tuple[str, ...], **changes) -> np.ndarray:
    """Return the objectives in each case by itself, (c, n, m)."""
    return np.array(
        [RideProblem(cases=[case], measures=measures, **SETTINGS | changes).evaluate(DESIGNS) for case in cases]
    )


@pytest.fixture(scope="module")
def alone() -> np.ndarray:
    return apart(CASES, MEASURES)


def test_an_objective_is_the_root_mean_square_by_shares(alone):
    found = RideProblem(cases=CASES, measures=MEASURES, **SETTINGS).evaluate(DESIGNS)
    shares = np.array([3.0, 1.0, 2.0]) / 6
    np.testing.assert_allclose(found[:, :5], np.sqrt(np.tensordot(shares, alone[:, :, :5] ** 2, 1)), rtol=1e-12)
    np.testing.assert_allclose(found[:, 5:], np.tensordot(shares, alone[:, :, 5:], 1), rtol=1e-12)


def test_the_worst_case_is_the_largest_whatever_the_shares(alone):
    """Of what is to be large, the roll damping, the least."""
    found = RideProblem(cases=CASES, measures=MEASURES, worst_case=True, **SETTINGS).evaluate(DESIGNS)
    np.testing.assert_allclose(found, alone.max(axis=0), rtol=1e-12)
    assert (alone[:, :, 6] < 0).all()
    assert len({tuple(row) for row in alone.argmax(axis=0).T.tolist()} | {0}) > 1  # not always the same case


def test_limits_count_in_the_worst_case(alone):
    """Also where objectives are means; after the objectives, in the order of the limits."""
    limits = ("SWS <= 0.02", "roll_gradient <= 4", "roll_damping >= 0.3", "DLC rear_left <= 0.2")
    values = apart(CASES, ("SWS", "roll_gradient", "roll_damping", "DLC rear_left")).swapaxes(0, 2)
    p = RideProblem(cases=CASES, measures=("ACC", "DTL"), constraints=limits, **SETTINGS)
    found = p.evaluate(DESIGNS)
    assert p.objectives == ("ACC", "DTL")
    assert found.shape == (2, 6)
    expected = [
        values[0].max(axis=1) / 0.02 - 1,
        values[1].max(axis=1) / 4 - 1,
        1 - values[2].min(axis=1) / 0.3,
        values[3].max(axis=1) / 0.2 - 1,
    ]
    np.testing.assert_allclose(found[:, 2:], np.transpose(expected), rtol=1e-10, atol=1e-12)


def test_the_worst_corner_and_the_worst_case_are_taken_together():
    """The mean over cases of the worst corner of each, as a corner that is worst now and then counts then."""
    corners = ("front_left", "front_right", "rear_left", "rear_right")
    each = apart(CASES, tuple(f"DTL {corner}" for corner in corners))
    shares = np.array([3.0, 1.0, 2.0]) / 6
    p = RideProblem(cases=CASES, measures=("DTL", "SWS"), **SETTINGS)
    expected = np.sqrt(np.tensordot(shares, each.max(axis=2) ** 2, 1))
    np.testing.assert_allclose(p.evaluate(DESIGNS)[:, 0], expected, rtol=1e-12)


@settings(max_examples=4)
@given(st.permutations(range(3)), st.booleans(), st.floats(0.1, 10))
def test_the_order_of_cases_and_the_scale_of_shares_make_no_difference(order, worst, scale):
    changed = [replace(CASES[i], share=scale * CASES[i].share) for i in order]
    one, other = (
        RideProblem(cases=cases, measures=MEASURES, constraints=["SWS <= 0.02"], worst_case=worst, **SETTINGS)
        for cases in (CASES, changed)
    )
    np.testing.assert_allclose(one.evaluate(DESIGNS), other.evaluate(DESIGNS), rtol=1e-12, atol=1e-14)


def test_one_case_is_vehicle_road_and_speed():
    p = RideProblem(FULL, ROAD, speed=30.0, measures=MEASURES[:4], **SETTINGS)
    np.testing.assert_array_equal(p.evaluate(DESIGNS), apart(CASES[:1], MEASURES[:4])[0])


def test_cases_of_different_vehicles_with_the_same_struts():
    """A half and a full car have two and four wheels, so measures of the worst have as many terms."""
    bounds = {"front.spring": (16e3, 24e3), "rear.damper": (1.2e3, 2.2e3)}
    settings = {"bounds": bounds, "struts": {"front.damper": 1500.0, "rear.spring": 23e3}, "nodes": 256,
                "measures": ("ACC", "SWS", "DTL")}  # fmt: skip
    cases = [LoadCase(vehicle=HALF, road=ROAD, speed=20.0), LoadCase(vehicle=FULL, road=ROAD, speed=20.0)]
    designs = [[2e4, 1500.0]]
    alone = np.array([RideProblem(cases=[case], **settings).evaluate(designs) for case in cases])
    for order in (cases, cases[::-1]):
        found = RideProblem(cases=order, **settings).evaluate(designs)
        np.testing.assert_allclose(found, np.sqrt((alone**2).mean(axis=0)), rtol=1e-12)


def test_quarter_cars_with_and_without_a_seat():
    """One goes by polynomials, the other by a block."""
    settings = {"lower": (16e3, 1.2e3), "upper": (24e3, 2.2e3), "nodes": 256, "measures": ("ACC", "SWS", "DTL")}
    cases = [LoadCase(vehicle=car, road=ROAD, speed=20.0) for car in (QUARTER, DRIVER.on(QUARTER))]
    designs = [[2e4, 1500.0]]
    alone = np.array([RideProblem(cases=[case], **settings).evaluate(designs) for case in cases])
    both = RideProblem(cases=cases, **settings)
    np.testing.assert_array_equal(call_compiled(both.kernel, np.array(designs[0])), both.evaluate(designs)[0])
    np.testing.assert_allclose(both.evaluate(designs), np.sqrt((alone**2).mean(axis=0)), rtol=1e-12)


def test_kernels_of_several_cases():
    """Of quarter cars, and with limits; to the last bit what evaluate gives."""
    cases = [LoadCase(vehicle=QUARTER, road=road, speed=20.0, share=2.0) for road in (ROAD, ROUGH)]
    p = RideProblem(cases=cases, lower=(16e3, 1.2e3), upper=(24e3, 2.2e3), nodes=256, constraints=("SWS <= 0.02",))
    found = call_compiled(p.kernel, np.array([2e4, 1500.0]))
    np.testing.assert_array_equal(found, p.evaluate([[2e4, 1500.0]])[0])


def test_variables_units_and_bounds():
    p = RideProblem(cases=CASES, measures=MEASURES, **SETTINGS)
    assert p.variables == ("rear.damper", "front_antiroll")
    assert (p.lower, p.upper) == ((1.2e3, 0.0), (2.2e3, 2e4))
    assert p.units == {
        "rear.damper": "N s/m", "front_antiroll": "N m/rad", "ACC": "m/s^2", "SWS": "m", "DTL front": "N",
        "DLC": "-", "both": "m/s^2", "roll_gradient": "deg/g", "-roll_damping": "-",
    }  # fmt: skip
    listed = RideProblem(HALF, ROAD, speed=20.0, lower=(16e3, 1.2e3, 18e3, 1.2e3), upper=(24e3, 2e3, 26e3, 2e3))
    assert listed.variables == ("front.spring", "front.damper", "rear.spring", "rear.damper")
    by_name = RideProblem(HALF, ROAD, speed=20.0, bounds={"rear.spring": (1e4, 2e4), "front.spring": (1e4, 2e4)},
                          struts={"front.damper": 1e3, "rear.damper": 1e3})  # fmt: skip
    assert by_name.variables == ("rear.spring", "front.spring")


def test_the_nodes_are_as_many_as_the_resonances_need():
    """Light damping makes them sharp."""
    usual = RideProblem(FULL, ROAD, speed=20.0, **SETTINGS | {"nodes": None})
    sharp = replace(usual, struts={"front": (19e3, 150.0), "rear.spring": 23e3})
    assert usual.nodes == 256
    assert 256 < sharp.nodes < 2048
    finer = replace(sharp, nodes=2048)
    np.testing.assert_allclose(sharp.evaluate(DESIGNS), finer.evaluate(DESIGNS), rtol=1e-6)


def test_a_kink_of_the_road_costs_no_digits():
    """Its corner, met at 4 Hz, is an end of a panel; across it 256 nodes would be off by 5e-6."""
    road = TwoSlopeRoad(roughness=6.4e-5, reference=0.1, lower_exponent=1.5, upper_exponent=3.0, corner=0.2)
    p = RideProblem(HALF, road, speed=20.0, bounds={"rear.damper": (1.2e3, 2.2e3)}, struts=STRUTS, nodes=256)
    finer = replace(p, nodes=1500).evaluate(DESIGNS[:, :1])
    np.testing.assert_allclose(p.evaluate(DESIGNS[:, :1]), finer, rtol=1e-10)


PLAIN = {"vehicle": FULL, "road": ROAD, "speed": 30.0}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"cases": CASES, **PLAIN}, "cases must stand in place of vehicle, road and speed, got both"),
        ({}, "vehicle, road and speed must be given, or cases in their place, got neither"),
        ({**PLAIN, "road": None}, "vehicle, road and speed must be given, or cases in their place, got neither"),
        ({**PLAIN, "speed": -1.0}, "speed must be finite and > 0 m/s, got -1.0"),
        ({**PLAIN, "bounds": {"front.stiffness": (1e4, 2e4)}}, "bounds must be one of "),
        ({**PLAIN, "bounds": {"rear.damper": (2e3, 1e3)}}, "bounds of rear.damper must be finite with 0 <= "),
        ({**PLAIN, "bounds": {"rear.damper": 2e3}}, "bounds of rear.damper must be finite with 0 <= "),
        ({**PLAIN, "struts": STRUTS | {"rear.damper": 1e3}}, "struts must be those that do not vary, "),
        ({**PLAIN, "road": "C"}, "road must be a road such as Iso8608Road('C'), got 'C'"),
        ({**PLAIN, "vehicle": "car"}, "vehicle must be a Vehicle such as a QuarterCar, got 'car'"),
        ({**PLAIN, "measures": ("ACC", "rear.damper = SWS")}, "measures must have names of their own, got "),
        ({**PLAIN, "constraints": ("SWS <= 1", "SWS <= 1")}, "constraints must have names of their own, got "),
        ({"cases": CASES[0]}, "cases must be a list of load cases, got one by itself"),
        ({**PLAIN, "bounds": {"rear.damper": (0.0, 1e3)}}, "lower bound of rear.damper must be finite and > 0"),
        ({**PLAIN, "bounds": {"front_antiroll": (-1.0, 1e3)}},
         "bounds of front_antiroll must be finite with 0 <= lower <= upper [N m/rad], got (-1.0, 1000.0)"),
        ({**PLAIN, "bounds": {}}, "bounds must hold one coefficient at least, got none"),
        ({**PLAIN, "bounds": None, "lower": (1e4, 1e3), "upper": (2e4, 2e3)},
         "lower and upper must bound front.spring, front.damper, rear.spring, rear.damper, got (10000.0, 1000.0)"),
        ({**PLAIN, "struts": {"front": (2e4, 1500.0)}},
         "bounds and struts must have front.spring, front.damper, rear.spring, rear.damper, front_antiroll, "
         "rear_antiroll, got none for rear.spring"),
        ({**PLAIN, "struts": STRUTS | {"middle.spring": 1.0}}, "setting must be one of "),
        ({**PLAIN, "measures": ("ACC",)}, "measures must be 2 or more with different names, got ('ACC',)"),
        ({**PLAIN, "measures": "ACC"}, "measures must be a list, got 'ACC'"),
        ({**PLAIN, "measures": ("ACC", "ACC")},
         "measures must be 2 or more with different names, got ('ACC', 'ACC')"),
        ({**PLAIN, "measures": ("ACC", "ACC = SWS")}, "measures must be 2 or more with different names, got "),
        ({**PLAIN, "measures": ("ACC", 5)},
         "measure must be a text such as 'SWS front' or 'name = SWS front', got 5"),
        ({**PLAIN, "measures": ("roll_damping", "-roll_damping")}, "measures must hold one of the ride, got "),
        ({**PLAIN, "measures": ("ACC", "roll_gradient")},
         "roll_geometry must be given in every load case for roll_gradient, got None"),
        ({**PLAIN, "constraints": ("front_load_transfer <= 0.6",)},
         "roll_geometry must be given in every load case for front_load_transfer, got None"),
        ({**PLAIN, "constraints": ("SWS",)},
         "constraint must be like 'SWS <= 30mm' or 'roll_damping >= 0.2', got 'SWS'"),
        ({**PLAIN, "weighting": "Wz"}, "weighting must be one of Wk, "),
        ({**PLAIN, "band": (5.0, 1.0)}, "band must be finite with 0 <= lower < upper [Hz], got (5.0, 1.0)"),
        ({**PLAIN, "nodes": 20}, "nodes must resolve every resonance in the box to 1e-06, got 20, which is off"),
        ({**PLAIN, "nodes": 2.5}, "nodes must be a whole number >= 2, got 2.5"),
        ({"cases": [CASES[0], replace(CASES[0], vehicle=HALF)]},
         "bounds and struts must be one of front.damping_ratio, front.spring, front.damper, rear.spring, "),
    ],
)  # fmt: skip
def test_rejects_bad_settings(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        RideProblem(**SETTINGS | changes)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["speed", "share"])
def test_rejects_bad_cases(name):
    with pytest.raises(ValueError, match=rf"^{name} must be finite and > 0( m/s)?, got 0\.0$"):
        LoadCase(**{"vehicle": FULL, "road": ROAD, "speed": 20.0, name: 0.0})
