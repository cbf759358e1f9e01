"""What functions get of designs in a load case: coefficients, spectra by python-control, summands of squares."""

import numpy as np

from garage import QUARTER, ROAD
from suspension_ctrl import LoadCase, Term
from suspension_ctrl.response.measures.terms import CaseMeasure
from suspension_ctrl.response.scores import Score, Scores

SETTING = {"spring": 2e4, "damper": 1500.0}
CASE = LoadCase(vehicle=QUARTER, road=ROAD, speed=20.0)
TERM = Term("body_acceleration", "Wk")
SCORES = Scores([CASE], [Score((CaseMeasure((TERM,)),), False)], [SETTING], ["damper"], (0.0, 20.0))
DAMPERS = np.array([[1200.0], [2100.0]])
(EVALUATED,) = SCORES.evaluated


def test_coefficients_that_do_not_vary_stand_beside_those_that_do():
    squares = np.array([[1.0], [4.0]])
    found = EVALUATED.designs(SCORES.kernel(64).cases[0], DAMPERS, squares)
    np.testing.assert_array_equal(found.coefficients, [[2e4, 1200.0], [2e4, 2100.0]])
    np.testing.assert_array_equal(found.values, DAMPERS)
    np.testing.assert_array_equal(found.mean_squares([TERM.integral, TERM.integral]), np.hstack([squares] * 2))
    np.testing.assert_array_equal(found.mean_travels(), np.zeros((2, 1)))
    np.testing.assert_array_equal(found.law_powers(), np.zeros((2, 1)))
    ((vehicle, coefficients),) = found.vehicles()
    assert vehicle is QUARTER
    assert coefficients is found.coefficients


def test_spectra_are_those_of_the_closed_vehicle():
    found = EVALUATED.designs(SCORES.kernel(64).cases[0], DAMPERS, np.zeros((2, 1)))
    for (damper,), (f, spectra) in zip(DAMPERS, found.spectra(), strict=True):
        closed = QUARTER.closed(spring=2e4, damper=damper)
        for name in ("body_acceleration", "suspension_travel", "tyre_load"):
            h = closed[name, "road"](2j * np.pi * f)
            np.testing.assert_allclose(spectra[name], np.abs(h) ** 2 * ROAD.psd(f, 20.0), rtol=1e-9)


def test_summands_are_those_of_the_mean_squares():
    case = SCORES.kernel(64).cases[0]
    rule, summands = EVALUATED.summands(case, DAMPERS, 64)
    assert summands.shape == (2, rule.f.size) == (2, rule.w.size)
    np.testing.assert_allclose(summands.sum(axis=1, keepdims=True), SCORES.evaluate(DAMPERS, 64) ** 2, rtol=1e-12)
