"""Vehicle files of kind plant: somebody's matrices give the ride of our car, from Python and on the terminal."""

import re

import control
import numpy as np
import pytest

from garage import HALF, ROAD
from programs import matlab_5, texts
from suspension_ctrl import HalfCar, Iso8608Road, Plant, QuarterCar, RideProblem, load_vehicle, ride, save_vehicle

# MATLAB's guide "Robust Control of Active Suspension" (mathworks.com/help/robust/gs): a quarter car with the
# spring and the damper in place; its actuator pushes with kN.
MB, MW, BS, KS, KT = 300.0, 60.0, 1000.0, 16000.0, 190000.0
BODY = [-KS / MB, -BS / MB, KS / MB, BS / MB]
A = np.array([[0, 1, 0, 0], BODY, [0, 0, 0, 1], [KS / MW, BS / MW, (-KS - KT) / MW, -BS / MW]])
B = np.array([[0, 0], [0, 1e3 / MB], [0, 0], [KT / MW, -1e3 / MW]])
C = np.array([[1, 0, 0, 0], [1, 0, -1, 0], BODY])
D = np.array([[0, 0], [0, 0], B[1]])
CAR = QuarterCar(body_mass=MB, wheel_mass=MW, tyre_stiffness=KT)
TOML = """kind = "plant"
file = "car.mat"
name = "Somebody's"

[inputs]
r = "road [m]"
fs = "-strut [kN]"

[outputs]
sd = "deflection [m]"
ab = "body_acceleration [m/s^2]"

[included]
spring_N_per_m = 16000
damper = "1 kN s/m"

[struts]
spring_N_per_m = 20000
damper_N_s_per_m = 1500

[bounds]
spring_N_per_m = [10000, 30000]
damper_N_s_per_m = [500, 3000]
"""


@pytest.fixture
def folder(tmp_path):
    names = {"InputName": ["r", "fs"], "OutputName": ["xb", "sd", "ab"]}
    (tmp_path / "car.mat").write_bytes(matlab_5({"A": A, "B": B, "C": C, "D": D, **names}))
    (tmp_path / "car.toml").write_text(TOML)
    return tmp_path


def test_somebody_elses_matrices_are_a_vehicle(folder):
    file = load_vehicle(folder / "car.toml")
    assert (file.name, file.setting) == ("Somebody's", {"spring": 20e3, "damper": 1500.0})
    assert file.bounds == {"spring": (10e3, 30e3), "damper": (500.0, 3000.0)}
    here, there = (
        ride(car, file.setting, ROAD, speed=20.0, measures=["ACC", "SWS"])["value"] for car in (file.vehicle, CAR)
    )
    np.testing.assert_allclose(here, there[here.index], rtol=1e-12)
    box = {"road": ROAD, "speed": 20.0, "bounds": file.bounds, "measures": ["ACC", "SWS"], "band": (0.1, 20.0)}
    designs = [[10e3, 500.0], [16e3, 1000.0], [30e3, 3000.0]]
    here, there = (RideProblem(car, **box).evaluate(designs) for car in (file.vehicle, CAR))
    np.testing.assert_allclose(here, there, rtol=1e-12)


def test_what_is_included_is_what_the_model_is_closed_with(folder):
    """The struts of the model put back give its own matrices, but for rounding."""
    closed = load_vehicle(folder / "car.toml").vehicle.closed((KS, BS), responses=["body_acceleration"])
    np.testing.assert_allclose(closed.A, A, rtol=1e-12, atol=1e-12 * np.abs(A).max())
    np.testing.assert_allclose(closed.C[0], C[2], rtol=1e-12)


def test_a_force_at_the_strut_is_that_of_the_whole_strut():
    system = control.ss(A, B, C[1:], D[1:], inputs=["road", "strut"], outputs=["deflection", "body_acceleration"])
    pushed = Plant.named(
        system, inputs=["road [m]", "-strut [kN]"], outputs=["deflection [m]", "body_acceleration [m/s^2]"]
    )
    plant = pushed.without({"spring": KS, "damper": BS})
    s = 2j * np.pi * np.array([0.5, 3.0, 12.0])
    here, there = (car.closed((20e3, 1500.0), responses=["strut_force"])(s) for car in (plant, CAR))
    np.testing.assert_allclose(here, there, rtol=1e-10)
    part = pushed.without({"spring": 6e3})
    np.testing.assert_allclose(
        part.closed((16e3, 500.0))(s), CAR.closed((26e3, 1500.0), responses=part.responses)(s), rtol=1e-10
    )
    for setting, message in (
        ({"front.spring": 1.0}, "setting must be one of spring, damper, got 'front.spring'"),
        ({"spring": -1.0}, "spring must be finite and > 0 N/m, got -1.0"),
    ):
        with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
            plant.without(setting)


