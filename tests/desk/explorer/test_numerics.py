"""Numerics of the explorer in JavaScript, under Node in one process: designs of many studies as in Python."""

import json
import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment
from scipy.special import gamma
from scipy.stats import norm

from garage import DRIVER, FULL, GEOMETRY, HALF, QUARTER, ROAD
from suspension_ctrl import (
    BilinearDamper,
    BumpStop,
    Damper,
    Friction,
    Inerter,
    Iso8608Road,
    LoadCase,
    MeasuredStiffness,
    Payload,
    PowerDamper,
    QuarterCar,
    RideProblem,
    Rubber,
    Spring,
    TableDamper,
    load_study,
    parallel,
    series,
)  # fmt: skip
from suspension_ctrl.desk.explorer.functions import functions_of
from suspension_ctrl.desk.explorer.packing import packed
from suspension_ctrl.desk.explorer.plant_matrices import plant_matrices
from suspension_ctrl.desk.explorer.plant_ports import plant_ports
from suspension_ctrl.desk.explorer.record import on_page
from suspension_ctrl.response.curves import frequencies, setting_of
from suspension_ctrl.response.linearisation import linear_at, working_points
from suspension_ctrl.response.mapped import unmapped
from suspension_ctrl.response.responses import frequency_responses, response_psds
from suspension_ctrl.vehicles.assembly import label
from suspension_ctrl.vehicles.force_laws import ForceLaw
from suspension_ctrl.vehicles.modes import DAMPED, FREQUENCY, RATIO

HERE = Path(__file__).parent
NORMALS = np.linspace(-10, 10, 401)
GAMMAS = np.linspace(0.05, 3.0, 60)
NAMES = (
    "quarter", "parameters", "half", "full", "seat", "table", "power", "stops", "mount", "hard mount", "network",
    "rubber", "payload", "damper curves", "functions", "static loads", "functions of stops",
)  # fmt: skip
LAWS = ("table", "power", "stops", "damper curves")
RANDOM = np.random.default_rng(5)
MATRICES = [
    *(RANDOM.normal(size=(n, n)) for n in (1, 2, 5, 14)), np.zeros((3, 3)), np.diag([2.0, 2.0, 1.0]),
    np.array([[0.0, 1.0], [-1.0, 0.0]]), np.roll(np.eye(5), 1, axis=1),
]  # fmt: skip
COSTS = [RANDOM.normal(size=shape) for shape in ((1, 1), (4, 7), (9, 9))]
WITH_PEAKS = ("damper curves",)  # simulated by Python alone
PLACES = np.array([-0.7, -0.2, -0.05, -0.01, 0.0, 0.004, 0.03, 0.11, 0.5, 1.4])  # m/s or m
MASSES = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}
SPRING = {"spring": (15e3, 30e3)}
LADEN = DRIVER.on(Payload(mass=200.0, position=(-1.0, 0.1)).on(FULL))
CORNERS = {
    "front.spring": (15e3, 30e3), "rear.spring": (15e3, 30e3), "front.damper": (800.0, 3e3),
    "rear.damper": (800.0, 3e3), "front_antiroll": (0.0, 40e3),
}  # fmt: skip

pytestmark = pytest.mark.skipif(shutil.which("node") is None and "NO_SKIPS" not in os.environ, reason="needs Node")


def quarter(strut, bounds, **settings) -> RideProblem:
    settings = {"road": Iso8608Road("C"), "speed": 20.0, "band": (0.1, 20.0)} | settings
    return RideProblem(QuarterCar(**MASSES, strut=strut), bounds=SPRING | bounds, **settings)


