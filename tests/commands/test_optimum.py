"""Table 5, and the best struts of another vehicle."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import load_vehicle, save_system
from suspension_ctrl.commands.studies import chosen_study

VARIABLES = [
    "front.spring [N/m]", "front.damper [N s/m]", "rear.spring [N/m]", "rear.damper [N s/m]",
    "front_antiroll [N m/rad]", "rear_antiroll [N m/rad]",
]  # fmt: skip

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
    assert exact["SWS [m]"] == pytest.approx(0.0287, rel=1e-9)
    assert exact["ACC [m/s^2]"] <= table.loc[("Wb-table", "published optimum"), "ACC [m/s^2]"] + 1e-3


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
        study = chosen_study(vehicle="jian_2022_full", road="C", weighting=weighting)
        problem = study.problem
        own = part.loc["its own struts"]
        assert own[VARIABLES].tolist() == list(study.present.values())
        found = part[["ACC [m/s^2]", "SWS [m]", "DTL [N]"]]
        np.testing.assert_allclose(found, problem.evaluate(part[VARIABLES].to_numpy(float)), rtol=1e-9)
        within = part.drop("its own struts")
        assert within["SWS [m]"].le(0.01 * (1 + 1e-6)).all()
        for header in ("ACC [m/s^2]", "DTL [N]"):
            least = part.loc[f"least {header.split()[0]} up to the limit", header]
            assert least <= within[header].min() * (1 + 1e-6)


def test_optimum_of_force_laws(called, tmp_path):
    """Coefficients in m/s and without a unit stand in the table as well."""
    (tmp_path / "car.toml").write_text(KNEE)
    quick = ["--iterations", "1", "--population", "20", "--sws-limit", "0.03", "--out", tmp_path / "out"]
    done = called("optimum", "--vehicle", tmp_path / "car.toml", "--road", "D", "--speed", "15", *quick)
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "out" / "table5.csv")
    assert {"damper.knee [m/s]", "damper.rebound_over_bump"} <= set(table.columns)


def test_optimum_of_a_plant_of_another_program_is_on_its_quarter_car(called, tmp_path):
    save_system(tmp_path / "car.npz", load_vehicle("yuen_ramli_2010").vehicle.plant())
    (tmp_path / "car.toml").write_text(
        'kind = "plant"\nfile = "car.npz"\n[struts]\nspring_N_per_m = 22e3\ndamper_N_s_per_m = 1500\n'
        "[bounds]\nspring_N_per_m = [15e3, 30e3]\ndamper_N_s_per_m = [1000, 4000]\n"
    )
    quick = ("--road", "C", "--iterations", 1, "--population", 20, "--sws-limit", 0.03, "--out", "out")
    done = called("optimum", "--vehicle", "car.toml", *quick)
    assert done.returncode == 0, done.stderr
    assert "published" not in done.stdout
    table = pd.read_csv(tmp_path / "out" / "table5.csv").set_index(["weighting", "design"])
    part = table.loc["Wb"]
    struts = part[["spring [N/m]", "damper [N s/m]"]]
    assert struts.loc["its own struts"].tolist() == [22e3, 1500.0]
    problem = chosen_study(vehicle="yuen_ramli_2010", road="C", weighting="Wb").problem
    found = part[["ACC [m/s^2]", "SWS [m]", "DTL [N]"]]
    np.testing.assert_allclose(found, problem.evaluate(struts.to_numpy(float)), rtol=1e-9)
