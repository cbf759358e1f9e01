"""The page of a run in a notebook."""

import gzip
import json
import re
from base64 import b64decode

import pytest

import suspension_ctrl as sc


@pytest.fixture(scope="module")
def run(table1_problem):
    return sc.minimise(table1_problem, sc.Nsga2(population=20), iterations=2, seed=1)


def test_a_notebook_shows_the_page_in_a_frame(table1_problem, run):
    page = sc.explore(table1_problem, run, present=[22e3, 1500.0], title="a <b>")
    assert repr(page) == "Page(title='a <b>')"
    frame = re.fullmatch(
        r'<iframe src="data:text/html;base64,([^"]*)" style="[^"]*"></iframe>', page._repr_html_()
    )
    assert b64decode(frame[1]).decode() == page.html
    assert "<h1>a &lt;b&gt;</h1>" in page.html
    assert "present design" in page.html


def test_a_run_of_another_problem_is_refused(table1_problem, run):
    other = table1_problem.replace(measures=["ACC", "DTL"])
    with pytest.raises(ValueError, match="run must be of the problem, 2 variables and 2 objectives, got 2 and 3"):
        sc.explore(other, run)
    with pytest.raises(ValueError, match="problem must be a RideProblem"):
        sc.explore(None, run)
    with pytest.raises(ValueError, match="each of certificates must be a Certificate, got 1"):
        sc.explore(table1_problem, run, certificates=[1])


def test_certified_designs_stand_with_their_simulated_values(table1_problem, run):
    certificate = sc.certify(table1_problem, [22e3, 1500.0], length=400.0, seeds=range(2))
    page = sc.explore(table1_problem, run, certificates=[certificate])
    packed = re.search(r'id="record" hidden data-gzip="([^"]*)"', page.html)[1]
    certified = json.loads(gzip.decompress(b64decode(packed)))["certified"]
    assert certified["names"] == ["certified 1"]
    known = dict(certified["known"][0])
    value = certificate.to_frame().loc[("1", "SWS"), "simulated"]
    assert known["SWS simulated"].startswith(f"{1e3 * value:.4g} mm (95 % ")
