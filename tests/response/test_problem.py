"""The batched objectives against second roads: adaptive quadrature, closed forms, the compiled kernel."""

import pickle
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from suspension_ctrl import PowerLawRoad, QuarterCar, RideProblem, weighting
from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.response import weightings

springs, dampers = st.floats(1e3, 30e3), st.floats(1e3, 5e3)
DRAWN = np.random.default_rng(2).uniform(1e3, [30e3, 5e3], (9000, 2))


@cache
def problem(**changes) -> RideProblem:
    return paper.ride_problem(**changes)


def by_adaptive_quadrature(p: RideProblem, spring: float, damper: float) -> np.ndarray:
    """ACC, SWS and DTL by QUADPACK over the response of python-control's closed model."""
    closed = p.vehicle.closed(spring, damper)
    weighting = weightings.by_name(p.weighting)

    @cache
    def densities(f: float) -> np.ndarray:
        factors = np.array([weighting.factor(np.array([f]))[0], 1.0, 1.0])
        return np.abs(factors * closed(2j * np.pi * f)[:, 0]) ** 2 * p.road.psd(np.array([f]), p.speed)

    low, high = p.band
    kinks = [f for f in (1.0, 4.0, 8.0, 12.0, *weighting.breakpoints) if low < f < high]
    integrals = [
        quad(lambda f, j=j: densities(f)[j], low, high, points=kinks, epsabs=0, epsrel=1e-11, limit=500)[0]
        for j in range(3)
    ]
    return np.sqrt(integrals)


CORNERS = [(k, c) for k in (1e3, 30e3) for c in (1e3, 5e3)]


@pytest.mark.parametrize("weighting", ["Wk", "Wb", "Wb-table"])
@pytest.mark.parametrize("design", CORNERS)
def test_equals_adaptive_quadrature_at_the_corners_of_the_box(weighting, design):
    p = problem(weighting=weighting)
    np.testing.assert_allclose(p.evaluate([design])[0], by_adaptive_quadrature(p, *design), rtol=1e-8)


@settings(max_examples=15)
@given(springs, dampers)
def test_equals_adaptive_quadrature_in_the_box(spring, damper):
    p = problem()
    np.testing.assert_allclose(
        p.evaluate([[spring, damper]])[0], by_adaptive_quadrature(p, spring, damper), rtol=1e-8
    )


def test_error_is_below_1e_9_over_the_whole_box():
    """Against five times the nodes, on a grid; the error falls geometrically, so those are exact."""
    p = problem()
    grid = np.array([(k, c) for k in np.linspace(1e3, 30e3, 25) for c in np.linspace(1e3, 5e3, 25)])
    np.testing.assert_allclose(p.evaluate(grid), replace(p, nodes=1280).evaluate(grid), rtol=1e-9)


@settings(max_examples=3)
@given(
    st.floats(150, 600), st.floats(20, 80), st.floats(1e5, 3e5), st.floats(8e3, 40e3), st.floats(800, 4000),
    st.floats(5, 40),
)  # fmt: skip
def test_white_noise_road_velocity_gives_the_closed_forms(m_s, m_u, k_t, k, c, speed):
    """A road of exponent 2 is white noise in velocity, two-sided intensity S = 2 pi^2 G V.

    Closed forms by residues (no band limit). The band ends at F, so the integral lacks the tail, which is
    known from the responses' asymptotes: |H| -> c k_t/(m_s m_u w) for acceleration, k_t for the tyre's load.
    Relative to these the next term is of order (f_w/F)^2, where f_w is the wheel's natural frequency.
    """
    road = PowerLawRoad(roughness=1e-6, exponent=2.0)
    car = QuarterCar(body_mass=m_s, wheel_mass=m_u, tyre_stiffness=k_t)
    end = 1000.0
    p = RideProblem(
        car, road, speed=speed, weighting=None, band=(0.0, end), nodes=3000,
        lower=(0.99 * k, 0.99 * c), upper=(1.01 * k, 1.01 * c),
    )  # fmt: skip
    s, m = 2 * np.pi**2 * road.roughness * speed, m_s + m_u
    acceleration = s * (k_t * c + k**2 * m / c) / (2 * m_s**2)
    travel = s * m / (2 * c)
    tyre = s * (
        m**3 * k**2 / (2 * m_s**2 * k_t**2 * c) - m_u * m * k / (m_s * k_t * c) + m_u / (2 * c)
        + m**2 * c / (2 * m_s**2 * k_t)
    )  # fmt: skip
    acceleration_tail = (c * k_t / (m_s * m_u)) ** 2 * 2 * s / (3 * (2 * np.pi) ** 4 * end**3)
    tyre_tail = s / (2 * np.pi**2 * end)
    next_term = 4 * (k_t + k) / m_u / (2 * np.pi * end) ** 2 + 4 * (c / m_u / (2 * np.pi * end)) ** 2
    acc, sws, dtl = p.evaluate([[k, c]])[0]
    np.testing.assert_allclose(
        acc**2 + acceleration_tail, acceleration, rtol=1e-8 + next_term * acceleration_tail / acceleration
    )
    np.testing.assert_allclose(sws**2, travel, rtol=1e-8 + (k_t / m_u) ** 2 / (2 * np.pi * end) ** 4)
    np.testing.assert_allclose(dtl**2 / k_t**2 + tyre_tail, tyre, rtol=1e-8 + next_term * tyre_tail / tyre)


