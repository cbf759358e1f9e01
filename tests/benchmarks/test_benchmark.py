"""The benchmark in its short form, where other libraries are: `make bench` installs them, and CI runs it after."""

import json
import struct
from importlib.util import find_spec

import pandas as pd
import pytest

from peers import PEERS


@pytest.fixture(scope="module")
def quick(script, tmp_path_factory):
    if not find_spec("pygmo"):
        pytest.skip("other libraries are not installed: make bench")
    out, docs = tmp_path_factory.mktemp("benchmark") / "results", tmp_path_factory.mktemp("docs")
    done = script("benchmark", "--quick", "--out", out, "--docs", docs, warnings="default")
    assert done.returncode == 0, done.stderr
    return out, docs, done


def test_writes_every_timing_the_page_and_the_picture(quick):
    out, docs, done = quick
    sections = {
        "process",
        "cold_start",
        "evaluation",
        "struts",
        "derivatives",
        "moead",
        "moead_limits",
        "target",
        "nsga2",
        "full_car",
        "roofline",
    }
    names = {f"{section}.csv" for section in sections}
    assert {path.name for path in out.iterdir()} == names | {
        "environment.json",
        "performance.md",
        "performance.png",
    }
    for section in sections:
        table = pd.read_csv(out / f"{section}.csv")
        assert (table.seconds.dropna() > 0).all()
    assert done.stdout.splitlines()[-1] == str(out)
    assert (docs / "performance.md").read_text() == (out / "performance.md").read_text()
    head = (docs / "performance.png").read_bytes()[:24]
    assert min(struct.unpack(">II", head[16:24])) > 700


def test_every_library_has_its_row_or_is_said_to_be_absent(quick):
    out, _, done = quick
    page = (out / "performance.md").read_text()
    timed = " ".join(pd.read_csv(out / "nsga2.csv").contender.unique()).lower()
    for distribution in PEERS:
        name = distribution.split("-")[0]
        if name not in timed:
            assert f"Absent: {distribution} (" in page
            assert f"Absent: {distribution} (" in done.stdout


def test_one_thread_and_the_machine_are_on_record(quick):
    out, _, _ = quick
    record = json.loads((out / "environment.json").read_text())
    assert record["threads"]["numba"] == 1
    assert record["processor"] in (out / "performance.md").read_text()
    for section in ("moead", "nsga2"):
        table = pd.read_csv(out / f"{section}.csv")
        ours = table[table.contender == "suspension_ctrl"]
        assert (ours.cpu_seconds < 1.5 * ours.seconds + 0.01).all()


@pytest.mark.parametrize("arguments", [("--out", "taken"), ("--fast",), ("--docs", "nowhere")])
def test_bad_input_is_one_line(script, tmp_path, arguments):
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "file").touch()
    done = script("benchmark", *arguments, cwd=tmp_path, warnings="default")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "results").exists()
