import numpy as np
import pandas as pd
import pytest


def test_compares_with_samples_by_number_of_variables(script, tmp_path):
    out = tmp_path / "results"
    sizes = ("--population", "20", "--evaluations", "120", "--seeds", "2")
    done = script("variables", "--variables", "2,3", *sizes, "--out", out)
    assert done.returncode == 0, done.stderr
    runs = pd.read_csv(out / "runs.csv")
    assert set(runs.problem) == {"zdt1-2", "zdt1-3", "dtlz2-3"}
    medians = pd.read_csv(out / "medians.csv", index_col="problem")
    assert list(medians.columns) == ["nsga2", "moead-dra", "random", "sobol"]
    one = runs[(runs.problem == "dtlz2-3") & (runs.algorithm == "sobol") & (runs.set == "population")]
    assert medians.sobol["dtlz2-3"] == np.median(one.relative_hypervolume)
    assert len(pd.read_csv(out / "differences.csv")) == 3 * 6
    assert done.stdout.splitlines()[-1] == str(out)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--seeds", "0"], "seeds must be a whole number >= 1, got 0"),
        (["--variables", "two"], "variables must be whole numbers separated by commas, got 'two'"),
        (["--variables", "1"], "variables must be >= 2 and <= 30, got '1'"),
        (["--evaluations", "10"], "evaluations must be >= 1000, a start and an iteration, got 10"),
    ],
)
def test_bad_input_is_one_line_and_status_2(script, tmp_path, arguments, message):
    done = script("variables", *arguments, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"error: {message}\n"
    assert list(tmp_path.iterdir()) == []
