"""Crossings, lift-off, largest peaks and power beside closed forms and counting in simulated driving."""

import pickle

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import DRIVER, FULL, HALF, QUARTER, ROAD, struts_of

# Class E at 20 m/s is where linear tyres pull: the formulas judge the linear car all the same.
pytestmark = pytest.mark.filterwarnings("ignore::suspension_ctrl.response.lift_off.LiftOffWarning")

SETTING = {"spring": 22e3, "damper": 1500.0}
SPEED, STEP, LENGTH = 20.0, 0.1, 60e3
ROUGH = sc.Iso8608Road("E")
BAND = (SPEED / LENGTH, SPEED / (2 * STEP))  # Hz, of the realisation


@pytest.fixture(scope="module")
def driven():
    """Travel [m], tyre load [N] and damper velocity [m/s] over 60 km, one period of a periodic road."""
    profile = ROUGH.profile(LENGTH, STEP, seed=3)
    names = ["suspension_travel", "tyre_load", "suspension_travel_rate"]
    table = sc.simulate(QUARTER, SETTING, profile, SPEED, periodic=True, responses=names)
    return table[table.columns[2:]].to_numpy().T


def measured(*measures, car=QUARTER, setting=SETTING, road=ROUGH, band=BAND):
    return sc.ride(car, setting, road, SPEED, measures=measures, band=band).value


def test_stops_are_struck_as_often_as_counted(driven):
    """Within 10 % with 1,000 strikes at least: at one and two standard deviations."""
    travel, per_km = driven[0], 1e3 / LENGTH
    for level in (1.0, 1.5, 2.0):
        gap = float(level * travel.std())
        down = ((travel[:-1] > -gap) & (travel[1:] <= -gap)).sum()
        up = ((travel[:-1] < gap) & (travel[1:] >= gap)).sum()
        assert min(up, down) >= 1000
        found = measured(f"bottoming {gap!r}", sc.Topping(gap=gap))
        assert found.iloc[0] == found.iloc[1]
        assert [down * per_km, up * per_km] == pytest.approx(found.iloc[:2].tolist(), rel=0.1)


def test_travel_crosses_its_mean_by_tyre_and_mass_alone():
    """sqrt(kt/M)/(2 pi), 3.66 Hz, times a second whatever the strut; the band to 500 Hz lacks 1 % of the rate."""
    expected = np.sqrt(192e3 / (317.5 + 45.4)) / (2 * np.pi) * 1e3 / SPEED
    for damper in (800.0, 3000.0):
        setting = {"spring": 22e3, "damper": damper}
        found = measured("bottoming 1e-9", setting=setting, road=sc.Iso8608Road("C"), band=(0.0, 500.0))
        assert found.iloc[0] == pytest.approx(expected, rel=1e-3)


def test_the_gap_is_that_of_the_stop_beside_the_spring():
    """At the wheel: a stop with installation ratio 0.5 closes a gap of 30 mm by 60 mm of travel."""
    stop, rebound = (
        sc.BumpStop(gap=0.03, stiffness=1e5, installation_ratio=0.5),
        sc.ReboundStop(gap=0.07, stiffness=1e5),
    )
    strut = sc.parallel(sc.Spring(), sc.Damper(), stop, rebound)
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    measures = ["bottoming", "bottoming 0.06", "topping", "topping 0.07"]
    found = measured(*measures, car=car, road=sc.Iso8608Road("D"), band=(0.1, 20.0)).iloc[:4]
    assert found.iloc[0] == pytest.approx(found.iloc[1], rel=1e-12)
    assert found.iloc[2] == pytest.approx(found.iloc[3], rel=1e-12)
    assert found.iloc[0] > 0
    problem = sc.RideProblem(
        car, sc.Iso8608Road("D"), speed=20.0, band=(0.1, 20.0), constraints=["bottoming <= 1"],
        bounds={"bump_stop.gap": (0.02, 0.05)}, struts={"spring": 22e3, "damper": 1500.0},
    )  # fmt: skip
    values = problem.evaluate([[0.02], [0.03], [0.05]])[:, -1]
    assert (np.diff(values) < 0).all()


