"""A study in sentences."""

from suspension_ctrl import Iso8608Road, LoadCase, Payload, RideProblem, StudyFile, load_vehicle
from suspension_ctrl.desk.study_texts import introduced

FILE = load_vehicle("minaker_half")
PROBLEM = RideProblem(
    FILE.vehicle, Iso8608Road("C"), speed=20.0, bounds=FILE.bounds, band=(0.3, 20.0), constraints=["SWS <= 0.02"]
)


def test_the_problem_is_told_with_its_cases_variables_and_present_design():
    laden = Payload(mass=200.0, position=(0.0, 0.0)).on(FILE.vehicle)
    cases = [PROBLEM.cases[0], LoadCase(vehicle=laden, road=Iso8608Road("D"), speed=15.0, share=0.5)]
    several = PROBLEM.replace(cases=cases, kinds={"front.spring": (20e3, 30e3)})
    lines = introduced(StudyFile(problem=several, name="A car", present=dict.fromkeys(several.variables, 15e3)))
    assert lines[0] == "A car; 0.3 to 20 Hz; ACC weighted with Wk."
    assert lines[1].startswith("Varied: front.spring of 20, 30 kN/m; front.damper 1 to 8 kN s/m; ")
    assert lines[2] == "Limits: SWS <= 20 mm."
    assert lines[4].startswith("Case 1, share 1: ISO 8608 class C")
    assert lines[5].endswith("15 m/s.")
    assert lines[6].startswith("Present design: front.spring 15 kN/m, front.damper 15 kN s/m, ")
    assert introduced(StudyFile(problem=PROBLEM))[-1] == "Present design: not known."
