"""Figures by their data: each curve beside python-control's own response in the unit that its axis names."""

import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from scipy.linalg import eigh

from garage import FULL, ROAD, SPEED, struts_of
from suspension_ctrl import QuarterCar, RideProblem, escaping
from suspension_ctrl.paper import figures
from suspension_ctrl.response import weightings
from suspension_ctrl.response.curves import DesignCurves, design_curves

DESIGNS = {"soft": (12e3, 1600.0), "stiff": (26e3, 1900.0)}
TITLES = {"SWS": "suspension_travel", "ACC": "body_acceleration", "DTL": "tyre_load"}
PER_SI = {"mm": 1e3, "mm/mm": 1.0, "m/s²": 1.0, "rad/s²": 1.0, "kN": 1e-3}
"""What one of the response's SI unit is in the unit that an axis names."""


@pytest.fixture(scope="module")
def curves(table1_problem) -> list[DesignCurves]:
    names = list(table1_problem.vehicle.responses)
    return [design_curves(table1_problem, label, design, names, 50) for label, design in DESIGNS.items()]


def by_control(car: QuarterCar, design: tuple[float, float], response: str, f: np.ndarray) -> np.ndarray:
    """Response to the road [SI unit/m], without the library's own paths."""
    return car.closed(*design)[response, "road"](2j * np.pi * f)


def shown_in(ax: Axes, kind: str) -> float:
    """Return the factor from SI units to the unit in the label of the vertical axis."""
    (found,) = re.findall(rf"^{kind} \[(.*)\]$", ax.get_ylabel())
    unit = re.sub(r"(/m|²/Hz)$", "", found).strip("()")
    return PER_SI[unit]


def drawn(ax: Axes) -> list[tuple[np.ndarray, np.ndarray]]:
    return [tuple(line.get_xydata().T) for line in ax.lines]


def axes_of(figure: Figure, rows: int) -> list[list[Axes]]:
    columns = len(figure.axes) // rows
    return [[figure.axes[row * columns + column] for row in range(rows)] for column in range(columns)]


def test_bode_shows_magnitude_and_phase_in_the_units_of_the_axes(curves, table1_problem):
    for magnitude, phase in axes_of(figures.bode(curves), 2):
        response = TITLES[magnitude.get_title()[:3]]
        assert (magnitude.get_xscale(), magnitude.get_yscale(), phase.get_ylabel()) == (
            "log",
            "log",
            "phase [deg]",
        )
        assert phase.get_xlabel() == "frequency [Hz]"
        for i, design in enumerate(DESIGNS.values()):  # a curve, then its marks
            (f, shown), (at, marks) = drawn(magnitude)[2 * i : 2 * i + 2]
            h = by_control(table1_problem.vehicle, design, response, f)
            np.testing.assert_allclose(shown, np.abs(h) * shown_in(magnitude, "magnitude"), rtol=1e-9)
            _, degrees = drawn(phase)[2 * i]
            np.testing.assert_allclose(np.exp(1j * np.radians(degrees)), h / np.abs(h), atol=1e-9)
            stiffness = [[design[0] + 192e3, -design[0]], [-design[0], design[0]]]
            natural = np.sqrt(eigh(stiffness, np.diag([45.4, 317.5]), eigvals_only=True)) / (2 * np.pi)
            np.testing.assert_allclose(at, natural, rtol=1e-9)
            np.testing.assert_allclose(marks, np.interp(at, f, shown), rtol=1e-12)


def test_spectra_show_densities_in_the_units_of_the_axes(curves, table1_problem):
    road, factor = table1_problem.road, weightings.by_name("Wk").factor
    for (ax,) in axes_of(figures.spectra(curves, "Wk"), 1):
        response = TITLES[ax.get_title()[:3]]
        weighted = response == "body_acceleration"
        assert ("dashed: Wk" in ax.get_title()) == weighted
        lines = drawn(ax)
        each = len(lines) // len(DESIGNS)
        assert each == 2 + weighted
        for i, design in enumerate(DESIGNS.values()):
            f, shown = lines[each * i]
            density = np.abs(by_control(table1_problem.vehicle, design, response, f)) ** 2 * road.psd(f, SPEED)
            np.testing.assert_allclose(shown, density * shown_in(ax, "PSD") ** 2, rtol=1e-9)
            if weighted:
                np.testing.assert_allclose(lines[each * i + 2][1], density * factor(f) ** 2, rtol=1e-9)


