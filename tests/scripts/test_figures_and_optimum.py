import numpy as np
import pandas as pd
import pytest


def test_weighting_draws_figure_2(script, tmp_path):
    done = script("weighting", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"figure2.png", "figure2.pdf", "figure2.csv"}
    factors = pd.read_csv(tmp_path / "out" / "figure2.csv").set_index("frequency [Hz]")
    assert factors.loc[1.0, "Wk [-]"] == pytest.approx(0.4825, abs=5e-5)


def test_bode_draws_the_papers_two_cars(script, tmp_path):
    done = script("bode", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    names = {path.name for path in (tmp_path / "out").iterdir()}
    figures = {"figure6.png", "figure6.pdf", "figure7.png", "figure7.pdf"}
    assert names == figures | {"curves.csv", "natural_frequencies.csv"}
    natural = pd.read_csv(tmp_path / "out" / "natural_frequencies.csv")["natural frequency [Hz]"]
    # Damping moves the poles but not the product of their moduli, det(M^-1 K)^(1/2) = (k k_t / (m_b m_w))^(1/2).
    product = (22e3 * 192e3 / (317.5 * 45.4)) ** 0.5 / (2 * np.pi) ** 2
    assert natural[0] * natural[1] == pytest.approx(product, rel=1e-9)
    assert natural[2] < natural[0]  # the published optimum is softer


def test_bode_draws_any_designs(script, tmp_path):
    """Two from the command line, three from a file as compare.py writes it; the last one overdamped."""
    table = tmp_path / "designs.csv"
    table.write_text("spring [N/m],damper [N s/m],ACC [m/s^2]\n5000,1000,0\n10000,1500,0\n2000,5000,0\n")
    done = script(
        "bode", "--design", "22000,1500", "--design", "8000,2500", "--designs", table, "--out", tmp_path / "out"
    )
    assert done.returncode == 0, done.stderr
    curves = pd.read_csv(tmp_path / "out" / "curves.csv")
    assert curves.design.nunique() == 5
    assert {"suspension_travel magnitude [m/m]", "tyre_load phase [deg]"} <= set(curves.columns)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--design", "22000"], "design must be 2 numbers separated by commas, got '22000'"),
        (["--design", "22000,-1"], "damper must be finite and > 0 N s/m, got -1.0"),
        (
            ["--designs", "bad.csv"],
            "designs must have the columns spring [N/m], damper [N s/m], got bad.csv without",
        ),
        (["--points", "1"], "points must be a whole number >= 2, got 1"),
        (["--weighting", "Wz"], "weighting must be one of Wk, "),
    ],
)
def test_bode_names_bad_input(script, tmp_path, arguments, message):
    (tmp_path / "bad.csv").write_text("spring,damper\n1,2\n")
    done = script("bode", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert message in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["bad.csv"]


def test_bode_reports_a_missing_file_in_one_line(script, tmp_path):
    done = script("bode", "--designs", "absent.csv", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "absent.csv" in done.stderr


def test_optimum_makes_table_5(script, tmp_path):
    done = script("optimum", "--low-frequency", "0.1", "--out", tmp_path / "out")
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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--sws-limit", "0"], "sws_limit must be finite and > 0 m, got 0.0"),
        (["--sws-limit", "1"], "sws_limit must be a travel that a design within the bounds has"),
        (["--low-frequency", "30"], "band must be finite with 0 <= lower < upper [Hz], got (30.0, 20.0)"),
        (["--population", "3"], "population must be a whole number >= 4, got 3"),
    ],
)
def test_optimum_names_bad_input(script, tmp_path, arguments, message):
    done = script("optimum", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert message in done.stderr
