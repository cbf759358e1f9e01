"""Designs certified in time: simulated beside linearised values, intervals, counts, limits and load cases."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, GEOMETRY, HALF, QUARTER, ROAD, struts_of
from suspension_ctrl.response.measures.measure import Measure
from suspension_ctrl.response.measures.robust import Robust
from suspension_ctrl.response.trips import random_profile

SPEED, BAND, LENGTH, SEEDS = 20.0, (0.1, 20.0), 1000.0, range(3)
BOUNDS = {"spring": (10e3, 30e3), "damper": (500.0, 5e3)}
BOUNCY = sc.parallel(
    sc.Spring(), sc.BilinearDamper(bump=750.0, rebound=2250.0), sc.BumpStop(gap=0.06, stiffness=50e3)
)


def heat(f, spectra):
    return 1500.0 * np.trapezoid((2 * np.pi * f) ** 2 * spectra["suspension_travel"], f)


@pytest.fixture(scope="module")
def linear():
    """A linear quarter car with measures of all kinds."""
    problem = sc.RideProblem(
        QUARTER, ROAD, speed=SPEED, band=BAND, bounds=BOUNDS,
        events={"bump": (sc.SpeedBump(height=0.05, length=2.0), 8.0)},
        measures=[
            "ACC", "SWS", "DTL", "DLC", "body_jerk", "topping 0.04", "largest travel 250", "largest travel 2000",
            "damper_power", "peak min travel bump", sc.Measure("heat", "W", heat),
            sc.Measure("price", "-", lambda designs: designs[:, 0]),
        ],
        constraints=["SWS <= 0.02", "DTL <= 2000", "bottoming 0.04 <= 1e6"],
    )  # fmt: skip
    return problem, sc.certify(problem, [22e3, 1500.0], length=4000.0, seeds=range(6))


def test_every_measure_of_a_linear_car_is_simulated_as_it_is_linearised(linear):
    """Within 5 standard errors of the mean, from half of the 95 % interval of 6 seeds (2.57 of them)."""
    problem, certificate = linear
    table = certificate.to_frame().loc["1"]
    assert list(table.index[:12]) == list(problem.objectives)
    assert set(table.index[12:]) == {"bottoming 0.04", "lift"}
    evaluated = problem.evaluate([[22e3, 1500.0]])[0]
    np.testing.assert_allclose(table.linearised.iloc[:12], evaluated[:12], rtol=1e-12)
    sampled = table.dropna(subset=["low"])
    assert len(sampled) == 12
    error = (sampled.high - sampled.low) / 2 / 2.57
    assert (np.abs(sampled.simulated - sampled.linearised) < 5 * error).all()
    assert (error[:5] < 0.03 * sampled.simulated[:5]).all()
    assert sampled.outside.sum() <= 2
    assert table.equivalent.isna().all()


def test_what_is_not_of_a_drive_says_it(linear):
    table = linear[1].to_frame().loc["1"]
    assert table.note[table.note != ""].to_dict() == {"price": "not of a drive, the value of the design alone"}
    assert np.isnan(table.simulated["price"])
    assert "price: not of a drive" in repr(linear[1])


def test_a_largest_value_over_more_than_the_roads_is_not_counted():
    problem = sc.RideProblem(
        QUARTER, ROAD, speed=SPEED, band=BAND, bounds=BOUNDS, measures=["SWS", "largest travel 2000"]
    )
    table = sc.certify(problem, [22e3, 1500.0], LENGTH, SEEDS).to_frame().loc["1"]
    assert np.isnan(table.simulated["largest travel 2000"])
    assert table.note["largest travel 2000"] == "of longer roads than these"


def test_the_peak_in_an_event_is_that_of_a_simulation(linear):
    table, event = linear[1].to_frame().loc["1"], sc.SpeedBump(height=0.05, length=2.0)
    history = sc.simulate(QUARTER, (22e3, 1500.0), event, 8.0)
    assert table.simulated["peak min travel bump"] == -history["suspension_travel [m]"].min()
    assert np.isnan(table.low["peak min travel bump"])
    assert table.linearised["peak min travel bump"] == pytest.approx(-history["suspension_travel [m]"].min(), 1e-3)


def test_a_peak_of_a_laden_car_with_a_law_is_a_change_from_rest():
    """Simulated as in the problem; the weight of the payload alone takes more travel than the bump."""
    strut = sc.parallel(
        sc.Spring(), sc.BilinearDamper(bump=750.0, rebound=2250.0), sc.BumpStop(gap=0.1, stiffness=1e5)
    )
    laden = sc.Payload(mass=150.0).on(replace(QUARTER, strut=strut))
    problem = sc.RideProblem(
        laden, ROAD, speed=20.0, bounds={"spring": (20e3, 24e3)}, band=(0.2, 20.0),
        events={"bump": (sc.SpeedBump(height=0.03, length=2.0), 8.0)},
        measures=["ACC", "peak body_acceleration bump", "peak travel bump"],
    )  # fmt: skip
    table = sc.certify(problem, [22e3], 400.0, range(2)).to_frame().loc["1"]
    peaks = table.loc[["peak body_acceleration bump", "peak travel bump"]]
    np.testing.assert_allclose(peaks.simulated, peaks.linearised, rtol=1e-3)
    assert peaks.simulated["peak travel bump"] < 150.0 * 9.80665 / 22e3


def test_limits_have_their_verdict(linear):
    assert [text.split(",")[0] for text in linear[1].limits] == [
        "SWS <= 0.02 m: not met", "DTL <= 2000 N: met", "bottoming 0.04 <= 1000000 1/km: met",
    ]  # fmt: skip


def test_the_interval_is_students_over_the_seeds():
    """From trips of single seeds: histories about their mean, t of 2 degrees of freedom is 4.3027."""
    problem = sc.RideProblem(QUARTER, ROAD, speed=SPEED, band=BAND, bounds=BOUNDS)
    table = sc.certify(problem, [22e3, 1500.0], LENGTH, [4, 7, 9]).to_frame().loc["1"]
    case, values = problem.cases[0], []
    for seed in (4, 7, 9):
        profile = random_profile(case, BAND, LENGTH, seed)
        values.append(
            sc.simulate(QUARTER, (22e3, 1500.0), profile, SPEED, periodic=True)["tyre_load [N]"].std(ddof=0)
        )
    half = 4.302653 * np.std(values, ddof=1) / np.sqrt(3)
    found = table.loc["DTL", ["simulated", "low", "high"]].to_list()
    assert found == pytest.approx([np.mean(values), np.mean(values) - half, np.mean(values) + half], rel=1e-6)


def test_force_laws_stand_beside_their_equivalents_on_the_same_roads():
    """Mean travel within 0.5 mm; r.m.s. values within DESIGN's 5 and 6 % of the equivalents', sampling cancels."""
    car = replace(QUARTER, strut=BOUNCY)
    problem = sc.RideProblem(car, ROAD, speed=SPEED, band=BAND, bounds={"spring": (10e3, 30e3)})
    table = sc.certify(problem, [22e3], LENGTH, SEEDS).to_frame().loc["1"]
    linear = sc.linearised(car, {"spring": 22e3}, ROAD, SPEED, band=BAND)
    assert table.linearised["mean travel"] == linear.mean_travel[""]
    assert table.simulated["mean travel"] == pytest.approx(linear.mean_travel[""], abs=5e-4)
    ratio = (table.simulated / table.equivalent)[["ACC", "SWS", "DTL"]]
    assert (np.abs(ratio - 1) < [0.05, 0.06, 0.05]).all()
    assert (np.abs(ratio - 1) > 1e-3).all()
    assert "bottoming" in table.index
    assert table.simulated["bottoming"] > 1


def test_objectives_count_over_load_cases_by_their_shares_and_by_the_worst():
    cases = [
        sc.LoadCase(vehicle=QUARTER, road=sc.Iso8608Road(name), speed=SPEED, share=share)
        for name, share in (("A", 0.9), ("C", 0.1))
    ]
    problem = sc.RideProblem(cases=cases, band=BAND, bounds=BOUNDS, measures=["SWS", "damper_power", "lift"])
    design = [22e3, 1500.0]
    for worst_case in (False, True):
        one = problem.replace(worst_case=worst_case)
        certificate = sc.certify(one, design, LENGTH, SEEDS)
        table = certificate.to_frame()
        np.testing.assert_allclose(table.linearised["all"], one.evaluate([design])[0], rtol=1e-12)
        first, second, both = (table.simulated[case] for case in ("1", "2", "all"))
        if worst_case:
            assert both["SWS"] == pytest.approx(second["SWS"])
        else:
            assert both["damper_power"] == pytest.approx(
                0.9 * first["damper_power"] + 0.1 * second["damper_power"]
            )
            assert 0.3 * second["SWS"] < both["SWS"] < second["SWS"]
    assert "All load cases" in repr(certificate)


def test_a_full_car_is_certified_at_all_wheels_with_handling_beside():
    case = sc.LoadCase(vehicle=FULL, road=ROAD, speed=SPEED, roll_geometry=GEOMETRY)
    names = ["front.spring", "front.damper", "rear.spring", "rear.damper"]
    values = [value for pair in struts_of(FULL).values() for value in pair]
    problem = sc.RideProblem(
        cases=[case], band=BAND, bounds={name: (0.9 * v, 1.1 * v) for name, v in zip(names, values, strict=True)},
        measures=["ACC (0.5, 0.3)", "SWS rear", "DTL", "roll_damping", "0.5 We roll_acceleration"],
    )  # fmt: skip
    table = sc.certify(problem, values, LENGTH, SEEDS).to_frame().loc["1"].dropna(subset="simulated")
    assert list(table.index) == ["ACC (0.5, 0.3)", "SWS rear", "DTL", "0.5 We roll_acceleration", "lift"]
    assert (np.abs(table.simulated / table.linearised - 1)[:4] < 0.1).all()


def test_lift_off_is_counted_and_may_be_allowed():
    problem = sc.RideProblem(QUARTER, sc.Iso8608Road("E"), speed=SPEED, band=BAND, bounds=BOUNDS)
    linear, lifting = (
        sc.certify(problem, [22e3, 1500.0], 400.0, [1, 2, 3], lift_off=allowed).to_frame().loc["1"]
        for allowed in (False, True)
    )
    assert linear.simulated["lift"] == pytest.approx(linear.linearised["lift"], rel=0.2)
    assert lifting.simulated["lift"] > 0
    assert lifting.simulated["DTL"] != linear.simulated["DTL"]


def test_every_kind_of_measure_is_of_a_trip_an_event_or_the_design():
    """A class with a function of designs says how it is counted in time."""
    texts = {"bottoming": "bottoming 0.05", "topping": "topping 0.05", "peak": "peak travel bump"}
    texts |= {"largest": "largest travel 100", "": "Wk body_acceleration", "SEAT": "SEAT driver"}
    texts |= {"frequency": "frequency heave", "damping_ratio": "damping_ratio heave"}
    seat = sc.Seat(mass=75.0, spring=15e3, damper=600.0, name="driver")
    case = sc.LoadCase(
        vehicle=seat.on(FULL),
        road=ROAD,
        speed=SPEED,
        roll_geometry=GEOMETRY,
        events={"bump": sc.SpeedBump(height=0.05, length=2.0)},
    )
    nominal = [word for word, kind in Measure.words.items() if not issubclass(kind, Robust)]
    for word in nominal:
        measure = Measure.parse(texts.get(word, word))
        found = measure.in_case(case, "Wk")
        in_time = bool(found.in_trip or found.in_event or not found.values)
        assert in_time == measure.of_ride, word


MOUNTED = sc.parallel(sc.Spring(), sc.Damper(), sc.Rubber("bush", storage=1e5, loss=1e4))


@pytest.mark.parametrize(
    ("changes", "design", "options", "text"),
    [
        ({}, [22e3, 1500.0], {"length": 399.0}, "length must be 400 m or more at 20 m/s, got 399 m"),
        ({}, [22e3, 1500.0], {"seeds": [1]}, r"seeds must be two or more that differ, got \[1\]"),
        ({}, [22e3, 1500.0], {"seeds": [1, 1]}, r"seeds must be two or more that differ, got \[1, 1\]"),
        ({}, [22e3, 1500.0], {"seeds": [-1, 1]}, "seeds must be .*-1"),
        ({}, [40e3, 1500.0], {}, "design.* must .*40000"),
        ({}, [22e3], {}, "designs must"),
        ({}, [[22e3, 1500.0], [22e3, 1500.0]], {}, "design must be one design, got 2"),
        ({"vehicle": replace(QUARTER, strut=MOUNTED)}, [22e3, 1500.0], {}, ".*bush"),
    ],
)
def test_what_cannot_be_certified_is_one_line(changes, design, options, text):
    problem = sc.RideProblem(QUARTER, ROAD, speed=SPEED, band=BAND, bounds=BOUNDS).replace(**changes)
    with pytest.raises(ValueError, match=f"^{text}") as error:
        sc.certify(problem, design, **{"length": LENGTH, "seeds": SEEDS} | options)
    assert "\n" not in str(error.value)


def test_a_half_car_with_a_seat_and_a_law_is_certified():
    strut = sc.parallel(sc.Spring(), sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1))
    car = sc.Seat(mass=75, spring=15.7e3, damper=650, position=(0.2, 0.0), name="driver").on(
        replace(HALF, front_strut=strut)
    )
    problem = sc.RideProblem(
        car, ROAD, speed=SPEED, band=BAND, measures=["ACC driver", "SWS front", "bottoming driver 0.03"],
        bounds={"front.spring": (10e3, 30e3)}, struts={"rear": (23e3, 1700.0)},
    )  # fmt: skip
    table = sc.certify(problem, [20e3], 500.0, range(2)).to_frame().loc["1"]
    assert {"mean travel front", "mean travel rear", "mean travel driver"} < set(table.index)
    assert (np.abs(table.simulated / table.equivalent - 1)[:2] < 0.06).all()
