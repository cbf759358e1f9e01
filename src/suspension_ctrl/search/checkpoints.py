"""Runs in ``.npz`` files of arrays and JSON; reading one executes nothing."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from .. import checks
from ..quantities import FrozenMapping
from ..tables.atomic import write_whole
from .gamultiobj import Gamultiobj
from .moead_dra import MoeadDra
from .nsga2 import Nsga2
from .population import State
from .run import Checkpoint, Log, Run
from .sampling import Sampling

OPTIMISERS = {kind.__name__: kind for kind in (Nsga2, MoeadDra, Gamultiobj, Sampling)}
"""Optimisers whose settings can be saved."""

LARGEST = 2000.0
"""Maximum size of a file [MB]."""

_ARRAYS = ("designs", "objectives", "constraints")
_NUMBERS = ("evaluations", "seed", "failures", "repeats")


def save(run: Run, path: Path) -> None:
    """Write a run to a file atomically."""
    optimiser, state, generator = run.checkpoint
    kind = type(optimiser).__name__
    if state is None:
        raise ValueError("run must have designs to be saved, got none")
    if OPTIMISERS.get(kind) is not type(optimiser):
        raise ValueError(f"optimiser must be one of {', '.join(OPTIMISERS)} to be saved, got {kind}")
    text = {
        "optimiser": [kind, asdict(optimiser)],
        "generator": dict(generator),
        "headers": run.headers,
        "columns": run.log.columns,
        **{name: getattr(run, name) for name in _NUMBERS},
    }
    arrays = {f"memory_{name}": value for name, value in state.memory.items()}
    arrays |= {name: getattr(run, name) for name in _ARRAYS} | {f"state_{n}": getattr(state, n) for n in _ARRAYS}
    arrays |= {"ideal": state.ideal, "rows": np.array(run.log.rows), "text": np.array(json.dumps(text))}
    write_whole(path, lambda temporary: _write(temporary, arrays))


def _write(path: Path, arrays: dict[str, Any]) -> None:
    with path.open("wb") as file:  # numpy would change the ending of a name
        np.savez(file, allow_pickle=False, **arrays)


def load(path: Path) -> Run:
    """Return the run in a file; ValueError if the file was not written by `save` or is damaged."""
    checks.regular(path, LARGEST)
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        text = json.loads(str(arrays["text"]))
        kind, settings = text["optimiser"]
        optimiser = OPTIMISERS[kind](**settings)
        memory = {name.removeprefix("memory_"): x for name, x in arrays.items() if name.startswith("memory_")}
        own = {name: arrays[f"state_{name}"] for name in _ARRAYS}
        state = State(**own, ideal=arrays["ideal"], evaluations=text["evaluations"], memory=FrozenMapping(memory))
        columns = tuple(text["columns"])
        rows = tuple((int(i), int(n), *rest) for i, n, *rest in arrays["rows"].tolist())
        last = dict(zip(columns, rows[-1], strict=True))
        np.random.default_rng(0).bit_generator.state = text["generator"]
        return Run(
            **{name: arrays[name] for name in _ARRAYS},
            **{name: text[name] for name in _NUMBERS},
            headers=tuple(text["headers"]),
            seconds=last["seconds"],
            cpu_seconds=last["cpu_seconds"],
            log=Log(columns, rows),
            checkpoint=Checkpoint(optimiser, state, text["generator"]),
        )
    except (BadZipFile, EOFError, LookupError, OSError, TypeError, ValueError) as error:
        if isinstance(error, FileNotFoundError):
            raise
        raise ValueError(f"{str(path)!r} must be a run written by save, got another or a spoilt file") from None
