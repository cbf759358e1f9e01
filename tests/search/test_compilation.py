"""What is compiled, when, and that it gives what plain Python gives."""

import os
import subprocess
import sys

import numpy as np
import pytest

from functions import dtlz2, srn
from suspension_ctrl import MoeadDra, Nsga2, minimise

OPTIMISERS = {"nsga2": Nsga2(population=24), "moead-dra": MoeadDra(population=24)}

PLAIN = """
import sys
import numpy as np
sys.path[:0] = [{tests!r}, {tests!r} + '/search']
from test_compilation import run
np.save({path!r}, run({name!r}))
"""

IMPORT = """
import pkgutil
from importlib import import_module
from numba.core import event

compiled = []

class Watch(event.Listener):
    def on_start(self, what):
        compiled.append(str(what.data["dispatcher"]))

    def on_end(self, what):
        pass

with event.install_listener("numba:compile", Watch()):
    import suspension_ctrl
    for module in pkgutil.walk_packages(suspension_ctrl.__path__, "suspension_ctrl."):
        import_module(module.name)
    imported = len(compiled)
    import numba
    numba.njit(lambda x: x)(1)
print(imported, len(compiled))
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
