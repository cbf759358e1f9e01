"""Tables of measured frequency responses: what is read is what was written, and a bad table is one line."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from garage import DAMPED_HALF
from suspension_ctrl import Plant
from suspension_ctrl.quantities import signal_unit

LINES = np.arange(0.3, 21.0, 0.1)
CONTACTS = {"front": (1.2, 0.0), "rear": (-1.5, 0.0)}


def written(folder: Path, text: str | bytes) -> Path:
    path = folder / "plant.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_a_table_is_the_plant_that_was_written(tmp_path):
    """Deflections and their rates are not measured apart: rates are left out, travels are the deflections."""
    h = DAMPED_HALF.plant().frequency_response(2 * np.pi * LINES)
    units = {"road": "m", "rate": "m/s", "strut": "N"}
    names, columns = ["frequency [Hz]"], [LINES]
    for output in h.output_labels:
        for given_ in [] if output.endswith(("travel", "deflection_rate")) else h.input_labels:
            unit = f"{signal_unit(output)}/{units[given_.rsplit('_', 1)[-1]]}"
            names += [f"{output}/{given_} {part} [{unit}]" for part in ("real", "imag")]
            columns += [h[output, given_].frdata.real.ravel(), h[output, given_].frdata.imag.ravel()]
    body = (",".join(map(repr, row)) for row in np.column_stack(columns).tolist())
    path = written(tmp_path, "\n".join(["# Source: none", ",".join(names), *body]))
    plant, there = Plant.from_csv(path, CONTACTS), Plant(h, CONTACTS)
    assert (plant.struts, plant.tyres) == (DAMPED_HALF.struts, DAMPED_HALF.tyres)
    assert set(plant.responses) == set(DAMPED_HALF.responses)
    here = plant.plant(there.responses)
    assert (here.input_labels, here.output_labels) == (h.input_labels, there.plant().output_labels)
    np.testing.assert_allclose(here.omega, h.omega, rtol=1e-15)
    np.testing.assert_allclose(here.frdata, h.frdata, rtol=1e-9, atol=1e-12 * np.abs(h.frdata).max())


F = "frequency [Hz]"
PAIRS = [
    f"{output}/{given} {part} [m/{unit}]"
    for output in ("deflection",)
    for given, unit in (("road", "m"), ("strut", "N"))
    for part in ("real", "imag")
]
GOOD = [[str(i + 1), "1", "0", "-0.001", "0"] for i in range(5)]


def rows(header: list[str], body: list[list[str]]) -> str:
    return "\n".join(",".join(row) for row in [header, *body])


def exchanged(name: str, *by: str) -> list[str]:
    return [F, *(new for old in PAIRS for new in (by if old == name else (old,)))]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file must begin with the names of its columns, got nothing"),
        (b"\xff\xfe", "the file must be CSV in UTF-8, got another encoding"),
        (rows([F, *PAIRS], GOOD[:1]), "rows of numbers must be 2 or more, got 1"),
        (rows([F, *PAIRS], GOOD[:3]), "frequency must be 4 finite values or more, got 3"),
        (rows([F, *PAIRS], GOOD[::-1]), "frequency must ascend from 0 Hz in steps >= 1e-06 Hz, got -1 Hz"),
        (rows([F, *PAIRS], [["0", *GOOD[0][1:]], *GOOD]), "frequency must ascend from 0 Hz in .* got 0 Hz"),
        (
            rows([F, *PAIRS], [*GOOD, ["9", "nan", "1", "1", "1"]]),
            r"'deflection/road real \[m/m\]' must be a number",
        ),
        (rows([F, *PAIRS], [*GOOD, ["9"]]), "row 6 must have 5 cells"),
        (rows(["frequency [rad/s]", *PAIRS], GOOD), r"first column must be 'frequency \[Hz\]', got 'freq"),
        (
            rows(exchanged(PAIRS[0], "x"), GOOD),
            "column must be like 'body_acceleration/front_road real .* got 'x'",
        ),
        (
            rows(exchanged(PAIRS[0], PAIRS[1]), GOOD),
            "columns must differ, got 'deflection/road imag .* twice",
        ),
        (
            rows(exchanged(PAIRS[0], "deflection/road real [mm/m]"), GOOD),
            "column deflection/road real must be in m/m, got 'mm/m'",
        ),
        (
            rows(exchanged(PAIRS[0], "pitch_acceleration/road real [m/s^2/m]"), GOOD),
            r"column pitch_acceleration/road real must be in rad/s\^2/m, got 'm/s\^2/m'",
        ),
        (
            rows(exchanged(PAIRS[0], "deflection/rad real [m/m]"), GOOD),
            "input must be like 'front_road' or 'front_strut', got 'rad'",
        ),
        (
            rows(exchanged(PAIRS[0], "wind/road real [m/s/m]"), GOOD),
            "output must be like 'body_acceleration', .* got 'wind'",
        ),
        (
            rows([name.replace("deflection", "suspension_travel") for name in [F, *PAIRS]], GOOD),
            "system must have the output 'deflection', got suspension_travel",
        ),
        (
            rows([F, *PAIRS[1:]], [row[:4] for row in GOOD]),
            "columns must include deflection/road real, got none",
        ),
        (
            rows([F, *PAIRS[2:]], [row[:3] for row in GOOD]),
            "system must have the input 'road', got strut",
        ),
        (
            rows([F], [["1"], ["2"], ["3"], ["4"]]),
            "there must be columns of responses, got none",
        ),
        (
            rows(
                [F, *PAIRS, "a_tyre_load/road real [N/m]", "a_tyre_load/road imag [N/m]"],
                [r + ["0"] * 2 for r in GOOD],
            ),
            "columns must include a_tyre_load/strut real, got none",
        ),
    ],
)
def test_bad_tables_are_one_line(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: {message}[^\n]*$"):
        Plant.from_csv(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(OSError, match="No such file"):
        Plant.from_csv(tmp_path / "no.csv", {})


NAMES = st.sampled_from(
    [F, *PAIRS, "body_acceleration/road real [m/s^2/m]", "body_acceleration/road imag [m/s^2/m]",
     "rear_deflection/rear_strut real [m/N]", "acceleration_at_1_-2_mm/road real [m/s^2/m]", "/ real []", '"', "#"]
)  # fmt: skip
CELLS = st.one_of(
    st.floats().map(repr), st.floats(-1e3, 1e3).map(repr), st.integers(-9, 9).map(str), st.text(max_size=2)
)
TABLES = st.builds(rows, st.lists(NAMES, max_size=6), st.lists(st.lists(CELLS, max_size=6), max_size=5))


@st.composite
def nearly_good(draw: st.DrawFn) -> str:
    """A good table with a few cells or names exchanged."""
    header, body = [F, *PAIRS], [list(row) for row in GOOD]
    for _ in range(draw(st.integers(1, 3))):
        if draw(st.integers(0, 3)):
            body[draw(st.integers(0, 4))][draw(st.integers(0, 4))] = draw(CELLS)
        else:
            header[draw(st.integers(0, 4))] = draw(NAMES)
    return rows(header, body)


@given(st.one_of(nearly_good(), TABLES, st.text(), st.binary()))
@example(rows([F, *PAIRS], [[repr(i * 1e-310), "1e9", "-1e9", "1", "1"] for i in range(1, 6)]))
@example(rows([F, *PAIRS], [[repr(i * 1e-6), repr((-1) ** i * 1e9), "-1e9", "1", "1"] for i in range(2, 7)]))
@settings(max_examples=150)
def test_whatever_the_text_of_a_table_it_is_read_or_refused(tmp_path_factory, text):
    content = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
    path = written(tmp_path_factory.getbasetemp(), content)
    try:
        Plant.from_csv(path).plant()
        refusal = f"{path}: "
    except ValueError as error:
        refusal = str(error)
    assert refusal.startswith(f"{path}: ")
    assert len(refusal.splitlines()) == 1
