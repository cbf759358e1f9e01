"""Records for a page: named tuples and arrays as JSON, arrays in base64."""

from base64 import b64encode
from typing import Any

import numpy as np

from ...quantities import Complex, Real

_KINDS = {"f": ("f8", "<f8"), "c": ("f8", "<c16"), "i": ("i4", "<i4"), "b": ("u1", "u1")}


def packed(value: Any) -> Any:
    """Return a value for JSON: a named tuple with its class, an array with kind, shape and base64.

    Complex numbers become pairs, integers have 32 bits. ``unpacked`` of ``numerics/packed.js`` reads it.
    """
    if isinstance(value, np.ndarray):
        return _array(value)
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        fields = {name: packed(one) for name, one in zip(value._fields, value, strict=True)}
        return {"class": type(value).__name__, **fields}
    if isinstance(value, dict):
        return {key: packed(one) for key, one in value.items()}
    return [packed(one) for one in value] if isinstance(value, list | tuple) else value


def _array(values: Real | Complex) -> dict[str, Any]:
    kind, stored = _KINDS[values.dtype.kind]
    content = np.ascontiguousarray(values.astype(stored, casting="same_kind" if kind != "i4" else "unsafe"))
    return {"kind": kind, "shape": list(values.shape), "base64": b64encode(content.tobytes()).decode("ascii")}