def studies() -> dict[str, RideProblem]:
    """Problems of every kind of case."""
    table = TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 0.3, 1.0], force=[-900.0, -300.0, 0.0, 600.0, 1e3, 1.8e3])
    stops = parallel(Spring(), Damper(), BumpStop(gap=0.03, stiffness=80e3), Friction(force=30.0))
    mount = parallel(Spring(), series(Damper(), Spring("mount", 300e3)))
    bush = MeasuredStiffness("bush", frequency=[0.1, 10.0, 50.0], storage=[2e5, 2.5e5, 3e5], loss=[1e3, 2e4, 6e4])
    odd = TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -400.0, 0.0, 400.0, 900.0])
    rubber = parallel(Spring(), series(odd, Rubber("mount", storage=300e3, loss=30e3), bush))
    damped = parallel(Spring(), BilinearDamper(), BumpStop(gap=0.05, stiffness=60e3))
    return {
        "quarter": load_study("paper").problem,
        "parameters": RideProblem(
            QUARTER, ROAD, speed=20.0, bounds={"ride_frequency": (1.0, 1.6), "damping_ratio": (0.2, 0.5)}
        ),
        "half": load_study("half_car").problem,
        "full": load_study("full_car").problem,
        "seat": RideProblem(
            DRIVER.on(FULL), ROAD, speed=20.0, band=(0.1, 20.0), measures=["ACC driver", "SWS", "DTL"],
            bounds={"front.spring": (15e3, 30e3), "rear.damper": (1e3, 3e3)},
            struts={"front.damper": 1500.0, "rear.spring": 20e3},
        ),
        "table": quarter(parallel(Spring(), table), {"damper.scale": (0.5, 2.0)}, constraints=["SWS <= 0.02"]),
        "power": quarter(
            parallel(Spring(), PowerDamper()),
            {"damper.force": (500.0, 2000.0), "damper.exponent": (0.6, 1.6)},
        ),
        "stops": quarter(stops, {"damper": (800.0, 3e3)}),
        "mount": quarter(mount, {"damper": (800.0, 3e3)}),
        "hard mount": quarter(mount, {"spring": (9e3, 11e3), "damper": (8e3, 20e3)}),
        "network": quarter(parallel(mount, Inerter("inerter", 20.0)), {"damper": (800.0, 3e3)}),
        "rubber": quarter(rubber, {"damper.scale": (0.5, 2.0), "mount.loss": (10e3, 50e3)}),
        "payload": RideProblem(
            Payload(mass=200.0, position=(-1.0, 0.0)).on(replace(HALF, front_strut=damped, rear_strut=damped)),
            Iso8608Road("C"), speed=20.0, band=(0.3, 20.0),
            bounds={"rear.spring": (15e3, 30e3), "rear.damper.bump": (800.0, 2e3), "payload.mass": (50.0, 300.0)},
            struts={"front.spring": 20e3, "front.damper.bump": 1000.0, "front.damper.rebound": 2000.0,
                    "rear.damper.rebound": 2500.0},
        ),
        "functions": RideProblem(
            cases=[
                LoadCase(vehicle=DRIVER.on(FULL), road=ROAD, speed=20.0, roll_geometry=GEOMETRY),
                LoadCase(vehicle=LADEN, road=ROAD, speed=12.0, share=0.5, roll_geometry=GEOMETRY),
            ],
            band=(0.1, 20.0), bounds=CORNERS,
            measures=[
                "ACC", "SEAT driver", "VDV driver 2h at 0.5", "lift", "largest travel 1000", "bottoming 0.02",
                "topping 0.03", "damper_power rear", "roll_gradient", "front_load_transfer", "roll_damping",
                "frequency heave", "damping_ratio roll",
            ],
        ),
        "static loads": RideProblem(
            DRIVER.on(FULL), ROAD, speed=20.0, band=(0.1, 20.0), measures=["ACC", "DLC", "lift front"],
            bounds=CORNERS | {
                "body_mass": (1000.0, 1600.0), "front_tyre_stiffness": (150e3, 250e3), "driver.x": (-0.2, 0.4),
                "rear.installation_ratio": (0.8, 1.0),
            },
        ),
        "functions of stops": RideProblem(
            QuarterCar(**MASSES, strut=stops), Iso8608Road("D"), speed=20.0, band=(0.1, 20.0),
            bounds=SPRING | {"damper": (800.0, 3e3), "bump_stop.gap": (0.02, 0.04)},
            measures=["ACC", "bottoming", "lift", "damper_power", "largest body_acceleration 1000"],
        ),
        "damper curves": load_study("damper_curve").problem,
    }  # fmt: skip


