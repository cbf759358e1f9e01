"""Headers of columns: a name, and a unit in brackets."""


def name_and_unit(header: str) -> tuple[str, str]:
    """Return name and unit of a header such as ``z [m/s^2]`` or ``z (m/s²)``, no unit where there is none.

    ``²`` and ``**`` of a unit become powers. Runs in linear time in the length of a header.
    """
    text = header.strip()
    for opening, closing in ("[]", "()"):
        name, found, unit = text[:-1].rpartition(opening)
        if found and text.endswith(closing):
            return name.strip(), " ".join(unit.split()).replace("²", "^2").replace("**", "^")
    return text, ""
