"""State space as plain arrays, with which the library computes: python-control takes long to import."""

from typing import TYPE_CHECKING, NamedTuple

from ..quantities import Real

if TYPE_CHECKING:
    import control


class StateMatrices(NamedTuple):
    """x' = A x + B u and y = C x + D u with the names of their signals, as attributes of `control.StateSpace`."""

    A: Real  # (n, n)
    B: Real  # (n, p)
    C: Real  # (m, n)
    D: Real  # (m, p)
    state_labels: list[str]
    input_labels: list[str]
    output_labels: list[str]
    name: str | None = None

    @property
    def nstates(self) -> int:
        """Number n of states."""
        return len(self.state_labels)

    @property
    def ninputs(self) -> int:
        """Number p of inputs."""
        return len(self.input_labels)

    @property
    def noutputs(self) -> int:
        """Number m of outputs."""
        return len(self.output_labels)

    def system(self) -> "control.StateSpace":
        """Return the same as a system of python-control."""
        import control

        names = {"states": self.state_labels, "inputs": self.input_labels, "outputs": self.output_labels}
        return control.ss(*self[:4], **names, name=self.name)
