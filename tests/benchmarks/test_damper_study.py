"""The study of curves of dampers beside straight dampers, on a few designs."""

import pytest

import damper_study
import suspension_ctrl as sc

SPRINGS = {"front.spring": 57e3, "rear.spring": 45e3, "front_antiroll": 3299.0, "rear_antiroll": 16270.0}


def test_straight_dampers_take_the_limits_and_springs_of_the_study():
    """Curves that are straight have the values of straight dampers: no search has an easier problem."""
    study = sc.load_problem(damper_study.STUDY)
    free, held = damper_study.straight(study), damper_study.straight(study, SPRINGS)
    assert list(free.bounds) == [*SPRINGS, "front.damper", "rear.damper"]
    assert list(held.bounds) == ["front.damper", "rear.damper"]
    assert free.constraints == held.constraints == study.constraints
    expected = held.evaluate([[3e3, 4e3]])
    assert free.evaluate([[*SPRINGS.values(), 3e3, 4e3]]) == pytest.approx(expected, rel=1e-9)
    curve = {"low_speed": 0.0, "high_speed": 0.0, "knee": 0.2, "rebound_over_bump": 1.0}
    slopes = {"front": 3e3, "rear": 4e3}
    values = SPRINGS | {
        f"{axle}.damper.{name}": value or slopes[axle] for axle in slopes for name, value in curve.items()
    }
    assert study.evaluate([[values[name] for name in study.variables]]) == pytest.approx(
        expected, rel=1e-3, abs=1e-3
    )


def test_straight_dampers_are_searched_with_the_travel_of_the_curves(capsys):
    study = sc.load_problem(damper_study.STUDY)
    curves = damper_study.Found("curves", study, SPRINGS | {"front.damper.knee": 0.2}, {}, 1.0)
    free, held = damper_study.beside(curves, 0.0122, population=40, seeds=(1, 2))
    said = capsys.readouterr().out.splitlines()
    assert list(held.design) == ["front.damper", "rear.damper"]
    for one, line in zip((free, held), said, strict=True):
        values = one.problem.evaluate([list(one.design.values())])[0]
        assert (values[2:] <= 0).all()
        assert values[0] == one.objectives["ACC"]
        assert str(one.problem.constraints[0]).startswith("SWS <= 0.01208")
        assert one.seconds > 0
        assert f"{one.objectives['ACC']:.4g}" == min(line.split()[-2:])
