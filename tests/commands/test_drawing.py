"""Figures by another process: the same files, and the errors and warnings of this process."""

import pandas as pd
import pytest

from suspension_ctrl import tables
from suspension_ctrl.commands import drawing
from suspension_ctrl.study.figures import final_populations

COLUMNS = ("SWS [m]", ["ACC [m/s^2]"])


def populations(algorithm: str = "nsga2") -> pd.DataFrame:
    row = {"algorithm": algorithm, "population": 2, "iterations": 1, "SWS [m]": 0.01, "ACC [m/s^2]": 1.0}
    return pd.DataFrame([row, row | {"SWS [m]": 0.02}])


@pytest.fixture(scope="module")
def process():
    """Another process that draws: it takes a second to start."""
    found = drawing.started()
    yield found
    found.kill()
    found.communicate()


@pytest.fixture(scope="module")
def figures(process):
    return drawing.Drawing(process)


def test_figures_of_another_process_are_those_of_this_one(figures, tmp_path, monkeypatch):
    figures.get_ready()
    write = tables.write_figure
    with monkeypatch.context() as patch:
        patch.setattr(tables, "write_figure", None)  # none is written here
        for name in ("a", "b"):
            figures.begin(tmp_path / name, final_populations, populations(name), *COLUMNS)
        figures.settle()
    write(tmp_path / "here", final_populations(populations("a"), *COLUMNS))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "here.png").read_bytes()
    assert (tmp_path / "a.png").read_bytes() != (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


def test_a_figure_that_cannot_be_drawn_raises_its_own_error_and_the_next_is_drawn(figures, tmp_path):
    three = pd.concat(map(populations, "abc"))
    figures.begin(tmp_path / "three", final_populations, three, *COLUMNS)
    with pytest.raises(ValueError, match=r"^populations must be of one or two algorithms, got \['a', 'b', 'c'\]$"):
        figures.settle()
    figures.begin(tmp_path / "none" / "a", final_populations, populations(), *COLUMNS)
    with pytest.raises(FileNotFoundError, match=r"none.a\.png"):
        figures.settle()
    figures.begin(tmp_path / "one", final_populations, populations(), *COLUMNS)
    figures.settle()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.pdf", "one.png"]


def test_a_warning_is_given_here(figures, tmp_path):
    figures.begin(tmp_path / "glyph", final_populations, populations("\U00013000"), *COLUMNS)
    with pytest.warns(UserWarning, match="Glyph"):
        figures.settle()


@pytest.mark.parametrize("begun", [False, True])
def test_without_the_process_figures_are_drawn_here(process, figures, begun, tmp_path):
    if begun:
        figures.begin(tmp_path / "a", final_populations, populations(), *COLUMNS)
    process.kill()
    process.wait()
    if not begun:
        figures.begin(tmp_path / "a", final_populations, populations(), *COLUMNS)
    figures.settle()
    assert (tmp_path / "a.pdf").exists()
    drawing.Drawing().settle()


def test_the_process_ends_with_the_command_and_is_not_started_on_one_processor(monkeypatch):
    monkeypatch.setattr(drawing.threads, "number", lambda _given: 2)
    made = []
    start = drawing.started
    monkeypatch.setattr(drawing, "started", lambda: made.append(start()) or made[0])
    with drawing.beside():
        assert made[0].poll() is None
    assert made[0].poll() is not None
    monkeypatch.setattr(drawing.threads, "number", lambda _given: 1)
    with drawing.beside():
        assert len(made) == 1
