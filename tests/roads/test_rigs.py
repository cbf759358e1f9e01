"""Inputs of a test rig: signs of the motions, sweeps, and what a vehicle of few wheels cannot do."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.vehicles.assembly import Response

FOUR = np.array([(1.3, 0.75), (1.3, -0.75), (-1.4, 0.7), (-1.4, -0.7)])
MOTIONS = ("heave", "pitch", "roll", "warp")


def test_motions_have_the_signs_of_the_axes_and_are_orthogonal():
    quarter = np.array([0.25])  # s, of a wave of 1 s
    posts = {
        m: sc.RigSine(motion=m, amplitude=0.02, frequency=1.0).elevation(quarter, FOUR, 0.0)[0] for m in MOTIONS
    }
    np.testing.assert_allclose(posts["heave"], 0.02)
    np.testing.assert_allclose(posts["pitch"], [-0.02, -0.02, 0.02, 0.02])  # nose down
    np.testing.assert_allclose(posts["roll"][:2], [0.02, -0.02])  # left side up
    np.testing.assert_allclose(posts["warp"][:2], [-0.02, 0.02])
    square = np.array([(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)])
    matrix = [
        sc.RigSine(motion=m, amplitude=1.0, frequency=1.0).elevation(quarter, square, 0.0)[0] for m in MOTIONS
    ]
    np.testing.assert_allclose(np.array(matrix) @ np.transpose(matrix), 4 * np.eye(4), atol=1e-12)


def test_a_slow_pitch_of_the_rig_pitches_the_body_by_its_rise_over_the_wheelbase():
    file = sc.load_vehicle("jian_2022_full")
    car = file.vehicle
    motion = sc.RigSine(motion="pitch", amplitude=0.01, frequency=1.0)
    posts = motion.elevation(np.array([0.25]), car.contact_points, 0.0)[0]
    closed = car.closed(file.setting, responses=["pitch_acceleration"])
    omega = 2 * np.pi * 0.01
    pitch = (closed(1j * omega)[0, : len(posts)] @ posts).real / -(omega**2)
    assert pitch == pytest.approx(
        2 * 0.01 / np.ptp(car.contact_points[:, 0]), rel=1e-3
    )  # f is 1 % of the pitch mode
    assert car.meanings["pitch_acceleration"] == Response("acceleration", "pitch")


def test_a_sweep_rises_evenly_and_a_sine_stops_after_its_waves():
    sweep = sc.RigChirp(motion="heave", amplitude=0.01, lowest=1.0, highest=9.0, waves=50.0)
    end = sweep.knots(FOUR, 0.0)[-1]
    time = np.linspace(0.0, end, 9)
    cycles = sweep.cycles(np.add.outer(time[1:-1], [-1e-4, 1e-4]))
    np.testing.assert_allclose(np.diff(cycles)[:, 0] / 2e-4, 1.0 + 8.0 * time[1:-1] / end, rtol=1e-9)
    assert end == 10.0
    assert sweep.cycles(np.array([end, 99.0])).tolist() == [50.0, 50.0]
    sine = sc.RigSine(motion="heave", amplitude=0.01, frequency=4.0, waves=2.0)
    assert abs(sine.elevation(np.array([0.5, 3.0]), FOUR, 0.0)).max() < 1e-15
    assert not sine.steady


@pytest.mark.parametrize(("motion", "wheels"), [("pitch", 1), ("roll", 1), ("warp", 1)])
def test_one_wheel_only_heaves(motion, wheels):
    with pytest.raises(ValueError, match=rf"^motion .*got {motion}"):
        sc.RigSine(motion=motion, amplitude=0.01, frequency=1.0).elevation(np.zeros(1), np.zeros((wheels, 2)), 0.0)


@pytest.mark.parametrize(
    ("make", "values", "key", "got"),
    [
        (sc.RigSine, {"motion": "yaw", "frequency": 1.0}, "motion", "yaw"),
        (sc.RigSine, {"motion": "heave", "frequency": 0.0}, "frequency", "0"),
        (sc.RigSine, {"motion": "heave", "frequency": 1.0, "waves": 0.7}, "waves", "0.7"),
        (sc.RigChirp, {"motion": "heave", "lowest": 5.0, "highest": 1.0, "waves": 3.0}, "highest", "1"),
    ],
)
def test_a_wrong_number_is_named(make, values, key, got):
    with pytest.raises(ValueError, match=rf"^{key} .*got .*{got}"):
        make(amplitude=0.01, **values)
