"""The page in a browser, one session for all tests: what is shown, linked and computed; no errors, no requests."""

import os
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import (
    Damper,
    Nsga2,
    QuarterCar,
    RideProblem,
    Spring,
    StudyFile,
    candidates,
    load_study,
    minimise,
    parallel,
    series,
)  # fmt: skip
from suspension_ctrl.desk.candidate_texts import parts_of
from suspension_ctrl.desk.decision import Decision
from suspension_ctrl.desk.explorer.page_file import page_of
from suspension_ctrl.desk.explorer.record import Column, columns_of
from suspension_ctrl.response.curves import setting_of
from suspension_ctrl.response.linearisation import linear_at
from suspension_ctrl.response.responses import response_psds
from suspension_ctrl.vehicles.assembly import label

CHROMIUM = shutil.which("chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-background-networking", "--enable-unsafe-swiftshader"]
FRONT = 1  # of the traces of a plot
EVIL = "<script>alert(1)</script>"

pytestmark = pytest.mark.skipif(CHROMIUM is None and "NO_SKIPS" not in os.environ, reason="needs Chromium")


class Opened(NamedTuple):
    """A study with its page in the browser."""

    study: StudyFile
    page: Any
    errors: list[str]
    requests: list[str]


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        launched = started.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield launched
        launched.close()


def searched(study: StudyFile) -> str:
    """Return the page of a study after a short search."""
    problem, present = study.problem, study.present or None
    run = minimise(problem, Nsga2(population=60), iterations=2, seed=1)
    table = candidates(problem, run, present=present)
    free = (
        run
        if not present
        else minimise(problem.replace(constraints=()), Nsga2(population=20), iterations=1, seed=1)
    )
    decision = Decision(problem, run, free, table)
    return page_of(study, decision, ["Said: <b>bold</b>."], {"Candidates": parts_of(problem, table)})


def studies() -> dict[str, StudyFile]:
    """A quarter car, a full car, a network and curves of dampers, with limits."""
    paper, full, damper = load_study("paper"), load_study("full_car"), load_study("damper_curve")
    mount = parallel(Spring(), series(Damper(), Spring("mount")))
    car = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=mount)
    bounds = {"spring": (15e3, 30e3), "damper": (800.0, 3e3), "mount": (1e5, 4e5)}
    network = RideProblem(car, paper.problem.road, speed=20.0, bounds=bounds, constraints=["SWS <= 0.03"])
    return {
        "quarter": replace(paper, problem=paper.problem.replace(constraints=["SWS <= 0.03"]), name=EVIL),
        "full": replace(full, problem=full.problem.replace(cases=full.problem.cases[:1], nodes=256)),
        "network": StudyFile(problem=network),
        "damper": replace(damper, problem=damper.problem.replace(constraints=["SWS <= 0.02"])),
    }


class Session:
    """Pages of studies in a browser, each opened once."""

    def __init__(self, browser, folder: Path) -> None:
        self.browser, self.folder, self.studies, self.opened = browser, folder, studies(), dict[str, Opened]()

    def __call__(self, name: str) -> Opened:
        if name not in self.opened:
            self.opened[name] = self._open(self.studies[name], self.folder / f"{name}.html")
        return self.opened[name]

    def _open(self, study: StudyFile, file: Path) -> Opened:
        file.write_text(searched(study), encoding="utf-8")
        page, errors, requests = self.browser.new_page(viewport={"width": 1400, "height": 1000}), [], []
        page.on("console", lambda one: errors.append(one.text) if one.type == "error" else None)
        page.on("pageerror", lambda one: errors.append(str(one)))
        page.on("request", lambda one: requests.append(one.url))
        page.on("dialog", lambda one: errors.append(one.message))
        page.goto(file.as_uri())
        page.wait_for_selector("body.drawn", timeout=30_000)
        return Opened(study, page, errors, requests)


@pytest.fixture(scope="module")
def session(browser, tmp_path_factory) -> Session:
    return Session(browser, tmp_path_factory.mktemp("pages"))


@pytest.fixture
def paper(session) -> Opened:
    return session("quarter")


def test_the_page_loads_without_errors_and_requests(paper):
    assert paper.errors == []
    assert [url for url in paper.requests if not url.startswith(("file:", "blob:", "data:"))] == []
    assert len([url for url in paper.requests if url.startswith("file:")]) == 1


