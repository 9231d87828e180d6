# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of what one vehicle does on its lane: changing it, driving faster than it allows."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

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
from aurora_core.quantities.lanes import (
    NO_LANE,
    LaneArray,
    edge_of,
    edges_with_several_lanes,
    lane_before,
    lane_change_ticks,
    lane_of,
)
from aurora_core.quantities.ticks import whole_ticks


def measure_lane_change(context: Context, condition: Condition) -> Evaluation:
    """Seconds for which a lane was kept after the change to it, of the change kept longest."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    end = context.together_until(condition)
    if isinstance(end, Missing):
        return end
    view = context.view
    body = view.body(condition.of[0])
    lanes = lane_of(view, body)[:end]
    several = edges_with_several_lanes(view.world)
    if not any(edge_of(view.world.lanes[k]) in several for k in _visited(lanes)):
        story = f'{body.body_id} was never on a street with another lane to change to'
        return Missing(reason=Reason.PREMISE_NEVER, story=story)
    changes = lane_change_ticks(view, lanes)
    if not changes:
        story = f'{body.body_id} kept to its lane'
        return at_tick(0, 0.0, story, ground_topics(condition), later=Later.RISES)
    kept = _kept(changes, lanes, end, whole_ticks(condition.threshold, view.dt_s))
    longest = int(np.argmax(kept))
    tick = changes[longest]
    kept_s = context.time_s(kept[longest])
    story = (
        f'{body.body_id} changed lane at {context.time_s(tick):.2f} s and kept to the new one for '
        f'{kept_s:.2f} s'
    )
    return at_tick(tick, kept_s, story, ground_topics(condition), later=Later.RISES)


def _kept(changes: list[int], lanes: LaneArray, end: int, least: int) -> list[int]:
    """Return for how many ticks each change lasted; going back before `least` is none."""
    kept: list[int] = []
    for k, (tick, stop) in enumerate(pairwise([*changes, end - 1])):
        back = k > 0 and kept[-1] < least and lanes[tick] == lane_before(lanes, changes[k - 1])
        kept.append(0 if back else stop - tick)
    return kept


def _visited(lanes: LaneArray) -> list[int]:
    found: list[int] = np.unique(lanes[lanes != NO_LANE]).tolist()
    return found


def measure_over_limit(context: Context, condition: Condition) -> Evaluation:
    """Metres per second by which the speed limit of the present lane was exceeded most."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    end = context.together_until(condition)
    if isinstance(end, Missing):
        return end
    view = context.view
    body = view.body(condition.of[0])
    lanes = lane_of(view, body)[:end]
    values = motion.speed(view, body)[:end]
    driven = np.flatnonzero((lanes != NO_LANE) & (values >= condition.arguments.slow_mps))
    if len(driven) == 0:
        story = f'{body.body_id} never drove on a street'
        return Missing(reason=Reason.PREMISE_NEVER, story=story)
    limits = np.array([lane.speed_limit_mps for lane in view.world.lanes])
    over = values[driven] - limits[lanes[driven]]
    most = int(np.argmax(over))
    tick = int(driven[most])
    return at_tick(tick, float(over[most]), evidence=ground_topics(condition), later=Later.RISES)
