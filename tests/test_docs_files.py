"""The page about files is what the code makes of it."""

import re
import runpy

import pytest

from spoilt import changed
from suspension_ctrl import Scatter, load_problem, load_study, load_vehicle, save_vehicle
from suspension_ctrl.quantities import quantity


def test_the_page_of_keys_is_that_of_the_code(checkout):
    made = runpy.run_path(str(checkout / "docs/keys.py"))
    assert (checkout / "docs/files.md").read_text(encoding="utf-8") == made["page"]()


def test_every_unit_of_a_key_can_be_typed(checkout):
    """A text of one such unit is the number one, or the key has no unit to type."""
    made = runpy.run_path(str(checkout / "docs/keys.py"))
    records = [*made["VEHICLES"].values(), *made["ROADS"].values(), *made["COHERENCES"].values()]
    records += [*made["ELEMENTS"].values()]
    records += [made[name] for name in ("Seat", "RollGeometry", "Payload", "CaseDocument", "ProblemDocument")]
    units = {key.unit for record in records for key in made["keys_of"](record).values() if key.unit}
    assert len(units) >= 8
    for unit in units:
        assert quantity("x", f"1 {unit}", unit) == 1.0


def test_the_pages_vehicle_is_read_and_its_mistakes_are_said(checkout, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = (checkout / "docs/files.md").read_text(encoding="utf-8")
    (text, *_), (said,) = (re.findall(rf"```{kind}\n(.*?)```", page, re.DOTALL) for kind in ("toml", "text"))
    (tmp_path / "van.toml").write_text(text)
    file = load_vehicle("van.toml")
    assert (file.vehicle.body_mass, file.vehicle.cg_to_front, file.setting["front.spring"]) == (1100.0, 1.3, 28e3)
    for old, new in (
        ("body_mass", "body_mas"),
        ("1300mm", "1300 kg"),
        ('"2.2', '"-2.2'),
        ('4 kN s/m"]\nr', '4"]\nr'),
    ):
        text = changed(text, old, new)
    (tmp_path / "van.toml").write_text(text)
    with pytest.raises(ValueError, match="van") as error:
        load_vehicle("van.toml")
    assert f"{error.value}\n" == said


def test_the_pages_lorry_is_read(checkout, tmp_path):
    page = (checkout / "docs/files.md").read_text(encoding="utf-8")
    _, lorry, *_ = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    (tmp_path / "lorry.toml").write_text(lorry)
    file = load_vehicle(tmp_path / "lorry.toml")
    assert file.vehicle.assembly.coordinates == (
        *("frame", "cab", "front_wheel", "rear_wheel"),
        *("frame_pitch", "cab_pitch"),
    )
    assert file.setting["mount.spring"] == 50e3
    assert "driver_acceleration" in file.vehicle.responses


def test_the_pages_strut_is_that_of_a_vehicle(checkout, tmp_path):
    page = (checkout / "docs/files.md").read_text(encoding="utf-8")
    van, _, strut, *_ = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    linear = [line for line in van.splitlines() if not line.startswith("front.damper")]
    (tmp_path / "van.toml").write_text("\n".join([*linear, strut]))
    file = load_vehicle(tmp_path / "van.toml")
    setting = file.vehicle.coefficients(file.setting)
    assert setting["front.damper.scale"] == 1.0
    assert setting["front.mount"] == 250e3
    assert setting["front.bump_stop.gap"] == 0.024


def test_the_pages_scatter_is_read(checkout, tmp_path):
    page = (checkout / "docs/files.md").read_text(encoding="utf-8")
    (scatter,) = (text for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL) if "[scatter]" in text)
    head = 'vehicle = "minaker_half"\nroad = "C"\nspeed = "20 m/s"\nmeasures = ["mean ACC", "q95 DTL"]\n'
    (tmp_path / "robust.toml").write_text(head + "band_Hz = [0.3, 20.0]\n" + scatter)
    given = {"spring": 0.05, "damper": (-0.25, 0.1), "front_tyre_stiffness": 0.1}
    assert load_problem(tmp_path / "robust.toml").scatter == Scatter(given, samples=512)


def test_the_pages_study_is_read(checkout, tmp_path):
    page = (checkout / "docs/files.md").read_text(encoding="utf-8")
    (study,) = (text for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL) if "[search]" in text)
    (tmp_path / "study.toml").write_text(study)
    save_vehicle(tmp_path / "car.toml", load_vehicle("yuen_ramli_2010"))
    found = load_study(tmp_path / "study.toml")
    assert (found.name, found.search.populations) == ("My car on a country road", (200,))
    assert found.present == {"spring": 22e3, "damper": 1500.0}
    assert [str(one) for one in found.problem.constraints] == ["SWS <= 0.012"]
