"""Figure 2."""

import pandas as pd
import pytest


def test_weighting_draws_figure_2(script, tmp_path):
    done = script("weighting", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"figure2.png", "figure2.pdf", "figure2.csv"}
    factors = pd.read_csv(tmp_path / "out" / "figure2.csv").set_index("frequency [Hz]")
    assert factors.loc[1.0, "Wk [-]"] == pytest.approx(0.4825, abs=5e-5)
