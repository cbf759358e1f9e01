"""The short form of the fuzz: 200 files per reader, each read or refused in one line."""

import numpy as np
import pytest

from soak import fuzz
from soak.readers import Reader, readers

READERS = readers()


@pytest.mark.parametrize("name", READERS)
def test_whatever_is_in_a_file_it_is_read_or_refused(name):
    outcome = fuzz.fuzz(READERS[name], 200, seed=1)
    assert outcome.failures == ()
    assert outcome.files == outcome.read + outcome.refused == 200
    assert outcome.read > 0  # else mutations would never reach the insides of a reader


def test_another_error_a_second_line_and_a_long_time_are_failures(monkeypatch):
    def reads(path):
        match int(rng.integers(4)):
            case 0:
                raise KeyError("x")
            case 1:
                raise ValueError("two\nlines")
            case 2:
                raise ValueError("one line")

    rng = np.random.default_rng(0)
    outcome = fuzz.fuzz(Reader(reads, ".csv", (b"x",)), 100)
    assert {text.partition(": ")[2] for text in outcome.failures} == {"KeyError('x')", r"'two\nlines'"}
    assert outcome.read + outcome.refused + sum("KeyError" in text for text in outcome.failures) == 100
    monkeypatch.setattr(fuzz, "SECONDS", -1.0)
    assert "s of processor time" in fuzz.fuzz(READERS["coherence"], 1).failures[-1]


def test_outcomes_make_a_table():
    outcome = fuzz.Outcome(10, 4, 6, 0.5, 12.0, ("3: KeyError('x')",))
    assert fuzz.table({"road": outcome}).splitlines()[2] == "| road | 10 | 4 | 6 | 1 | 0.50 | 12 |"
