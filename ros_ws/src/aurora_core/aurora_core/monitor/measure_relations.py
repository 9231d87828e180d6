# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of placements, relations in motion and behaviours between ground agents."""

from __future__ import annotations

import numpy as np

from aurora_core.conditions.placements import RELATION_WORDS
from aurora_core.errors import VerificationError
from aurora_core.monitor.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    FloatArray,
    Later,
    Measured,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.monitor.place_slack import before_place, place_slack
from aurora_core.monitor.shares import share_of
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.angle import bearing_error_deg, compass_bearing_deg
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.vocabulary import Relation
from aurora_core.trace.layout import GroundColumn

# A follower that is not behind its leader, or stands, has no time gap: this stands for it.
NO_TIME_GAP_S = 100.0


def relation_slack(context: Context, condition: Condition) -> FloatArray:
    """Return by how much a relation of two agents holds, (T,) metres; negative where it does not.

    Ahead, behind: along the route of the one that follows, on that route. Same lane: what is left
    of the lane to the offset. Left, right, beside: in the frame of the other one's heading.
    Oncoming: minus the cosine of the headings. Near, at: what is left of the distance. Adjacent
    lane: what is left of the lane next to the route of the other one, in its direction. For
    places see `place_slack`.
    """
    view, arguments = context.view, condition.arguments
    a, b = condition.of
    relation = arguments.relation
    if not view.has(b):
        return place_slack(context, condition)
    if relation in (Relation.AHEAD, Relation.BEHIND, Relation.BEFORE):
        follower, leader = (b, a) if relation is Relation.AHEAD else (a, b)
        along = context.along(follower, leader)
        left = arguments.offset_m - along.offset_m
        return np.where(left >= 0.0, along.lead_m, np.minimum(along.lead_m, left))
    if relation is Relation.SAME_LANE:
        return arguments.offset_m - context.along(b, a).offset_m
    if relation in (Relation.NEAR, Relation.AT):
        return arguments.high - motion.horizontal_distance(view, a, b)
    own, other = view.rows(view.body(a)), view.rows(view.body(b))
    hx, hy = other[:, GroundColumn.HEADING_X], other[:, GroundColumn.HEADING_Y]
    if relation is Relation.ONCOMING:
        gx, gy = own[:, GroundColumn.HEADING_X], own[:, GroundColumn.HEADING_Y]
        return -(gx * hx + gy * hy)
    if relation is Relation.ADJACENT_LANE:
        offset = context.along(b, a).offset_m
        beside = arguments.offset_m - np.abs(offset - 2.0 * arguments.offset_m)
        same_way = own[:, GroundColumn.HEADING_X] * hx + own[:, GroundColumn.HEADING_Y] * hy > 0.0
        return np.where(same_way, beside, np.minimum(beside, -offset))
    dx = own[:, GroundColumn.X] - other[:, GroundColumn.X]
    dy = own[:, GroundColumn.Y] - other[:, GroundColumn.Y]
    along_m, left_m = dx * hx + dy * hy, dy * hx - dx * hy
    if relation is Relation.LEFT:
        return left_m
    if relation is Relation.RIGHT:
        return -left_m
    if relation is Relation.BESIDE:
        half = (view.body(a).entry.length_m + view.body(b).entry.length_m) / 2.0
        return half - np.abs(along_m)
    raise VerificationError(f'condition {condition.id}: no signal for relation {relation}')


def measure_placement(context: Context, condition: Condition) -> Evaluation:
    """Relation, distance or bearing at t = 0.

    Aspects: none (slack of the relation), `distance`, `bearing`, `distance_start` and
    `distance_closing` (straight, when the closing starts), `overtake`.
    """
    aspect = condition.arguments.aspect
    if aspect == 'overtake':
        return _overtake(context, condition)
    tick = 0
    if aspect == 'distance_closing':
        body = context.view.body(condition.of[0])
        start = motion.closing_start_tick(context.view, body, condition.arguments.slow_mps)
        if start is None:
            if not context.complete(condition):
                return context.short(condition)
            story = f'{body.body_id} never moved'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        tick = start
    gone = context.gone(condition, np.array([tick], dtype=np.intp))
    if gone is not None:
        return gone
    value = float(_at_start(context, condition)[tick])
    return at_tick(tick, value, evidence=ground_topics(condition))


