"""Compilation: none at import nor in a second process, none needed, and the same arrays without it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest
from numba import njit, typeof

import suspension_ctrl
from functions import dtlz2, srn
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.compiled import alike, compilable, compiled, entry, filling, once


@compilable()
def halved(x):
    if x < 0:
        raise ValueError("x must be >= 0")
    return 0.5 * x


@njit
def quarter_of(x):
    return halved(halved(x))


def test_an_error_of_a_part_reaches_its_caller():
    """Without machine code or an environment of its own."""
    assert quarter_of(3.0) == 0.75
    with pytest.raises(ValueError, match="x must be >= 0"):
        quarter_of(-1.0)


def reciprocals(x, result):
    for i in range(x.size):
        result[i] = 1.0 / x[i]


def test_functions_that_fill_arrays_divide_as_numpy_does(tmp_path, monkeypatch):
    """Without an error by zero; arrays have no counts of references in them."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    fill, result = filling()(reciprocals), np.empty(2)
    fill(np.array([0.0, 4.0]), result)
    np.testing.assert_array_equal(result, [np.inf, 0.25])
    (code,) = fill.inspect_llvm().values()
    assert "NRT_incref" not in code


def total(x):
    found = 0.0
    for i in range(x.size):
        found += x[i]
    return found


def test_loops_that_are_not_unrolled_have_one_body_and_the_same_bits(tmp_path, monkeypatch):
    """The sum of 100 numbers, in order: one addition in the machine code."""
    numbers, bodies = np.random.default_rng(0).normal(size=100), {}
    for unrolled in (True, False):
        monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / str(unrolled)))  # stored code is not shown
        function = compiled(unrolled=unrolled, _nrt=False)(total)
        assert function(numbers) == total(numbers)
        code = function.inspect_asm(function.signatures[0])
        bodies[unrolled] = len(re.findall(r"\bv?addsd\b|\bfadd\b", code))
    assert bodies[False] == 1 < bodies[True]


def squared(x, y):
    for i in range(x.size):
        y[i] = x[i] * x[i]


def test_loops_that_are_not_interleaved_are_shorter_and_give_the_same_bits(tmp_path, monkeypatch):
    """The squares of 101 numbers: fewer multiplications in the machine code."""
    numbers, length = np.random.default_rng(0).normal(size=101), {}
    for interleaved in (True, False):
        monkeypatch.setattr(
            numba.config, "CACHE_DIR", str(tmp_path / str(interleaved))
        )  # stored code is not shown
        function, squares = compiled(interleaved=interleaved, _nrt=False)(squared), np.empty(101)
        function(numbers, squares)
        np.testing.assert_array_equal(squares, numbers**2)
        code = function.inspect_asm(function.signatures[0])
        length[interleaved] = len(re.findall(r"\bv?mulpd\b|\bfmul\b", code))
    assert 0 < length[False] < length[True]


def test_what_is_alike_is_of_one_type():
    """Arrays by kind of number, dimensions, order, and whether they may be written and lie aligned."""
    table, bytes_ = np.zeros((4, 3)), np.zeros(25, dtype=np.uint8)
    fixed = table.copy()
    fixed.flags.writeable = False
    arguments = [
        table, np.ones((2, 5)), table.T, table[:, ::2], table[0], fixed, bytes_[1:].view(float), np.zeros(2, bool),
        np.zeros(3, np.int32), np.zeros(3, np.int64), 1.0, 2.0, True, 3, None, (1.0, table), (2.0, fixed),
        np.random.default_rng(0), quarter_of,
    ]  # fmt: skip
    for one in arguments:
        for other in arguments:
            same = alike(one) == alike(other)
            assert not same or typeof(one) == typeof(other)
    assert alike(table) == alike(np.ones((2, 5)))
    assert alike((1.0, table)) == alike((2.0, np.ones((2, 5)))) != alike((2.0, fixed))


@njit
def increased(x):
    return x + 1


def test_machine_code_is_that_of_the_types():
    assert entry(increased, (1,)) is entry(increased, (5,))
    assert entry(increased, (1,)) is not entry(increased, (1.0,))
    assert (entry(increased, (1,))(2), entry(increased, (1.0,))(2.5)) == (3, 3.5)
    assert entry(halved, (1.0,)) is halved


def test_what_is_kept_is_made_once_and_has_a_limit():
    made, kept = [], {}
    for key in (*range(1000), 0, 999, "one more", 0):
        once(kept, key, lambda key=key: made.append(key) or [key])
    assert made == [*range(1000), "one more", 0]
    assert len(kept) == 2


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
from suspension_ctrl.compiled_verbs import call_compiled
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
