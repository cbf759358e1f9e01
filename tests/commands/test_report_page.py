"""`suspension-ctrl report`: the page of a study and the study in a folder."""


def test_report_writes_the_page_and_the_study(called, tmp_path):
    done = called("report", "--study", "paper", "--population", 40, "--iterations", 3, "--out", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["report.html", "study.toml"]
    assert "<h1>Yuen and Ramli 2010</h1>" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert done.stdout.splitlines()[-1].endswith("out")


def test_report_refuses_a_folder_that_is_not_empty(refused, tmp_path):
    (tmp_path / "own.txt").touch()
    refused("report", ["--study", "paper", "--out", "."], "out must be a folder that is absent or empty", 2)
