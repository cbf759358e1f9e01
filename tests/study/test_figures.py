"""Figures by their data: what is drawn against numbers computed here, and the units of the axes."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from suspension_ctrl import escaping
from suspension_ctrl.study import figures

ALGORITHMS = ("a", "b")
SEEDS = range(9)
rng = np.random.default_rng(3)


@pytest.fixture
def ax():
    return Figure().subplots()


@pytest.fixture(scope="module")
def quality() -> pd.DataFrame:
    """Runs of two algorithms at three numbers of evaluations, rising in quality."""
    rows = [
        {
            "algorithm": name,
            "seed": seed,
            "evaluations": evaluations,
            "seconds": evaluations * (1e-3 if name == "a" else 2e-3),
            "relative_hypervolume": 1 - rng.random() * 10 / evaluations,
        }
        for name in ALGORITHMS
        for seed in SEEDS
        for evaluations in (20, 40, 100)
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize("over", ["evaluations", "seconds"])
def test_anytime_curves_are_medians_between_quartiles(ax, quality, over):
    figures.anytime(ax, quality, over)
    assert ax.get_xlabel() == {"evaluations": "evaluations [-]", "seconds": "time [s]"}[over]
    assert (ax.get_ylabel(), ax.get_xscale()) == ("hypervolume / reference [-], more is better", "log")
    assert [line.get_label() for line in ax.lines] == list(ALGORITHMS)
    for line, band, name in zip(ax.lines, ax.collections, ALGORITHMS, strict=True):
        part = quality[quality.algorithm == name]
        places = sorted(part[over].unique())
        values = np.array([part.relative_hypervolume[part[over] == place] for place in places])
        low, middle, high = np.quantile(values, [0.25, 0.5, 0.75], axis=1)
        np.testing.assert_allclose(line.get_xydata(), np.stack([places, middle], axis=1), rtol=1e-14)
        corners = {tuple(corner) for corner in np.round(band.get_paths()[0].vertices, 12)}
        for edge in (low, high):
            assert {tuple(corner) for corner in np.round(np.stack([places, edge], axis=1), 12)} <= corners


def test_boxes_reach_from_quartile_to_quartile_of_finite_values():
    values = {"a": [3.0, 1.0, 2.0, 5.0, 4.0, *[np.inf] * 4], "b": [20.0, 10.0, 30.0, *[np.inf] * 5]}
    rows = [{"algorithm": n, "seed": seed, "igd_plus": x} for n, xs in values.items() for seed, x in enumerate(xs)]
    (ax,) = figures.box_panels(pd.DataFrame(rows), ["igd_plus"], "N = 20").axes
    assert ax.get_ylabel() == "IGD+ [-], less is better"
    assert [label.get_text() for label in ax.get_xticklabels()] == ["a", "b"]
    medians = [
        line.get_ydata()[0] for line in ax.lines if line.get_color() == "black" and len(line.get_xdata()) == 2
    ]
    boxes = [
        (patch.get_path().vertices[:, 1].min(), patch.get_path().vertices[:, 1].max()) for patch in ax.patches
    ]
    assert boxes == [(2.0, 4.0), (15.0, 25.0)]  # of 1 to 5; of 10, 20, 30
    assert {3.0, 20.0} <= set(medians)


def fronts(shift: float, seeds) -> pd.DataFrame:
    """Populations of five designs in two objectives, some of which are dominated."""
    points = [(seed, *(rng.random(2) + shift)) for seed in seeds for _ in range(5)]
    return pd.DataFrame(points, columns=["seed", "SWS [m]", "DTL [N]"])


def test_attainment_is_the_share_of_runs_that_reach_a_place(ax):
    """In the middle of cells, by counting; only seeds that both have are shown."""
    first, second = fronts(0.0, SEEDS), fronts(0.2, [*SEEDS, 99])
    drawn = figures.attainment_differences(ax, first, second, ("SWS [m]", "DTL [N]"))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("SWS [m]", "DTL [N]")
    left, right, bottom, top = drawn.get_extent()
    shares = drawn.get_array().filled(0.0)
    assert shares.shape == (figures.CELLS, figures.CELLS)
    for row, column in np.random.default_rng(0).integers(0, figures.CELLS, (30, 2)):
        place = [(column + 0.5) / figures.CELLS, (row + 0.5) / figures.CELLS]
        middle = np.array([left, bottom]) + np.array([right - left, top - bottom]) * place
        attained = [
            np.mean([(side[side.seed == seed].iloc[:, 1:] <= middle).all(axis=1).any() for seed in SEEDS])
            for side in (first, second)
        ]
        assert shares[row, column] == pytest.approx(attained[0] - attained[1], abs=1e-12)
    assert drawn.get_clim() == (-1, 1)
    assert shares.max() > 0


def test_panels_are_as_many_as_asked_for():
    figure, axes = figures.panels(4, columns=3)
    assert len(axes) == len(figure.axes) == 4


def test_anytime_panels_are_sets_by_evaluations_and_seconds(quality, ax):
    table = pd.concat([quality.assign(set=name, population=20) for name in ("population", "archive")])
    figure = figures.anytime_panels(table, ["population", "archive"])
    assert [panel.get_title() for panel in figure.axes] == ["population"] * 2 + ["archive"] * 2
    assert figure.get_suptitle() == "N = 20, median and quartiles of 9 runs each"
    assert [panel.get_xlabel() for panel in figure.axes] == ["evaluations [-]", "time [s]"] * 2
    figures.anytime(ax, quality, "seconds")
    np.testing.assert_array_equal(figure.axes[3].lines[1].get_xydata(), ax.lines[1].get_xydata())


def test_hostile_names_are_no_formulas_and_stand_in_the_legends(quality):
    name = r"_$x$ \frac{ <b>"
    sets = [quality.assign(set="s", population=10).replace({"algorithm": {"a": name}})]
    anytime = figures.anytime_panels(sets[0], ("s",))
    sides = [fronts(shift, SEEDS).rename(columns={"SWS [m]": name}) for shift in (0.0, 0.2)]
    attained = figures.attainment_panels(*sides, [name, "DTL [N]"], (name, "b"))
    boxes = figures.box_panels(sets[0], ["seconds"], "N = 20")
    table = populations().replace({"algorithm": {"a": name}}).rename(columns={"DTL [N]": f"{name} [N]"})
    populated = figures.final_populations(table, "SWS [m]", [f"{name} [N]"])
    for figure in (anytime, attained, boxes, populated):
        FigureCanvasAgg(figure).draw()
    for figure in (anytime, populated):
        assert figure.legends[0].get_texts()[0].get_text() == escaping.figure(name)
    assert populated.subfigs[0].axes[0].yaxis.label.get_text() == escaping.figure(f"{name} [kN]")
    assert [attained.axes[0].get_xlabel(), boxes.axes[0].get_xticklabels()[0].get_text()] == [
        escaping.figure(name)
    ] * 2


def test_attainment_panels_are_of_every_two_objectives():
    sides = [fronts(shift, SEEDS) for shift in (0.0, 0.2)]
    sides = [side.assign(**{"ACC [m/s^2]": side["SWS [m]"] ** 2}) for side in sides]
    names = ["SWS [m]", "DTL [N]", "ACC [m/s^2]"]
    figure = figures.attainment_panels(*sides, names, ALGORITHMS)
    *panels, bar = figure.axes
    pairs = [(panel.get_xlabel(), panel.get_ylabel()) for panel in panels]
    assert pairs == [("SWS [mm]", "DTL [kN]"), ("SWS [mm]", "ACC [m/s²]"), ("DTL [kN]", "ACC [m/s²]")]
    assert bar.get_ylabel() == "a less b [-]"
    assert figure.get_suptitle().startswith("Share of 9 runs each that attain a point or better, a less b\n")
    left, right, *_ = panels[0].images[0].get_extent()
    both = pd.concat(sides)
    assert 1e3 * both["SWS [m]"].min() <= left < right <= 1e3 * both["SWS [m]"].max()


def populations() -> pd.DataFrame:
    rows = [
        {"algorithm": name, "population": n, "iterations": 5, "SWS [m]": x, "ACC [m/s^2]": y, "DTL [N]": z}
        for name in ALGORITHMS
        for n in (10, 20)
        for x, y, z in np.random.default_rng(3).random((n, 3)) * [0.1, 2, 3000]
    ]
    return pd.DataFrame(rows)


def test_final_populations_show_every_design_in_the_units_of_its_axes():
    table = populations()
    figure = figures.final_populations(table, "SWS [m]", ["ACC [m/s^2]", "DTL [N]"])
    (left, right) = figure.subfigs
    for place, n in ((left, 10), (right, 20)):
        upper, lower = place.axes
        assert upper.get_title() == f"N = {n}, 5 iterations"
        assert (upper.get_ylabel(), lower.get_ylabel(), lower.get_xlabel()) == (
            "ACC [m/s²]",
            "DTL [kN]",
            "SWS [mm]",
        )
        for ax, column, factor in ((upper, "ACC [m/s^2]", 1), (lower, "DTL [N]", 1e-3)):
            assert [marks.get_label() for marks in ax.lines] == list(ALGORITHMS)
            for marks, name in zip(ax.lines, ALGORITHMS, strict=True):
                part = table[(table.algorithm == name) & (table.population == n)]
                expected = np.stack([1e3 * part["SWS [m]"], factor * part[column]], axis=1)
                np.testing.assert_allclose(marks.get_xydata(), expected, rtol=1e-14)


def test_final_populations_are_of_two_algorithms_at_most():
    table = pd.concat([populations(), populations().replace({"algorithm": {"a": "c"}})])
    with pytest.raises(ValueError, match=r"^populations must be of one or two algorithms, got \['a', 'b', 'c'\]$"):
        figures.final_populations(table, "SWS [m]", ["DTL [N]"])


def test_a_short_study_has_points_and_ranges():
    """Of three runs: every value a point, the median a line; a curve between the least and the greatest."""
    rows = [
        {"algorithm": name, "seed": seed, "evaluations": e, "seconds": e / 100, "relative_hypervolume": value + e}
        for name, values in (("a", (0.1, 0.7, 0.2)), ("b", (0.5, 0.4, 0.9)))
        for seed, value in enumerate(values)
        for e in (1, 2)
    ]
    runs = pd.DataFrame(rows).assign(set="population", population=20)
    last = runs[runs.evaluations == 2]
    figure = figures.box_panels(last, ["relative_hypervolume"], "N = 20")
    (ax,) = figure.axes
    assert not ax.patches
    assert [sorted(line.get_ydata()) for line in ax.lines] == [[2.1, 2.2, 2.7], [2.4, 2.5, 2.9]]
    assert [lines.get_segments()[0][0][1] for lines in ax.collections] == [2.2, 2.5]
    assert figure.get_suptitle() == "N = 20\npoints and median of 3 runs each"
    curves = figures.anytime_panels(runs, ["population"])
    assert curves.get_suptitle() == "N = 20, median and range of 3 runs each"
    corners = curves.axes[0].collections[0].get_paths()[0].vertices
    assert {(1.0, 1.1), (1.0, 1.7), (2.0, 2.1), (2.0, 2.7)} <= set(map(tuple, np.round(corners, 12)))


def test_directions_and_numbers_of_runs_are_said(quality):
    figure = figures.box_panels(quality.assign(igd_plus=1.0, spread=1.0), ["igd_plus", "spread"], "N = 20")
    assert [ax.get_ylabel() for ax in figure.axes] == [
        "IGD+ [-], less is better", "generalised spread [-], less is more even",
    ]  # fmt: skip
    uneven = pd.concat([quality, quality.assign(seed=quality.seed + 10)])
    uneven = uneven[uneven.algorithm.eq("a") | (uneven.seed < 15)]
    figure = figures.box_panels(uneven.assign(spread=1.0), ["spread"], "N = 20")
    assert figure.get_suptitle() == "N = 20\nboxes of median and quartiles of 14 to 18 runs"


def test_eight_algorithms_have_lines_of_their_own(quality, ax):
    many = pd.concat([quality[quality.algorithm == "a"].assign(algorithm=f"a{i}") for i in range(8)])
    figures.anytime(ax, many)
    assert len({(line.get_color(), str(line.get_linestyle())) for line in ax.lines}) == 8
    figure = figures.anytime_panels(many.assign(set="s", population=20), ["s"])
    assert len(figure.legends[0].get_texts()) == 8
