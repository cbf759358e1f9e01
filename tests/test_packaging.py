"""The wheel, installed in an empty environment, works from any folder."""

import json
import subprocess
import sys
import venv
import zipfile

import pytest

PROGRAM = """
import json, sys
import numpy as np
from suspension_ctrl import MoeadDra, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.response import weightings
problem = paper.ride_problem(weighting="Wb-table")
run = minimise(problem, MoeadDra(population=20), iterations=2, seed=0)
print(json.dumps({
    "objectives": problem.evaluate([paper.reference_design()])[0].tolist(),
    "table": weightings.by_name("Wk-table").factor([1.0])[0],
    "published": len(paper.published_seconds()),
    "evaluations": run.evaluations,
    "file": sys.modules["suspension_ctrl"].__file__,
}))
"""


@pytest.fixture(scope="module")
def wheel(checkout, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(checkout)]
    subprocess.run(build, check=True, capture_output=True)
    return next(folder.glob("*.whl"))


def test_wheel_holds_the_data_and_the_type_marker(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assert "suspension_ctrl/data/standards/iso8041_wk_wb_table.csv" in names
    assert "suspension_ctrl/py.typed" in names
    assert not any(name.startswith(("tests", "scripts", "benchmarks")) for name in names)


def test_wheel_works_in_an_empty_environment(wheel, checkout, tmp_path):
    venv.create(tmp_path / "env", with_pip=True)
    python = tmp_path / "env" / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    install = [python, "-m", "pip", "install", "--quiet", "--constraint", checkout / "constraints.txt", wheel]
    subprocess.run(install, check=True, capture_output=True, cwd=tmp_path)
    done = subprocess.run([python, "-c", PROGRAM], check=True, capture_output=True, text=True, cwd=tmp_path)
    found = json.loads(done.stdout)
    assert found["objectives"][0] == pytest.approx(2.1157, abs=5e-5)
    assert found["table"] == pytest.approx(0.4825)
    assert found["published"] == 40
    assert found["evaluations"] == 28
    assert str(tmp_path) in found["file"]
