"""The machine a result was made on: threads held at one, and a record of what ran."""

import os
import platform
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numba
from threadpoolctl import threadpool_info, threadpool_limits

_PACKAGES = ("suspension-ctrl", "control", "deap", "moocore", "numba", "numpy", "pandas", "scipy")


@contextmanager
def single_thread() -> Iterator[None]:
    """Hold the thread pools of BLAS and numba at one thread, so that timings compare algorithms."""
    before = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        with threadpool_limits(limits=1):
            yield
    finally:
        numba.set_num_threads(before)


def describe(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return what a reader needs to judge timings: processor, versions, threads in force and arguments."""
    pools = [{key: pool.get(key) for key in ("user_api", "internal_api", "version", "num_threads")}
             for pool in threadpool_info()]  # fmt: skip
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "processor": processor_name(),
        "cores": os.cpu_count(),
        "platform": platform.platform(),
        "python": sys.version.split()[0],
        "versions": {name: version(name) for name in _PACKAGES},
        "threads": {"numba": numba.get_num_threads(), "pools": pools},
        "arguments": arguments,
    }


def processor_name() -> str:
    """Return the processor's name as the system tells it."""
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        if names:
            return names[0].split(":", 1)[1].strip()
    return platform.processor() or platform.machine()
