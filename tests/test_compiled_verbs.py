"""Verbs: settings with a method that compiled loops call, and which of them numba can store."""

import sys
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit
from numba.core.errors import TypingError
from numba.extending import register_jitable

from suspension_ctrl.compiled_verbs import Linked, call, call_compiled, linked, storable, verb_of
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.kinds import Coding
from suspension_ctrl.search.operators import DifferentialChild, MutateDesign


class Line(NamedTuple):
    slope: float
    constant: float

    @register_jitable
    def __call__(self, x):
        return self.slope * x + self.constant


class Doubled(NamedTuple):
    """A verb that calls another."""

    inner: Any

    @register_jitable
    def __call__(self, x):
        return 2.0 * call(self.inner, (x,))


@njit
def called(verb, x):
    return call(verb, (x,))


@njit
def plus(x, constant):
    return x + constant


@njit
def minus(x, constant):
    return x - constant


@njit
def square(x):
    return x * x


@njit
def cube(x):
    return x * x * x


@pytest.mark.parametrize(
    ("verb", "expected"),
    [
        (Line(2.0, 1.0), 7.0),
        (Doubled(Line(2.0, 1.0)), 14.0),
        (verb_of((plus, (0.5,))), 3.5),
        (verb_of((minus, (0.5,))), 2.5),
        (verb_of((square, ())), 9.0),
        (verb_of((cube, ())), 27.0),
        (Doubled(verb_of((cube, ()))), 54.0),
    ],
)
def test_compiled_loops_call_the_function_of_the_verbs_class(verb, expected):
    """Those with equal types of settings are not taken for one another."""
    assert called(verb, 3.0) == expected


def test_python_calls_verbs_and_any_other_callable():
    assert call(Line(2.0, 1.0), (3.0,)) == call_compiled(Line(2.0, 1.0), 3.0) == 7.0
    assert call(max, (1, 2)) == 2
    assert verb_of(line := Line(2.0, 1.0)) is line


class Row(NamedTuple):
    """A verb that returns a part of its own settings."""

    table: np.ndarray

    @register_jitable
    def __call__(self, i):
        return self.table[i]


@njit
def sum_of_rows(verb, times):
    total = 0.0
    for k in range(times):
        row = call(verb, (k % 2,))
        total += row[0] + row[1]
    return total


def test_calls_leave_the_references_to_the_arrays_of_a_verb_as_they_are():
    """Whoever calls a verb holds it: an array counted down too often would be freed in its owner's hands."""
    table = np.array([[1.0, 2.0], [3.0, 4.0]])
    before = sys.getrefcount(table)
    assert sum_of_rows(Row(table), 1000) == 5000.0
    assert sys.getrefcount(table) == before
    np.testing.assert_array_equal(table, [[1.0, 2.0], [3.0, 4.0]])


class Sum(NamedTuple):
    """A verb of two arrays with settings of several kinds."""

    weights: np.ndarray
    line: Line
    on: bool

    @register_jitable
    def __call__(self, design, value):
        if design[0] < 0.0:
            raise ValueError("first must be >= 0")
        value[0] = call(self.line, ((self.weights * design).sum(),)) if self.on else 0.0
        return value.size


@njit
def total(design, value, constant):
    value[0] = design.sum() + constant
    return value.size


@njit("int64(float64[:], float64[:], float64)")
def total_of_any_layout(design, value, constant):
    value[0] = design.sum() + constant
    return value.size


@njit
def over_rows(verb, designs):
    result, value = 0.0, np.empty(1)
    for k in range(designs.shape[0]):
        result += call(verb, (designs[k], value)) * value[0]
    return result


DESIGNS = np.arange(6.0).reshape(3, 2)
SUM = Sum(np.array([1.0, 10.0]), Line(2.0, 1.0), True)


@pytest.mark.parametrize(
    ("verb", "expected"),
    [
        (SUM, 195.0),
        (SUM._replace(on=False), 0.0),
        (verb_of((total, (0.5,))), 16.5),
        (verb_of((total_of_any_layout, (0.5,))), 16.5),
    ],
)
def test_a_linked_verb_gives_what_the_verb_does(verb, expected):
    found = linked(verb)
    assert isinstance(found, Linked)
    assert over_rows(found, DESIGNS) == over_rows(verb, DESIGNS) == expected


def test_loops_are_compiled_once_for_all_linked_verbs():
    over_rows(linked(SUM), DESIGNS)
    before = len(over_rows.overloads)
    over_rows(linked(verb_of((total, (1,)))), DESIGNS)
    assert len(over_rows.overloads) == before


def test_an_exception_crosses_the_address_and_other_arrays_do_not():
    verb = linked(SUM)
    with pytest.raises(ValueError, match="first must be >= 0"):
        over_rows(verb, -1.0 - DESIGNS)
    with pytest.raises(TypingError, match="a linked verb takes two arrays"):
        over_rows(verb, DESIGNS[:, ::-1])


def test_verbs_are_storable_where_every_process_finds_their_class():
    box = np.zeros(2), np.ones(2)
    assert storable(DifferentialChild(0.5))
    assert storable(MutateDesign.of(*box, 20.0, 0.5))
    assert storable(paper.ride_problem().kernel)
    assert not storable(verb_of((square, ())))
    assert not storable(Doubled(DifferentialChild(0.5)))
    mixed = paper.ride_problem().replace(kinds={"spring": "log"})
    for kernel, expected in ((mixed.kernel, True), (verb_of((square, ())), False)):
        assert storable(Coding(mixed).kernel(kernel)) == expected
