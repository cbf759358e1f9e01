"""Names and units of a vehicle's signals."""

ResponseName = str | tuple[str, float, float]
"""One of a vehicle's named responses, or ``("acceleration", x, y)``, vertical, at a point of the body."""


def label(response: ResponseName) -> str:
    """Return the name of a response as a signal of python-control, which has no dots."""
    if isinstance(response, str):
        return response
    return "acceleration_at_{}_{}_mm".format(*(round(1e3 * x) for x in response[1:]))


def signal_unit(signal: str) -> str:
    """Return the unit of a response or a deflection by its name as a signal, empty if that tells none."""
    if signal in ("pitch_acceleration", "roll_acceleration"):
        return "rad/s^2"
    if signal.endswith("acceleration") or signal.startswith("acceleration_at"):
        return "m/s^2"
    return {"travel": "m", "deflection": "m", "load": "N"}.get(signal.rsplit("_", 1)[-1], "")


def joined(*parts: str) -> str:
    """Return the parts that are not empty, joined by underscores."""
    return "_".join(part for part in parts if part)
