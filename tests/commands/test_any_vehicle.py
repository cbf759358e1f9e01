"""The scripts on other vehicles, roads, speeds and bands, and on problems from files."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import garage
from suspension_ctrl import Iso8608Road
from suspension_ctrl.commands import bode, compare
from suspension_ctrl.paper.experiment import chosen
from suspension_ctrl.quantities import column_headers
from suspension_ctrl.response import weightings
from suspension_ctrl.roads.files import load_road
from suspension_ctrl.vehicles.files import load_vehicle

TINY = ("--populations", "20,25", "--iterations", 2, "--repeats", 1)
PICTURES = {"figure5.png", "figure5.pdf"}
TABLES = {f"table{n}{ending}" for n in (2, 3, 4) for ending in (".csv", ".md", ".tex")}
MEASURED = "wavenumber [cycle/m],psd [m^3]\n0.02,1e-3\n0.1,1e-4\n1,1e-6\n2,2e-7\n"
CASE = '[[cases]]\nvehicle = "minaker_half"\nroad = "C"\nspeed_m_per_s = 15\n'
VARIABLES = [
    "front.spring [N/m]", "front.damper [N s/m]", "rear.spring [N/m]", "rear.damper [N s/m]",
    "front_antiroll [N m/rad]", "rear_antiroll [N m/rad]",
]  # fmt: skip


def study(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text + CASE)
    return path


def assert_one_line(done, message, status=2):
    assert done.returncode == status
    assert done.stdout == ""
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert message in done.stderr


def assert_nothing_published(out):
    """Columns of published values are there, and empty."""
    for number in (2, 3):  # of NSGA-II and MOEA/D-DRA
        assert pd.read_csv(out / f"table{number}.csv").published_seconds.isna().all()
    table = pd.read_csv(out / "table4.csv")
    assert table[["published_seconds", "published_ratio_percent"]].isna().all(axis=None)


def test_compare_on_another_vehicle(called, tmp_path):
    done = called("compare", "--vehicle", "jian_2022_full", "--road", "C", "--speed", 20, *TINY, "--out", "out")
    assert done.returncode == 0, done.stderr
    out = tmp_path / "out"
    assert {path.name for path in out.iterdir()} == TABLES | PICTURES | {
        "runs.csv", "environment.json", "fronts", "timed",
    }  # fmt: skip
    assert_nothing_published(out)
    assert "Case 1, share 1: ISO 8608 class C, geometric mean" in done.stdout
    assert "20 m/s" in done.stdout
    assert "the non-dominated designs of all these runs" in done.stdout
    front = pd.read_csv(out / "fronts" / "nsga2_n25_i2_r1.csv")
    assert list(front.columns) == [*VARIABLES, "ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    problem, _ = chosen("jian_2022_full", "C", 20.0)
    np.testing.assert_allclose(
        front.iloc[:, 6:], problem.evaluate(front.iloc[:, :6].to_numpy()), rtol=1e-12
    )  # by another number of threads
    assert json.loads((out / "environment.json").read_text())["arguments"]["vehicle"] == "jian_2022_full"


def test_another_speed_is_not_beside_the_paper(called, tmp_path, monkeypatch):
    monkeypatch.setattr(compare, "GRID_VARIABLES", 1)  # a reference front of the runs is made at once
    sizes = ("--populations", 500, "--iterations", 10, "--repeats", 1)  # of the paper
    done = called("compare", "--speed", 30, "--algorithms", "moead-dra", *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(tmp_path / "out" / "table3.csv").published_seconds.isna().all()
    assert "Case 1, share 1: power law: " in done.stdout


def test_compare_on_a_study_goes_on_and_judges_quality(called, checkout, tmp_path):
    """Eight variables, three cases and limits; then the same with `--quality` in the same folder, then another."""
    path = checkout / "data/studies/full_car.toml"
    command = ("compare", "--problem", path, *TINY, "--out", "out")
    done = called(*command)
    assert done.returncode == 0, done.stderr
    out = tmp_path / "out"
    assert_nothing_published(out)
    assert "Limits: SWS <= 0.012, roll_gradient <= 6." in done.stdout
    assert "Case 3, share 0.2: ISO 8608 class C, geometric mean" in done.stdout
    assert "ACC is weighted" not in done.stdout  # comfort has weightings of its own
    front = pd.read_csv(out / "fronts" / "moead-dra_n20_i2_r1.csv")
    assert list(front.columns) == [
        *VARIABLES, "driver.spring [N/m]", "driver.damper [N s/m]",
        "comfort [m/s^2]", "SWS [m]", "DLC [-]", "violation",
    ]  # fmt: skip
    assert front.violation.eq(0).all()
    before = {path: path.stat().st_mtime_ns for path in (out / "timed" / "runs").iterdir()}

    again = called(*command, "--quality", "--seeds", 2)
    assert again.returncode == 0, again.stderr
    assert {path: path.stat().st_mtime_ns for path in (out / "timed" / "runs").iterdir()} == before
    assert {f"{kind}_n{n}.png" for kind in ("anytime", "boxes", "attainment") for n in (20, 25)} <= {
        path.name for path in out.iterdir()
    }
    runs = pd.read_csv(out / "runs.csv")
    assert len(runs[~runs.timing]) == 2 * 2 * 2
    assert "Hypervolume of the archive cut to N" in (out / "verdict.md").read_text()

    other = study(tmp_path, 'measures = ["ACC", "SWS", "DTL"]\n')
    assert_one_line(called("compare", "--problem", other, *TINY, "--out", "out"), "error: problem must be '")


@pytest.mark.parametrize("measures", ['["ACC", "SWS"]', '["comfort = ACC", "SWS", "DTL front", "DTL rear"]'])
def test_compare_takes_any_number_of_objectives(called, tmp_path, measures):
    path = study(tmp_path, f"measures = {measures}\n")
    sizes = ("--populations", 40, "--iterations", 1, "--repeats", 1, "--quality", "--seeds", 2)
    done = called("compare", "--problem", path, "--algorithms", "nsga2,random", *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "ACC is weighted with Wk" in done.stdout
    assert (tmp_path / "out" / "attainment_n40.png").exists()


@pytest.mark.parametrize(
    ("limit", "message"),
    [
        (0.001, "constraints must leave a feasible design, got none in any run"),
        (0.00696, "the best designs of all runs must differ in every objective, got 1 that do not"),
    ],
)
def test_limits_that_leave_no_front_are_one_line(called, tmp_path, limit, message):
    """With limits near the least travel that 20 designs have: none within them, and a single one."""
    path = study(tmp_path, f'measures = ["ACC", "SWS", "DTL"]\nconstraints = ["SWS <= {limit}"]\n')
    done = called("compare", "--problem", path, "--populations", 20, "--iterations", 2, "--repeats", 1)
    assert done.returncode == 2
    assert done.stderr.strip() == f"error: {message}"
    assert not done.stdout


def test_runs_without_a_feasible_design_are_counted(called, tmp_path):
    """Just above the least travel some runs find designs within the limits and some do not."""
    path = study(tmp_path, 'measures = ["ACC", "SWS", "DTL"]\nconstraints = ["SWS <= 0.0071"]\n')
    sizes = ("--populations", 20, "--iterations", 2, "--repeats", 1)
    done = called("compare", "--problem", path, *sizes, "--out", "out")
    assert done.returncode == 0, done.stderr
    empty = sum(pd.read_csv(path).empty for path in (tmp_path / "out" / "fronts").iterdir())
    assert 0 < empty < 3
    assert f"{empty} of 3 timed runs found no design within the limits." in done.stdout


def test_bode_of_a_half_car(called, tmp_path):
    """Spectra by python-control's closed model, natural frequencies by the vehicle's modes."""
    done = called(
        "bode", "--vehicle", "minaker_half", "--road", "C", "--speed", 15, "--band", "0.5,20",
        "--response", "pitch_acceleration", "--response", "rear_tyre_load", "--points", 50, "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert list(curves.columns) == [
        "design",
        "frequency [Hz]",
        "pitch_acceleration magnitude [rad/s^2/m]",
        "pitch_acceleration phase [deg]",
        "pitch_acceleration PSD [(rad/s^2)^2/Hz]",
        "weighted_pitch_acceleration PSD [(rad/s^2)^2/Hz]",
        "rear_tyre_load magnitude [N/m]",
        "rear_tyre_load phase [deg]",
        "rear_tyre_load PSD [(N)^2/Hz]",
    ]
    f = curves["frequency [Hz]"].to_numpy()
    np.testing.assert_allclose(f[[0, -1]], [0.5, 20.0], rtol=1e-12)
    file = load_vehicle("minaker_half")
    h = garage.from_roads(file.vehicle, file.setting, ["pitch_acceleration"], f)[:, 0]
    lag = np.exp(-2j * np.pi * f * (1.189 + 1.696) / 15)  # of the rear wheel on the same track
    met = np.abs(h[:, 0] + h[:, 1] * lag)
    density = Iso8608Road("C").psd(f, 15.0) * met**2
    np.testing.assert_allclose(curves["pitch_acceleration magnitude [rad/s^2/m]"], met, rtol=1e-8)
    np.testing.assert_allclose(curves["pitch_acceleration PSD [(rad/s^2)^2/Hz]"], density, rtol=1e-8)
    np.testing.assert_allclose(
        curves["weighted_pitch_acceleration PSD [(rad/s^2)^2/Hz]"],
        density * weightings.by_name("Wk").factor(f) ** 2,
        rtol=1e-8,
    )
    assert_natural(tmp_path / "out", file.vehicle.modes(file.setting))


def assert_natural(out, modes):
    natural = pd.read_csv(out / "natural_frequencies.csv")
    swinging = modes[modes["damping ratio [-]"] < 1]
    assert natural["mode"].tolist() == swinging["name"].tolist()
    np.testing.assert_allclose(natural["natural frequency [Hz]"], swinging["frequency [Hz]"], rtol=1e-12)


def test_bode_of_designs_of_six_variables(called, tmp_path):
    """Columns in any order, others beside them."""
    design = [9e3, 1500.0, 12e3, 1800.0, 1e4, 2e4]
    table = pd.DataFrame([[0.7, *design]], columns=["ACC [m/s^2]", *VARIABLES])
    table[table.columns[::-1]].to_csv(tmp_path / "designs.csv", index=False)
    done = called(
        "bode", "--vehicle", "jian_2022_full", "--designs", "designs.csv", "--points", 20, "--out", "out"
    )
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert set(curves.design) == {"9000, 1500, 12000, 1800, 10000, 20000"}
    problem, _ = chosen("jian_2022_full", None, None)
    assert column_headers(problem.variables, problem.units) == VARIABLES
    modes = load_vehicle("jian_2022_full").vehicle.modes(dict(zip(problem.variables, design, strict=True)))
    assert_natural(tmp_path / "out", modes)


def test_bode_on_a_measured_road_within_its_band(called, tmp_path):
    (tmp_path / "road.csv").write_text(MEASURED)
    command = ("bode", "--road", "road.csv", "--speed", 10, "--points", 20, "--out", "out")
    done = called(*command, "--band", "0.2,20")
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    f = curves["frequency [Hz]"].to_numpy()
    np.testing.assert_allclose(f[[0, 19]], [0.2, 20.0], rtol=1e-12)
    road = load_road(str(tmp_path / "road.csv")).psd(f, 10.0)
    np.testing.assert_allclose(
        curves["tyre_load PSD [(N)^2/Hz]"], road * curves["tyre_load magnitude [N/m]"] ** 2, rtol=1e-9
    )


@pytest.mark.parametrize(("band", "low"), [((0.01, 0.05), 0.01), ((0.0, 0.05), 0.005), ((0.0, 20.0), 0.1)])
def test_bode_draws_in_any_band(band, low):
    """Ascending, though a logarithmic axis does not begin at 0."""
    f = bode.frequencies(band, 20)
    assert (np.diff(f) > 0).all()
    np.testing.assert_allclose(f[[0, -1]], [low, band[1]], rtol=1e-12)


def test_optimum_of_another_vehicle(called, tmp_path):
    done = called(
        "optimum", "--vehicle", "jian_2022_full", "--road", "C", "--sws-limit", 0.01,
        "--population", 200, "--iterations", 5, "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "published" not in done.stdout
    table = pd.read_csv(tmp_path / "out" / "table5.csv").set_index(["weighting", "design"])
    assert len(table) == 3 * 5
    assert table.filter(like="published").isna().all(axis=None)
    for weighting in ("Wk", "Wb", "Wb-table"):
        part = table.loc[weighting]
        problem, struts = chosen("jian_2022_full", "C", None, weighting=weighting)
        own = part.loc["its own struts"]
        assert own[VARIABLES].tolist() == [struts[name] for name in problem.variables]
        found = part[["ACC [m/s^2]", "SWS [m]", "DTL [N]"]]
        np.testing.assert_allclose(found, problem.evaluate(part[VARIABLES].to_numpy(float)), rtol=1e-9)
        within = part.drop("its own struts")
        assert within["SWS [m]"].le(0.01 * (1 + 1e-6)).all()
        for header in ("ACC [m/s^2]", "DTL [N]"):
            least = part.loc[f"least {header.split()[0]} up to the limit", header]
            assert least <= within[header].min() * (1 + 1e-6)


BAD = [
    (["--vehicle", "car"], "vehicle must be one of cantero_2022_half, jian_2022_full, ", 2),
    (["--vehicle", ""], "vehicle must be one of cantero_2022_half, jian_2022_full, ", 2),
    (["--vehicle", "cantero_2022_half"], "vehicle must be a file with bounds, got 'cantero_2022_half'", 2),
    (["--vehicle", "no.toml"], "No such file or directory: 'no.toml'", 1),
    (["--vehicle", "bad.toml"], "bad.toml: kind must be one of quarter-car, half-car, full-car, got 'sledge'", 2),
    (["--road", "c"], "road must be a class of ISO 8608 such as C, C-lower or C-upper, or the path of a ", 2),
    (["--road", ""], "road must be a class of ISO 8608 such as C, C-lower or C-upper, or the path of a ", 2),
    (["--road", "Z"], "road_class must be one of A, B, C, D, E, F, G, H, got 'Z'", 2),
    (["--road", "no.csv"], "No such file or directory: 'no.csv'", 1),
    (["--road", "bad.csv"], "bad.csv: ", 2),
    (["--road", "road.csv"], "f must lie from 0.4 to 40 Hz at 20 m/s, as the road is known from ", 2),
    (["--speed", "0"], "speed must be finite and > 0 m/s, got 0.0", 2),
    (["--speed", "nan"], "speed must be finite and > 0 m/s, got nan", 2),
    (["--speed", "fast"], "Invalid value for '--speed': must be a number, got 'fast'", 2),
]
OF_BODE = [
    (["--band", "20"], "band must be 2 numbers separated by commas, got '20'", 2),
    (["--band", "20,1"], "band must be finite with 0 <= lower < upper [Hz], got (20.0, 1.0)", 2),
    (["--band", "0.5,inf"], "band must be finite with 0 <= lower < upper [Hz], got (0.5, inf)", 2),
    (["--response", "pitch_acceleration"], "response must be one of body_acceleration, suspension_travel, ", 2),
    (["--vehicle", "minaker_half", "--design", "1,2"], "design must be 4 numbers separated by commas, got", 2),
    (["--vehicle", "minaker_half", "--designs", "road.csv"], "in the columns front.spring [N/m], front.", 2),
]
OF_COMPARE = [
    (["--problem", "no.toml"], "No such file or directory: 'no.toml'", 1),
    (["--problem", "bad.toml"], "bad.toml: kind must be one of the keys title, measures, ", 2),
    (["--problem", "x.toml", "--speed", "3"], "problem must stand without weighting, vehicle, ", 2),
    (["--problem", "x.toml", "--weighting", ""], "problem must stand without weighting, vehicle, ", 2),
    (["--weighting", ""], "weighting must be one of Wk, ", 2),
]
OF_OPTIMUM = [
    (["--vehicle", "minaker_half", "--sws-limit", "1e-4", "--population", "20", "--iterations", "1"],
     "sws_limit must be a travel that a design within the bounds has, got 0.0001 m", 2),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "arguments", "message", "status"),
    [(name, *one) for name in ("compare", "bode", "optimum") for one in BAD]
    + [("bode", *one) for one in OF_BODE]
    + [("compare", *one) for one in OF_COMPARE]
    + [("optimum", *one) for one in OF_OPTIMUM],
)
def test_bad_input_is_one_line(called, tmp_path, name, arguments, message, status):
    """Status 2; of files that cannot be read, 1."""
    (tmp_path / "road.csv").write_text(MEASURED)
    (tmp_path / "bad.csv").write_text("a,b\n1,2\n")
    (tmp_path / "bad.toml").write_text('kind = "sledge"')
    before = set(tmp_path.iterdir())
    assert_one_line(called(name, *arguments), message, status)
    assert set(tmp_path.iterdir()) == before


def test_a_script_itself_ends_so(script, tmp_path):
    """As a process of its own, for what the others see from inside."""
    path = study(tmp_path, 'measures = ["ACC", "SWS"]\nconstraints = ["SWS"]\n')
    assert_one_line(script("compare", "--problem", path), "study.toml: constraints[1]: constraint must be like")
