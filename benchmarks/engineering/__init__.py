"""Engineering problems of the RE and CRE suites with up to four objectives, and what is known of their fronts.

R. Tanabe, H. Ishibuchi, "An easy-to-use real-world multi-objective optimization problem suite", Applied Soft
Computing 89, 2020. A problem RE with constraints takes the sum of their violations for its last objective; its
CRE counterpart keeps them. The formulas round whole and catalogue values, as the suite's do, for searches on real
variables alone.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from suspension_ctrl import Problem

from . import formulas
from .formulas import Answer, Real

Model = tuple[Callable[[Real], Answer], Sequence[float], Sequence[float]]

_MODELS: dict[str, Model] = {
    "RE21": (formulas.four_bar_truss, (1, np.sqrt(2), np.sqrt(2), 1), (3, 3, 3, 3)),
    "RE22": (formulas.reinforced_beam, (0.2, 1e-9, 0), (15, 20, 40)),  # the width's 0 would be divided by
    "RE23": (formulas.pressure_vessel, (1, 1, 10, 10), (100, 100, 200, 240)),
    "RE24": (formulas.hatch_cover, (0.5, 0.5), (4, 50)),
    "RE25": (formulas.coil_spring, (1, 0.6, 0.09), (70, 3, 0.5)),
    "RE31": (formulas.two_bar_truss, (1e-5, 1e-5, 1), (100, 100, 3)),
    "RE32": (formulas.welded_beam, (0.125, 0.1, 0.1, 0.125), (5, 10, 10, 5)),
    "RE33": (formulas.disc_brake, (55, 75, 1000, 11), (80, 110, 3000, 20)),
    "RE34": (formulas.crashworthiness, (1,) * 5, (3,) * 5),
    "RE35": (formulas.speed_reducer, (2.6, 0.7, 17, 7.3, 7.3, 2.9, 5), (3.6, 0.8, 28, 8.3, 8.3, 3.9, 5.5)),
    "RE36": (formulas.gear_train, (12,) * 4, (60,) * 4),
    "RE37": (formulas.rocket_injector, (0,) * 4, (1,) * 4),
    "RE41": (formulas.side_impact, (0.5, 0.45, 0.5, 0.5, 0.875, 0.4, 0.4), (1.5, 1.35, 1.5, 1.5, 2.625, 1.2, 1.2)),
    "RE42": (formulas.bulk_carrier, (150, 20, 13, 10, 14, 0.63), (274.32, 32.31, 25, 11.71, 18, 0.75)),
}
_KINDS: dict[str, Mapping[str, str | Sequence[float]]] = {
    "RE22": {"x1": formulas.BAR_AREAS.tolist()},
    "RE23": {"x1": "integer", "x2": "integer"},
    "RE25": {"x1": "integer", "x3": formulas.WIRES[formulas.WIRES >= 0.09].tolist()},
    "RE35": {"x3": "integer"},
    "RE36": dict.fromkeys(("x1", "x2", "x3", "x4"), "integer"),
}
_CONSTRAINED = {
    "CRE21": "RE31", "CRE22": "RE32", "CRE23": "RE33", "CRE24": "RE35", "CRE25": "RE36", "CRE31": "RE41",
    "CRE32": "RE42",
}  # fmt: skip

NAMES = (*_MODELS, *_CONSTRAINED)
"""All problems, "RE21" to "CRE32"."""


def problem(name: str) -> Problem:
    """Return the problem of this name of the suite."""
    model = _CONSTRAINED.get(name, name)
    formula, lower, upper = _MODELS[model]
    objectives, margins = formula(np.array([upper], dtype=float).T)
    separate = name in _CONSTRAINED
    m = len(objectives) + (1 if margins and not separate else 0)
    return Problem(
        evaluate=partial(_evaluate, formula, separate),
        lower=lower,
        upper=upper,
        objectives=tuple(f"f{j + 1}" for j in range(m)),
        constraints=tuple(f"g{j + 1}" for j in range(len(margins))) if separate else (),
        kinds=_KINDS.get(model, {}),
    )


def _evaluate(formula: Callable[[Real], Answer], separate: bool, designs: Real) -> NDArray[np.float64]:
    """Return objectives and margins below zero, (n, m + c), or with the sum of violations, (n, m)."""
    objectives, margins = formula(designs.T)
    if separate:
        return np.stack([*objectives, *(-margin for margin in margins)], axis=1)
    violation = [np.maximum(-np.array(margins), 0).sum(axis=0)] if margins else []
    return np.stack([*objectives, *violation], axis=1)