@pytest.fixture(scope="module")
def problems() -> dict[str, RideProblem]:
    return studies()


@pytest.fixture(scope="module")
def designs(problems) -> dict[str, np.ndarray]:
    """Random designs in the box of each problem."""
    rng = np.random.default_rng(7)
    return {name: rng.uniform(one.lower, one.upper, (10, len(one.lower))) for name, one in problems.items()}


def curves_asked(problem: RideProblem) -> dict:
    """Return the networks of a problem's first case with the values of its setting, and places on curves."""
    networks = unmapped(problem.scores.kernel(problem.nodes).cases[0], np.zeros((1, 0)))[0].networks
    return {"networks": packed(networks), "values": networks.setting.tolist(), "places": PLACES.tolist()}


@pytest.fixture(scope="module")
def answers(problems, designs, tmp_path_factory):
    """What Node answers to all."""
    records = {}
    for name, problem in problems.items():
        kernel = problem.scores.kernel(problem.nodes)
        ports = plant_ports(problem.scores, 0, kernel.cases[0], 40)
        both = zip(problem.scores.cases, problem.scores.settings, strict=True)
        matrices = [plant_matrices(case.vehicle, own, problem.scores.variables) for case, own in both]
        records[name] = {
            "kernel": packed(on_page(kernel)), "ports": packed(ports), "matrices": packed(matrices),
            "functions": packed(functions_of(problem)), "designs": designs[name].tolist(),
        }  # fmt: skip
    laws = {name: curves_asked(problems[name]) for name in LAWS}
    asked = {"records": records, "laws": laws, "normals": NORMALS.tolist(), "gammas": GAMMAS.tolist()}
    asked |= {"matrices": [one.tolist() for one in MATRICES], "costs": [one.tolist() for one in COSTS]}
    file = tmp_path_factory.mktemp("explorer") / "asked.json"
    file.write_text(json.dumps(asked), encoding="utf-8")
    done = subprocess.run(["node", HERE / "answers.js", file], capture_output=True, text=True)
    assert done.stderr == ""
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", NAMES)
def test_scores_are_those_of_python(name, problems, designs, answers):
    """Sums in another order differ by 1e-12; fixed points end within 1e-8 of their root, far nearer as a rule."""
    problem, found = problems[name], np.array(answers["records"][name]["scores"])
    functions = functions_of(problem)
    computed = [
        not one.by_function or own is not None for one, own in zip(problem.scores.scores, functions, strict=True)
    ]
    wanted = problem.evaluate(designs[name])
    np.testing.assert_allclose(found[:, computed], wanted[:, computed], rtol=1e-8, atol=1e-9)
    assert all(computed) or name in WITH_PEAKS


@pytest.mark.parametrize("name", NAMES)
def test_mean_positions_are_those_of_python(name, problems, designs, answers):
    """The means of laws are within 1e-8 of the deviation, of some 10 mm."""
    problem, found = problems[name], answers["records"][name]["positions"]
    case, linear = unmapped(problem.scores.kernel(problem.nodes).cases[0], designs[name])
    if found[0] is None:
        assert not hasattr(case, "networks")
    else:
        np.testing.assert_allclose(found, working_points(case, linear).position, atol=1e-9)


@pytest.mark.parametrize("name", sorted({*NAMES} - {"rubber"}))  # which has no state space in Python
def test_curves_are_those_of_python(name, problems, designs, answers):
    """Laws of a curve in Python have another number of nodes, which resolve a deviation to 1e-6."""
    problem, found = problems[name], answers["records"][name]["curves"]
    case, responses = problem.cases[0], list(dict.fromkeys(term.response for term in problem.scores.terms[0]))
    vehicle, setting = linear_at(case, setting_of(problem, designs[name][0].tolist()), problem.band)
    closed, f = vehicle.closed(setting, responses=responses), frequencies(problem.band, 40)
    x = case.vehicle.contact_points[:, 0]
    by_name = frequency_responses(closed, f, (x.max() - x) / case.speed)
    densities = response_psds(closed, f, case.cross_spectrum(f))
    for response, curves in zip(map(label, responses), found, strict=True):
        h = by_name[response]
        np.testing.assert_allclose(curves["magnitude"], abs(h), rtol=2e-6, atol=1e-9 * abs(h).max())
        turns = np.exp(1j * np.radians(curves["phase"]))
        np.testing.assert_allclose(turns * abs(h), h, atol=2e-6 * abs(h).max())
        np.testing.assert_allclose(curves["density"], densities[response], rtol=4e-6)


