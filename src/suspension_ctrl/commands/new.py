"""A study file to begin with: a commented template, complete as it is."""

from . import options as o

KINDS = ("quarter-car", "half-car", "full-car", "multibody")


def new(kind: o.Kind, out: o.NewFile) -> None:
    """Write a commented study of one kind of vehicle.

    It runs as it is and is there to be changed. Kinds are quarter-car, half-car, full-car and multibody. A file
    that exists is not written over.
    """
    from .. import checks, datafiles
    from ..tables import write_bytes
    from . import terminal

    checks.one_of("kind", kind, KINDS)
    if out.exists():
        raise ValueError(f"out must be a file that does not exist yet, got {checks.shown(str(out))}")
    write_bytes(out, datafiles.path(f"templates/{kind}.toml").read_bytes())
    terminal.end(out)