def test_the_front_without_limits_stands_beside(paper):
    names = paper.page.evaluate('document.querySelector("#projections .plot").data.map(one => one.name)')
    assert names == [
        *("others", "front", "candidates", "kept", "present design", "front without limits", "design at hand"),
    ]


def test_texts_of_a_study_are_no_markup(paper):
    assert paper.page.inner_text("h1") == EVIL
    assert "Said: <b>bold</b>." in paper.page.inner_text("main")


MOVES = """places => places.map(place => {
  const begin = performance.now();
  document.querySelectorAll(".slider input").forEach((input, v) => {
    input.value = place[v];
    input.dispatchEvent(new Event("input"));
  });
  const each = (performance.now() - begin) / place.length;
  const values = selector => [...document.querySelectorAll(selector)].map(one => one.dataset.value);
  return {each, design: values(".slider output"), measures: values("#measures tr[data-value]")};
})"""
"""Moves all sliders of several designs; returns the designs, their measures and the milliseconds of one slider."""


def shown_in(found, study: StudyFile) -> tuple[np.ndarray, list[Column]]:
    """Return the measures that rows of a page show, in SI units, and their columns."""
    rows = [one for one in columns_of(study.problem) if one.kind != "variable"]
    given = np.array([[np.nan if one == "null" else float(one) for one in each] for each in found])
    return given / [one.factor for one in rows], rows


@pytest.mark.parametrize("name", ["quarter", "full", "network", "damper"])
def test_sliders_give_the_measures_of_python(name, session):
    """Sums in another order differ by 1e-12, working points of laws by 1e-9."""
    study, page = session(name).study, session(name).page
    problem = study.problem
    places = np.random.default_rng(3).integers(0, 1001, (20, len(problem.variables)))
    found = page.evaluate(MOVES, places.tolist())
    designs = np.array([one["design"] for one in found], dtype=float)
    share = (designs - problem.lower) / np.subtract(problem.upper, problem.lower)
    np.testing.assert_allclose(1000 * share, places, rtol=1e-9, atol=1e-9)
    shown, rows = shown_in([one["measures"] for one in found], study)
    scores = problem.evaluate(designs)
    wanted = np.array([(scores[:, one.place] - one.offset) / one.scale for one in rows]).T
    wanted[:, [not one.computed for one in rows]] = np.nan
    np.testing.assert_allclose(shown, wanted, rtol=1e-8)
    assert np.median([one["each"] for one in found]) < 50.0


def rest(page, case: int = 0) -> np.ndarray:
    """Return the design at hand once modes and sensitivities in a load case are its own."""
    shown = ",".join([str(case), *values(page, ".slider output")])
    page.wait_for_selector(f'#sensitivities[data-shown="{shown}"]', state="attached")
    return designs_of(page)


def changes_at(problem: RideProblem, design: np.ndarray) -> np.ndarray:
    """Return by variable the changes of measures by 1 % more of it [%]: exact, with force laws by differences."""
    if not problem.cases[0].vehicle.networks:
        found, jacobian = problem.with_jacobian(design[None])
        return (jacobian[0] * design / np.abs(found[0][:, None])).T
    steps = 3e-4 * np.diag(design)
    above, below, here = (problem.evaluate(each) for each in (design + steps, design - steps, design[None]))
    return (above - below) / (6e-4 * np.abs(here))


@pytest.mark.parametrize("name", ["quarter", "damper"])
def test_modes_and_sensitivities_are_those_of_python(name, session):
    """Central differences have an error of 1e-4 by the rounding of working points, less without force laws."""
    study, page = session(name).study, session(name).page
    problem, design = study.problem, rest(page)
    vehicle, setting = linear_at(problem.cases[0], setting_of(problem, design.tolist()), problem.band)
    modes = vehicle.modes(setting)
    found = np.array([one.split(",") for one in values(page, "#modes tr[data-value]")], dtype=float)
    np.testing.assert_allclose(
        found, modes[["frequency [Hz]", "damped frequency [Hz]", "damping ratio [-]"]], rtol=1e-5
    )
    exact = pd.DataFrame(changes_at(problem, design), index=list(problem.variables))
    names = page.locator("#sensitivities td:first-child").all_inner_texts()
    assert sorted(names) == sorted(problem.variables)
    rows = [one.split(",") for one in values(page, "#sensitivities tr[data-value]")]
    shown = np.array([[float(one or "nan") for one in row] for row in rows])[:, : len(problem.objectives)]
    known = np.isfinite(shown)
    assert known.any()
    np.testing.assert_allclose(shown[known], exact.loc[names].to_numpy()[:, : shown.shape[1]][known], atol=1e-4)


