# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Until when a condition can be judged, and what has not happened by then."""

from __future__ import annotations

from aurora_core.judging.evaluation import Context, Later, Measured, Missing, at_tick
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick


def existing_until(context: Context, condition: Condition) -> int | Missing:
    """Return the tick before which all bodies of a condition exist in its window."""
    ticks = context.window(condition)
    return ticks if isinstance(ticks, Missing) else context.together_until(condition)


def moving_until(context: Context, condition: Condition, moving_mps: float) -> int | Missing:
    """Return the same tick, for what only a body that has moved can do."""
    end = existing_until(context, condition)
    if isinstance(end, Missing):
        return end
    body = context.view.body(condition.of[0])
    if first_tick(motion.speed(context.view, body) >= moving_mps, 0, end) is None:
        return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
    return end


def not_yet(
    context: Context,
    condition: Condition,
    tick: int,
    earliest_s: float,
    story: str,
    topics: tuple[str, ...],
) -> Measured:
    """Return the measurement of a deadline for what has not happened by the end of the record.

    One tick after the deadline stands for "never" where the run is over before it; should the run
    go on, what is asked can still happen in time.
    """
    if earliest_s > condition.threshold:
        return at_tick(tick, earliest_s, story, topics, later=Later.RISES, provisional=True)
    never_s = condition.threshold + context.view.dt_s
    return at_tick(tick, never_s, story, topics, later=Later.ANY, provisional=True)
