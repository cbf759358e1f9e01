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
    for title in ("Table 2: nsga2", "Table 3: moead-dra", "Table 4: the ratio", "Quality of the final pop"):
        assert title in done.stdout
    assert "ACC is weighted with Wb" in done.stdout
    assert "MOEA/D-DRA has not allocated resources yet" in done.stdout
    assert done.stdout.splitlines()[-1] == str(out)


def test_writes_everything(quick):
    out, _ = quick
    names = {path.name for path in out.glob("[!.]*")}
    tables = {f"{n}{e}" for n in ("table2", "table3", "table4", "hypervolume") for e in (".csv", ".md", ".tex")}
    others = ("", "_moead-dra", "_moead-dra-raw")  # the first algorithm beside each of the others
    pictures = {f"figure5{other}.{ending}" for other in others for ending in ("png", "pdf")}
    files = {"runs.csv", "reference.csv", "environment.json", "study.toml", "report.html"}
    assert names == tables | pictures | files | {"reference", "fronts", "timed"}
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


def test_same_seed_same_results_but_for_the_times(quick, called, tmp_path):
    out, _ = quick
    again = called("compare", "--quick", "--seed", 5, "--weighting", "Wb", "--out", tmp_path / "again")
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


def test_default_folder_is_new_and_below_results(called, tmp_path):
    done = called("compare", "--quick", "--algorithms", "nsga2")
    assert done.returncode == 0, done.stderr
    folder = tmp_path / done.stdout.splitlines()[-1]
    assert folder.parent == tmp_path / "results"
    assert np.isnan(pd.read_csv(folder / "table2.csv").published_seconds).all()
