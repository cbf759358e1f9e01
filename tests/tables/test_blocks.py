"""Columns in blocks: every one once, in their order, the keys in each, within the room where that can be."""

from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.tables.blocks import blocks


@given(st.lists(st.integers(1, 30), min_size=1, max_size=8), st.integers(0, 3), st.integers(10, 90))
def test_every_column_stands_once_behind_the_keys(sizes, keys, room):
    widths = {f"c{n}": size for n, size in enumerate(sizes)}
    names = list(widths)
    found = blocks(names, keys, widths, room, gap=2)
    assert all(block[:keys] == names[:keys] for block in found)
    assert [name for block in found for name in block[keys:]] == names[keys:]
    for block in found:
        assert sum(widths[name] + 2 for name in block) - 2 <= room or len(block) <= keys + 1


def test_a_block_is_filled_before_the_next():
    assert blocks(["k", "a", "b", "c"], 1, {"k": 4, "a": 10, "b": 10, "c": 10}, 28, 2) == [
        ["k", "a", "b"],
        ["k", "c"],
    ]
