"""Verbs: settings with a method that compiled loops call, and which of them numba can store."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit
from numba.core.errors import TypingError
from numba.extending import register_jitable

import suspension_ctrl
from functions import dtlz2, srn
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.compiled import Linked, call, call_compiled, compilable, linked, storable, verb_of
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


@compilable()
def halved(x):
    if x < 0:
        raise ValueError("x must be >= 0")
    return 0.5 * x


@njit
def quarter_of(x):
    return halved(halved(x))


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


def test_an_error_of_a_part_reaches_its_caller():
    """Without machine code or an environment of its own."""
    assert quarter_of(3.0) == 0.75
    with pytest.raises(ValueError, match="x must be >= 0"):
        quarter_of(-1.0)


WATCH = """
from numba.core import event

compiled = []

class Watch(event.Listener):
    def on_start(self, what):
        compiled.append(str(what.data["dispatcher"]))

    def on_end(self, what):
        pass

watched = event.install_listener("numba:compile", Watch())
"""

SEARCH = f"""
{WATCH}
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.compiled import call_compiled
from suspension_ctrl.paper import experiment
problem = experiment.ride_problem()
with watched:
    for optimiser in (Nsga2(population=20), MoeadDra(population=20, utility_period=1)):
        run = minimise(problem, optimiser, iterations=2, seed=0)
    call_compiled(problem.kernel, run.designs[0].copy())
print(len(compiled), run.objectives.tobytes().hex())
"""

IMPORT = f"""
{WATCH}
import pkgutil
from importlib import import_module
with watched:
    import suspension_ctrl
    for module in pkgutil.walk_packages(suspension_ctrl.__path__, "suspension_ctrl."):
        import_module(module.name)
    imported = len(compiled)
    import numba
    numba.njit(lambda x: x)(1)
print(imported, len(compiled))
"""


def test_a_second_process_compiles_nothing(tmp_path):
    """Searches of both algorithms are stored as a whole, the sweep of MOEA/D-DRA with its verbs too.

    The store holds the kernel twice: at its address for the sweep, and with a wrapper for Python.
    """
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    command = [sys.executable, "-c", SEARCH]
    (first, found), (second, again) = (subprocess.check_output(command, env=environment).split() for _ in range(2))
    assert 10 < int(first) < 60
    assert int(second) == 0
    assert again == found


OPTIMISERS = {"nsga2": Nsga2(population=24), "moead-dra": MoeadDra(population=24)}

PLAIN = """
import sys
import numpy as np
sys.path[:0] = [{tests!r}, {tests!r} + '/search']
from test_compiled import run
np.save({path!r}, run({name!r}))
"""


def run(name: str) -> np.ndarray:
    """What two searches end with, long enough for MOEA/D-DRA to update its utilities; one has constraints."""
    runs = [
        minimise(problem, OPTIMISERS[name], iterations=60, seed=4) for problem in (dtlz2(5), srn(compiled=False))
    ]
    return np.concatenate([np.hstack([r.designs, r.objectives, r.constraints]).ravel() for r in runs])


@pytest.mark.parametrize("name", OPTIMISERS)
def test_compiled_or_plain_the_same_seed_gives_the_same_arrays(name, checkout, tmp_path):
    path = str(tmp_path / "plain.npy")
    program = PLAIN.format(tests=str(checkout / "tests"), name=name, path=path)
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", program], capture_output=True, check=True, env=environment)
    np.testing.assert_array_equal(run(name), np.load(path))


def test_nothing_is_compiled_at_import(tmp_path):
    """Numba tells of every compilation; the one made on purpose shows that the test would see one."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}  # nothing there to load instead
    done = subprocess.run(
        [sys.executable, "-c", IMPORT], capture_output=True, text=True, check=True, env=environment
    )
    assert done.stdout.split() == ["0", "1"]


def test_a_read_only_installation_without_a_home_compiles_in_every_process(tmp_path):
    """Files in place of the folders for caches stand for folders that cannot be written."""
    copy = tmp_path / "suspension_ctrl"
    shutil.copytree(Path(suspension_ctrl.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__"))
    for folder in [copy, *(path for path in copy.rglob("*") if path.is_dir())]:
        (folder / "__pycache__").touch()
    program = (
        "import numpy as np, suspension_ctrl as sc\n"
        "p = sc.Problem(evaluate=lambda x: np.c_[x, 1 - x], lower=(0,), upper=(1,), objectives=('a', 'b'))\n"
        "print(len(sc.minimise(p, sc.Nsga2(population=20), iterations=2, seed=0).designs), sc.__file__)"
    )
    kept = {name: value for name, value in os.environ.items() if name not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")}
    nowhere = {"HOME": str(tmp_path / "none" / "x"), "PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}
    (tmp_path / "none").touch()  # no folder can be made below it
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], env=kept | nowhere, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["20", str(copy / "__init__.py")]
