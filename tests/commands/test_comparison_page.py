"""The page of a comparison: fronts of the algorithms as layers, its tables, and those of the paper."""

import gzip
import json
import re
from base64 import b64decode

TINY = ("--populations", "20,25", "--iterations", 2, "--repeats", 1)


def parts_of(page: str) -> tuple[list[str], list[str], list[dict]]:
    """Return the sections, the titles of tables and the layers of a page."""
    packed = re.search(r'id="record" hidden data-gzip="([^"]*)"', page)[1]
    layers = json.loads(gzip.decompress(b64decode(packed)))["others"]
    sections = re.findall(r'<h2 id="section-\d+">(.*?)</h2>', page)
    return sections, re.findall(r"<h3>(.*?)</h3>", page), layers


def test_of_the_paper_it_has_the_fronts_of_all_algorithms_and_tables_1_to_5(called, tmp_path):
    (tmp_path / "front.csv").write_text("DTL [kN],ACC [m/s^2],SWS [mm]\n2,1,25\n1,3,50\n")
    assert called("compare", *TINY, "--reference", "front.csv", "--out", "out").returncode == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert len(page) < 8e6
    sections, titles, layers = parts_of(page)
    assert sections == ["Tables of the paper", "Candidates"]
    assert page.index('id="opening"') < page.index('id="choice"')
    assert re.search(r'<p class="advice">nsga2 takes \S+ to \S+ times as long at equal iterations', page)
    tables = [title[: len("Table 1")] for title in titles if title.startswith("Table ")]
    assert tables == [f"Table {number}" for number in range(1, 6)]
    assert [(one["name"], one["kind"], one["shown"]) for one in layers] == [
        ("nsga2, N = 25, 2 iterations", "run", True),
        ("moead-dra, N = 25, 2 iterations", "run", True),
        ("nsga2, N = 20, 2 iterations", "run", False),
        ("moead-dra, N = 20, 2 iterations", "run", False),
        ("reference front", "reference", False),
        ("attainable, LQR", "attainable", True),
    ]
    assert "<li>The reference front is of &#x27;front.csv&#x27;.</li>" in page


def test_without_a_design_within_the_limits_there_is_none(called, tmp_path):
    (tmp_path / "front.csv").write_text("DTL [kN],ACC [m/s^2]\n2,1\n1,3\n")
    text = 'vehicle = "yuen_ramli_2010"\nroad = "C"\nspeed_m_per_s = 20\nmeasures = ["ACC", "DTL"]\n'
    (tmp_path / "study.toml").write_text(text + 'constraints = ["SWS <= 2e-4"]\n')
    done = called("compare", "--study", "study.toml", *TINY, "--reference", "front.csv", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "out" / "report.html").exists()
