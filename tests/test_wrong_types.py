"""Every argument of another type than wanted is one line of ValueError, never a TypeError or an AttributeError."""

import re

import numpy as np
import pytest

import suspension_ctrl as sc

WRONG = [1.5, "x", None, [1.0], (1.0, 2.0), {"a": 1}, object(), True, b"y", [[0.0, 0.0], [0.1, 850.0]], [None], ()]
CAR = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
FILE, ROAD = sc.load_vehicle("minaker_half"), sc.Iso8608Road("C")
BOUNDS = {"spring": (10e3, 30e3), "damper": (1e3, 5e3)}
SETTING = {"spring": 22e3, "damper": 1500.0}
PROBLEM = sc.RideProblem(CAR, ROAD, speed=20.0, band=(0.5, 20.0), bounds=BOUNDS, nodes=256)
CLOSED = CAR.closed(22e3, 1500.0)
F = np.array([1.0, 2.0])
PLAIN = sc.Problem(evaluate=lambda x: x, lower=[0, 0], upper=[1, 1], objectives=("f", "g"))
TABLE = {"velocity": [0.0, 1.0], "force": [0.0, 100.0]}
HALF = {
    name: getattr(FILE.vehicle, name)
    for name in (
        "body_mass", "pitch_inertia", "front_wheel_mass", "rear_wheel_mass", "front_tyre_stiffness",
        "rear_tyre_stiffness", "cg_to_front", "cg_to_rear", "front_strut",
    )
}  # fmt: skip


def ride(car, setting, road, speed, weighting, band, measures):
    return sc.ride(car, setting, road, speed=speed, weighting=weighting, band=band, measures=measures)


CALLS = {
    "QuarterCar": (
        sc.QuarterCar,
        {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3, "strut": CAR.strut},
    ),
    "HalfCar": (sc.HalfCar, HALF),
    "Seat": (sc.Seat, {"mass": 70.0, "spring": 1e4, "damper": 500.0, "position": (0.1, 0.2), "name": "d"}),
    "Payload": (sc.Payload, {"mass": 70.0, "position": (0.0, 0.0)}),
    "Seat.on": (sc.Seat(mass=70.0, spring=1e4, damper=500.0).on, {0: CAR}),
    "VehicleFile": (sc.VehicleFile, {"vehicle": CAR, "setting": SETTING, "bounds": BOUNDS}),
    "load_vehicle": (sc.load_vehicle, {0: "minaker_half"}),
    "save_vehicle": (sc.save_vehicle, {0: "v.toml", 1: FILE}),
    "load_problem": (sc.load_problem, {0: "p.toml"}),
    "save_problem": (sc.save_problem, {0: "p.toml", 1: PROBLEM}),
    "load_road": (sc.load_road, {0: "C"}),
    "save_road": (sc.save_road, {0: "r.toml", 1: ROAD}),
    "load_property": (sc.load_property, {0: "d.dpr"}),
    "save_property": (sc.save_property, {0: "d.dpr", 1: sc.TableDamper(**TABLE)}),
    "QuarterCar.closed": (CAR.closed, {0: 22e3, 1: 1500.0}),
    "HalfCar.closed": (FILE.vehicle.closed, {0: FILE.setting}),
    "closed, responses": (CAR.closed, {0: SETTING, "responses": ["tyre_load"]}),
    "plant": (CAR.plant, {0: ["tyre_load"]}),
    "modes": (CAR.modes, {0: SETTING}),
    "ride": (ride, dict(enumerate([CAR, SETTING, ROAD, 20.0, "Wk", (0.5, 20.0), ("ACC",)]))),
    "LoadCase": (sc.LoadCase, {"vehicle": CAR, "road": ROAD, "speed": 20.0, "share": 1.0, "events": {}}),
    "RideProblem.replace": (
        PROBLEM.replace,
        {
            "bounds": BOUNDS,
            "struts": {},
            "kinds": {},
            "cases": PROBLEM.cases,
            "measures": ("ACC", "SWS"),
            "band": (0.5, 9.0),
            "scatter": {"spring": 0.05},
        },
    ),
    "RideProblem.evaluate": (PROBLEM.evaluate, {0: [[22e3, 1500.0]]}),
    "simulate": (sc.simulate, {0: CAR, 1: SETTING, 2: ROAD.profile(20.0, 0.1, seed=1)}),
    "response_psds": (sc.response_psds, {0: CLOSED, 1: F, 2: F}),
    "vehicle_file": (sc.vehicle_file, {0: PROBLEM, 1: [22e3, 1500.0], "case": 1}),
    "as_scipy": (sc.as_scipy, {0: PROBLEM, 1: "ACC"}),
    "certify": (sc.certify, {0: PROBLEM, 1: [22e3, 1500.0]}),
    "international_roughness_index": (sc.international_roughness_index, {0: ROAD.profile(20.0, 0.1, seed=1)}),
    "weighting": (sc.weighting, {0: "Wk"}),
    "Iso8608Road": (sc.Iso8608Road, {0: "C", "level": "lower", "coherence": sc.Constant(0.5)}),
    "MeasuredRoad": (sc.MeasuredRoad, {"wavenumber": [0.01, 1.0], "density": [1e-3, 1e-6]}),
    "psd": (ROAD.psd, {0: F, 1: 20.0}),
    "profile": (ROAD.profile, {0: 30.0, 1: 0.1, 2: 1, 3: (0.75, -0.75)}),
    "Tabulated": (sc.Tabulated, {"wavenumber": [0.1, 1.0], "coherence": [0.9, 0.1], "distance": 1.5}),
    "TableDamper": (sc.TableDamper, TABLE),
    "parallel": (sc.parallel, {0: sc.Spring(), 1: sc.Damper()}),
    "SpeedBump": (sc.SpeedBump, {"height": 0.1, "length": 1.0, "side": "both"}),
    "Term": (sc.Term, {0: "body_acceleration", 1: "Wk", 2: 1.0}),
    "RootSumSquare": (sc.RootSumSquare, {0: [sc.Term("body_acceleration")]}),
    "Limit": (sc.Limit, {0: "SWS", 1: 0.01}),
    "Scatter": (sc.Scatter, {0: {"spring": 0.05}, "samples": 8, "seed": 1, "distribution": "normal"}),
    "Quantile": (sc.Quantile, {0: "SWS", 1: 95.0}),
    "robustness": (sc.robustness, {0: PROBLEM, 1: SETTING, 2: {"spring": 0.05}, 3: 8, 4: 1}),
    "Plant": (sc.Plant, {0: CAR.plant(), 1: {"": (0.0, 0.0)}}),
    "Problem": (
        sc.Problem,
        {
            "evaluate": PLAIN.evaluate,
            "lower": [0, 0],
            "upper": [1, 1],
            "objectives": ("f", "g"),
            "variables": ("a", "b"),
        },
    ),
    "minimise": (sc.minimise, {0: PLAIN, 1: sc.Nsga2(population=8), "callback": len, "iterations": 1}),
    "non_dominated": (sc.non_dominated, {0: [[1.0, 2.0], [2.0, 1.0]]}),
}
"""Functions by name, each with arguments that it takes."""
SLOW = {("certify", 1), ("minimise", 0), ("minimise", "callback"), ("minimise", "iterations")}
"""Arguments of which some of the wrong values are right, and computing takes long."""


