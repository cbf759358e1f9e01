"""Files written from dataclasses: what is read back is equal."""

import re
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.schema.writing import content, toml
from wheels import FULL, GOOD, NUMBER, WHEEL, Track, Tyre, Wheel, accepted, accepted_table


def test_what_is_written_is_what_is_read():
    table = content(WHEEL)
    assert table == FULL
    text = toml(table, WHEEL, accepted_table)
    assert tomllib.loads(text) == table
    assert content(accepted(GOOD)) == GOOD  # no defaults


NUMBERS = st.floats(1e-12, 1e12)


@given(
    NUMBERS, st.tuples(NUMBERS, NUMBERS), st.text(min_size=1).filter(lambda text: text.strip() and text != "spare")
)
def test_any_record_is_read_as_it_was_written(mass, place, name):
    wheel = Wheel(mass, place, name)
    text = toml(content(wheel), wheel, accepted_table)  # raises if its reader makes another record of it
    assert tomllib.loads(text) == content(wheel)


def test_what_a_file_cannot_hold_is_refused():
    large = Wheel(1e13, (1.0, 0.5), "left")
    with pytest.raises(ValueError, match=f"^mass_kg must be {re.escape(NUMBER)}, got 10000000000000.0$"):
        toml(content(large), large, accepted_table)
    with pytest.raises(ValueError, match=r"^a file must hold all of what is written, got Wheel"):
        toml(content(WHEEL), Wheel(3.0, (1.0, 0.5), "left"), accepted_table)
    with pytest.raises(ValueError, match=r"^a file must hold numbers, texts and tables, got <object"):
        content(Track(object()))
    with pytest.raises(ValueError, match=r"^a file must hold one of tyre, got Track"):
        content(Track((3.0,)), {"tyre": Tyre})
