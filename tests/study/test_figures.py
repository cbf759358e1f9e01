"""Figures by their data: what is drawn against numbers computed here, and the units of the axes."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from suspension_ctrl import escaping
from suspension_ctrl.study import figures

ALGORITHMS = ("a", "b")
SEEDS = range(7)
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
    assert (ax.get_ylabel(), ax.get_xscale()) == ("hypervolume / reference [-]", "log")
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
    values = {"a": [3.0, 1.0, 2.0, 5.0, 4.0], "b": [20.0, 10.0, np.inf, 30.0]}
    runs = pd.DataFrame([{"algorithm": name, "igd_plus": x} for name, xs in values.items() for x in xs])
    (ax,) = figures.box_panels(runs, ["igd_plus"]).axes
    assert ax.get_ylabel() == "IGD+ [-]"
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
    """In the middle of every rectangle, by counting; only seeds that both have are shown."""
    first, second = fronts(0.0, SEEDS), fronts(0.2, [*SEEDS, 99])
    drawn = figures.attainment_differences(ax, first, second, ("SWS [m]", "DTL [N]"))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("SWS [m]", "DTL [N]")
    for path, share in zip(drawn.get_paths(), drawn.get_array(), strict=True):
        middle = path.vertices[:4].mean(axis=0)
        attained = [
            np.mean([(side[side.seed == seed].iloc[:, 1:] <= middle).all(axis=1).any() for seed in SEEDS])
            for side in (first, second)
        ]
        assert share == pytest.approx(attained[0] - attained[1], abs=1e-12)
    assert drawn.get_clim() == (-1, 1)
    assert max(drawn.get_array()) > 0


def test_panels_are_as_many_as_asked_for():
    figure, axes = figures.panels(4, columns=3)
    assert len(axes) == len(figure.axes) == 4


def test_anytime_panels_are_sets_by_evaluations_and_seconds(quality, ax):
    table = pd.concat([quality.assign(set=name, population=20) for name in ("population", "archive")])
    figure = figures.anytime_panels(table, ["population", "archive"])
    assert [panel.get_title() for panel in figure.axes] == ["population, N = 20"] * 2 + ["archive, N = 20"] * 2
    assert [panel.get_xlabel() for panel in figure.axes] == ["evaluations [-]", "time [s]"] * 2
    figures.anytime(ax, quality, "seconds")
    np.testing.assert_array_equal(figure.axes[3].lines[1].get_xydata(), ax.lines[1].get_xydata())


def test_box_panels_are_one_per_indicator(quality):
    figure = figures.box_panels(quality.assign(spread=2.0), ["relative_hypervolume", "spread"])
    assert [panel.get_ylabel() for panel in figure.axes] == [
        "hypervolume / reference [-]",
        "generalised spread [-]",
    ]


def test_hostile_names_are_no_formulas_and_stand_in_the_legends(quality):
    name = r"_$x$ \frac{ <b>"
    sets = [quality.assign(set="s", population=10).replace({"algorithm": {"a": name}})]
    anytime = figures.anytime_panels(sets[0], ("s",))
    sides = [fronts(shift, SEEDS).rename(columns={"SWS [m]": name}) for shift in (0.0, 0.2)]
    attained = figures.attainment_panels(*sides, [name, "DTL [N]"], (name, "b"))
    boxes = figures.box_panels(sets[0], ["seconds"])
    for figure in (anytime, attained, boxes):
        FigureCanvasAgg(figure).draw()
    assert anytime.axes[0].get_legend().get_texts()[0].get_text() == escaping.figure(name)
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
    assert pairs == [("SWS [m]", "DTL [N]"), ("SWS [m]", "ACC [m/s^2]"), ("DTL [N]", "ACC [m/s^2]")]
    assert bar.get_ylabel() == "share of runs attaining: a less b"