@given(st.lists(st.tuples(springs, dampers), min_size=1, max_size=40))
def test_rows_are_independent_and_the_input_is_untouched(designs):
    p = problem()
    x = np.array(designs)
    before = x.copy()
    together = p.evaluate(x)
    alone = np.vstack([p.evaluate(row[None]) for row in x])
    np.testing.assert_array_equal(x, before)
    np.testing.assert_array_equal(together, alone)


@settings(max_examples=10)
@given(st.integers(0, 9000), st.integers(2, 3))
def test_any_number_of_threads_gives_the_same_bits(count, threads):
    """Two threads take part from some 1,500 designs on."""
    designs = DRAWN[:count]
    np.testing.assert_array_equal(
        problem().evaluate(designs, threads=threads), problem().evaluate(designs, threads=1)
    )


def test_a_design_outside_is_refused_on_threads_as_without():
    designs = np.vstack([DRAWN, [[1e3, 1e9]]])
    with pytest.raises(ValueError, match="designs must lie within"):
        problem().evaluate(designs, threads=2)
    with pytest.raises(ValueError, match="threads must be a whole number >= 1, got 0"):
        problem().evaluate(DRAWN[:1], threads=0)


@given(springs, dampers)
def test_the_kernel_gives_the_same_to_the_last_bit(spring, damper):
    p = problem()
    found = call_compiled(p.kernel, np.array([spring, damper]))
    np.testing.assert_array_equal(found, p.evaluate([[spring, damper]])[0])


@given(springs, dampers, st.floats(0.1, 100))
def test_objectives_scale_with_the_root_of_the_roughness(spring, damper, factor):
    p = problem()
    rougher = replace(p, road=replace(p.road, roughness=factor * p.road.roughness))
    np.testing.assert_allclose(
        rougher.evaluate([[spring, damper]]), np.sqrt(factor) * p.evaluate([[spring, damper]]), rtol=1e-12
    )


