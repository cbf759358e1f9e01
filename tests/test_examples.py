"""The programs in `examples` run in a folder of their own and end with the numbers of a second road."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import garage
from suspension_ctrl import Iso8608Road, ride

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.py"))


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """What each program prints, by the first number in its name; each runs once."""
    known: dict[int, str] = {}

    def output(number: int) -> str:
        if number not in known:
            (path,) = [one for one in EXAMPLES if one.name.startswith(f"{number:02d}_")]
            done = subprocess.run(
                [sys.executable, "-W", "error", str(path)],
                capture_output=True, text=True, cwd=tmp_path_factory.mktemp(path.stem), check=False,
                env=os.environ | {"MPLBACKEND": "agg"},
            )  # fmt: skip
            assert done.returncode == 0, done.stderr
            known[number] = done.stdout
        return known[number]

    return output


def test_there_are_ten_of_a_page_each():
    assert [int(path.name[:2]) for path in EXAMPLES] == list(range(1, 11))
    assert all(len(path.read_text(encoding="utf-8").splitlines()) <= 60 for path in EXAMPLES)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_it_runs(path, printed):
    assert printed(int(path.name[:2])).strip()


def numbers(text: str, row: str) -> list[float]:
    """Return the numbers of the first line that begins with `row`."""
    line = next(line for line in text.splitlines() if line.startswith(row))
    return [float(number) for number in re.findall(r"-?\d+\.\d+", line.removeprefix(row))]


def test_the_ride_is_that_of_python_controls_closed_model(printed):
    """Mean squares by python-control at the nodes of the library; printed with four decimals."""
    setting = {"front": (21e3, 1500.0), "rear": (23e3, 1600.0), "front_antiroll": 12e3}
    terms = [("body_acceleration", "Wk"), ("rear_left_tyre_load", None)]
    found = garage.mean_squares(garage.FULL, setting, terms, (0.3, 20.0), 1000, road=Iso8608Road("C"))
    assert numbers(printed(1), "ACC") == pytest.approx([np.sqrt(found[0])], abs=5.1e-5)
    assert numbers(printed(1), "DTL") == pytest.approx([np.sqrt(found[1])], abs=5.1e-5)


def test_a_class_of_road_doubles_every_response(printed):
    """Gd(n0) of ISO 8608 rises by a factor of four from class to class."""
    for row in ("ACC", "DTL"):
        a, b, c = numbers(printed(3), row)
        assert [b / a, c / b] == pytest.approx([2, 2], rel=1e-3)


def test_responses_grow_with_the_root_of_the_speed(printed):
    """On a road of waviness 2 the spectrum over frequency is proportional to the speed."""
    slow, fast = numbers(printed(5), "as it is"), numbers(printed(5), "30 m/s")
    assert fast[:2] == pytest.approx([value * np.sqrt(1.5) for value in slow[:2]], rel=1e-3)
    assert numbers(printed(5), "other bounds") == slow


def test_the_history_has_the_ride_of_the_spectrum(printed):
    """Of 50 s of a realisation, a_w scatters by some percent about the expectation."""
    table = ride(garage.QUARTER, (22e3, 1500.0), Iso8608Road("C"), 20.0, band=(0.1, 100.0))
    assert float(re.search(r"a_w (\d\.\d+)", printed(6))[1]) == pytest.approx(table.value["ACC"], rel=0.1)


def test_fewer_strikes_cost_comfort(printed):
    header, softest, firmest = printed(8).splitlines()
    assert header.split("]")[-2].endswith("strikes [1/km")
    soft, firm = ([float(cell) for cell in line.split()] for line in (softest, firmest))
    assert soft[2] < firm[2]
    assert soft[3] > firm[3]


def test_a_measured_plant_rides_as_its_vehicle(printed):
    """Lines 0.025 Hz apart: the spline of the wheels' resonances is off by some 1e-4."""
    assert numbers(printed(9), "measured") == pytest.approx(numbers(printed(9), "masses and links"), rel=1e-3)


def test_more_evaluations_come_nearer_to_the_reference(printed):
    before, after = numbers(printed(10), "3000"), numbers(printed(10), "6000")
    assert all(0.9 < x <= y <= 1 for x, y in zip(before, after, strict=True))
