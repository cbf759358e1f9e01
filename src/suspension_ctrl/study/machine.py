"""Conditions of timed runs: one thread, and a record of processor, versions and threads."""

import os
import platform
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ..checks import installed
from ..threads import limited

PACKAGES = ("suspension-ctrl", "control", "deap", "moocore", "numba", "numpy", "pandas", "scipy")


def provenance() -> dict[str, str]:
    """Return the versions of the packages that determine a result."""
    return {name: version(name) for name in PACKAGES}


@contextmanager
def single_thread() -> Iterator[None]:
    """Limit evaluations and the thread pools of BLAS and numba to one thread: timings compare algorithms."""
    import numba

    with installed("study"):
        from threadpoolctl import threadpool_limits

    before = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        with threadpool_limits(limits=1), limited(1):
            yield
    finally:
        numba.set_num_threads(before)


def describe(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Return a record of the conditions: date, processor, versions, numbers of threads and arguments."""
    import numba

    with installed("study"):
        from threadpoolctl import threadpool_info

    keys = ("user_api", "internal_api", "version", "num_threads")
    pools = [{key: pool.get(key) for key in keys} for pool in threadpool_info()]
    return {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "processor": processor_name(),
        "cores": os.cpu_count(),
        "platform": platform.platform(),
        "python": sys.version.split()[0],
        "versions": provenance(),
        "threads": {"numba": numba.get_num_threads(), "pools": pools},
        "arguments": dict(arguments),
    }


def processor_name() -> str:
    """Return the name of the processor, from /proc if it exists."""
    cpuinfo = Path("/proc/cpuinfo")
    text = cpuinfo.read_text(encoding="utf-8", errors="replace") if cpuinfo.exists() else ""
    names = [line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