def test_each_load_case_has_modes_and_curves(session):
    study, page = session("damper").study, session("damper").page
    problem = study.problem
    choice = page.locator("#cases select")
    assert choice.locator("option").count() == len(problem.cases)
    last = len(problem.cases) - 1
    choice.select_option(str(last))
    design, case = rest(page, last), problem.cases[last]
    vehicle, setting = linear_at(case, setting_of(problem, design.tolist()), problem.band)
    ratios = [float(one.split(",")[2]) for one in values(page, "#modes tr[data-value]")]
    np.testing.assert_allclose(ratios, vehicle.modes(setting)["damping ratio [-]"], rtol=1e-5)
    responses = list(dict.fromkeys(term.response for term in problem.scores.terms[last]))
    closed = vehicle.closed(setting, responses=responses[:1])
    x, y = page.evaluate(
        "(({x, y}) => [x, y])(document.querySelector('#curves').data.find(one => one.yaxis === 'y3'))"
    )
    density = response_psds(closed, np.array(x), case.cross_spectrum(np.array(x)))[label(responses[0])]
    np.testing.assert_allclose(y, density, rtol=1e-5)
    choice.select_option("0")


def test_a_knee_of_a_damper_can_be_dragged(session):
    study, page = session("damper").study, session("damper").page
    before = designs_of(page)
    knot = page.locator(".knot").nth(2)
    knot.scroll_into_view_if_needed()
    box = knot.bounding_box()
    page.mouse.move(box["x"] + 7, box["y"] + 7)
    page.mouse.down()
    page.mouse.move(box["x"] + 7 - 20, box["y"] + 7 - 12, steps=3)
    page.mouse.up()
    design = designs_of(page)
    names = [
        name for name, one, other in zip(study.problem.variables, before, design, strict=True) if one != other
    ]
    assert names
    assert all(name.startswith("front.damper") for name in names)
    shown, rows = shown_in([values(page, "#measures tr[data-value]")], study)
    scores = study.problem.evaluate(design[None])[0]
    wanted = [(scores[one.place] - one.offset) / one.scale for one in rows]
    np.testing.assert_allclose(shown[0], wanted, rtol=1e-8)


def values(page, selector: str) -> list[str]:
    """Return the exact values of elements."""
    return page.eval_on_selector_all(selector, "all => all.map(one => one.dataset.value)")


def designs_of(page) -> np.ndarray:
    """Return the design that the sliders show."""
    return np.array(values(page, ".slider output"), dtype=float)


def test_a_click_on_a_point_takes_its_design(paper):
    page, design = paper.page, designs_of(paper.page)
    place = page.evaluate(
        """() => {
          const plot = document.querySelector("#projections .plot"), {xaxis, yaxis} = plot._fullLayout;
          const box = plot.getBoundingClientRect(), {x, y} = plot.data[2];
          const [right, down] = [xaxis._offset + xaxis.l2p(x[0]), yaxis._offset + yaxis.l2p(y[0])];
          return [box.x + right, box.y + window.scrollY + down];
        }"""
    )
    page.evaluate("window.scrollTo(0, 0)")
    page.mouse.click(*place)
    page.wait_for_timeout(300)
    found = designs_of(page)
    assert (found != design).any()
    first = candidates_of(page)[0]
    np.testing.assert_allclose(found, first, rtol=1e-12)


def candidates_of(page) -> list[list[float]]:
    """Return the designs of the candidates by the choice of designs to start from."""
    options = page.locator("#sliders select option").count()
    found = []
    for i in range(options):
        page.locator("#sliders select").select_option(str(i))
        found.append(designs_of(page).tolist())
    return found


