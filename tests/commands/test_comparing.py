"""Comparisons on other vehicles, roads and speeds, and on problems from files."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Iso8608Road, RideProblem, escaping, load_study, load_vehicle, save_system
from suspension_ctrl.commands import reports
from suspension_ctrl.commands.studies import chosen_study
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study.kept_fronts import KeptFronts
from suspension_ctrl.study.reference import TOLERANCE, Reference

TINY = ("--populations", "20,25", "--iterations", 2, "--repeats", 1)
PICTURES = {"populations.png", "populations.pdf"}
TABLES = {f"{name}{ending}" for name in ("times", "hypervolume") for ending in (".csv", ".md", ".tex")}
CASE = '[[cases]]\nvehicle = "minaker_half"\nroad = "C"\nspeed_m_per_s = 15\n'
VARIABLES = [
    "front.spring [N/m]", "front.damper [N s/m]", "rear.spring [N/m]", "rear.damper [N s/m]",
    "front_antiroll [N m/rad]", "rear_antiroll [N m/rad]",
]  # fmt: skip


def study(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text + CASE)
    return path


def assert_nothing_of_the_paper(done, out):
    """No table of the paper is printed or written, no column of published values."""
    assert not re.search(r"Table \d|Figure \d|publ", done.stdout)
    assert not [*out.glob("table*"), *out.glob("figure*")]
    assert not [name for name in pd.read_csv(out / "times.csv") if "publ" in name]


def test_compare_on_another_vehicle(called, tmp_path):
    done = called("compare", "--vehicle", "jian_2022_full", "--road", "C", "--speed", 20, *TINY, "--out", "out")
    assert done.returncode == 0, done.stderr
    out = tmp_path / "out"
    assert {path.name for path in out.glob("[!.]*")} == TABLES | PICTURES | {
        "runs.csv", "environment.json", "study.toml", "fronts", "timed", "reference", "reference.csv",
        "report.html",
    }  # fmt: skip
    assert_nothing_of_the_paper(done, out)
    assert "Road: ISO 8608 class C, geometric mean" in done.stdout
    assert "20 m/s" in done.stdout
    said = " ".join(done.stdout.split())
    assert "The reference front is of all timed runs (no grid within 20,000,000 designs and 60 s has" in said
    front = pd.read_csv(out / "fronts" / "nsga2_n25_i2_r1.csv")
    assert list(front.columns) == [*VARIABLES, "ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    problem = chosen_study(vehicle="jian_2022_full", road="C", speed=20.0).problem
    np.testing.assert_allclose(
        front.iloc[:, 6:], problem.evaluate(front.iloc[:, :6].to_numpy()), rtol=1e-12
    )  # by another number of threads
    assert json.loads((out / "environment.json").read_text())["arguments"]["vehicle"] == "jian_2022_full"


def test_what_a_comparison_of_masses_and_links_never_asks_for_is_not_imported():
    """They would take a second and a half: python-control with SciPy's filters and statistics, and matplotlib."""
    program = (
        "import sys\n"
        "from suspension_ctrl.commands import comparing\n"
        "from suspension_ctrl.desk.attaining import optimal_controllers\n"
        "from suspension_ctrl.paper import experiment\n"
        "problem, design = experiment.ride_problem(), experiment.reference_design()\n"
        "optimal_controllers(problem, dict(zip(problem.variables, design)), 2, {})\n"
        "print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    found = set(done.stdout.split())
    assert {"numba", "pandas", "scipy.linalg"} <= found
    assert not found & {"control", "matplotlib", "scipy.signal", "scipy.stats"}


def test_another_speed_with_a_given_reference_front_is_not_beside_the_paper(called, tmp_path):
    (tmp_path / "front.csv").write_text("DTL [kN],ACC [m/s^2],SWS [mm]\n2,1,25\n1,3,50\n")
    sizes = ("--populations", 500, "--iterations", 10, "--repeats", 1)  # of the paper
    given = ("--reference", "front.csv")
    done = called("compare", "--speed", 30, "--algorithms", "moead-dra", *sizes, *given, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert_nothing_of_the_paper(done, tmp_path / "out")
    assert re.search(r"^reference front in .* s, given$", done.stderr, re.MULTILINE)
    assert "The reference front is of 'front.csv'." in " ".join(done.stdout.split())
    reference = pd.read_csv(tmp_path / "out" / "reference.csv")
    assert reference.to_dict("list") == {"ACC [m/s^2]": [1, 3], "SWS [m]": [0.025, 0.05], "DTL [N]": [2000, 1000]}
    assert "Road: power law: " in done.stdout


def test_a_front_of_an_earlier_comparison_is_said_to_be_kept(called, tmp_path, monkeypatch):
    monkeypatch.setenv("SUSPENSION_CTRL_CACHE", str(tmp_path / "kept"))
    front = ReferenceFront.of(np.array([[1.0, 0.05, 3000.0], [3.0, 0.01, 1000.0]]))
    problem = chosen_study(vehicle="minaker_half").problem
    KeptFronts.of_user().keep(problem, TOLERANCE, Reference(front, "a grid"))
    sizes = ("--populations", 20, "--iterations", 1, "--repeats", 1)
    done = called("compare", "--vehicle", "minaker_half", "--algorithms", "random", *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert re.search(r"^reference front in .* s, kept from an earlier comparison$", done.stderr, re.MULTILINE)
    assert "The reference front is of a grid." in " ".join(done.stdout.split())


@pytest.mark.drawn
def test_compare_on_a_study_goes_on_and_judges_quality(called, checkout, tmp_path):
    """Eight variables, three cases and limits; then the same with `--quality` in the same folder, then another."""
    path = checkout / "data/studies/full_car.toml"
    command = ("compare", "--study", path, *TINY, "--out", "out")
    done = called(*command)
    assert done.returncode == 0, done.stderr
    out = tmp_path / "out"
    assert_nothing_of_the_paper(done, out)
    assert "Limits: SWS <= 12 mm, roll_gradient <= 6" in done.stdout
    assert "Road of all cases: ISO 8608 class C, geometric mean" in done.stdout
    assert "Case 3, share 0.2: 30 m/s." in done.stdout
    assert "ACC is weighted" not in done.stdout  # discomfort has weightings of its own
    front = pd.read_csv(out / "fronts" / "moead-dra_n20_i2_r1.csv")
    assert list(front.columns) == [
        *VARIABLES, "driver.spring [N/m]", "driver.damper [N s/m]",
        "discomfort [m/s^2]", "SWS [m]", "DLC [-]", "violation",
    ]  # fmt: skip
    assert front.violation.eq(0).all()
    before = {path: path.stat().st_mtime_ns for path in (out / "timed" / "runs").iterdir()}
    assert load_study(out / "study.toml").search.seeds == 31

    again = called(*command, "--quality", "--seeds", 2, "--target", 0.9)
    assert again.returncode == 0, again.stderr
    for text in (r"timed runs, 6 of 6 in .* s, 6 found", r"reference front in .* s, found in out"):
        assert re.search(f"^{text}$", again.stderr, re.MULTILINE)
    assert {path: path.stat().st_mtime_ns for path in (out / "timed" / "runs").iterdir()} == before
    assert {f"{kind}_n{n}.png" for kind in ("anytime", "boxes", "attainment") for n in (20, 25)} <= {
        path.name for path in out.glob("[!.]*")
    }
    runs = pd.read_csv(out / "runs.csv")
    assert len(runs[~runs.timing]) == 2 * 2 * 2
    assert (out / "verdict.md").read_text().startswith("No verdict: 2 runs against 2 cannot differ")
    assert not (out / "verdict.csv").exists()

    kept = (out / "study.toml").read_bytes()
    search = load_study(out / "study.toml").search
    assert (search.seeds, search.target, search.populations) == (2, 0.9, (20, 25))
    more = called(*command, "--quality", "--seeds", 3)
    assert (more.returncode, more.stderr.startswith("error: seeds must be 2 as in ")) == (2, True)
    assert called(*command).returncode == 0  # without judged runs, of which there are 31 by default
    assert (out / "study.toml").read_bytes() == kept

    other = study(tmp_path, 'measures = ["ACC", "SWS", "DTL"]\n')
    refused = called("compare", "--study", other, *TINY, "--out", "out")
    assert refused.returncode == 2
    assert refused.stderr.startswith("error: problem.")
    assert refused.stderr.count("\n") == 1


@pytest.mark.parametrize("measures", ['["ACC", "SWS"]', '["comfort = ACC", "SWS", "DTL front", "DTL rear"]'])
@pytest.mark.drawn
def test_compare_takes_any_number_of_objectives(called, tmp_path, measures):
    path = study(tmp_path, f"measures = {measures}\n")
    sizes = ("--populations", 40, "--iterations", 1, "--repeats", 1, "--quality", "--seeds", 2)
    done = called("compare", "--study", path, "--algorithms", "nsga2,random", *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "ACC is weighted with Wk" in done.stdout
    assert (tmp_path / "out" / "attainment_n40.png").exists()


@pytest.mark.parametrize("limit", [0.001, 0.00695])
def test_limits_that_leave_no_front_leave_times_without_quality(called, tmp_path, limit):
    """With limits near the least travel that 20 designs have: none within them; a single one."""
    path = study(tmp_path, f'measures = ["ACC", "SWS", "DTL"]\nconstraints = ["SWS <= {limit}"]\n')
    sizes = ("--populations", 20, "--iterations", 2, "--repeats", 1, "--quality")
    done = called("compare", "--study", path, *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "Quality is not judged: no two designs found within the limits differ" in " ".join(done.stdout.split())
    assert "Times: the ratio" in done.stdout
    assert {path.name for path in (tmp_path / "out").glob("[!.]*")} == PICTURES | {
        *("times.csv", "times.md", "times.tex", "runs.csv", "environment.json", "fronts", "timed", "reference"),
        "study.toml", *(["report.html"] if limit > 0.001 else []),
    }  # fmt: skip


def test_runs_without_a_feasible_design_are_counted(called, tmp_path):
    """Just above the least travel some runs find designs within the limits and some do not."""
    path = study(tmp_path, 'measures = ["ACC", "SWS", "DTL"]\nconstraints = ["SWS <= 0.0071"]\n')
    sizes = ("--populations", 20, "--iterations", 2, "--repeats", 1)
    done = called("compare", "--study", path, *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    empty = sum(pd.read_csv(path).empty for path in (tmp_path / "out" / "fronts").iterdir())
    assert 0 < empty < 3
    assert f"{empty} of 3 timed runs found no design within the limits." in done.stdout


def test_hostile_names_are_harmless_in_all_that_is_written_and_printed(called, tmp_path):
    """Measures of another's file: terminal, figures and CSV; the comparison resumes by them too."""
    names = ["@a|<b>_$x$ \x1b[31m\u202e[bold]x", "-b", "+c\\"]
    measures = [f"{name} = {kind}" for name, kind in zip(names, ("ACC", "SWS", "DTL"), strict=True)]
    case = 'vehicle = "minaker_half"\nroad = "C"\nspeed_m_per_s = 20'
    (tmp_path / "p.toml").write_text(f"measures = {json.dumps(measures)}\n[[cases]]\n{case}", encoding="utf-8")
    command = ("compare", "--study", "p.toml", "--populations", 20, "--iterations", 2, "--repeats", 1,
               "--algorithms", "sobol,random", "--out", "out")  # fmt: skip
    first, again = called(*command), called(*command)
    assert first.returncode == 0
    assert first.stderr.startswith("timed runs, 2 of 2 in ")
    assert re.match(r"timed runs, 2 of 2 in 0.\d s, 2 found\n", again.stderr)
    assert again.stdout == first.stdout
    assert "\x1b" not in first.stdout + first.stderr
    files = [*(tmp_path / "out" / "fronts").iterdir()]
    assert len(files) == 2
    for file in files:
        header = file.read_text(encoding="utf-8").splitlines()[0]
        assert header.isprintable()
        assert all(f",'{start}" in header for start in "@-+")
        columns = [escaping.from_csv(name) for name in pd.read_csv(file).columns]
        assert columns[-3:] == [f"{name} [{unit}]" for name, unit in zip(names, ("m/s^2", "m", "N"), strict=True)]


def test_compare_on_a_problem_of_a_plant_of_another_program(called, tmp_path):
    (tmp_path / "front.csv").write_text("DTL [kN],ACC [m/s^2]\n2,1\n1,3\n")
    save_system(tmp_path / "car.npz", load_vehicle("yuen_ramli_2010").vehicle.plant())
    (tmp_path / "plant.toml").write_text('kind = "plant"\nfile = "car.npz"\n')
    (tmp_path / "p.toml").write_text(
        'measures = ["ACC", "DTL"]\nconstraints = ["SWS <= 0.03"]\nband_Hz = [0.1, 20.0]\n'
        "[bounds]\nspring_N_per_m = [15e3, 30e3]\ndamper_N_s_per_m = [500, 4000]\n"
        '[[cases]]\nvehicle = "plant.toml"\nroad = "C"\nspeed_m_per_s = 20\n'
    )
    done = called("compare", "--study", "p.toml", *TINY, "--reference", "front.csv", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "Limits: SWS <= 30 mm." in done.stdout
    assert_nothing_of_the_paper(done, tmp_path / "out")
    problem = RideProblem(
        load_vehicle("yuen_ramli_2010").vehicle, Iso8608Road("C"), speed=20.0, measures=["ACC", "DTL"],
        bounds={"spring": (15e3, 30e3), "damper": (500.0, 4000.0)}, band=(0.1, 20.0),
    )  # fmt: skip
    for algorithm in ("nsga2", "moead-dra"):
        front = pd.read_csv(tmp_path / "out" / "fronts" / f"{algorithm}_n20_i2_r1.csv")
        wanted = problem.evaluate(front[["spring [N/m]", "damper [N s/m]"]].to_numpy())
        np.testing.assert_allclose(front[["ACC [m/s^2]", "DTL [N]"]], wanted, rtol=1e-9)


def test_an_interrupted_comparison_says_what_is_kept(called, tmp_path, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(reports, "write_times", interrupted)
    done = called("compare", "--vehicle", "minaker_half", *TINY, "--out", "out")
    assert done.returncode == 130
    kept = done.stderr.splitlines()[-1]
    assert re.fullmatch(r"(\d+) of \1 runs are kept in out; go on with --out out", kept)