def test_a_full_car_has_a_panel_for_each_response():
    """Of all tracks alike, each wheel when it gets there; rotations in radians."""
    setting = FULL.coefficients(struts_of(FULL))
    free = {"front.spring": (1.5e4, 2.5e4)}
    fixed = {name: value for name, value in setting.items() if name not in free}
    problem = RideProblem(FULL, ROAD, speed=SPEED, bounds=free, struts=fixed, band=(0.1, 20.0))
    names = ["pitch_acceleration", "rear_left_tyre_load"]
    curve = design_curves(problem, "own", (setting["front.spring"],), names, 30)
    panels = axes_of(figures.bode([curve]), 2)
    assert [magnitude.get_title() for magnitude, _ in panels] == ["pitch acceleration", "rear left tyre load"]
    closed, x = FULL.closed(struts_of(FULL), responses=names), FULL.contact_points[:, 0]
    for row, (magnitude, _) in enumerate(panels):
        f, shown = drawn(magnitude)[0]
        h = np.moveaxis(closed(2j * np.pi * f), 2, 0)
        late = np.exp(-2j * np.pi * f[:, None] * (x.max() - x) / SPEED)
        expected = np.abs((h[:, row] * late).sum(axis=1))
        np.testing.assert_allclose(shown, expected * shown_in(magnitude, "magnitude"), rtol=1e-9)


def test_weighting_factors_are_those_of_filters_and_tables():
    ax = Figure().add_subplot()
    figures.weighting_factors(ax, ["Wk", "Wb"], ["Wb-table"])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("frequency [Hz]", "weighting factor [-]")
    for name, (f, shown) in zip(("Wk", "Wb", "Wb-table"), drawn(ax), strict=True):
        np.testing.assert_array_equal(shown, weightings.by_name(name).factor(f))
    (lines, marks) = ax.lines[1], ax.lines[2]
    assert [line.get_label() for line in (lines, marks)] == ["Wb, filter", "Wb, table"]
    np.testing.assert_allclose(marks.get_xdata(), weightings.BANDS)


def test_eight_of_many_designs_are_drawn_in_colours_of_their_own_and_said_so(curves):
    many = [replace(curves[0], label=str(n)) for n in range(15)]
    eight = ["0", "2", "4", "6", "8", "10", "12", "14"]
    for designs, drawn_ones, title in ((curves, ["soft", "stiff"], ""), (many, eight, "8 of 15 designs")):
        figure = figures.bode(designs)
        (legend,) = figure.legends
        assert [text.get_text() for text in legend.get_texts()] == drawn_ones
        assert legend.get_title().get_text() == title
        assert len({line.get_color() for line in figure.axes[0].lines}) == len(drawn_ones)


def test_root_mean_squares_stand_beside_the_spectra(curves, table1_problem):
    """Those of the problem's measures, in the units of the axes."""
    values = table1_problem.evaluate(list(DESIGNS.values()))
    for (ax,) in axes_of(figures.spectra(curves, "Wk"), 1):
        texts = [text.get_text().split(" / ")[-1] for text in ax.get_legend().get_texts()]
        measure = table1_problem.objectives.index(ax.get_title()[:3])
        expected = values[:, measure] * shown_in(ax, "PSD")
        np.testing.assert_allclose([float(text) for text in texts], expected, rtol=5e-4)
        assert (
            ax.get_legend()
            .get_title()
            .get_text()
            .endswith(f"[{ax.get_ylabel().split('[')[1].split('²/Hz')[0].strip('()')}]")
        )


def test_panels_of_many_responses_stand_in_rows_of_four(table1_problem):
    names = [*table1_problem.vehicle.responses, "body_velocity", "strut_force"]
    one = design_curves(table1_problem, "one", (22e3, 1500.0), names, 20)
    axes = figures.bode([one]).axes
    assert len(axes) == 2 * len(names)
    assert [ax.get_xlabel() for ax in axes].count("frequency [Hz]") == len(names)
    bottoms = {round(ax.get_subplotspec().rowspan.start) for ax in axes}
    assert bottoms == {0, 1, 2, 3}


def test_hostile_names_are_no_formulas_and_stand_in_the_legends(curves):
    """Names of designs; a formula with a mistake would raise as it is drawn."""
    name = r"_$x$ \frac{ <b>"
    figure = figures.bode([replace(curves[0], label=name)])
    FigureCanvasAgg(figure).draw()
    assert figure.legends[0].get_texts()[0].get_text() == escaping.figure(name)
