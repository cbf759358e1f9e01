"""The TeimOrbit format: values by block, tables by their names, units by block, whatever the spelling."""

import time

import numpy as np
import pytest

from suspension_ctrl.vehicles.teimorbit import TeimOrbit

TEXT = """! ours
[Spring_Data]
 free_length = 0.3 $ of a spring
 'text' = 3
 WORDS = 'a $ b'
[UNITS]
 LENGTH = 'm'
 FORCE = 'kN'
 TIME = 'ms'
[CURVE]
 1 2
{ disp force }
 0 0
 1 2
{ velocity force }
 3 4
(LAST)
 5 6
"""


def parsed(folder, text: str) -> TeimOrbit:
    (folder / "f.txt").write_text(text)
    return TeimOrbit.read(folder / "f.txt")


def test_values_stand_by_block_and_key(tmp_path):
    file = parsed(tmp_path, TEXT)
    assert file.values["SPRING_DATA", "FREE_LENGTH"] == "0.3"
    assert file.values["SPRING_DATA", "WORDS"] == "a $ b"
    assert file.number("SPRING_DATA", "FREE_LENGTH", "m") == 0.3
    with pytest.raises(ValueError, match=r"^the file must have X in \[SPRING_DATA\], got none$"):
        file.number("SPRING_DATA", "X", "m")
    with pytest.raises(ValueError, match=r"^WORDS must be a number with a unit like m, got 'a \$ b m'$"):
        file.number("SPRING_DATA", "WORDS", "m")


def test_rows_belong_to_the_names_above_them_in_their_block(tmp_path):
    file = parsed(tmp_path, TEXT)
    np.testing.assert_array_equal(file.curve("disp", "m"), [[0.0, 1.0], [0.0, 2000.0]])
    np.testing.assert_array_equal(file.curve("vel", "m/s"), [[3000.0], [4000.0]])


@pytest.mark.parametrize(
    "text",
    ["{ disp force }\n" * 60_000, "{ disp force }\n" + "1 2\n" * 200_000, "[A]\n" * 200_000, "(" * 900_000,
     "{ vel" + " force" * 150_000, "a = '" * 180_000, "x" * 900_000, "\n" * 900_000],
)  # fmt: skip
def test_a_hostile_file_is_refused_at_once(tmp_path, text):
    before = time.process_time()
    with pytest.raises(ValueError, match="must"):
        parsed(tmp_path, text).curve("vel", "m/s")
    assert time.process_time() - before < 10.0
