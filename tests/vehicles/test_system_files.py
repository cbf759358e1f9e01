"""Systems in files: a plant written in each format and read again gives the same ride to 1e-12."""

import re
from pathlib import Path

import control
import numpy as np
import pytest

from garage import DAMPED_FULL, DAMPED_HALF, QUARTER, ROAD, SPEED, struts_of
from suspension_ctrl import Plant, load_system, ride, save_system

CARS = {"quarter": QUARTER, "damped half": DAMPED_HALF, "damped full": DAMPED_FULL}
F = np.arange(0.4, 21.0, 0.1)


def plant(car, system):
    return Plant(system, dict(zip(car.tyres, map(tuple, car.contact_points.tolist()), strict=True)))


def values(vehicle, setting):
    return ride(vehicle, setting, ROAD, speed=SPEED, band=(0.5, 20.0))["value"]


def setting_of(car):
    """A setting by strut, as plants have it."""
    if car.struts == ("",):
        return struts_of(car)
    pairs = {"front": (19e3, 1500.0), "rear": (23e3, 1700.0)}
    return {strut: pairs[strut.split("_")[0]] for strut in car.struts}


@pytest.mark.parametrize(
    ("name", "ending"),
    [(name, ending) for name in ("quarter", "damped half") for ending in (".mat", ".npz", ".a")]
    + [("damped half", ".csv"), ("damped full", ".mat")],
)
def test_a_plant_written_and_read_again_gives_the_same_ride(tmp_path, name, ending):
    """A table is compared with the frequency responses from which it was written."""
    car, path = CARS[name], tmp_path / f"car{ending}"
    system = car.plant()
    if ending == ".csv":
        h = system.frequency_response(2 * np.pi * F)
        system = control.frd(h.frdata, h.omega, inputs=h.input_labels, outputs=h.output_labels)
    save_system(path, system)
    names = {}
    if ending == ".a":
        units = {"road": "m", "rate": "m/s", "strut": "N", "acceleration": "m/s^2", "load": "N", "travel": "m",
                 "deflection": "m"}  # fmt: skip
        kinds = {"roll_acceleration": "rad/s^2", "pitch_acceleration": "rad/s^2"}
        for kind, labels in (("inputs", system.input_labels), ("outputs", system.output_labels)):
            names[kind] = [f"{one} [{kinds.get(one, units[one.rpartition('_')[2]])}]" for one in labels]
    there = plant(car, system)
    here = Plant.named(load_system(path), **names, contacts=there.contacts)
    setting = setting_of(car)
    np.testing.assert_allclose(values(here, setting), values(there, setting), rtol=1e-12)
    assert list(values(here, setting).index) == list(values(there, setting).index)


@pytest.mark.parametrize("ending", [".mat", ".npz", ".a", ".csv"])
def test_a_closed_vehicle_is_written_too(tmp_path, ending):
    closed = DAMPED_HALF.closed(struts_of(DAMPED_HALF))
    save_system(tmp_path / f"closed{ending}", closed, F)
    found = load_system(tmp_path / f"closed{ending}")
    assert found.output_labels == (closed.output_labels if ending != ".a" else [f"y[{i}]" for i in range(6)])
    s = 2j * np.pi * F
    np.testing.assert_allclose(found(s), closed(s), rtol=1e-12, atol=1e-14 * np.abs(closed(s)).max())


@pytest.mark.parametrize(
    ("path", "system", "message"),
    [
        ("car.xls", QUARTER.plant(), "ending of the file must be one of .mat, .m, .npz, .a, .csv, got '.xls'"),
        ("car.mat", 3, "system must be a control.StateSpace or FrequencyResponseData, got int"),
        ("car.csv", QUARTER.plant(), "frequency must be given for a table of a control.StateSpace, got none"),
        ("car.npz", control.frd([[[1.0, 1.0]]], [1.0, 2.0]),
         "system must be a control.StateSpace for matrices, got FrequencyResponseData"),
    ],
)  # fmt: skip
def test_what_cannot_be_written_is_one_line_and_no_file(tmp_path, path, system, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        save_system(tmp_path / path, system)
    assert not list(tmp_path.iterdir())


def test_endings_count_in_any_case(tmp_path):
    plant = QUARTER.plant()
    save_system(tmp_path / "car.NPZ", plant)
    np.testing.assert_array_equal(load_system(tmp_path / "car.NPZ").A, plant.A)


def test_lines_of_a_table_ascend(tmp_path):
    with pytest.raises(ValueError, match=r"^frequency must be finite, above zero and ascend, got 1.0 in row 2$"):
        save_system(tmp_path / "car.csv", QUARTER.plant(), [2.0, 1.0])


def test_a_file_of_another_kind_is_named(tmp_path):
    path = tmp_path / "car.xls"
    with pytest.raises(ValueError, match="^" + re.escape(f"{path}: ending of the file must be one of .mat, ")):
        load_system(path)


@pytest.mark.parametrize("ending", ["mat", "npz", "npy", "a", "csv", "uff"])
def test_devices_and_large_files_are_refused_unread(tmp_path, ending):
    """A sparse file of 200 MB, and a link to a device that never ends."""
    stem = "A" if ending == "npy" else "car"
    with (tmp_path / f"{stem}.{ending}").open("wb") as file:
        file.truncate(200_000_000)
    (tmp_path / f"B.{ending}").symlink_to("/dev/zero")
    for name in (stem, "B"):
        with pytest.raises(ValueError, match=r"must be a regular one of at most [\d.]+ MB, got "):
            load_system(Path(tmp_path / f"{name}.{ending}"))
