"""Sensitivities of a design: against differences of vehicles that are built anew."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DRIVER, FULL, GEOMETRY, QUARTER, ROAD
from suspension_ctrl import LoadCase, Payload, RideProblem, Scatter, refine, robustness, sensitivity
from suspension_ctrl.desk.slope_table import slopes_at

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
BAND = (0.3, 20.0)
STEP = 1e-3  # of a value: the error of the difference of fourth order is some 1e-12
HALF_BOUNDS = {f"{axle}.{name}": pair for axle in ("front", "rear") for name, pair in BOUNDS.items()}


def difference(function):
    """Return the change (k,) by 1 % more by a difference of fourth order of a function of a factor."""
    far, near = (np.subtract(function(1 + n * STEP), function(1 - n * STEP)) for n in (2, 1))
    return 0.01 * (8 * near - far) / (12 * STEP)


def quarter(car=QUARTER, **changes):
    given = {"speed": 20.0, "bounds": BOUNDS, "band": BAND, "nodes": 384}
    return RideProblem(car, ROAD, **given | changes)


def assert_alike(table, name, labels, found, values):
    """Compare a row with changes (k,) of measures with these values: both within 1e-6, or 1e-10 of the values."""
    row = table.loc[name, labels].to_numpy(dtype=float)
    np.testing.assert_allclose(row / values, found / values, rtol=1e-6, atol=1e-10)


@settings(max_examples=6)
@given(st.floats(1.1e4, 2.9e4), st.floats(1.1e3, 3.9e3))
def test_changes_of_a_quarter_car_are_those_of_differences(spring, damper):
    problem, x = quarter(), np.array([spring, damper])
    table, values = sensitivity(problem, x), problem.evaluate([x])[0]
    labels = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    for name, only in zip(BOUNDS, np.eye(2, dtype=bool), strict=True):
        found = difference(lambda factor, only=only: problem.evaluate([np.where(only, factor * x, x)])[0])
        assert_alike(table, name, labels, found, values)
    shares = table[["ACC [%]", "SWS [%]", "DTL [%]"]].to_numpy(dtype=float)
    np.testing.assert_allclose(shares, 100 * table[labels].to_numpy(dtype=float) / values, rtol=1e-9)


@pytest.mark.parametrize("name", ["tyre_stiffness", "body_mass", "wheel_mass"])
def test_changes_by_a_parameter_are_those_of_vehicles_built_anew(name):
    x = [22e3, 1500.0]

    def anew(factor):
        return quarter(replace(QUARTER, **{name: factor * getattr(QUARTER, name)})).evaluate([x])[0]

    assert_alike(
        sensitivity(quarter(), x), name, ["ACC [m/s^2]", "SWS [m]", "DTL [N]"], difference(anew), anew(1.0)
    )


def test_parameters_of_load_cases_change_from_their_values_there():
    """A payload in the second case alone; limits of the worst case; handling by differences in the library too."""

    def problem(load, mass, spring):
        car = replace(FULL, body_mass=mass)
        laden = Payload(mass=load, position=(-1.0, 0.0)).on(car)
        cases = [LoadCase(vehicle=one, road=ROAD, speed=20.0, roll_geometry=GEOMETRY) for one in (car, laden)]
        bounds = {name: pair for name, pair in HALF_BOUNDS.items() if name != "rear.spring"}
        given = {"measures": ("ACC", "DTL", "roll_gradient"), "constraints": ["SWS <= 20mm"], "nodes": 256}
        return RideProblem(cases=cases, bounds=bounds, band=BAND, struts={"rear.spring": spring}, **given)

    x = [2e4, 1500.0, 1600.0]
    table = sensitivity(problem(300.0, 1300.0, 2.2e4), x)
    labels = ["ACC [m/s^2]", "DTL [N]", "roll_gradient [deg/g]", "SWS <= 0.02 [m]"]
    rows = {
        "payload.mass": lambda factor: problem(300.0 * factor, 1300.0, 2.2e4),
        "body_mass": lambda factor: problem(300.0, 1300.0 * factor, 2.2e4),
        "rear.spring": lambda factor: problem(300.0, 1300.0, 2.2e4 * factor),
    }
    for name, changed in rows.items():

        def measures(factor, changed=changed):
            values = changed(factor).evaluate([x])[0]
            return [*values[:3], 0.02 * (1 + values[3])]

        found = difference(measures)
        np.testing.assert_allclose(table.loc[name, labels].astype(float), found, rtol=1e-6, atol=1e-9)
    assert table.loc["payload.mass", ["kind", "value", "unit"]].tolist() == ["parameter", 300.0, "kg"]
    assert table.loc["rear.spring", ["kind", "value", "unit"]].tolist() == ["coefficient", 2.2e4, "N/m"]


def test_a_frequency_as_a_variable_and_the_spring_for_it():
    bounds = {"ride_frequency": (1.0, 1.6), "damper": (1e3, 4e3)}
    problem = quarter(bounds=bounds)
    table = sensitivity(problem, {"ride_frequency": 1.3, "damper": 1500.0})
    own = difference(lambda factor: problem.evaluate([[1.3 * factor, 1500.0]])[0])
    np.testing.assert_allclose(
        table.loc["ride_frequency", ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]].astype(float), own, rtol=1e-6
    )
    rate = QUARTER.at({"ride_frequency": 1.3, "damper": 1500.0})[1]["spring"]
    plain = sensitivity(quarter(), [rate, 1500.0])
    for name in ("spring", "body_mass", "damper"):
        np.testing.assert_allclose(
            table.loc[name].iloc[3:].astype(float), plain.loc[name].iloc[3:].astype(float), rtol=1e-6
        )
    assert table["kind"]["spring"] == "coefficient"


def test_rows_are_ranked_and_a_variable_at_0_moves_by_its_range():
    bounds = {**HALF_BOUNDS, "rear_antiroll": (0.0, 5e4)}
    problem = RideProblem(
        DRIVER.on(FULL),
        ROAD,
        speed=20.0,
        bounds=bounds,
        band=BAND,
        struts={"driver.spring": 12e3, "driver.damper": 700.0},
    )
    x = [2e4, 1500.0, 2.2e4, 1600.0, 0.0]
    table = sensitivity(problem, x)
    largest = table[[f"{name} [%]" for name in problem.objectives]].abs().max(axis=1)
    assert (np.diff(largest) <= 0).all()
    zero, near, far = problem.evaluate([[*x[:4], bar] for bar in (0.0, 500.0, 1000.0)])[:, :3]
    row = table.loc["rear_antiroll", ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]].to_numpy(dtype=float)
    np.testing.assert_allclose(row, (4 * near - far - 3 * zero) / 2, rtol=0.02)  # by 500 N m/rad, of second order
    assert "front_antiroll" not in table.index
    assert table["kind"]["driver.mass"] == "parameter"


def test_the_price_of_a_limit_is_what_a_larger_one_gains():
    """Against the least ACC at a limit 0.1 % larger and smaller: the error is of second order."""
    limits = {
        share: quarter(constraints=[f"SWS <= {0.0287 * share!r}"], nodes=None) for share in (0.999, 1.0, 1.001)
    }
    best = {share: refine(one, [22e3, 1500.0], minimise="ACC") for share, one in limits.items()}
    table = sensitivity(limits[1.0], best[1.0].design, minimise="ACC")
    row = table.loc["SWS <= 0.0287"]
    gain = 10 * (best[1.001].measures["ACC"] - best[0.999].measures["ACC"]) / 2
    assert row["ACC [m/s^2]"] == pytest.approx(gain, rel=1e-4)
    assert row["ACC [%]"] == pytest.approx(100 * gain / best[1.0].measures["ACC"], rel=1e-4)
    assert row[["kind", "value", "unit"]].tolist() == ["limit", 0.0287, "m"]
    assert row[["SWS [%]", "DTL [%]"]].isna().all()
    assert "note" not in table.attrs


def test_a_design_that_is_no_optimum_has_no_prices():
    table = sensitivity(quarter(nodes=None), [22e3, 1500.0], minimise="ACC")
    assert "limit" not in table["kind"].to_numpy()
    found = refine(quarter(nodes=None), [22e3, 1500.0], minimise="ACC", within=_held([22e3, 1500.0]))
    gain = 100 * (1 - found.measures["ACC"] / quarter(nodes=None).evaluate([[22e3, 1500.0]])[0, 0])
    assert table.attrs["note"] == f"no prices: ACC could be {gain:.1f} % less at the same other measures"
    with pytest.raises(ValueError, match=r"^minimise must be one of ACC, SWS, DTL, got 'speed'$"):
        sensitivity(quarter(nodes=None), [22e3, 1500.0], minimise="speed")


def test_robust_measures_are_refined_in_one_load_case_alone():
    """At the optimum 95 % of the samples meet the limit; over load cases each sample counts by itself."""
    scatter = Scatter({"damper": 0.15}, samples=40)
    robust = {"measures": ("mean ACC", "CVaR90 DTL"), "constraints": ["q95 SWS <= 29mm"], "scatter": scatter}
    found = refine(quarter(**robust, nodes=None), [22e3, 2e3], minimise="mean ACC")
    beyond = robustness(quarter(**robust, nodes=None), found.design)["beyond limit [%]"].iloc[-1]
    assert beyond == pytest.approx(5.0, abs=2.6)  # the sample at the limit may count
    assert found.residual < 1e-8
    cases = [LoadCase(vehicle=QUARTER, road=ROAD, speed=speed) for speed in (15.0, 25.0)]
    both = RideProblem(cases=cases, bounds=BOUNDS, band=BAND, **robust)
    with pytest.raises(ValueError, match=r"^measures must be of nominal vehicles in several load cases"):
        refine(both, [22e3, 2e3], minimise="mean ACC")


def _held(design):
    """Return the other objectives of a design."""
    return dict(zip(("SWS", "DTL"), quarter(nodes=None).evaluate([design])[0, 1:].tolist(), strict=True))


def test_designs_outside_of_the_bounds_and_robust_problems():
    table = sensitivity(quarter(), [5e4, 800.0])
    wide = sensitivity(quarter(bounds={"spring": (1e4, 6e4), "damper": (500.0, 4e3)}, nodes=None), [5e4, 800.0])
    np.testing.assert_allclose(
        table.iloc[:, 3:].astype(float), wide.iloc[:, 3:].astype(float), rtol=1e-5, atol=1e-9
    )
    robust = quarter(measures=("mean ACC", "q95 SWS", "DTL"), scatter={"spring": 0.05})
    assert list(sensitivity(robust, [2e4, 1500.0])) == list(sensitivity(quarter(), [2e4, 1500.0]))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"design": [1.0]}, "design must be finite values of spring, damper, got [1.0]"),
        ({"problem": 1}, "problem must be a RideProblem, got 1"),
    ],
)
def test_wrong_arguments_are_told_in_one_line(arguments, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        sensitivity(**{"problem": quarter(), "design": [2e4, 1500.0]} | arguments)


@pytest.mark.parametrize(("worst_case", "limits"), [(True, 0), (False, 1)])
def test_a_limit_on_an_objective_says_more_where_load_cases_are_averaged(worst_case, limits):
    """It holds in the worst of them."""
    cases = [LoadCase(vehicle=QUARTER, road=ROAD, speed=v) for v in (10.0, 20.0)]
    given = {"bounds": BOUNDS, "band": BAND, "measures": ["ACC", "SWS"], "constraints": ["SWS <= 0.03"]}
    table = sensitivity(RideProblem(cases=cases, worst_case=worst_case, **given), [2e4, 2e3])
    assert len([name for name in table if name.startswith("SWS <=")]) == 2 * limits


def test_values_of_a_measure_of_which_more_is_better_have_its_sign():
    problem = quarter(measures=["ACC", "-damper_power"])
    found = slopes_at(problem, [2e4, 2e3])
    np.testing.assert_allclose(found.nominal, problem.evaluate([[2e4, 2e3]])[0] * [1, -1], rtol=1e-9)
    assert found.nominal[1] > 0
