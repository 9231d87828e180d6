# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of manoeuvres of one agent: how far it slowed down, turned, crossed."""

from __future__ import annotations

import numpy as np

from aurora_core.knowledge.world import SurfaceKind
from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.angle import compass_bearing_deg
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.stl.windows import Extremum, sliding_clipped
from aurora_core.trace.layout import GroundColumn


def _until(context: Context, condition: Condition) -> int | Missing:
    ticks = context.window(condition)
    return ticks if isinstance(ticks, Missing) else context.together_until(condition)


def _moving_until(context: Context, condition: Condition) -> int | Missing:
    end = _until(context, condition)
    if isinstance(end, Missing):
        return end
    body = context.view.body(condition.of[0])
    moving = motion.speed(context.view, body) >= condition.arguments.slow_mps
    if first_tick(moving, 0, end) is None:
        return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
    return end


def measure_greatest_drop(context: Context, condition: Condition) -> Evaluation:
    """Metres per second by which the speed fell below one that was driven before."""
    end = _moving_until(context, condition)
    if isinstance(end, Missing):
        return end
    values = motion.speed(context.view, context.view.body(condition.of[0]))[:end]
    drop = np.maximum.accumulate(values) - values
    tick = int(np.argmax(drop))
    return at_tick(tick, float(drop[tick]), evidence=ground_topics(condition), later=Later.RISES)


def measure_turn(context: Context, condition: Condition) -> Evaluation:
    """Degrees by which the heading changed to the `left` or `right` within `high` seconds."""
    end = _moving_until(context, condition)
    if isinstance(end, Missing):
        return end
    arguments = condition.arguments
    rows = context.view.rows(context.view.body(condition.of[0]))[:end]
    bearing = compass_bearing_deg(rows[:, GroundColumn.HEADING_X], rows[:, GroundColumn.HEADING_Y])
    step = bearing[1:] - bearing[:-1]
    step = np.where(step > 180.0, step - 360.0, np.where(step < -180.0, step + 360.0, step))
    turned = np.concatenate(([0.0], np.add.accumulate(step)))  # clockwise since t = 0
    if arguments.aspect == 'left':
        turned = -turned
    width = whole_ticks(arguments.high, context.view.dt_s) + 1
    least_before = sliding_clipped(turned[::-1], width, Extremum.LEAST)[::-1]
    tick = int(np.argmax(turned - least_before))
    value = float(turned[tick] - least_before[tick])
    return at_tick(tick, value, evidence=ground_topics(condition), later=Later.RISES)


def measure_crossing(context: Context, condition: Condition) -> Evaluation:
    """Metres from where a carriageway was entered to where it was left, of the widest crossing."""
    end = _until(context, condition)
    if isinstance(end, Missing):
        return end
    name = condition.of[0]
    point = context.view.reference(name)[:end, :2]
    on = context.view.geometry.surfaces(SurfaceKind.DRIVING).contains(point)
    edges = np.flatnonzero(np.diff(on.astype(np.int8)))
    entered = edges[~on[edges]]
    if len(entered) == 0:
        story = f'{name} never stepped onto a carriageway'
        return Missing(reason=Reason.PREMISE_NEVER, story=story)
    widest, tick = 0.0, int(entered[0])
    for before in entered.tolist():
        after = first_tick(~on, before + 1)
        if after is None:
            continue
        dx, dy = (point[after] - point[before]).tolist()
        width = distance_2d(float(dx), float(dy))
        if width > widest:
            widest, tick = width, after
    return at_tick(tick, widest, evidence=ground_topics(condition), later=Later.RISES)
