"""RPC III files, written here from the layout of their blocks, are read as CSV of the same numbers."""

import struct

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import exposure_by_axis
from suspension_ctrl.response.channels import channels_of
from suspension_ctrl.response.history_files import read_accelerations
from suspension_ctrl.response.recordings import read_recording

pytest.importorskip("rpc3")

STEP, FRAME, FRAMES, PER_GROUP = 0.005, 64, 5, 2
TIME = STEP * np.arange(FRAME * FRAMES)
SIGNALS = {"z [g]": 1 + 0.3 * np.sin(9 * TIME), "Back_X [m/s^2]": 2 * np.cos(7 * TIME)}


def rpc(signals, kind="FLOATING_POINT", **changes: object) -> bytes:
    """Return a file: blocks of 512 bytes with keys of 32 and values of 96; groups of frames, by channel."""
    keys: dict[str, object] = {
        "FORMAT": "BINARY_IEEE_LITTLE_END", "NUM_HEADER_BLOCKS": 8, "NUM_PARAMS": 0, "FILE_TYPE": "TIME_HISTORY",
        "TIME_TYPE": "RESPONSE", "DELTA_T": f"{STEP:.6E}", "CHANNELS": len(signals), "DATA_TYPE": kind,
        "PTS_PER_FRAME": FRAME, "PTS_PER_GROUP": FRAME * PER_GROUP, "FRAMES": FRAMES, "INT_FULL_SCALE": 32752,
    }  # fmt: skip
    rows, format_, data = [], "f" if kind == "FLOATING_POINT" else "h", b""
    for i, (header, signal) in enumerate(signals.items(), start=1):
        name, _, unit = header.rstrip("]").partition(" [")
        scale = np.abs(signal).max() / 32752 if format_ == "h" else 1.0
        texts = {"DESC": name, "UNITS": unit, "SCALE": scale, "LOWER_LIMIT": -9.0, "UPPER_LIMIT": 9.0}
        keys |= {f"{key}.CHAN_{i}": text for key, text in texts.items()}
        rows.append(np.rint(signal / scale).astype(int) if format_ == "h" else signal)
    keys |= changes
    keys["NUM_PARAMS"] = len(keys)
    group = FRAME * PER_GROUP
    for start in range(0, FRAME * FRAMES, group):
        for row in rows:
            part = [*row[start : start + group], *[0] * group][:group]
            data += struct.pack(f"<{group}{format_}", *part)
    header = b"".join(struct.pack("32s96s", k.encode(), str(v).encode("latin-1")) for k, v in keys.items())
    return header.ljust(512 * 8, b"\0") + data


def written(tmp_path, content: bytes, name="rig.rsp"):
    path = tmp_path / name
    path.write_bytes(content)
    return path


@pytest.mark.parametrize(("kind", "error"), [("FLOATING_POINT", 1e-7), ("SHORT_INTEGER", 4e-5)])
@pytest.mark.parametrize("name", ["rig.rsp", "rig.RPC", "rig.tim"])
def test_histories_are_those_written_to_single_precision_or_half_a_step_of_the_integers(
    tmp_path, kind, error, name
):
    histories, step = read_accelerations(written(tmp_path, rpc(SIGNALS, kind), name))
    assert step == pytest.approx(STEP, rel=1e-12)
    assert list(histories) == ["seat z", "back x"]
    for factor, found, wanted in zip((9.80665, 1.0), histories.values(), SIGNALS.values(), strict=True):
        np.testing.assert_allclose(found, factor * wanted, rtol=0, atol=factor * 2 * error)


def test_names_of_columns_are_refused_for_a_file_that_has_its_own(tmp_path):
    with pytest.raises(ValueError, match=r"columns must be those of the file itself, got \['z \[g\]'\]$"):
        read_accelerations(written(tmp_path, rpc(SIGNALS)), columns=["z [g]"])


def test_rpc_and_csv_of_the_same_numbers_give_the_same_exposure_and_channels(tmp_path):
    single = {header: signal.astype(np.float32).astype(float) for header, signal in SIGNALS.items()}
    rows = np.column_stack([TIME, *single.values()])
    csv = written(tmp_path, b"", "rig.csv")
    np.savetxt(csv, rows, delimiter=",", header=",".join(["time [s]", *single]), comments="", fmt="%.17g")
    path = written(tmp_path, rpc(SIGNALS))
    found, wanted = (exposure_by_axis(*read_accelerations(one)) for one in (path, csv))
    pd.testing.assert_frame_equal(found.to_frame(), wanted.to_frame(), rtol=1e-9)
    names = {"z": "body_acceleration"}
    found, wanted = (channels_of(one, names) for one in (path, csv))
    np.testing.assert_allclose(found.numbers, wanted.numbers, rtol=1e-12)
    np.testing.assert_allclose(found.axis, wanted.axis, rtol=1e-12, atol=1e-15)
    assert found.responses == wanted.responses == ("body_acceleration",)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file must be an RPC III time history, binary .*, got one that cannot be read"),
        (rpc(SIGNALS)[:-4], "the file must be an RPC III time history, "),
        (rpc(SIGNALS, FORMAT="BINARY_IEEE_BIG_END"), "the file must be an RPC III time history, "),
        (rpc(SIGNALS, CHANNELS=10**9), "the file must be an RPC III time history, "),
        (rpc(SIGNALS, FRAMES=10**15), "the file must be an RPC III time history, "),
        (rpc(SIGNALS, FRAMES=0), "samples must be 2 or more, got 0"),
        (rpc({"z [g]": np.where(TIME > 1, np.nan, 1.0)}), r"samples must be numbers up to 1e\+09, got others"),
        (rpc({"z": TIME}), r"columns must have their units, as in 'z \[\] \[m/s\^2\]', got 'z \[\]'"),
        (rpc({"z [mm]": TIME}), r"unit of 'z \[mm\]' must be in m/s\^2 or a unit like it, got "),
        (rpc({"up [g]": TIME}), r"columns must include an axis such as .*, got \['time \[s\]', 'up \[g\]'\]"),
    ],
)
def test_other_files_are_refused_in_one_line(tmp_path, content, message):
    with pytest.raises(ValueError, match=rf"rig.rsp: {message}[^\n]*$"):
        read_accelerations(written(tmp_path, content))


def test_a_device_and_a_large_file_are_refused_unread(tmp_path):
    (tmp_path / "device.rsp").symlink_to("/dev/zero")
    with (tmp_path / "large.rsp").open("wb") as file:
        file.truncate(200_000_000)
    for name in ("device", "large"):
        with pytest.raises(ValueError, match="the file must be a regular one of at most 100 MB, got "):
            read_recording(tmp_path / f"{name}.rsp")
