"""Colours of the page under protanopia and deuteranopia, by Vienot, Brettel and Mollon (1999)."""

import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import suspension_ctrl.desk.explorer

PALETTE = Path(suspension_ctrl.desk.explorer.__file__).parent / "page" / "palette.js"
SEEN = {
    "all": np.eye(3),
    "protanopia": [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    "deuteranopia": [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
}
"""Linear RGB as seen, from linear RGB."""
TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])


def lab(colour: str, seen: str) -> np.ndarray:
    """CIE L*a*b* of a colour of sRGB, white D65."""
    encoded = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    x = TO_XYZ @ np.clip(np.array(SEEN[seen]) @ linear, 0, 1) / (TO_XYZ @ np.ones(3))
    f = np.where(x > (6 / 29) ** 3, np.cbrt(x), x * (29 / 6) ** 2 / 3 + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("seen", SEEN)
def test_colours_are_told_apart(seen):
    """Distances of 10 in L*a*b* are seen at a glance; just noticeable is 2.3."""
    text = PALETTE.read_text(encoding="utf-8")
    colours = set(re.findall(r"#[0-9a-f]{6}", text.split("FAINT")[0])) | set(
        re.findall(r"#[0-9a-f]{6}", text.split("LAYERS")[1])
    )
    assert len(colours) == 8
    for one, other in combinations(sorted(colours), 2):
        assert np.linalg.norm(lab(one, seen) - lab(other, seen)) > 10, (one, other)
