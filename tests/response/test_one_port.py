"""A quarter car on struts of any kind: equivalents, exact relations of white road velocity, and linear struts."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.measures.terms import Term
from suspension_ctrl.response.one_port import OnePort

CAR = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
ROAD = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
ZENER = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount", 250e3)))
BLOW_OFF = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
RESPONSES = ["body_acceleration", "suspension_travel", "tyre_load"]


def on(damper) -> sc.QuarterCar:
    return sc.QuarterCar(**CAR, strut=sc.parallel(sc.Spring(), damper))


def mean_squares(car, setting, road=ROAD, speed=20.0, band=(0.1, 20.0), nodes=512, variables=None):
    values = car.coefficients(setting)
    case = sc.LoadCase(vehicle=car, road=road, speed=speed)
    names = list(variables or values)
    squares = case_of(case, [Term(name) for name in RESPONSES], values, names, band, nodes)
    assert isinstance(squares, OnePort) or not car.networks
    return squares(np.array([[values[name] for name in names]]))[0]


TABLE = sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0])


@pytest.mark.parametrize(
    ("damper", "equivalent", "travel"),
    [
        (sc.BilinearDamper(bump=1500.0, rebound=1500.0), 1500, 0.0),
        (sc.BilinearDamper(bump=750.0, rebound=2250.0), 1500, -13.2),
        (BLOW_OFF, 1301, 0.0),
        (TABLE, 1258, -11.9),
        (sc.DigressiveDamper(low_speed=1000.0, high_speed=3000.0, knee=0.5), 1563, 0.0),
        (sc.DigressiveDamper(low_speed=20000.0, high_speed=500.0, knee=0.02), 1057, 0.0),
    ],
)
def test_six_dampers_of_the_design(damper, equivalent, travel):
    """Equivalents, and mean travel [mm] of a simulation of 26 minutes to 10 % or 0.5 mm; both worked out apart."""
    linear = sc.linearised(on(damper), {"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    assert linear.laws["damper"].equivalent == pytest.approx(equivalent, abs=1.0)
    assert 1e3 * linear.mean_travel[""] == pytest.approx(travel, rel=0.1, abs=0.5)


def test_straight_laws_give_the_linear_results():
    linear = sc.QuarterCar(**CAR)
    for law in (
        sc.BilinearDamper(bump=1500.0, rebound=1500.0),
        sc.TableDamper(velocity=[-1.0, -0.2, 0.0, 0.5], force=[-1500.0, -300.0, 0.0, 750.0]),
        sc.PowerDamper(force=1500.0, exponent=1.0),
    ):
        found = mean_squares(on(law), {"spring": 22e3})
        expected = mean_squares(linear, {"spring": 22e3, "damper": 1500.0}, variables=["spring", "damper"])
        np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_a_linear_network_is_the_closed_vehicle():
    """The same nodes, H(w) by python-control in place of ratios of polynomials in the dynamic stiffness."""
    car, setting = sc.QuarterCar(**CAR, strut=ZENER), {"spring": 22e3, "damper": 1500.0}
    table = sc.ride(car, setting, ROAD, speed=20.0, band=(0.1, 20.0), weighting=None)["value"]
    f = np.linspace(0.1, 20.0, 40001)
    psd = sc.response_psds(car.closed(setting, responses=RESPONSES), f, ROAD.psd(f, 20.0))
    for name in RESPONSES:
        assert table[name] == pytest.approx(np.sqrt(np.trapezoid(psd[name], f)), rel=1e-6)  # step^2 f''/12


def rate_of(linear):
    """Root mean square of the damper's rate, of the linearised vehicle."""
    measures = ["ACC", "SWS", "DTL", "suspension_travel_rate"]
    return sc.ride(linear, {}, ROAD, 20.0, band=(0.1, 20.0), measures=measures)["value"]["suspension_travel_rate"]


