# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a prompt states an annotated number.

What a specification calls explicit gets a condition of its own (the altitude is held, the link
has that loss), and needs a span. Of a reference these spans come from the reader of numbers that
the validator uses, which shares nothing with the product's parser.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from aurora_bench.prompts.documents import Doc
from aurora_bench.prompts.numerals import Dimension, stated_numbers

# Rounding in an annotation, e.g. 500 ft as 152.4 m.
_RELATIVE = 0.005
# "About 40 m" widens a tolerance to so much (the contract's figure).
_ABOUT = 0.10
_DIMENSIONS: Mapping[str, tuple[Dimension, ...]] = MappingProxyType(
    {
        'm': (Dimension.LENGTH, Dimension.BARE),
        's': (Dimension.TIME, Dimension.BARE),
        'm/s': (Dimension.SPEED, Dimension.BARE),
        'm/s^2': (Dimension.ACCELERATION,),
        'deg': (Dimension.ANGLE, Dimension.BARE),
        '1': (Dimension.SHARE, Dimension.BARE),
    }
)


class StatedSpans:
    """The numbers of one prompt and where they stand."""

    def __init__(self, prompt: str) -> None:
        """Read the numbers of a prompt."""
        self._length = len(prompt)
        self._numbers = stated_numbers(prompt)

    def of(self, value: float, unit: str) -> Doc:
        """Return the span of a number as a document.

        The first place that states it; the whole prompt where none does, because the number
        follows from what is said ("half of them", "without any loss").

        Args:
            value: In `unit`.
            unit: SI unit of the specification.
        """
        for dimension in _DIMENSIONS.get(unit, (Dimension.BARE,)):
            for number in self._numbers:
                near = abs(number.value - value) <= max(_RELATIVE * abs(value), 1e-6)
                if number.dimension is dimension and near:
                    return {'start': number.start, 'end': number.start + len(number.text)}
        return {'start': 0, 'end': self._length}


def binding(value: float, low: float, high: float) -> Doc:
    """Return how a number binds whose annotated range is [low, high].

    A range that goes a tenth or more to both sides is "about" the value: that tolerance lies
    inside of it, so that who keeps the one has kept the other. One that goes so far to one side
    and begins at the value is a bound ("at least 40 m"). A narrower one is the number itself.
    """
    about = _ABOUT * abs(value) * (1.0 - 1e-9)
    below, above = (0.0 < about <= value - low), (0.0 < about <= high - value)
    if below and above:
        return {'approximate': True}
    if below and value == high:
        return {'bound': 'at_most'}
    return {'bound': 'at_least'} if above and value == low else {}
