"""The page in a browser, one session for all tests: what is shown, linked and computed; no errors, no requests."""

import os
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from suspension_ctrl import Nsga2, StudyFile, load_study
from suspension_ctrl.desk.decision import Decision
from suspension_ctrl.desk.explorer.page_file import page_of

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
    present = study.present or None
    decision = Decision.of(study.problem, Nsga2(population=60), iterations=4, seed=1, present=present)
    return page_of(study, decision, ["Said: <b>bold</b>."])


def opened(browser, study: StudyFile, file: Path) -> Opened:
    file.write_text(searched(study), encoding="utf-8")
    page, errors, requests = browser.new_page(viewport={"width": 1400, "height": 1000}), [], []
    page.on("console", lambda one: errors.append(one.text) if one.type == "error" else None)
    page.on("pageerror", lambda one: errors.append(str(one)))
    page.on("request", lambda one: requests.append(one.url))
    page.on("dialog", lambda one: errors.append(one.message))
    page.goto(file.as_uri())
    page.wait_for_selector("body.drawn", timeout=20_000)
    return Opened(study, page, errors, requests)


@pytest.fixture(scope="module")
def paper(browser, tmp_path_factory) -> Opened:
    study = load_study("paper")
    limited = replace(study, problem=study.problem.replace(constraints=["SWS <= 0.03"]), name=EVIL)
    return opened(browser, limited, tmp_path_factory.mktemp("page") / "report.html")


def test_the_page_loads_without_errors_and_requests(paper):
    assert paper.errors == []
    assert [url for url in paper.requests if not url.startswith(("file:", "blob:", "data:"))] == []
    assert len([url for url in paper.requests if url.startswith("file:")]) == 1


def test_texts_of_a_study_are_no_markup(paper):
    assert paper.page.inner_text("h1") == EVIL
    assert "Said: <b>bold</b>." in paper.page.inner_text("header")


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


def test_sliders_give_the_measures_of_python(paper):
    problem, places = paper.study.problem, np.random.default_rng(3).integers(0, 1001, (20, 2))
    found = paper.page.evaluate(MOVES, places.tolist())
    designs = np.array([one["design"] for one in found], dtype=float)
    share = (designs - problem.lower) / np.subtract(problem.upper, problem.lower)
    np.testing.assert_allclose(1000 * share, places, rtol=1e-12, atol=1e-9)
    in_mm_and_kn = [1.0, 1e3, 1e-3]
    wanted = in_mm_and_kn * problem.evaluate(designs)[:, :3]
    np.testing.assert_allclose(np.array([one["measures"] for one in found], dtype=float), wanted, rtol=1e-9)
    assert np.median([one["each"] for one in found]) < 50.0


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