def test_friction_and_quadratic_damper_have_their_analytic_fixed_points():
    """c_eq = c + sqrt(2/pi) F/s, and 2 sqrt(2/pi) c2 s, at the deviation s that results."""
    friction = on(sc.parallel(sc.Damper(), sc.Friction(force=60.0)))
    linear = sc.linearised(friction, {"spring": 22e3, "damper": 900.0}, ROAD, 20.0, band=(0.1, 20.0))
    one = linear.laws["friction"]
    assert one.equivalent == pytest.approx(np.sqrt(2 / np.pi) * 60.0 / one.deviation, rel=1e-8)
    assert one.deviation == pytest.approx(rate_of(linear), rel=1e-6)  # 256 nodes
    quadratic = on(sc.PowerDamper(force=4000.0, exponent=2.0))
    linear = sc.linearised(quadratic, {"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    one = linear.laws["damper"]
    assert one.equivalent == pytest.approx(2 * np.sqrt(2 / np.pi) * 4000.0 * one.deviation, rel=1e-8)
    assert one.deviation == pytest.approx(rate_of(linear), rel=1e-6)


def test_a_law_in_series_has_its_own_share_of_the_rate():
    """Own rate by frequency response of the linearised damper in its series, by complex numbers."""
    law = sc.series(BLOW_OFF, sc.Spring("mount", 150e3), installation_ratio=0.8)
    linear = sc.linearised(on(law), {"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0))
    one = linear.laws["damper"]
    f = np.linspace(0.1, 20.0, 20001)
    psd = sc.response_psds(linear.closed(responses=["suspension_travel"]), f, ROAD.psd(f, 20.0))[
        "suspension_travel"
    ]
    s = 2j * np.pi * f
    share = 0.8 * 150e3 / (150e3 + one.equivalent * s)
    assert one.deviation == pytest.approx(np.sqrt(np.trapezoid(np.abs(s * share) ** 2 * psd, f)), rel=1e-6)


def test_a_design_alone_and_among_others_is_the_same():
    car = on(TABLE)
    problem = sc.RideProblem(car, ROAD, speed=20.0, bounds={"spring": (1e4, 3e4), "damper.scale": (0.5, 2.0)})
    designs = np.random.default_rng(1).uniform(problem.lower, problem.upper, (20, 2))
    together = problem.evaluate(designs)
    np.testing.assert_array_equal(together, np.concatenate([problem.evaluate(one[None]) for one in designs]))


def test_designs_alike_in_damping_begin_alike():
    """A stop, whose mean deflection is not that of the design before; and the deviations at the setting itself."""
    car = on(sc.parallel(TABLE, sc.BumpStop(gap=0.02, stiffness=8e4)))
    case = sc.LoadCase(vehicle=car, road=ROAD, speed=20.0)
    squares = case_of(case, [Term("tyre_load")], car.coefficients({"spring": 22e3}), ["spring"], (0.1, 20.0), 256)
    assert squares.networks.same_damping
    designs = np.array([[12e3], [30e3], [22e3]])
    alone = np.concatenate([squares(design[None]) for design in designs])
    np.testing.assert_array_equal(squares(designs), alone)
    law = sc.linearised(on(TABLE), {"spring": 22e3}, ROAD, 20.0, band=(0.1, 20.0)).laws["damper"]
    only = case_of(
        sc.LoadCase(vehicle=on(TABLE), road=ROAD, speed=20.0), [Term("tyre_load")],
        on(TABLE).coefficients({"spring": 22e3}), ["spring"], (0.1, 20.0), 512,
    )  # fmt: skip
    np.testing.assert_allclose(only.guess[1:], [law.deviation, law.equivalent], rtol=1e-3)


def test_best_tyre_load_with_an_inerter():
    """J3 at k = 120 kN/m of a car of 250 kg, 35 kg, 150 kN/m (Smith and Wang 2004, table worked out apart)."""
    frame = {"body_mass": 250.0, "wheel_mass": 35.0, "tyre_stiffness": 150e3}
    k, band, road = 120e3, (0.0, 2000.0), sc.PowerLawRoad(roughness=1.0, exponent=2.0)

    def j3(strut, **values):
        car = sc.QuarterCar(**frame, strut=strut)
        table = sc.ride(car, {"spring": k} | values, road, 1.0, band=band, weighting=None)
        beyond = 150e3**2 / band[1]  # above the band the wheel stands still, and the road's spectrum is 1/f^2
        square = table["value"]["tyre_load"] ** 2 + beyond
        # White road velocity of two-sided intensity (2 pi)^2/2; J3 = 2 pi sqrt(V kappa) ||H||_2
        return 2 * np.pi * np.sqrt(25.0 * 5e-7) * np.sqrt(square) / (2 * np.pi / np.sqrt(2))

    plain = j3(sc.parallel(sc.Spring(), sc.Damper()), damper=4902.0)
    beside = j3(sc.parallel(sc.Spring(), sc.Damper(), sc.Inerter()), damper=4471.0, inerter=88.0)
    chain = j3(sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Inerter())), damper=6538.0, inerter=451.0)
    assert plain == pytest.approx(686.7, abs=0.1)
    assert [round(100 * (one / plain - 1), 1) for one in (beside, chain)] == [-4.5, -13.4]


def test_a_working_point_that_is_not_reached_names_the_design(monkeypatch):
    from suspension_ctrl.response import linearisation

    with pytest.raises(ValueError, match=r"^force laws must have a working point, got none for design \[2\.0\]$"):
        linearisation.check_reached(np.array([True, False]), np.array([[1.0], [2.0]]))
