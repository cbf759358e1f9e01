"""A child of MOEA/D-DRA in a sweep: by this package's operators without arrays of their own, or by any verbs."""

from typing import Any, NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..compiled_verbs import call
from ..quantities import Integer, Real
from .operators import DifferentialChild, MutateDesign, RedrawOutside, differ, mutate_design, redraw_outside

WRONG_SIZE, OUTSIDE = -3, -4
"""Marks of children that a user's verbs made wrongly."""


class ChildInSweep(NamedTuple):
    """Reproduction, repair and mutation in place."""

    reproduce: DifferentialChild
    repair: RedrawOutside
    mutate: MutateDesign

    @uncounted(forceinline=True)
    def __call__(self, rng: np.random.Generator, designs: Real, i: int, partners: Integer, child: Real) -> int:
        """Put a child of individual i into `child` (d,) and return 0."""
        differ(self.reproduce, rng, designs, i, partners, child)
        redraw_outside(self.repair, rng, child, designs[i])
        mutate_design(self.mutate, rng, child)
        return 0


class ChildByVerbs(NamedTuple):
    """Reproduction, repair and mutation by verbs that return arrays, the last checked by the box, if any."""

    reproduce: Any
    repair: Any
    mutate: Any
    box: Real | None  # (2, d)

    @compilable()
    def __call__(self, rng: np.random.Generator, designs: Real, i: int, partners: Integer, child: Real) -> int:
        """Put a child of individual i into `child` (d,) and return 0, or the mark of a wrong one."""
        made = call(self.reproduce, (rng, designs, i, partners))
        if made.size != child.size:
            return WRONG_SIZE
        made = call(self.repair, (rng, made, designs[i]))
        if made.size != child.size:
            return WRONG_SIZE
        made = call(self.mutate, (rng, made))
        if made.size != child.size:
            return WRONG_SIZE
        for v in range(child.size):
            child[v] = made[v]
        if self.box is not None and not within(child, self.box):  # numba leaves out what None rules out
            return OUTSIDE
        return 0


@compilable()
def within(child: Real, box: Real) -> bool:
    """Whether a child (d,) is in the box (2, d)."""
    good = True
    for v in range(child.size):
        good = good and box[0, v] <= child[v] <= box[1, v]
    return good


def child_maker(reproduce: Any, repair: Any, mutate: Any, box: Real | None) -> Any:
    """Return the verb that makes a child by these three, in place where they are this package's."""
    verbs = reproduce, repair, mutate
    own = DifferentialChild, RedrawOutside, MutateDesign
    if all(type(verb) is kind for verb, kind in zip(verbs, own, strict=True)):
        return ChildInSweep(*verbs)
    return ChildByVerbs(*verbs, box)
