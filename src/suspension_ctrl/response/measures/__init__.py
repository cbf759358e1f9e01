"""Measures of a ride and of handling, and limits on them.

A measure has a text: a word and a place, ``SWS front``, with ``-`` in front if more is better, and a name of its
own in ``comfort = ACC driver``. `Measure.parse` reads it, ``str`` writes it. A class has all of a measure: its
word, its unit, and its terms in a load case.
"""

from . import comfort, dose, gaussian, handling, limits, modal, peak, power, robust, vibration

__all__ = ["comfort", "dose", "gaussian", "handling", "limits", "modal", "peak", "power", "robust", "vibration"]
