"""Table 5, and candidates of other vehicles: files, values by other roads, words."""

import re

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import load_road, load_vehicle, ride, save_system

FILES = {
    *("candidates.csv", "candidates.md", "front.csv", "front.png", "front.pdf", "changes.png", "changes.pdf"),
    *("study.toml", "report.html", "candidates", "attained.csv", "attainable.csv"),
}  # fmt: skip
QUICK = ("--population", 60, "--iterations", 5)
OBJECTIVES = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]

KNEE = """
kind = "quarter-car"
body_mass_kg = 317.5
wheel_mass_kg = 45.4
tyre_stiffness_N_per_m = 192e3

[strut]
layout = "spring | damper"
damper.kind = "digressive-damper"

[struts]
spring_N_per_m = 22e3
damper.low_speed_N_s_per_m = 3000
damper.high_speed_N_s_per_m = 1000
damper.knee_m_per_s = 0.1
damper.rebound_over_bump = 1.5

[bounds]
spring_N_per_m = [15e3, 30e3]
damper.knee_m_per_s = [0.05, 0.2]
damper.rebound_over_bump = [1, 2]
"""


def test_optimum_makes_table_5(script, tmp_path):
    done = script("optimum", "--band", "0.1,20", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "out" / "table5.csv").set_index(["weighting", "design"])
    assert len(table) == 3 * 6
    for design in ("reference car", "published optimum"):
        row = table.loc[("Wb-table", design)]
        assert abs(row["ACC off [%]"]) < 0.1
        assert abs(row["DTL off [%]"]) < 0.1
        assert round(row["SWS [m]"], 4) == 0.0287
    exact = table.loc[("Wb-table", "exact, least ACC")]
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES | {"table5.csv"}
    assert exact["SWS [m]"] == pytest.approx(0.0287, rel=1e-9)
    assert exact["ACC [m/s^2]"] <= table.loc[("Wb-table", "published optimum"), "ACC [m/s^2]"] + 1e-3


@pytest.mark.drawn
def test_candidates_of_another_vehicle(called, tmp_path):
    done = called(
        "optimum", "--vehicle", "jian_2022_full", "--road", "C", "--sws-limit", "10mm", "--band", "0.1,20",
        "--weighting", "Wb", *QUICK, "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "ublished" not in done.stdout
    assert "Table" not in done.stdout
    folder, file = tmp_path / "out", load_vehicle("jian_2022_full")
    assert {path.name for path in folder.iterdir()} == FILES
    table = pd.read_csv(folder / "candidates.csv", index_col="candidate")
    assert 6 <= len(table) <= 9
    assert (table["SWS [m]"][1:] <= 0.01 * (1 + 1e-6)).all()
    names = [f"{name} [{file.vehicle.variables[name].unit}]" for name in file.bounds]
    for number in (0, 3):
        setting = dict(zip(file.bounds, table.loc[number, names], strict=True))
        road = load_road("C")
        expected = ride(file.vehicle, setting, road, 20.0, band=(0.1, 20.0), weighting="Wb").value[
            ["ACC", "SWS", "DTL"]
        ]
        np.testing.assert_allclose(table.loc[number, OBJECTIVES].tolist(), expected, rtol=1e-6)
    assert table.loc[0, names].tolist() == [file.vehicle.coefficients(file.setting)[name] for name in file.bounds]
    knee = load_vehicle(next((folder / "candidates").glob("3_*.toml")))
    assert [knee.setting[name] for name in file.bounds] == table.loc[3, names].tolist()
    front = pd.read_csv(folder / "front.csv")
    assert (front["SWS [m]"] <= 0.01 * (1 + 1e-6)).all()
    shares = pd.read_csv(folder / "attained.csv", index_col="suspension")
    own = table.loc[0, OBJECTIVES].tolist()
    np.testing.assert_allclose(shares.loc["present design", OBJECTIVES], own, rtol=1e-9)
    assert f"The passive optimum takes {shares['share [%]']['passive optimum']:.0f} % of" in done.stdout
    active = pd.read_csv(folder / "attainable.csv")
    assert set(active.controller) == {"LQR", "skyhook"}
    page = (folder / "candidates.md").read_text(encoding="utf-8")
    for text in (
        "20 m/s",
        "class C",
        "0.1 to 20 Hz",
        "Wb",
        "Present design: front.spring 10 kN/m",
        "SWS <= 10 mm cuts",
    ):
        assert text in " ".join(done.stdout.split())
        assert text.replace("<", "&lt;") in page


def test_candidates_of_force_laws(called, tmp_path):
    """Coefficients in m/s and without a unit stand in the tables as well; no limit is set."""
    (tmp_path / "car.toml").write_text(KNEE)
    done = called("optimum", "--vehicle", "car.toml", "--road", "D", "--speed", 15, *QUICK, "--out", "out")
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "out" / "candidates.csv")
    assert {"damper.knee [m/s]", "damper.rebound_over_bump", "heave damping [-]"} <= set(table.columns)
    assert "No limit is set. The front has ACC from" in done.stdout
    assert "The passive optimum takes" in done.stdout
    assert "skyhook" not in done.stdout  # which takes springs and dampers alone


def test_candidates_of_a_plant_of_another_program_are_those_of_its_quarter_car(called, tmp_path):
    save_system(tmp_path / "car.npz", load_vehicle("yuen_ramli_2010").vehicle.plant())
    (tmp_path / "car.toml").write_text(
        'kind = "plant"\nfile = "car.npz"\n[struts]\nspring_N_per_m = 22e3\ndamper_N_s_per_m = 1500\n'
        "[bounds]\nspring_N_per_m = [15e3, 30e3]\ndamper_N_s_per_m = [1000, 4000]\n"
    )
    done = called("optimum", "--vehicle", "car.toml", "--road", "C", *QUICK, "--sws-limit", 0.03, "--out", "out")
    assert done.returncode == 0, done.stderr
    assert "Modes" not in done.stdout
    table = pd.read_csv(tmp_path / "out" / "candidates.csv")
    struts = table[["spring [N/m]", "damper [N s/m]"]]
    assert struts.iloc[0].tolist() == [22e3, 1500.0]
    car = load_vehicle("yuen_ramli_2010").vehicle
    for i in (0, 2):
        expected = ride(car, struts.iloc[i].tolist(), load_road("C"), 20.0).value[["ACC", "SWS", "DTL"]]
        np.testing.assert_allclose(table.loc[i, OBJECTIVES].tolist(), expected, rtol=1e-6)


def test_a_study_with_scatter_has_its_candidates_over_it(called, tmp_path):
    text = """
vehicle = "yuen_ramli_2010"
road = "C"
speed_m_per_s = 20.0
band_Hz = [0.3, 20.0]
measures = ["mean ACC", "q95 DTL"]
constraints = ["q95 SWS <= 12mm"]
[scatter]
damper = [-0.25, 0.1]
samples = 16
[search]
populations = [12]
iterations = [2]
"""
    (tmp_path / "robust.toml").write_text(text)
    done = called("optimum", "--study", "robust.toml", "--out", "out")
    assert done.returncode == 0, done.stderr
    shown = done.stdout
    assert "Over a scatter of damper -25 to +10 %, 16 samples, seed 1\n" in shown
    assert "What changes each measure most, by 1 % more\n" in shown
    assert "Scatter: damper -25 to 10 %; 16 samples, seed 1." in shown
    assert any(re.search(r"damper [+-]\d", line) for line in shown.splitlines())
    page = (tmp_path / "out" / "candidates.md").read_text(encoding="utf-8")
    assert "## Over a scatter of damper -25 to +10 %" in page
    assert "beyond SWS" in page