@pytest.mark.parametrize("name", NAMES)
def test_modes_are_those_of_python(name, problems, designs, answers):
    """Poles have rounding errors of 1e-13 of the fastest, slopes of laws of 1e-8 as their deviations."""
    problem, found = problems[name], answers["records"][name]["modes"]
    if name == "rubber":  # its loss is no damper's
        assert found is None
        return
    setting = setting_of(problem, designs[name][0].tolist())
    vehicle, setting = linear_at(problem.cases[0], setting, problem.band)
    wanted = vehicle.modes(setting)
    assert [one["name"] for one in found] == wanted["name"].tolist()
    tolerance = 1e-5 if problem.cases[0].vehicle.networks else 1e-9
    for key, column in (("frequency", FREQUENCY), ("damped", DAMPED), ("ratio", RATIO)):
        np.testing.assert_allclose([one[key] for one in found], wanted[column], rtol=tolerance, atol=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_a_design_takes_less_than_50_ms(name, answers):
    assert np.median(answers["records"][name]["milliseconds"]) < 50.0


def test_shares_of_the_normal_distribution(answers):
    """Python's table has an error of 1e-17; the series cancels to 1e-15 of a half at most."""
    above, density = np.transpose(answers["normals"])
    np.testing.assert_allclose(above, norm.sf(NORMALS), rtol=1e-12, atol=2e-18)
    np.testing.assert_allclose(density, norm.pdf(NORMALS), rtol=1e-14, atol=2e-18)


def test_places_of_a_slider_are_values_of_every_kind(answers):
    """A whole number, a logarithmic variable, one of a catalogue; 500 is the middle of 1000 steps."""
    assert answers["sliders"] == [[6, 600], [20.0, 500], [15.0, 1], [3.0, 300]]


def test_eigenvectors_are_turned_by_their_eigenvalues_alone(answers):
    """Backward errors are some 1e-15 of the norm, here at most 14."""
    for matrix, (values, *vectors) in zip(MATRICES, answers["eigen"], strict=True):
        poles, *shapes = (np.array(one).reshape(-1, 2) @ [1, 1j] for one in (values, *vectors))
        x = np.array(shapes).T
        np.testing.assert_allclose(matrix @ x, x * poles, atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(x, axis=0), 1.0)
        np.testing.assert_allclose(np.poly(poles), np.poly(matrix), atol=1e-8)
        np.testing.assert_array_equal(np.sort_complex(poles), np.sort_complex(poles.conj()))


def test_an_assignment_has_the_least_cost(answers):
    for costs, columns in zip(COSTS, answers["assigned"], strict=True):
        assert len(set(columns)) == len(costs)
        found, least = costs[np.arange(len(costs)), columns], costs[linear_sum_assignment(costs)]
        np.testing.assert_allclose(found.sum(), least.sum(), rtol=1e-12)


def test_gamma_function(answers):
    np.testing.assert_allclose(answers["gammas"], gamma(GAMMAS), rtol=1e-13)


@pytest.mark.parametrize("name", LAWS)
def test_forces_of_curves_are_those_of_python(name, problems, answers):
    problem = problems[name]
    setting, found = problem.scores.settings[0], answers["laws"][name]
    for network in problem.cases[0].vehicle.networks:
        for law in (one for one in network.strut.elements if isinstance(one, ForceLaw)):
            own = {
                one.name.removeprefix(f"{law.name}."): setting[network.prefix + one.name]
                for one in law.coefficients
            }
            wanted = law.tension(PLACES, **own)
            assert any(np.allclose(one, wanted, rtol=1e-12, atol=1e-9) for one in found)
