"""The roughness of a file from the command line: the numbers of the library, and bad input in one line."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Iso8608Road, MeasuredRoad, international_roughness_index, save_profile

PROFILE = Iso8608Road("C").profile(400.0, 0.1, 1, (0.75, -0.75))
FILES = {"road.png", "road.pdf", "roughness.csv", "spectrum.csv"}


def test_a_file_is_judged_whole_and_by_segments(called, tmp_path):
    save_profile(tmp_path / "p.csv", PROFILE)
    done = called("road", "p.csv", "--segments", "100m,25", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES | {
        "roughness_100m.csv",
        "roughness_25m.csv",
    }
    index = international_roughness_index(PROFILE)
    whole = pd.read_csv(tmp_path / "out" / "roughness.csv")
    np.testing.assert_allclose(whole["IRI [mm/m]"], [*index.tracks, index.mean], rtol=1e-12)
    assert whole["track [m]"].tolist() == ["0.75", "-0.75", "mean"]
    for length in (100, 25):
        part = pd.read_csv(tmp_path / "out" / f"roughness_{length}m.csv")
        pd.testing.assert_frame_equal(part, index.by_segment(float(length)), rtol=1e-12)
    spectrum = pd.read_csv(tmp_path / "out" / "spectrum.csv")
    np.testing.assert_allclose(spectrum["psd [m^3]"], MeasuredRoad.from_profile(PROFILE).density, rtol=1e-12)
    assert "ISO 8608 class C: Gd(0.1 cycle/m) = " in done.stdout
    assert f"{index.mean:.2f}" in done.stdout
    assert done.stdout.splitlines()[-1] == "out"


def test_feet_and_inches_without_a_header_and_a_smoothed_profile(called, tmp_path):
    rows = np.column_stack([PROFILE.distance / 0.3048, PROFILE.height / 0.0254])
    np.savetxt(tmp_path / "p.txt", rows)
    columns = "distance [ft],left [in],right [in]"
    done = called("road", "p.txt", "--columns", columns, "--track-width", "1.5m", "--smoothed", "--out", "out")
    assert done.returncode == 0, done.stderr
    index = international_roughness_index(PROFILE, average=False)
    whole = pd.read_csv(tmp_path / "out" / "roughness.csv")
    np.testing.assert_allclose(whole["IRI [mm/m]"], [*index.tracks, index.mean], rtol=1e-9)


def test_a_short_road_has_an_index_and_no_spectrum(called, tmp_path):
    height = PROFILE.height[:200, 0]
    (tmp_path / "p.txt").write_text("\n".join(map(repr, height.tolist())))
    done = called("road", "p.txt", "--step", "10cm", "--segments", "10,100", "--out", "out")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES - {"spectrum.csv"} | {"roughness_10m.csv"}
    assert "No spectrum: a profile in steps of 0.1 m must have 256 points at least" in " ".join(
        done.stdout.split()
    )


def test_what_is_assumed_is_a_warning_of_a_line(script, tmp_path):
    save_profile(tmp_path / "p.csv", PROFILE)
    text = (tmp_path / "p.csv").read_text()
    (tmp_path / "p.csv").write_text("distance [m],LWP [m],RWP [m]\n" + text.partition("\n")[2])
    done = script("road", "p.csv", "--out", "out", cwd=tmp_path, warnings="default")
    assert done.returncode == 0, done.stderr
    assert done.stderr == "warning: p.csv: left and right are taken 1.5 m apart, as no track width is given\n"


@pytest.mark.parametrize(
    ("arguments", "message", "status"),
    [
        (["absent.csv"], "No such file or directory: 'absent.csv'", 1),
        (["/dev/zero"], "/dev/zero: the file must be a regular one of at most 100 MB, got another kind", 2),
        (["p.csv", "--segments", "20,x"], "segments must be a number with a unit like m, got 'x'", 2),
        (["p.csv", "--segments", "0.1"], "segment must be from 0.5 to 400 m, got 0.1 m", 2),
        (["p.csv", "--segments", "-5"], "segment must be finite and > 0 m, got -5.0", 2),
        (["p.csv", "--columns", "x"], "p.csv: columns must be names of 3 columns, got ['x']", 2),
        (["p.csv", "--tracks", "0"], "p.csv: tracks must be given for a .crg file only, got (0.0,)", 2),
        (["p.csv", "--step", "x"], "Invalid value for '--step': must be a number with a unit like m, got 'x'", 2),
        (["coarse.csv"], "a profile for the roughness index must have steps of at most 0.3048 m, got 1 m", 2),
        (["p.csv", "--out", "."], "out must be a folder that is absent or empty", 2),
        ([], "Missing argument 'FILE'.", 2),
    ],
)  # fmt: skip
def test_bad_input_is_one_line(refused, tmp_path, arguments, message, status):
    save_profile(tmp_path / "p.csv", PROFILE)
    (tmp_path / "coarse.csv").write_text("x [m],z [m]\n" + "".join(f"{i},{i % 2}\n" for i in range(300)))
    refused("road", arguments, message, status)


def test_the_script_is_the_command(script, tmp_path):
    save_profile(tmp_path / "p.csv", PROFILE)
    done = script("road", "p.csv", "--out", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "road.png").stat().st_size > 10_000