def _at_start(context: Context, condition: Condition) -> FloatArray:
    view, arguments = context.view, condition.arguments
    a, b = condition.of
    if arguments.aspect in ('distance_start', 'distance_closing'):
        return motion.distance(view, a, b)
    if arguments.aspect == 'distance':
        if arguments.relation is Relation.BEFORE and not view.has(b):
            return np.full(view.ticks, before_place(context, condition)[0])
        if arguments.relation is Relation.AHEAD:
            return context.along(b, a).lead_m
        if arguments.relation in (Relation.BEHIND, Relation.BEFORE):
            return context.along(a, b).lead_m
        if arguments.relation is Relation.SAME_LANE:
            return np.abs(context.along(b, a).lead_m)
        return motion.horizontal_distance(view, a, b)
    if arguments.aspect == 'bearing':
        return _bearing_error(context, condition)
    return relation_slack(context, condition)


def _bearing_error(context: Context, condition: Condition) -> FloatArray:
    a, b = condition.of
    delta = context.view.reference(a) - context.view.reference(b)
    bearing = compass_bearing_deg(delta[:, 0], delta[:, 1])
    return bearing_error_deg(bearing, condition.arguments.wanted)


def _overtake(context: Context, condition: Condition) -> Evaluation:
    """Metres by which an agent gets ahead, once it has been behind."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    end = context.together_until(condition)
    if isinstance(end, Missing):
        return end
    a, b = condition.of
    behind = context.along(a, b)  # on the route of the one that overtakes
    lead = np.where(behind.offset_m <= condition.arguments.offset_m, -behind.lead_m, 0.0)[:end]
    start = first_tick(lead < 0.0)
    if start is None:
        return Missing(reason=Reason.PREMISE_NEVER, story=f'{a} was never behind {b}')
    farthest = start + int(np.argmax(lead[start:]))
    most_m = float(lead[farthest])
    return at_tick(farthest, most_m, evidence=ground_topics(condition), later=Later.RISES)


def measure_relation_fraction(context: Context, condition: Condition) -> Evaluation:
    """Share of the time in which a relation holds; `bearing`: of a UAV from its target."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    view, arguments = context.view, condition.arguments
    a, b = condition.of
    good: BoolArray
    if arguments.aspect == 'bearing':
        values = _bearing_error(context, condition)
        good = values <= arguments.sample_tolerance
        what = f'{a} kept its bearing from {b}'
    else:
        values = relation_slack(context, condition)
        good = values > 0.0 if arguments.relation is not Relation.BESIDE else values >= 0.0
        words = (
            RELATION_WORDS.get(arguments.relation, '') if arguments.relation is not None else ''
        )
        what = f'{a} was {words} {b}'
    good = good & view.present(a) & view.present(b)
    return share_of(context, ticks, good, values, what, ground_topics(condition))


def measure_follow_fraction(context: Context, condition: Condition) -> Evaluation:
    """Share of the time with the gap inside its limits, which depend on the follower's speed."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    view, arguments = context.view, condition.arguments
    a, b = condition.of
    along = context.along(a, b)
    moving = motion.speed(view, view.body(a)) > arguments.slow_mps
    low = np.where(moving, arguments.low, arguments.slow_low)
    high = np.where(moving, arguments.high, arguments.slow_high)
    good = (along.gap_m >= low) & (along.gap_m <= high)
    good &= (along.offset_m <= arguments.offset_m) & view.present(a) & view.present(b)
    return share_of(
        context, ticks, good, along.gap_m, f'{a} followed {b}', ground_topics(condition)
    )


def measure_time_gap(context: Context, condition: Condition) -> Evaluation:
    """Bumper gap divided by the follower's speed; NO_TIME_GAP_S where that means nothing."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    view, arguments = context.view, condition.arguments
    a, b = condition.of
    along = context.along(a, b)
    speed = motion.speed(view, view.body(a))
    valid = (speed > arguments.slow_mps) & (along.lead_m > 0.0)
    valid &= (along.offset_m <= arguments.offset_m) & view.present(a) & view.present(b)
    gap = np.maximum(along.gap_m, 0.0) / np.where(valid, speed, 1.0)
    values = np.where(valid, np.minimum(gap, NO_TIME_GAP_S), NO_TIME_GAP_S)
    return Measured(ticks=ticks, values=values[ticks], evidence=ground_topics(condition))


def measure_distance_travelled(context: Context, condition: Condition) -> Evaluation:
    """Metres covered within the window."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    last = int(ticks[-1])
    value = float(motion.travelled(context.view, context.view.body(condition.of[0]))[last])
    story = f'{condition.of[0]} covered {value:.2f} m by {context.time_s(last):.2f} s'
    return at_tick(last, value, story, ground_topics(condition), later=Later.RISES)
