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
        (["--designs", "bad.csv"], "in the columns spring [N/m], damper [N s/m], got 'bad.csv': "),
        (["--designs", "text.csv"], "could not convert string to float: 'soft'"),
        (["--designs", "header.csv"], "got 'header.csv' without a row"),
        (["--designs", "empty.csv"], "designs must be a CSV file with numbers"),
        (["--designs", "binary.csv"], "designs must be a CSV file with numbers"),
        (["--designs", "absent.csv"], "got 'absent.csv': No such file or directory"),
        (["--designs", "."], "designs must be a CSV file with numbers"),
        (["--designs", "nan.csv"], "damper must be finite and > 0 N s/m, got nan"),
        (["--points", "1"], "points must be a whole number >= 2, got 1"),
        (["--weighting", "Wz"], "weighting must be one of Wk, "),
    ],
)
def test_bode_names_bad_input(script, tmp_path, arguments, message):
    header = "spring [N/m],damper [N s/m]\n"
    (tmp_path / "bad.csv").write_text("spring,damper\n1,2\n")
    (tmp_path / "text.csv").write_text(header + "22000,soft\n")
    (tmp_path / "nan.csv").write_text(header + "22000,\n")
    (tmp_path / "header.csv").write_text(header)
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "binary.csv").write_bytes(bytes(range(256)))
    before = set(tmp_path.iterdir())
    assert_one_line(script("bode", *arguments, cwd=tmp_path), message)
    assert set(tmp_path.iterdir()) == before


def assert_one_line(done, message):
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert message in done.stderr


def test_weighting_names_bad_input(script, tmp_path):
    (tmp_path / "mine.txt").write_text("kept")
    assert_one_line(script("weighting", "--out", tmp_path), "out must be a folder that is absent or empty")


def test_bode_draws_many_designs_and_frequencies_beyond_the_band(script, tmp_path):
    """Without a legend, which would cover the curves, and without marks where there is no curve."""
    table = tmp_path / "designs.csv"
    rows = "".join(f"{k},{c}\n" for k in range(2000, 32000, 2000) for c in (500, 1500))
    table.write_text("spring [N/m],damper [N s/m]\n" + rows + "1e6,100\n1e6,100.0001\n")
    done = script("bode", "--designs", table, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(tmp_path / "out" / "curves.csv").design.nunique() == 32


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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--sws-limit", "0"], "sws_limit must be finite and > 0 m, got 0.0"),
        (["--sws-limit", "1"], "sws_limit must be a travel that a design within the bounds has"),
        (["--band", "30,20"], "band must be finite with 0 <= lower < upper [Hz], got (30.0, 20.0)"),
        (["--sws-limit", "0.0449", "--population", "20"], "within 0.2 % of which the Pareto set has a design"),
        (["--out", "/proc/results"], "out must be a folder that can be written, got '/proc/results'"),
        (["--population", "3"], "population must be a whole number >= 4, got 3"),
        (["--iterations", "0"], "iterations must be a whole number >= 1, got 0"),
        (["--seed", "-1"], "seed must be a whole number >= 0, got -1"),
        (["--sws-limit", "soft"], "must be a number, got 'soft'"),
    ],
)
def test_optimum_names_bad_input(script, tmp_path, arguments, message):
    assert_one_line(script("optimum", *arguments, cwd=tmp_path), message)
    assert list(tmp_path.iterdir()) == []
