"""The page about files is what the code makes of it."""

import runpy

from suspension_ctrl.quantities import quantity


def test_the_page_of_keys_is_that_of_the_code(checkout):
    made = runpy.run_path(str(checkout / "docs/keys.py"))
    assert (checkout / "docs/files.md").read_text(encoding="utf-8") == made["page"]()


def test_every_unit_of_a_key_can_be_typed(checkout):
    """A text of one such unit is the number one, or the key has no unit to type."""
    made = runpy.run_path(str(checkout / "docs/keys.py"))
    records = [*made["VEHICLES"].values(), *made["ROADS"].values(), *made["COHERENCES"].values()]
    records += [made[name] for name in ("Seat", "RollGeometry", "Payload", "CaseDocument", "ProblemDocument")]
    units = {key.unit for record in records for key in made["keys_of"](record).values() if key.unit}
    assert len(units) >= 8
    for unit in units:
        assert quantity("x", f"1 {unit}", unit) == 1.0