def test_a_strut_without_a_stop_needs_a_gap():
    message = r"^bottoming must be given a gap where no BumpStop stands beside the spring, .* got none at strut$"
    with pytest.raises(ValueError, match=message):
        measured("bottoming")
    with pytest.raises(ValueError, match=r"got none at front"):
        measured("topping front", car=FULL, setting=struts_of(FULL), road=sc.Iso8608Road("D"), band=(0.1, 20.0))


def test_a_tyre_lifts_for_the_share_of_time_that_is_counted(driven):
    static = (317.5 + 45.4) * 9.80665
    assert measured("lift")["lift"] == pytest.approx((driven[1] > static).mean(), rel=0.1)


def test_the_largest_peak_is_the_mean_of_those_of_many_kilometres(driven):
    """Sixty of 1 km, each with its largest value: their mean scatters by 1.5 %."""
    for name, values in (("travel", driven[0]), ("tyre_load", driven[1])):
        peaks = values.reshape(60, -1).max(axis=1)
        assert measured(f"largest {name} 1000").iloc[0] == pytest.approx(peaks.mean(), rel=0.05)


@pytest.mark.parametrize(
    ("measure", "text", "unit"),
    [
        (sc.Bottoming("front", gap=0.06), "bottoming front 0.06", "1/km"),
        (sc.Topping(gap=0.08), "topping 0.08", "1/km"),
        (sc.Bottoming("front"), "bottoming front", "1/km"),
        (sc.Topping(), "topping", "1/km"),
        (sc.Lift("rear"), "lift rear", "-"),
        (sc.LargestPeak("front_tyre_load", 1e4), "largest front_tyre_load 10000", "N"),
        (sc.DamperPower("front", name="heat"), "heat = damper_power front", "W"),
    ],
)
def test_a_text_is_its_measure(measure, text, unit):
    assert str(measure) == text
    assert sc.Measure.parse(text) == measure == pickle.loads(pickle.dumps(measure))
    assert measure.unit == unit


def test_of_several_wheels_the_worst_counts():
    setting, road = struts_of(FULL), sc.Iso8608Road("D")
    options = {"car": FULL, "setting": setting, "road": road, "band": (0.1, 20.0)}
    for word, rest in (("bottoming", " 0.04"), ("lift", ""), ("damper_power", "")):
        texts = [f"{word}{place}{rest}" for place in ("", " front", " rear", " front_left")]
        worst, front, rear, left = measured(*texts, **options).iloc[:4]
        assert worst == max(front, rear)
        assert left == pytest.approx(front, rel=1e-9)
    seat = measured(
        "damper_power driver", car=DRIVER.on(HALF), setting=struts_of(HALF), road=road, band=(0.1, 20.0)
    )
    rate = seat["driver_suspension_travel_rate"]
    assert seat.iloc[0] == pytest.approx(DRIVER.damper * rate**2, rel=1e-9)


def test_limits_on_them_steer_a_search():
    problem = sc.RideProblem(
        QUARTER, sc.Iso8608Road("D"), speed=SPEED, band=(0.1, 20.0),
        constraints=["bottoming 0.06 <= 1", "lift <= 0.02"],
        bounds={"spring": (10e3, 40e3), "damper": (500.0, 5e3)},
    )  # fmt: skip
    values = problem.evaluate([[22e3, 500.0], [22e3, 3000.0]])
    assert (values[0, 3:] > 0).all()
    assert values[1, 4] < values[0, 4]
    options = {"setting": (22e3, 500.0), "road": sc.Iso8608Road("D"), "band": (0.1, 20.0)}
    rate = measured("bottoming 0.06", **options).iloc[0]
    assert values[0, 3] == pytest.approx(rate - 1.0, rel=1e-5)  # at other numbers of nodes
    run = sc.minimise(problem, sc.Nsga2(population=24), iterations=5, seed=1)
    assert run.feasible.any()


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("bottoming front", "bottoming"), ("bottoming 0.0", "gap"), ("lift wing", "lift"),
        ("largest travel", "largest"),
        ("largest travel -3", "distance"), ("largest wings 3", "response"), ("damper_power wing", "damper_power"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(text, key):
    with pytest.raises(ValueError, match=rf"^{key} "):
        sc.ride(HALF, struts_of(HALF), ROAD, SPEED, measures=[text])
