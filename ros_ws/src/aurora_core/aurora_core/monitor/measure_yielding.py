# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of yielding: one gets slower, or waits, and the other one passes first.

The other one passes when it gets ahead on the way of the one that yields: it crosses that way,
joins it, or overtakes there.
"""

from __future__ import annotations

import numpy as np

from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.monitor.measure_actions import measure_passed_after
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick


def _ahead(context: Context, condition: Condition, end: int) -> FloatArray:
    """Return by how much the other one is ahead on the way of the one that yields, (end,) m."""
    along = context.along(*condition.of)
    left = condition.arguments.offset_m - along.offset_m
    ahead: FloatArray = np.where(left >= 0.0, along.lead_m, np.minimum(along.lead_m, left))
    return ahead[:end]


def measure_yielding(context: Context, condition: Condition) -> Evaluation:
    """Aspects: `passed` (metres), `slower` (m/s, until the other one has passed), `passed_after`.

    The last one counts from an event on.
    """
    if condition.arguments.aspect == 'passed_after':
        return measure_passed_after(context, condition)
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    end = context.together_until(condition)
    if isinstance(end, Missing):
        return end
    a, b = condition.of
    offset = context.along(a, b).offset_m[:end]
    if first_tick(offset <= condition.arguments.offset_m) is None:
        story = f'{b} never came to the way of {a}'
        return Missing(reason=Reason.PREMISE_NEVER, story=story)
    ahead = _ahead(context, condition, end)
    start = first_tick(ahead <= 0.0)
    if start is None:
        story = f'{b} was ahead of {a} all the time: there was nothing to yield to'
        return Missing(reason=Reason.PREMISE_NEVER, story=story)
    if condition.arguments.aspect == 'passed':
        farthest = start + int(np.argmax(ahead[start:]))
        most_m = float(ahead[farthest])
        return at_tick(farthest, most_m, evidence=ground_topics(condition), later=Later.RISES)
    return _slower(context, condition, end, first_tick(ahead > 0.0, start))


def _slower(context: Context, condition: Condition, end: int, passed: int | None) -> Evaluation:
    body = context.view.body(condition.of[0])
    speed = motion.speed(context.view, body)[:end]
    moved = first_tick(speed >= condition.arguments.slow_mps)
    if moved is None:
        return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
    if passed is not None and passed <= moved:
        # It waited: what it drives afterwards is what it did not drive before.
        tick = int(np.argmax(speed))
        value = float(speed[tick])
    else:
        until = speed if passed is None else speed[: passed + 1]
        drop = np.maximum.accumulate(until) - until
        tick = int(np.argmax(drop))
        value = float(drop[tick])
    return at_tick(tick, value, evidence=ground_topics(condition), later=Later.RISES)
