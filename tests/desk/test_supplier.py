"""The sheet of a design: all its numbers stand on one page, the same each time."""

import re
from dataclasses import replace
from io import BytesIO

import pytest

from garage import QUARTER, ROAD, SPEED
from suspension_ctrl import BumpStop, Damper, ReboundStop, RideProblem, Spring, parallel, supplier_sheet

PROBLEM = RideProblem(
    QUARTER,
    ROAD,
    speed=SPEED,
    bounds={"spring": (10e3, 30e3), "damper": (500.0, 5e3)},
    constraints=["SWS <= 0.03"],
)


def sheet(**options):
    return supplier_sheet(PROBLEM, [12389.0, 1616.3], **options)


def test_it_shows_values_tolerances_curves_range_and_measures():
    figure = sheet(present=[22e3, 1500.0], tolerances={"damper": 0.1}, name="A $car_1", date="27 November")
    texts = [one.get_text() for one in figure.texts]
    for text in (r"A \$car\_1".replace(r"\_", "_"), "27 November", "12.39", "22", "1616", "±10 %", "Ride", "met"):
        assert text in texts, text
    assert "808.1" in texts  # 1616.3 N s/m at 0.5 m/s
    (axes,) = figure.axes
    assert axes.get_xlabel() == "rate [m/s]"
    assert axes.lines[0].get_ydata()[-1] == pytest.approx(1616.3)


def test_the_file_depends_on_the_design_alone():
    files = []
    for _ in range(2):
        file = BytesIO()
        sheet().savefig(file, format="pdf", metadata={"CreationDate": None})
        files.append(file.getvalue())
    assert files[0] == files[1]
    assert len(re.findall(rb"/Type /Page\b", files[0])) == 1
    assert b"/MediaBox [ 0 0 595." in files[0]  # A4, 210 mm wide


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"present": {"spring": 22e3}}, "present must have spring, damper, got none for damper"),
        ({"tolerances": {"front": 0.1}}, "tolerances must be one of spring, damper, got 'front'"),
        ({"tolerances": {"spring": -0.1}}, "tolerance of spring must be finite and > 0, got -0.1"),
        ({"tolerances": 3}, "tolerances must be a mapping by name, got 3"),
    ],
)
def test_a_mistake_is_one_line(options, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        sheet(**options)


def test_stops_are_drawn_as_far_as_the_softest_and_dampers_as_a_whole():
    stops = BumpStop(gap=0.02, stiffness=1e6), ReboundStop(gap=0.02, stiffness=2e4)
    car = replace(QUARTER, strut=parallel(Spring(), Damper("soft"), Damper("hard"), *stops))
    bounds = {"spring": (10e3, 30e3), "soft": (100.0, 1e3), "hard": (1e3, 5e3)}
    problem = RideProblem(car, ROAD, speed=SPEED, bounds=bounds, band=(0.1, 20.0))
    dampers, springs = supplier_sheet(problem, [22e3, 100.0, 4e3]).axes
    assert dampers.get_ylim()[1] > 4e3  # at 1 m/s
    assert springs.get_xlabel() == "deflection [mm]"
    assert springs.get_ylim() == pytest.approx((-4 * 2e4 * 0.08, 4 * 2e4 * 0.08))  # 80 mm beyond the gap
