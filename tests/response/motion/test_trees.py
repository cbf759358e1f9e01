"""Trees of struts: their states, and what has no response in time."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, HALF
from suspension_ctrl.response.motion.trees import Tree, numbers_of, tree_of
from suspension_ctrl.vehicles.networks import Program

LAW = sc.TableDamper(velocity=[0.0, 0.1, 1.0], force=[0.0, 400.0, 900.0])
MOUNTED = sc.parallel(sc.Spring(), sc.series(LAW, sc.Spring("mount", 2e5)))


def tree(strut, car=HALF) -> tuple[Tree, Program, sc.HalfCar]:
    changed = replace(car, front_strut=strut)
    program = Program.of(changed.networks, [one.name for one in changed.strut_coefficients])
    return tree_of(changed.networks, program, 10), program, changed


def test_a_network_stands_at_each_of_its_ports():
    found, _, car = tree(MOUNTED, FULL)
    q = len(car.struts)
    assert found.slot.tolist() == [0, 1]
    assert found.first.tolist() == [q, q + 2]
    assert found.law_slot.tolist() == [q, q + 2]
    assert found.linear_slot.tolist() == [q + 1, q + 3]
    assert found.state.tolist() == [[10, -1], [11, -1]]
    assert found.states == 2
    assert car.struts[:2] == ("front_left", "front_right")


def test_a_series_with_an_inerter_has_its_rate_as_a_state_too():
    found, program, car = tree(
        sc.parallel(sc.Spring(), sc.series(LAW, sc.parallel(sc.Inerter(), sc.Damper("bush"))))
    )
    series = found.state[:, 0].argmax()
    assert found.state[series].tolist() == [10, 11]
    first = found.first[series]
    values = car.coefficients({"front.spring": 2e4, "front.inerter": 30.0, "front.bush": 5e3, "rear": (2e4, 1e3)})
    numbers = numbers_of(program, found, np.array(list(values.values())))
    assert numbers.linear[2, first] == 30.0


RUBBER = sc.Rubber("bush", storage=2e5, loss=2e4)
MEASURED = sc.MeasuredStiffness(frequency=[1.0, 20.0], storage=[2e5, 3e5], loss=[1e4, 2e4])


@pytest.mark.parametrize(("element", "name"), [(RUBBER, "front.bush"), (MEASURED, "front.mount")])
def test_what_is_known_at_frequencies_alone_has_no_response_in_time(element, name):
    with pytest.raises(ValueError, match=rf"^struts must be of elements with a response in time.*got {name}$"):
        tree(sc.parallel(sc.Spring(), sc.series(LAW, element)))


def test_inerters_at_both_ends_are_refused():
    with pytest.raises(ValueError, match=r"^series must have an inerter in one of its parts at most"):
        tree(sc.parallel(LAW, sc.series(sc.Inerter(), sc.Inerter("other"))))
