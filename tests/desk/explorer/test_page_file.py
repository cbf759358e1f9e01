"""The page as a file: its size, its policy, its parts."""

import gzip
import json
import re
from base64 import b64decode, b64encode
from hashlib import sha256
from pathlib import Path

import pytest

import suspension_ctrl.desk.explorer.page_file
from suspension_ctrl import Nsga2, load_study
from suspension_ctrl.desk.candidate_texts import parts_of
from suspension_ctrl.desk.decision import Decision
from suspension_ctrl.desk.explorer.page_file import page_of

PLOTLY = Path(suspension_ctrl.desk.explorer.page_file.__file__).parent / "plotly"
PUBLISHED = "4ac841837b31c1bfd2ab140e3a248ddcc6c2106978fbf2c1c18a7aada930a37a"  # plotly-strict.min.js 4.1.1 on npm


@pytest.fixture(scope="module")
def page() -> str:
    study = load_study("paper")
    decision = Decision.of(study.problem, Nsga2(population=40), iterations=2, seed=1, present=study.present)
    return page_of(study, decision, ["a < b"], {"Tables": parts_of(decision.problem, decision.table)})


def test_the_plotting_library_is_the_published_one():
    content = gzip.decompress((PLOTLY / "plotly-strict.min.js.gz").read_bytes())
    assert sha256(content).hexdigest() == PUBLISHED
    assert "MIT" in (PLOTLY / "LICENSE").read_text()


def test_the_policy_allows_the_scripts_of_the_page_alone(page):
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    assert policy.startswith("default-src 'none'; ")
    assert "unsafe-eval" not in policy
    allowed = re.search(r"script-src ([^;]*);", policy)[1].split()
    scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    plotly = gzip.decompress(b64decode(re.search(r'id="plotly" hidden data-gzip="([^"]*)"', page)[1]))
    wanted = [*(one.encode() for one in scripts), plotly]
    assert allowed == [f"'sha256-{b64encode(sha256(one).digest()).decode()}'" for one in wanted]


def test_the_record_is_compressed_json(page):
    packed = re.search(r'id="record" hidden data-gzip="([^"]*)"', page)[1]
    record = json.loads(gzip.decompress(b64decode(packed)))
    assert [one["name"] for one in record["columns"]] == ["ACC", "SWS", "DTL", "spring", "damper"]


def test_nothing_is_fetched_and_texts_are_escaped(page):
    assert not re.findall(r'(?:src|action)="|href="[^#]', page)
    assert "<li>a &lt; b</li>" in page
    assert len(page) < 8e6
