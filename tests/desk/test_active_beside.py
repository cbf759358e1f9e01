"""Active suspensions beside a decision: the sentence by its tables, reasons where there is none."""

import pytest

from garage import QUARTER
from suspension_ctrl import Iso8608Road, LoadCase, RideProblem
from suspension_ctrl.desk.active_beside import ActiveBeside

BOUNDS = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
PRESENT = {"spring": 22e3, "damper": 1500.0}


@pytest.fixture(scope="module")
def problem():
    return RideProblem(QUARTER, Iso8608Road("C"), speed=20.0, bounds=BOUNDS)


def test_the_share_is_told_with_its_values(problem):
    found = ActiveBeside.of(problem, PRESENT)
    values = found.shares["ACC [m/s^2]"]
    share = 100 * (values.iloc[0] - values["passive optimum"]) / (values.iloc[0] - values["active optimum"])
    own, passive, sky, active = (f"{value:.3g} m/s^2" for value in values)
    assert found.text == (
        f"The passive optimum takes {share:.0f} % of what is attainable: ACC of {passive} in place of {own} with "
        f"no more SWS and DTL than the present design; skyhook has {sky}, an active suspension with full "
        f"information {active}."
    )
    assert found.fronts.attrs["present"][0] == pytest.approx(values.iloc[0])
    headers = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    assert [*found.by_controller(headers)] == ["attainable, LQR", "attainable, skyhook"]
    assert sum(map(len, found.by_controller(headers).values())) == len(found.fronts)
    assert found.by_controller([*headers, "mean ACC [m/s^2]"]) == {}


def test_without_it_the_reason_is_told(problem):
    nothing = ActiveBeside.of(problem, {})
    assert nothing == ("What is attainable is not told without a present design.", None, None)
    cases = [LoadCase(vehicle=QUARTER, road=Iso8608Road("C"), speed=v) for v in (10.0, 20.0)]
    several = ActiveBeside.of(RideProblem(cases=cases, bounds=BOUNDS), PRESENT)
    reason = "problem must have one load case for a controller, got 2"
    assert several == (f"What is attainable is not told: {reason}.", None, None)