def test_any_layout_of_designs_is_taken():
    p = problem()
    x = np.random.default_rng(0).uniform(p.lower, p.upper, (50, 2))
    expected = p.evaluate(x)
    assert p.evaluate([p.lower, p.upper]).shape == (2, 3)
    read_only = x.copy()
    read_only.flags.writeable = False
    for same in (np.asfortranarray(x), x.tolist(), np.repeat(x, 2, axis=0)[::2], read_only):
        np.testing.assert_array_equal(p.evaluate(same), expected)
    as_array = paper.ride_problem(band=np.array([0.0, 20.0]), lower=np.array(p.lower), upper=list(p.upper))
    np.testing.assert_array_equal(as_array.evaluate(x), expected)
    whole = x.round().astype(int)
    np.testing.assert_array_equal(p.evaluate(whole), p.evaluate(whole.astype(float)))
    assert p.evaluate(np.empty((0, 2))).shape == (0, 3)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"speed": 0.0}, "speed must be finite and > 0 m/s, got 0.0"),
        (
            {"weighting": "Wz"},
            "weighting must be one of Wk, Wd, Wf, Wc, We, Wj, Wb, Wm, Wh, Wk-table, Wb-table, got 'Wz'",
        ),
        ({"band": (20.0, 0.0)}, "band must be finite with 0 <= lower < upper [Hz], got (20.0, 0.0)"),
        ({"band": (0.0, 1.0, 2.0)}, "band must be finite with 0 <= lower < upper [Hz], got (0.0, 1.0, 2.0)"),
        ({"band": "0,20"}, "band must be finite with 0 <= lower < upper [Hz], got '0,20'"),
        ({"lower": (31e3, 1e3)}, "lower must be finite, <= upper in every variable and < upper in one"),
        ({"lower": (0.0, 1e3)}, "lower bound of spring must be finite and > 0 N/m, got 0.0"),
        ({"lower": (1e3,), "upper": (3e4,)}, "lower and upper must bound spring, damper, got (1000.0,)"),
        ({"nodes": 1}, "nodes must be a whole number >= 2, got 1"),
        ({"nodes": 60}, "nodes must resolve every resonance in the box to 1e-06, got 60"),
        ({"lower": (1e3, 1.0)}, "nodes must resolve every resonance in the box"),
    ],
)
def test_rejects_bad_settings(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        paper.ride_problem(**changes)


@pytest.mark.parametrize(
    "design", [[22e3, -1500.0], [22e3, 100.0], [40e3, 1500.0], [np.nan, 1500.0], [22e3, np.inf]]
)
def test_rejects_designs_outside_the_bounds(design):
    """Where a quadrature checked at the corners of the box says nothing."""
    with pytest.raises(
        ValueError, match=r"^designs must lie within \[1000.0, 1000.0\] and \[30000.0, 5000.0\], got"
    ):
        problem().evaluate([[22e3, 1500.0], design])


@pytest.mark.parametrize("designs", [[1.0, 2.0], [[1.0, 2.0, 3.0]], [[[1.0, 2.0]]]])
def test_rejects_designs_of_another_shape(designs):
    with pytest.raises(ValueError, match=r"^designs must have shape \(n, 2\), got"):
        problem().evaluate(designs)


def test_one_thing_of_a_problem_is_replaced():
    p = problem()
    bounds = {"spring": (1e4, 2e4), "damper": (1e3, 2e3)}
    for changed in (p.replace(bounds=bounds), replace(p, bounds=bounds)):
        assert (changed.lower, changed.upper) == ((1e4, 1e3), (2e4, 2e3))
        np.testing.assert_array_equal(changed.evaluate([[15e3, 15e2]]), p.evaluate([[15e3, 15e2]]))
    narrow = p.replace(bounds={"damper": (1e3, 2e3)}, struts={"spring": 15e3})
    assert (narrow.variables, narrow.units) == (("damper",), {"damper": "N s/m"} | dict(list(p.units.items())[2:]))
    assert p.replace(lower=(2e3, 1e3)).bounds == {"spring": (2e3, 30e3), "damper": (1e3, 5e3)}
    faster = replace(p, speed=30.0)
    assert (faster.speed, faster.vehicle, faster.road) == (30.0, p.vehicle, p.road)
    assert faster == paper.ride_problem(speed=30.0)


def test_nodes_are_found_anew_unless_given():
    """Less damping makes resonances sharper."""
    p = problem()
    assert p.nodes == 256
    assert p.replace(lower=(1e3, 300.0)).nodes > 256
    with pytest.raises(ValueError, match=r"^nodes must resolve every resonance in the box to 1e-06, got 256"):
        p.replace(nodes=256).replace(lower=(1e3, 100.0))


def test_problems_are_values():
    """Equal, hashed alike, pickled, and out of reach of the parts they were made of."""
    bounds = {"spring": np.array([1e4, 2e4]), "damper": [1e3, 2e3]}
    p = paper.ride_problem(lower=[1e4, 1e3], upper=np.array([2e4, 2e3]))
    same = p.replace(bounds=bounds)
    bounds["spring"][:] = 0.0
    bounds.clear()
    assert same == p
    assert len({p, same, pickle.loads(pickle.dumps(p))}) == 1
    assert p != p.replace(weighting="Wb")
    with pytest.raises(TypeError):
        p.bounds["spring"] = (1.0, 2.0)
    with pytest.raises(AttributeError):
        p.band = (1.0, 2.0)
    systems = [p.replace(weighting=weighting("Wk")) for _ in range(2)]
    assert systems[0] == systems[1] != p.replace(weighting=weighting("Wb"))
    assert hash(systems[0]) == hash(pickle.loads(pickle.dumps(systems[1])))


def test_a_problem_is_shown_in_a_few_lines_with_units():
    assert repr(problem(constraints=("SWS <= 0.03",))).splitlines() == [
        "RideProblem(ACC [m/s^2], SWS [m], DTL [N]; SWS <= 0.03; spring 1000 to 30000 N/m; damper",
        "    1000 to 5000 N s/m; QuarterCar at 20 m/s; 0 to 20 Hz, weighting Wk, 256 nodes)",
    ]


def test_bounds_are_of_what_may_vary():
    varies = (
        "spring, damper, tyre_stiffness, tyre_damping, wheel_mass, body_mass, installation_ratio, "
        "ride_frequency, wheel_hop_frequency, damping_ratio"
    )
    with pytest.raises(ValueError, match=f"^bounds must be one of {varies}, got 'position'$"):
        paper.ride_problem(lower=(), upper=(), bounds={"position": (1e5, 2e5)})


@pytest.mark.parametrize(
    ("measures", "used"),
    [
        (["ACC", "SWS"], True),
        (["comfort = ACC", "SWS"], True),
        (["comfort = Wk body_acceleration", "SWS"], False),  # a weighting of its own
        (["SWS", "DTL"], False),
        (["my ACC = SWS", "DTL"], False),
    ],
)
def test_weighting_is_used_by_measures_that_depend_on_it(table1_problem, measures, used):
    assert table1_problem.replace(measures=measures).weighted is used


def test_without_a_weighting_none_is_used(table1_problem):
    assert not table1_problem.replace(weighting=None).weighted


def test_kinds_are_part_of_a_problem():
    problem = paper.ride_problem(kinds={"spring": [20e3, 18e3], "damper": "log"})
    assert dict(problem.kinds) == {"spring": (18e3, 20e3), "damper": "log"}
    assert "spring 18000, 20000 N/m; damper 1000 to 5000 N s/m, log;" in " ".join(repr(problem).split())
    assert problem.describe()[0] == "Varied: spring of 18, 20 kN/m; damper 1 to 5 kN s/m, log."
    assert pickle.loads(pickle.dumps(problem)) == problem == problem.replace()
    assert problem.replace(kinds={}) == paper.ride_problem() != problem
    with pytest.raises(
        ValueError, match=r"^kinds of spring must be integer, log, fixed or values from 1000 to 30000"
    ):
        problem.replace(kinds={"spring": (18e3, 40e3)})
    held = paper.ride_problem(lower=(20e3, 1e3), upper=(20e3, 5e3))
    assert held.evaluate([[20e3, 2e3]]) == pytest.approx(paper.ride_problem().evaluate([[20e3, 2e3]]), rel=1e-12)
    with pytest.raises(ValueError, match=r"^designs must lie within"):
        held.evaluate([[20.001e3, 2e3]])


def test_designs_and_nodes_of_any_type_are_taken_or_refused():
    """A small whole number of nodes does not wrap round; nothing is stripped in silence."""
    problem, designs = paper.ride_problem(), [[20_000, 1500], [25_000, 2000]]
    expected = problem.evaluate(designs)
    for given_ in (np.array(designs, dtype=np.int32), np.asfortranarray(designs), np.array(designs, dtype=object)):
        np.testing.assert_array_equal(problem.evaluate(given_), expected)
    one, other = (paper.ride_problem(nodes=n).evaluate(designs) for n in (np.uint8(250), 250))
    np.testing.assert_array_equal(one, other)
    masked, rows = np.ma.array(designs, mask=[[0, 0], [1, 0]]), (row for row in designs)
    for bad in (masked, np.array(designs) + 0j, [[20e3, 1500.0], [1.0]], {"spring": 1}, rows, "a"):
        with pytest.raises(ValueError, match=r"^designs must be an array of real numbers, got .{1,40}$"):
            problem.evaluate(bad)