def said(function, arguments):
    """Return the text of the ValueError of a call, None if it has none."""
    positional = [arguments.pop(i) for i in sorted(key for key in arguments if isinstance(key, int))]
    try:
        function(*positional, **arguments)
    except OSError:
        return None
    except ValueError as error:
        return str(error)
    return None


@pytest.mark.parametrize(
    ("name", "which"), [(name, which) for name, (_, arguments) in CALLS.items() for which in arguments]
)
@pytest.mark.filterwarnings("ignore")
def test_a_wrong_type_is_one_line(tmp_path, monkeypatch, name, which):
    monkeypatch.chdir(tmp_path)
    function, arguments = CALLS[name]
    for wrong in WRONG:
        if (name, which) in SLOW and (wrong is None or wrong is True):
            continue
        text = said(function, {**arguments, which: wrong})
        assert text is None or ("\n" not in text and " must " in text), (wrong, text)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: FILE.vehicle.closed(1e4, 2000.0), "setting must be one mapping, or keywords by strut"),
        (lambda: CAR.closed({"spring": 22e3, "damper": 1500.0}), None),
        (lambda: PROBLEM.evaluate({"spring": 22e3, "damper": 1500.0}), "designs must be an array of real numbers"),
        (lambda: sc.simulate(CLOSED, ([0.0, 1.0], [0.0, 0.1]), 20.0), "profile must "),
        (lambda: CAR.closed(20e3, [[0.0, 0.0], [0.1, 850.0]]), "damper must be finite and > 0 N s/m, got [[0.0"),
    ],
)
def test_calls_that_people_make(call, message):
    """Five calls of the collection; a mapping for a quarter car is right."""
    if message is None:
        assert call().noutputs == 3
        return
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        call()
    assert "\n" not in str(error.value)
