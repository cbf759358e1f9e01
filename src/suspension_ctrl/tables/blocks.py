"""Blocks of columns: a table that is too wide stands in blocks one below another, each with the key columns."""

from collections.abc import Mapping, Sequence


def blocks(names: Sequence[str], keys: int, widths: Mapping[str, int], room: int, gap: int) -> list[list[str]]:
    """Return the columns in blocks of at most `room` characters, each with the first `keys` and another.

    `widths` are the characters of each column, `gap` those between two.
    """
    first, others = list(names[:keys]), names[keys:]
    found: list[list[str]] = []
    for name in others:
        if not found or sum(widths[one] + gap for one in [*found[-1], name]) - gap > room:
            found.append(list(first))
        found[-1].append(name)
    return found or [first]
