"""Robust measures of problems: against quantiles and quadrature in one parameter, and the nominal vehicle."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DRIVER, FULL, GEOMETRY, HALF, QUARTER, ROAD
from suspension_ctrl import (
    DigressiveDamper,
    LoadCase,
    Mean,
    Measure,
    MoeadDra,
    Nsga2,
    RideProblem,
    Scatter,
    Spring,
    certify,
    minimise,
    parallel,
)
from suspension_ctrl.compiled_verbs import call_compiled

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
BAND = (0.3, 20.0)
FULL_BOUNDS = {
    "front.spring": (1e4, 3e4), "front.damper": (1e3, 3e3), "rear.spring": (1e4, 3e4), "rear.damper": (1e3, 3e3),
}  # fmt: skip
ROBUST = ("mean ACC", "q95 SWS", "CVaR90 DTL")


@cache
def quarter(measures=ROBUST, **changes) -> RideProblem:
    changes = {"scatter": Scatter({"spring": 0.05, "damper": 0.15}, samples=64), **changes}
    return RideProblem(QUARTER, ROAD, speed=20.0, bounds=BOUNDS, band=BAND, measures=measures, **changes)


def test_samples_have_the_same_bits_on_any_number_of_threads():
    p = quarter()
    designs = np.random.default_rng(5).uniform(p.lower, p.upper, (150, 2))
    one = p.evaluate(designs, threads=1)
    for threads in (2, 3):
        np.testing.assert_array_equal(p.evaluate(designs, threads=threads), one)


def nominal(designs, measures=("ACC", "SWS", "DTL"), **changes):
    return quarter(measures, scatter=None, **changes).evaluate(designs)


@pytest.mark.parametrize("name", ["damper", "tyre_stiffness", "wheel_mass"])
@pytest.mark.parametrize("level", [5, 50, 95])
def test_a_quantile_in_one_parameter_is_the_measure_at_its_quantile(name, level):
    """Of 256 samples one lies in each 1/256 of the range: the quantile is between the measures at its ends."""
    design, half = np.array([22e3, 1500.0]), 0.1
    problem = quarter((f"q{level} DTL", "ACC"), scatter=Scatter({name: half}, samples=256))
    index = int(np.ceil(256 * level / 100))
    if name == "damper":
        ends = [[22e3, 1500.0 * (1 + half * (2 * u - 1))] for u in (0.0, 1.0)]
        rising = np.diff(nominal(ends)[:, 2]) > 0
    else:
        rising = np.diff([_with(name, 1 + half * (2 * u - 1))[2] for u in (0.0, 1.0)]) > 0
    places = [(index - 1) / 256, index / 256] if rising else [1 - index / 256, 1 - (index - 1) / 256]
    factors = [1 + half * (2 * u - 1) for u in places]
    if name == "damper":
        values = nominal([[22e3, 1500.0 * factor] for factor in factors])[:, 2]
    else:
        values = [_with(name, factor)[2] for factor in factors]
    found = problem.evaluate([design])[0, 0]
    assert min(values) * (1 - 1e-9) <= found <= max(values) * (1 + 1e-9)


def _with(name: str, factor: float) -> np.ndarray:
    """Return ACC, SWS and DTL of the quarter car with another parameter, built anew."""
    car = replace(QUARTER, **{name: factor * getattr(QUARTER, name)})
    problem = RideProblem(car, ROAD, speed=20.0, bounds=BOUNDS, band=BAND)
    return problem.evaluate([[22e3, 1500.0]])[0]


def test_a_mean_is_that_of_gauss_and_legendre():
    """Over a spring and a damper by 12 x 12 points; 4096 Sobol samples of a smooth function are within 1e-5."""
    x, weight = np.polynomial.legendre.leggauss(12)
    k, c = np.meshgrid(22e3 * (1 + 0.05 * x), 1500.0 * (1 + 0.15 * x))
    values = nominal(np.column_stack([k.ravel(), c.ravel()]))
    expected = np.outer(weight, weight).ravel() @ values / 4
    scatter = Scatter({"spring": 0.05, "damper": 0.15}, samples=4096)
    found = quarter(("mean ACC", "mean SWS", "mean DTL"), scatter=scatter).evaluate([[22e3, 1500.0]])[0]
    np.testing.assert_allclose(found, expected, rtol=1e-5)
    assert (np.abs(found / nominal([[22e3, 1500.0]])[0] - 1) > 1e-4).any()  # the nominal value is another


@pytest.mark.parametrize("scatter", [{"spring": 0.0}, {"damper": 0, "tyre_stiffness": 0}])
def test_without_deviations_robust_measures_are_the_nominal_ones_bit_for_bit(scatter):
    designs = [[22e3, 1500.0], [1e4, 1e3], [3e4, 4e3]]
    limits = ["q95 SWS <= 30mm", "CVaR90 DTL <= 1kN"]
    problem = quarter(scatter=Scatter(scatter, samples=100), constraints=tuple(limits))
    expected = nominal(designs, constraints=("SWS <= 30mm", "DTL <= 1kN"))
    np.testing.assert_array_equal(problem.evaluate(designs), expected)


def test_a_full_car_without_deviations_is_the_nominal_one_bit_for_bit():
    car, struts = DRIVER.on(FULL), {"driver.spring": 12e3, "driver.damper": 700.0}
    given = {"bounds": FULL_BOUNDS, "struts": struts, "band": BAND, "speed": 20.0}
    problem = RideProblem(car, ROAD, measures=ROBUST, scatter=Scatter({"spring": 0.0}, samples=7), **given)
    designs = [[2e4, 1500.0, 2.2e4, 1600.0], [1e4, 1e3, 1e4, 1e3]]
    np.testing.assert_array_equal(problem.evaluate(designs), problem.nominal.evaluate(designs))
    assert problem.nominal.objectives == ("ACC", "SWS", "DTL")


def test_of_one_sample_all_robust_measures_are_its_value():
    measures = ("mean ACC", "q5 ACC", "q95 ACC", "CVaR90 ACC")
    problem = quarter(measures, scatter=Scatter({"damper": 0.15}, samples=1))
    values = problem.evaluate([[22e3, 1500.0]])[0]
    assert len(set(values.tolist())) == 1
    assert values[0] != nominal([[22e3, 1500.0]])[0, 0]


@settings(max_examples=10)
@given(st.floats(1e4, 3e4), st.floats(1e3, 4e3), st.integers(1, 70))
def test_robust_measures_are_in_order(spring, damper, samples):
    measures = ("q0 DTL", "q50 DTL", "q95 DTL", "CVaR95 DTL", "q100 DTL", "mean DTL", "CVaR0 DTL")
    problem = quarter(measures, scatter=Scatter({"spring": 0.05, "damper": 0.15}, samples=samples), nodes=256)
    least, median, high, tail, most, mean, whole = problem.evaluate([[spring, damper]])[0]
    slack = 1e-12 * most  # rounding of sums
    assert least <= median <= high <= tail + slack
    assert tail <= most + slack
    assert least - slack <= mean <= most + slack
    assert whole == pytest.approx(mean, rel=1e-12)


def test_each_design_is_as_if_alone_bit_for_bit_and_the_kernel_agrees():
    problem = quarter(constraints=("q95 SWS <= 30mm", "SWS <= 20mm"))
    designs = np.array([[1e4, 1e3], [22e3, 1500.0], [3e4, 4e3], [1.2e4, 2e3]])
    whole = problem.evaluate(designs)
    for design, row in zip(designs, whole, strict=True):
        np.testing.assert_array_equal(problem.evaluate([design])[0], row)
        np.testing.assert_allclose(call_compiled(problem.kernel, design), row, rtol=1e-12)
    np.testing.assert_array_equal(whole[:, 4], nominal(designs, constraints=("SWS <= 20mm",))[:, 3])


def test_populations_and_samples_are_evaluated_in_parts():
    """Of 2^14 samples two designs fit in a part, of 70,000 half of one."""
    problem = quarter(("mean ACC", "q95 DTL"), scatter=Scatter({"damper": 0.15}, samples=1 << 14), nodes=256)
    designs = np.array([[1.2e4 + 2e3 * i, 1500.0] for i in range(5)])
    whole = problem.evaluate(designs)
    np.testing.assert_array_equal(whole, [problem.evaluate([design])[0] for design in designs])
    assert len(np.unique(whole[:, 0])) == 5
    more = problem.replace(scatter=Scatter({"damper": 0.15}, samples=70_000), nodes=256)
    np.testing.assert_allclose(more.evaluate(designs[:1]), whole[:1], rtol=1e-4)


def test_searches_run_with_robust_measures():
    problem = quarter(("mean ACC", "q95 DTL"), constraints=("q95 SWS <= 20mm",))
    for optimiser in (Nsga2(population=20), MoeadDra(population=20)):
        run = minimise(problem, optimiser, iterations=3, seed=1)
        values = problem.evaluate(run.designs)
        np.testing.assert_allclose(np.hstack([run.objectives, run.constraints]), values, rtol=1e-9)


def test_load_cases_are_combined_sample_by_sample():
    """Each sampled vehicle drives all load cases: the mean of the root over cases is not the root of means."""
    cases = tuple(
        LoadCase(vehicle=QUARTER, road=ROAD, speed=speed, share=share) for speed, share in ((10, 3), (30, 1))
    )
    scatter = Scatter({"damper": 0.15}, samples=16)
    given = {"bounds": BOUNDS, "band": BAND, "cases": cases}
    problem = RideProblem(
        measures=("mean DTL", "CVaR90 ACC"), constraints=["q95 SWS <= 20mm"], scatter=scatter, **given
    )
    plain = RideProblem(measures=("DTL", "ACC"), constraints=["SWS <= 20mm"], **given)
    factors = scatter.factors([(-0.15, 0.15)])[:, 0]
    values = plain.evaluate(np.column_stack([np.full(16, 22e3), 1500.0 * factors]))
    ordered = np.sort(values, axis=0)
    expected = [values[:, 0].mean(), (ordered[-1, 1] + 0.6 * ordered[-2, 1]) / 1.6, ordered[-1, 2]]
    np.testing.assert_allclose(problem.evaluate([[22e3, 1500.0]])[0], expected, rtol=1e-12)


def test_the_worst_of_a_measure_of_which_more_is_better_is_the_least():
    case = LoadCase(vehicle=FULL, road=ROAD, speed=20.0, roll_geometry=GEOMETRY)
    scatter = Scatter({"damper": 0.15}, samples=10)
    given = {"cases": [case], "bounds": FULL_BOUNDS, "band": BAND}
    measures = ("-CVaR80 roll_damping", "-q20 roll_damping", "mean ACC")
    limits = ["CVaR80 roll_damping >= 0.1", "q20 roll_damping >= 0.1"]
    problem = RideProblem(measures=measures, constraints=limits, scatter=scatter, **given)
    design = [2e4, 1500.0, 2.2e4, 1600.0]
    factors = scatter.factors([(-0.15, 0.15)] * 2)
    rows = np.tile(design, (10, 1))
    rows[:, [1, 3]] *= factors
    damping = np.sort(-RideProblem(measures=("-roll_damping", "ACC"), **given).evaluate(rows)[:, 0])
    found = problem.evaluate([design])[0]
    np.testing.assert_allclose(found[:2], [-damping[:2].mean(), -damping[1]], rtol=1e-12)
    np.testing.assert_allclose(found[3:], 1 - np.array([damping[:2].mean(), damping[1]]) / 0.1, rtol=1e-12)


def test_measures_of_ones_own_see_the_scattered_variables():
    cost = Measure("cost", "EUR", lambda designs: designs @ [1e-3, 1e-2])
    scatter = Scatter({"spring": 0.1, "tyre_stiffness": 0.1}, samples=32)
    problem = quarter((Mean(cost), "ACC"), scatter=scatter)
    assert problem.kernel is None
    expected = (22.0 * scatter.factors([(-0.1, 0.1)] * 2)[:, 0]).mean() + 15.0
    assert problem.evaluate([[22e3, 1500.0]])[0, 0] == pytest.approx(expected, rel=1e-12)


def test_force_laws_scatter():
    """Each sample has a working point of its own: against a problem with the scale of the law as a variable."""
    strut = parallel(Spring(), DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1))
    car = replace(QUARTER, strut=strut)
    given = {"bounds": {"spring": (1e4, 3e4), "damper.low_speed": (2e3, 5e3)}, "band": BAND, "speed": 20.0}
    scatter = Scatter({"damper.low_speed": 0.15}, samples=8)
    problem = RideProblem(car, ROAD, measures=("mean ACC", "q100 SWS"), scatter=scatter, **given)
    factors = scatter.factors([(-0.15, 0.15)])[:, 0]
    rows = np.column_stack([np.full(8, 22e3), 4e3 * factors])
    values = RideProblem(car, ROAD, measures=("ACC", "SWS"), **given).evaluate(rows)
    found = problem.evaluate([[22e3, 4e3]])[0]
    np.testing.assert_allclose(found, [values[:, 0].mean(), values[:, 1].max()], rtol=1e-9)


def test_designs_at_the_bounds_scatter_beyond_them():
    problem = quarter(("q100 SWS", "ACC"), scatter=Scatter({"damper": (-0.25, 0.0)}, samples=64))
    found = problem.evaluate([[22e3, 1e3]])[0, 0]
    softer = RideProblem(
        QUARTER, ROAD, speed=20.0, bounds={"spring": (1e4, 3e4), "damper": (750.0, 4e3)}, band=BAND
    )
    last, almost = softer.evaluate([[22e3, 750.0], [22e3, 750.0 * 1.01]])[:, 1]
    assert almost < found < last


def test_a_problem_with_scatter_is_a_record():
    problem = quarter()
    assert problem == quarter().replace() == problem.replace(scatter=quarter().scatter)
    assert problem != problem.replace(scatter=Scatter({"spring": 0.05, "damper": 0.15}, samples=64, seed=2))
    assert "scatter spring ±5 %, damper ±15 %; 64 samples, seed 1" in " ".join(repr(problem).split())
    assert "Scatter: spring ±5 %, damper ±15 %; 64 samples, seed 1." in problem.describe()
    given = RideProblem(QUARTER, ROAD, speed=20.0, bounds=BOUNDS, band=BAND, scatter={"spring": 0.05})
    assert given.scatter == Scatter({"spring": 0.05})
    assert given.nominal == given.replace(scatter=None)
    plain = problem.nominal
    assert plain.nominal is plain


def test_the_certificate_is_of_the_nominal_vehicle():
    problem = quarter(("mean ACC", "q95 SWS"), constraints=("q95 SWS <= 30mm",))
    table = certify(problem, [22e3, 1500.0], length=500.0, seeds=range(2)).to_frame()
    expected = nominal([[22e3, 1500.0]])[0]
    found = [table.xs(name, level="measure")["linearised"].iloc[0] for name in ("ACC", "SWS")]
    np.testing.assert_allclose(found, expected[:2], rtol=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"scatter": None}, "scatter must be given for mean ACC, got none"),
        ({"scatter": {"sprang": 0.1}}, "scatter must be one of spring, damper, tyre_stiffness, "),
        ({"scatter": {"sprang": 0.1}, "measures": ("ACC", "SWS")}, "scatter must be one of spring, damper, "),
        ({"scatter": {"spring": 1.0}}, "scatter.spring must leave values above zero, 0.05 for 5 %, got 1.0"),
        ({"scatter": 0.05}, "scatter must be a Scatter or tolerances by name, got 0.05"),
        (
            {"scatter": {"damper": (-0.99, 0.0)}, "nodes": 256},
            "nodes must resolve every resonance in the box to 1e-06, got ",
        ),
    ],
)
def test_a_scatter_that_does_not_fit_is_told_in_one_line(changes, message):
    given = {"bounds": BOUNDS, "band": BAND, "measures": ROBUST} | changes
    with pytest.raises(ValueError, match=f"^{re.escape(message)}") as error:
        RideProblem(QUARTER, ROAD, speed=20.0, **given)
    assert "\n" not in str(error.value)


def test_a_half_car_with_masses_against_vehicles_built_anew():
    scatter = Scatter({"body_mass": 0.1, "rear_tyre_stiffness": (-0.2, 0.1)}, samples=8)
    problem = RideProblem(
        HALF,
        ROAD,
        speed=20.0,
        bounds=FULL_BOUNDS,
        band=BAND,
        measures=("mean ACC", "q100 DTL", "mean DLC"),
        scatter=scatter,
    )
    design = [2e4, 1500.0, 2.2e4, 1600.0]
    # Names are in the order of the vehicle's parameters: tyres before masses.
    rear, body = scatter.factors([(-0.2, 0.1), (-0.1, 0.1)]).T
    rows = []
    for one, other in zip(rear, body, strict=True):
        car = replace(HALF, rear_tyre_stiffness=200e3 * one, body_mass=650.0 * other)
        anew = RideProblem(
            car, ROAD, speed=20.0, bounds=FULL_BOUNDS, band=BAND, measures=("ACC", "DTL", "DLC"), nodes=512
        )
        rows.append(anew.evaluate([design])[0])
    acc, dtl, dlc = np.transpose(rows)
    np.testing.assert_allclose(problem.evaluate([design])[0], [acc.mean(), dtl.max(), dlc.mean()], rtol=1e-7)
