"""Texts of files with something wrong in them."""

from hypothesis import strategies as st


def changed(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new)


def spelt(value: object) -> str:
    """Return a value in TOML, whatever a mutation has made of it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{spelt(str(key))} = {spelt(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(spelt, value)) + "]"
    if isinstance(value, str):
        return '"' + "".join(f"\\U{ord(c):08X}" for c in value) + '"'
    return str(value).lower() if isinstance(value, bool) else repr(value)


SCALARS = st.one_of(
    st.floats(),
    st.floats(1e-12, 1e12),
    st.integers(),
    st.booleans(),
    st.text(st.characters(exclude_categories=["Cs"]), max_size=3),
    st.sampled_from([0, 1e-300, 1e308, 10**400, -1, "body", "front", "full-car", [], {}, [0, 0], [0.1, 0]]),
)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from("ab"), inner, max_size=2)
)
