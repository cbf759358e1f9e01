"""Tables and fronts of timed runs, from what the runs have stored."""

import numpy as np
import pandas as pd

SIZES = ("--populations", 20, "--iterations", "2,3", "--repeats", 2, "--vehicle", "minaker_half", "--out", "out")


def test_tables_and_fronts_are_those_of_the_stored_runs(called, tmp_path):
    done = called("compare", *SIZES)
    assert done.returncode == 0, done.stderr
    out = tmp_path / "out"
    runs = pd.read_csv(out / "runs.csv")
    table = pd.read_csv(out / "times.csv").set_index(["iterations", "algorithm", "equal"])
    seconds = runs.groupby(["iterations", "algorithm", "budget"]).seconds.mean()
    key = (2, "moead-dra", "iterations")
    assert np.isclose(table.loc[key, "time [s]"], seconds[key], rtol=1e-12)
    ratio = 100 * seconds[(2, "nsga2", "iterations")] / seconds[key]
    assert np.isclose(table.loc[key, "ratio of times [%]"], ratio, rtol=1e-12)
    headers = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    for path in (out / "fronts").iterdir():
        front = pd.read_csv(path)[headers].to_numpy()
        final = pd.read_csv(out / "timed" / "final" / path.name)[headers].to_numpy()
        dominated = [((final <= x).all(axis=1) & (final < x).any(axis=1)).any() for x in final]
        np.testing.assert_array_equal(front, final[~np.array(dominated)])
