# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Quantities with a value at every sample: the worst one, a stretch or a share counts."""

from __future__ import annotations

from abc import abstractmethod

from aurora_core.document import omitted
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Measured,
    Missing,
    TickArray,
)
from aurora_core.judging.quantity import PerSample, Quantity
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition


class Series(Quantity):
    """A quantity with a value at every sample while all its bodies are there."""

    @abstractmethod
    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the value at every tick, (T,)."""

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the values in the window."""
        ticks = self.ticks(context, condition)
        if isinstance(ticks, Missing):
            return ticks
        values = self.values(context, condition)
        return Measured(ticks=ticks, values=values[ticks], evidence=self.topics(condition))

    def ticks(self, context: Context, condition: Condition) -> TickArray | Missing:
        """Return the ticks to judge, or why there are none."""
        ticks = context.window(condition)
        return ticks if isinstance(ticks, Missing) else context.with_bodies(condition, ticks)

    def topics(self, condition: Condition) -> tuple[str, ...]:
        """Return the evidence."""
        return tuple(f'state[{name}]' for name in condition.of)


class StatedSeries(Series):
    """A series that prompts state numbers of.

    Attributes:
        share: The share of the samples that are so counts, in place of the worst one.
    """

    share: PerSample | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the values in the window, or the share of the good ones."""
        if self.share is None:
            return super().measure(context, condition)
        ticks = self.ticks(context, condition)
        if isinstance(ticks, Missing):
            return ticks
        values = self.values(context, condition)
        return share_of(context, ticks, self.share.good(values), values)