def test_marked_designs_are_marked_in_all_plots(paper):
    page, half = paper.page, 5
    page.evaluate(
        """count => {
          const plot = document.querySelector("#projections .plot");
          const points = plot.data[1].customdata.slice(0, count).map(customdata => ({customdata}));
          plot.emit("plotly_selected", {points});
        }""",
        half,
    )
    lit = page.evaluate(
        """() => [...document.querySelectorAll("#projections .plot"), document.querySelector("#space")]
          .map(plot => plot.data[1].customdata)"""
    )
    assert len({tuple(one) for one in lit}) == 1
    assert len(lit[0]) == half
    blue = page.locator("#lines polyline[stroke='#0072b2']").count()
    assert blue == half
    page.evaluate('document.querySelector("#projections .plot").emit("plotly_deselect")')


def test_the_study_that_is_saved_has_the_design_at_hand(paper, tmp_path):
    page = paper.page
    with page.expect_download() as download:
        page.get_by_text("Study with this design").click()
    download.value.save_as(tmp_path / "mine.toml")
    study = load_study(tmp_path / "mine.toml")
    assert list(study.present.values()) == designs_of(page).tolist()
    assert study.problem == paper.study.problem


def test_the_designs_that_are_saved_are_those_shown(paper, tmp_path):
    page = paper.page
    with page.expect_download() as download:
        page.get_by_text("Designs shown").click()
    download.value.save_as(tmp_path / "designs.csv")
    table = pd.read_csv(tmp_path / "designs.csv")
    assert list(table)[:3] == ["design", "ACC [m/s^2]", "SWS [mm]"]
    assert set(data_of(page, FRONT)) <= set(table["ACC [m/s^2]"])


def data_of(page, trace: int) -> np.ndarray:
    """Return the first measure of a trace of the first projection."""
    return np.array(page.evaluate(f'document.querySelector("#projections .plot").data[{trace}].x'))


def test_a_filter_hides_exactly_the_designs_beyond_it(paper):
    page, before = paper.page, data_of(paper.page, FRONT)
    limit = float(np.sort(before)[len(before) // 2 :][:2].mean())  # between two designs
    page.evaluate(
        """limit => {
          const input = document.querySelectorAll(".filter")[0].querySelectorAll("input")[1];
          input.value = limit;
          input.dispatchEvent(new Event("input"));
        }""",
        limit,
    )
    np.testing.assert_array_equal(data_of(page, FRONT), before[before <= limit])


@pytest.mark.parametrize(("width", "media"), [(1400, "screen"), (1280, "screen"), (390, "screen"), (794, "print")])
def test_nothing_is_wider_than_the_page(paper, tmp_path, width, media):
    """Of a desk, a projector, a phone and paper, A4 at 96 dpi."""
    page = paper.page
    page.emulate_media(media=media)
    page.set_viewport_size({"width": width, "height": 900})
    page.wait_for_timeout(200)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.screenshot(path=tmp_path / f"{media}-{width}.png")
    assert (tmp_path / f"{media}-{width}.png").stat().st_size > 10_000
    page.emulate_media(media="screen")


def test_a_candidate_is_taken_by_the_keyboard(paper):
    button = paper.page.locator("#candidates button").nth(1)
    button.focus()
    paper.page.keyboard.press("Enter")
    row = paper.page.locator("#candidates tr[aria-current=true]")
    assert row.locator("button").inner_text() == button.inner_text()
    assert paper.page.locator("[tabindex]:not([tabindex='0'])").count() == 0


def test_a_layer_is_switched_off_and_on(paper):
    box = paper.page.get_by_label("front without limits")
    names = 'document.querySelector("#projections .plot").data.map(one => one.name)'
    box.uncheck()
    assert "front without limits" not in paper.page.evaluate(names)
    box.check()
    assert "front without limits" in paper.page.evaluate(names)


def test_plots_are_as_wide_as_paper_in_print(paper):
    """But for the 3-D plot, which paper does not show."""
    widths = "[...document.querySelectorAll('.plot:not(#space)')].map(plot => plot._fullLayout.width)"
    printed = paper.page.evaluate(f"window.dispatchEvent(new Event('beforeprint')), {widths}")
    assert printed == [350, 350, 700]
    paper.page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert not {350, 700} & set(paper.page.evaluate(widths))
