import json
import struct

import numpy as np
import pandas as pd
import pytest


@pytest.fixture(scope="module")
def quick(script, tmp_path_factory):
    """The main job in its short form, with every algorithm, run once."""
    out = tmp_path_factory.mktemp("compare") / "results"
    algorithms = "nsga2,nsga2-standard-sort,moead-dra,moead-dra-raw"
    done = script("compare", "--quick", "--algorithms", algorithms, "--weighting", "Wb", "--seed", 5, "--out", out)
    assert done.returncode == 0, done.stderr
    return out, done


def test_prints_tables_and_last_the_folder(quick):
    out, done = quick
    for title in ("Table 2: nsga2", "Table 3: moead-dra", "Table 4:"):
        assert title in done.stdout
    assert "ACC is weighted with Wb" in done.stdout
    assert "MOEA/D-DRA has not allocated resources yet" in done.stdout
    assert done.stdout.splitlines()[-1] == str(out)


def test_writes_everything(quick):
    out, _ = quick
    names = {path.name for path in out.iterdir()}
    tables = {f"table{n}{ending}" for n in (2, 3, 4) for ending in (".csv", ".md", ".tex")}
    others = ("", "_moead-dra", "_moead-dra-raw")  # the first algorithm beside each of the others
    pictures = {f"figure5{other}.{ending}" for other in others for ending in ("png", "pdf")}
    assert names == tables | pictures | {"runs.csv", "environment.json", "reference.npz", "fronts", "timed"}
    runs = pd.read_csv(out / "runs.csv")
    assert runs.timing.all()
    assert len(list((out / "fronts").iterdir())) == len(runs) == 2 * 2 * 2 * (4 + 2)
    record = json.loads((out / "environment.json").read_text())
    assert record["arguments"]["seed"] == 5
    assert record["arguments"]["populations"] == "60,100"
    assert record["threads"]["numba"] == 1
    assert all(pool["num_threads"] == 1 for pool in record["threads"]["pools"])


def test_identical_runs_by_both_selections(quick):
    """The same seed gives the same fronts by our selection and by DEAP's, which only takes longer."""
    out, _ = quick
    ours = pd.read_csv(out / "fronts" / "nsga2_n100_i10_r2.csv")
    deaps = pd.read_csv(out / "fronts" / "nsga2-standard-sort_n100_i10_r2.csv")
    pd.testing.assert_frame_equal(ours, deaps)
    runs = pd.read_csv(out / "runs.csv").groupby("algorithm").seconds.sum()
    assert runs["nsga2"] < runs["nsga2-standard-sort"]


def test_figure_is_a_picture_of_its_size(quick):
    out, _ = quick
    head = (out / "figure5.png").read_bytes()[:24]
    assert head.startswith(b"\x89PNG")
    assert min(struct.unpack(">II", head[16:24])) > 1000
    assert (out / "figure5.pdf").read_bytes().startswith(b"%PDF")


def test_same_seed_same_results_but_for_the_times(quick, script, tmp_path):
    out, _ = quick
    again = script("compare", "--quick", "--seed", 5, "--weighting", "Wb", "--out", tmp_path / "again")
    assert again.returncode == 0, again.stderr
    quality = [
        "algorithm",
        "population",
        "iterations",
        "budget",
        "repeat",
        "evaluations",
        "hypervolume",
        "igd_plus",
    ]
    first, second = (pd.read_csv(folder / "runs.csv")[quality] for folder in (out, tmp_path / "again"))
    shared = first.merge(second, on=quality)
    assert len(shared) == len(second)


def test_default_folder_is_new_and_below_results(script, tmp_path):
    done = script("compare", "--quick", "--algorithms", "nsga2", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    folder = tmp_path / done.stdout.splitlines()[-1]
    assert folder.parent == tmp_path / "results"
    assert np.isnan(pd.read_csv(folder / "table2.csv").published_seconds).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--populations", "3"], "population must be a whole number >= 4, got 3"),
        (["--populations", "12"], "population must be >= 15 for 3 objectives"),
        (["--populations", "500,x"], "populations must be whole numbers separated by commas, got '500,x'"),
        (["--iterations", "0"], "iterations must be a whole number >= 1, got 0"),
        (["--quick", "--repeats", "3"], "quick must stand without populations, iterations, repeats and seeds"),
        (["--repeats", "0"], "repeats must be a whole number >= 1, got 0"),
        (["--repeats", "two"], "Invalid value for '--repeats': must be a whole number, got 'two'"),
        (["--algorithms", "nsga3"], "algorithms must be one of nsga2, "),
        (["--weighting", "Wz"], "weighting must be one of Wk, "),
        (["--seed", "-1"], "seed must be a whole number >= 0, got -1"),
        (["--fast", "3"], "--fast"),
        (["--jobs", "2"], "jobs and scheduler must stand with quality, got 2 without it"),
        (["--quality", "--jobs", "0"], "jobs must be a whole number >= 1, got 0"),
        (["--quality", "--jobs", "2", "--scheduler", "tcp://h:1"], "jobs must stand without scheduler, got 2 and"),
        (
            ["--quality", "--scheduler", "host:8786"],
            "scheduler must be tcp://host:port or tls://host:port, got",
        ),
        (["--quality", "--seeds", "0"], "seeds must be a whole number >= 1, got 0"),
        (["--quality", "--target", "1.5"], "target must be a number from 0 to 1, got 1.5"),
        (["--quick", "--seeds", "5"], "quick must stand without populations, iterations, repeats and seeds"),
        (["--out", "/proc/results"], "out must be a folder that can be written, got '/proc/results'"),
        (["--out", "."], "out must be a folder that is absent or empty, got '.', which is not empty"),
    ],
)
def test_bad_input_is_one_line_and_status_2(script, tmp_path, arguments, message):
    (tmp_path / "mine.txt").write_text("kept")
    done = script("compare", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("error: ")
    assert message in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
