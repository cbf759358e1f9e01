"""Two checkouts timed in turn, of which one sleeps and the other one works."""

import pandas as pd
import pytest

import beside


@pytest.fixture
def checkouts(tmp_path, monkeypatch):
    """Return two folders; both scripts note their turn and the folder of kept fronts in a file."""
    note = "import os, time; print({!r}, os.environ[{!r}], file=open({!r}, 'a'))\n"
    works = "end = time.process_time() + 0.2\nwhile time.process_time() < end: pass"
    for name, does in (("here", "time.sleep(0.2)"), ("there", works)):
        (tmp_path / name / "scripts").mkdir(parents=True)
        text = note.format(name, beside.KEPT, str(tmp_path / "log")) + does
        (tmp_path / name / "scripts" / "compare.py").write_text(text)
    monkeypatch.setattr(beside, "HERE", tmp_path / "here")
    return tmp_path


def test_sides_take_turns_with_what_was_kept_and_with_nothing(checkouts):
    runs = pd.DataFrame(list(beside.in_turn(checkouts / "there", [], 1)))
    turns = [line.split(maxsplit=1) for line in (checkouts / "log").read_text().splitlines()]
    assert [name for name, _ in turns] == ["here", "there"] * 3
    kept = [folder for _, folder in turns]
    assert len(set(kept[:4])) == 1
    assert len({*kept[3:]}) == 3
    assert (runs["wall-clock [s]"] >= 0.2).all()
    used = runs.groupby("side")["processor [s]"].min()
    assert used["other"] - used["this"] == pytest.approx(0.2, abs=0.15)  # 0.2 s of work, not asleep


def test_ratios_are_of_medians():
    rows = [("this", 2, 1.0), ("other", 8, 5.0), ("this", 4, 3.0), ("other", 4, 5.0)]
    runs = pd.DataFrame(rows, columns=["side", "wall-clock [s]", "processor [s]"]).assign(repeat=0)
    found = beside.compared(runs)
    assert found["this / side, wall-clock"].tolist() == [1.0, 0.5]
    assert found["this / side, processor"].tolist() == [1.0, 0.4]


def test_a_script_that_fails_is_told(checkouts):
    (checkouts / "there" / "scripts" / "compare.py").write_text("raise SystemExit('no road')")
    with pytest.raises(ValueError, match=r"compare.py must run, got: no road$"):
        beside.timed(checkouts / "there", [], checkouts)