def test_a_road_by_its_rate_alone(tmp_path):
    """States are relative to the road, as in models of active suspensions: x' = A x + B (dr/dt, F)."""
    m, w, k, c, kt = MB, MW, 20e3, 1500.0, KT
    a = [[0, 1, 0, -1], [-k / m, -c / m, 0, c / m], [0, 0, 0, 1], [k / w, c / w, -kt / w, -c / w]]
    b = [[0, 0], [0, -1 / m], [-1, 0], [0, 1 / w]]
    np.savez(tmp_path / "car.npz", A=a, B=b, C=[[1, 0, 0, 0], a[1], [0, 0, kt / 1e3, 0]], D=[[0, 0], b[1], [0, 0]])
    (tmp_path / "car.toml").write_text(
        'kind = "plant"\nfile = "car.npz"\ninputs = ["road_rate [m/s]", "strut [N]"]\n'
        'outputs = ["deflection [m]", "body_acceleration [m/s^2]", "tyre_load [kN]"]\n'
        "[included]\nspring_N_per_m = 20e3\ndamper_N_s_per_m = 1500\n"
    )
    plant = load_vehicle(tmp_path / "car.toml").vehicle
    assert plant.plant().input_labels == ["road", "road_rate", "strut"]
    here, there = (ride(car, (22e3, 1800.0), ROAD, speed=20.0)["value"] for car in (plant, CAR))
    np.testing.assert_allclose(here, there[here.index], rtol=1e-9)  # rounding of small differences from 0 Hz on


def test_four_texts_in_order_with_contacts(tmp_path):
    system = HALF.plant(["pitch_acceleration", "front_tyre_load"])
    texts(tmp_path, (system.A, system.B, system.C, system.D))
    (tmp_path / "car.toml").write_text(
        """kind = "plant"
file = "car.a"
inputs = ["front_road [m]", "rear_road [m]", "front_strut [N]", "rear_strut [N]"]
outputs = [
    "pitch_acceleration [rad/s^2]", "front_tyre_load [N]", "front_deflection [m]", "rear_deflection [m]", "", "",
]

[[contacts]]
wheel = "front"
position_m = [1.2, 0]

[[contacts]]
wheel = "rear"
position = ["-1500 mm", "0 m"]
"""
    )
    plant = load_vehicle(tmp_path / "car.toml").vehicle
    assert plant.contacts == {"front": (1.2, 0.0), "rear": (-1.5, 0.0)}
    setting = {"front": (19e3, 1500.0), "rear": (23e3, 1700.0)}
    here, there = (
        ride(car, setting, Iso8608Road("C"), speed=15.0, measures=["SWS"])["value"] for car in (plant, HALF)
    )
    assert isinstance(HALF, HalfCar)
    np.testing.assert_allclose(here, there[here.index], rtol=1e-11)  # numbers of 17 digits


def test_a_plant_cannot_be_written_into_a_vehicle_file(folder):
    file = load_vehicle(folder / "car.toml")
    with pytest.raises(ValueError, match=r"^a file must hold one of quarter-car, .*, got Plant"):
        save_vehicle(folder / "again.toml", file)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("car.mat", "../car.mat",
         ":2: file must be beside this file or below it, unless outside is allowed, got '../car.mat'"),
        ("car.mat", "car.xls",
         ":2: file: {folder}/car.xls: ending of the file must be one of .mat, .npz, .npy, .a, .b, .c, .d, .csv, "
         ".uff, .unv, got '.xls'"),
        ("fs =", "f =", ":5: inputs must be one of r, fs, got 'f'"),
        ("-strut [kN]", "-strut [mm]", ": strut must be in N or a unit like it, got '1 mm' in mm"),
        ("sd = ", "# ", ": system must have the output 'deflection', got body_acceleration"),
        ("16000", "-1", ":14: included.spring_N_per_m must be finite and > 0 N/m, got -1.0"),
        ("spring_N_per_m = 16000", "front.spring_N_per_m = 1",
         ":14: included.front.spring_N_per_m must be one of the keys"),
        ('file = "car.mat"\n', "", ": file must be given, got none"),
        ("[bounds]", "[[seats]]\nmass_kg = 80\nspring_N_per_m = 1e4\ndamper_N_s_per_m = 600\n[bounds]",
         ":21: seats[1]: vehicle must be one of masses and links for static loads, roll, modes and seats, "
         "got a Plant"),
    ],
)  # fmt: skip
def test_mistakes_name_file_line_and_key(folder, old, new, message):
    path = folder / "car.toml"
    path.write_text(TOML.replace(old, new, 1))
    with pytest.raises(ValueError, match=re.escape(f"{path}{message.format(folder=folder)}")) as error:
        load_vehicle(path)
    assert len(str(error.value).splitlines()) == 1, error.value
