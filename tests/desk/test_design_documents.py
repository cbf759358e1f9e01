"""The document of a design: every number by a second road, strict JSON, no NaN."""

import json

import numpy as np
import pytest

from garage import QUARTER, ROAD, SPEED
from suspension_ctrl import Plant, RideProblem, VehicleFile
from suspension_ctrl.desk.design_documents import can_be_written, design_document
from suspension_ctrl.documents import Mistakes, Table
from suspension_ctrl.vehicles.files import read_vehicle

BOUNDS = {"spring": (10e3, 30e3), "damper": (500.0, 5e3)}
DESIGN = {"spring": 22e3, "damper": 1500.0}


def problem(vehicle=QUARTER) -> RideProblem:
    return RideProblem(vehicle, ROAD, speed=SPEED, bounds=BOUNDS)


def test_it_holds_design_vehicle_matrices_and_measures():
    text = json.dumps(design_document(problem(), DESIGN, {}, "knee"), allow_nan=False)
    found = json.loads(text)
    (case,) = found["cases"]
    assert (found["format"], found["version"]) == ("suspension_ctrl design", 1)
    assert found["design"]["damper"] == {"value": 1500.0, "unit": "N s/m"}
    np.testing.assert_array_equal(case["system"]["A"], QUARTER.closed(22e3, 1500.0).A)
    assert case["system"]["outputs"][0] == {"name": "body_acceleration", "unit": "m/s^2"}
    values = {one["name"]: one["value"] for one in found["measures"]}
    np.testing.assert_array_equal(list(values.values()), problem().evaluate([[22e3, 1500.0]])[0])
    assert found["measures"][0]["change"] is None
    file = read_vehicle(Table("", case["vehicle"]), Mistakes())
    assert (file.vehicle, file.setting, file.name) == (QUARTER, DESIGN, "knee")
    assert case["working_range"][0]["travel_m"] == pytest.approx(values["SWS"], rel=1e-6)
    assert case["parts"][0]["values"] == {"spring": {"value": 22e3, "unit": "N/m"}}


def test_what_a_plant_does_not_have_is_none():
    found = design_document(problem(Plant(QUARTER.plant())), DESIGN, {}, "knee")
    (case,) = found["cases"]
    assert case["vehicle"] is None
    assert case["working_range"][0]["static_m"] is None
    assert case["system"]["A"]
    assert can_be_written(VehicleFile(vehicle=QUARTER))
