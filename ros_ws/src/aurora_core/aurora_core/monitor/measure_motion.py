# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of distance, altitude, speed: a value at every tick of the window."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import numpy as np

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
)
from aurora_core.monitor.measure_actions import measure_speed_before_event
from aurora_core.monitor.measure_manoeuvres import measure_greatest_drop
from aurora_core.monitor.shares import share_of
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import contact, free_road, motion
from aurora_core.quantities.kernels import bound_error, distance_2d
from aurora_core.quantities.ticks import first_tick
from aurora_core.quantities.waypoints import pattern_centre
from aurora_core.spec.parameter import Bound
from aurora_core.trace.layout import UavCommandColumn

_Series = Callable[[Context, Condition], FloatArray]


def _distance(context: Context, condition: Condition) -> FloatArray:
    return motion.distance(context.view, condition.of[0], condition.of[1])


def _horizontal(context: Context, condition: Condition) -> FloatArray:
    if condition.arguments.aspect == 'centre':
        mission = condition.arguments.mission
        if mission is None:
            raise VerificationError(f'condition {condition.id} names no mission')
        x, y = pattern_centre(mission.waypoints)
        point = context.view.reference(condition.of[0])
        return distance_2d(point[:, 0] - x, point[:, 1] - y)
    return motion.horizontal_distance(context.view, condition.of[0], condition.of[1])


def _altitude(context: Context, condition: Condition) -> FloatArray:
    uav = context.view.body(condition.of[0])
    if condition.arguments.aspect == 'commanded':
        return context.view.commands(uav)[:, UavCommandColumn.Z]
    return motion.altitude(context.view, uav)


def _speed(context: Context, condition: Condition) -> FloatArray:
    view, aspect = context.view, condition.arguments.aspect
    body = view.body(condition.of[0])
    if aspect == 'horizontal':
        return motion.horizontal_speed(view, body)
    if aspect == 'commanded':
        return motion.commanded_speed(view, body)
    if aspect == 'greatest':
        each = np.stack([motion.speed(view, view.body(name)) for name in condition.of])
        greatest: FloatArray = np.max(each, axis=0)
        return greatest
    return motion.speed(view, body)


def _separation(context: Context, condition: Condition) -> FloatArray:
    pairs = combinations(condition.of, 2)
    each = np.stack([contact.separation(context.view, a, b) for a, b in pairs])
    # Of a group the pair counts that is worst: an upper bound has to hold for the farthest one.
    upper = condition.op in ('<', '<=')
    if condition.arguments.aspect == 'share':
        upper = condition.arguments.bound is Bound.AT_MOST
    worst: FloatArray = np.max(each, axis=0) if upper else np.min(each, axis=0)
    return worst


def _climb(context: Context, condition: Condition) -> FloatArray:
    return motion.climb_rate(context.view, context.view.body(condition.of[0]))


def _measure(context: Context, condition: Condition, series: _Series) -> Evaluation:
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    if condition.arguments.aspect != 'greatest':
        ticks = context.with_bodies(condition, ticks)
        if isinstance(ticks, Missing):
            return ticks
    values = series(context, condition)
    arguments = condition.arguments
    if arguments.aspect == 'share':
        off = bound_error(values, arguments.wanted, arguments.bound)
        good = off < 0.0 if arguments.strict else off <= arguments.sample_tolerance
        return share_of(context, ticks, good, values)
    return Measured(ticks=ticks, values=values[ticks], evidence=_topics(condition))


def _topics(condition: Condition) -> tuple[str, ...]:
    commanded = condition.arguments.aspect == 'commanded'
    return tuple(f'{"uav/command" if commanded else "state"}[{name}]' for name in condition.of)


def measure_distance(context: Context, condition: Condition) -> Evaluation:
    """Samples of the 3-D distance; `closed_in`: how much it fell below the one at t = 0."""
    if condition.arguments.aspect == 'closed_in':
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        values = _distance(context, condition)
        both = context.view.present(condition.of[0]) & context.view.present(condition.of[1])
        # Only the time before one of them is gone counts.
        end = first_tick(~both)
        if end == 0:
            return Missing(reason=Reason.TARGET_GONE, story='not both are there at t = 0', tick=0)
        nearest = int(np.argmin(values[:end]))
        closer_m = float(values[0] - values[nearest])
        return at_tick(nearest, closer_m, evidence=_topics(condition), later=Later.RISES)
    return _measure(context, condition, _distance)


def measure_horizontal_distance(context: Context, condition: Condition) -> Evaluation:
    """Samples of the distance in the plane; `centre`: from the centre of the pattern."""
    return _measure(context, condition, _horizontal)


def measure_separation(context: Context, condition: Condition) -> Evaluation:
    """Samples of the 3-D distance of two bodies, of a group: of its worst pair."""
    return _measure(context, condition, _separation)


def measure_altitude(context: Context, condition: Condition) -> Evaluation:
    """Samples of the altitude; `commanded`: of the set-point."""
    return _measure(context, condition, _altitude)


def measure_climb_rate(context: Context, condition: Condition) -> Evaluation:
    """Samples of the vertical speed, upwards positive."""
    return _measure(context, condition, _climb)


def _free_speed(context: Context, condition: Condition) -> Evaluation:
    """Share of the samples on a free road (of a walker: while it walks) at the stated speed."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    gone = context.gone(condition, ticks)
    if gone is not None:
        return gone
    view, arguments = context.view, condition.arguments
    body = view.body(condition.of[0])
    values = motion.speed(view, body)
    if arguments.aspect == 'walking':
        free, never = values >= arguments.slow_mps, 'walked'
    else:
        free, never = _free_road(context, condition), 'drove free of leaders and junctions'
    ticks = ticks[free[ticks]]
    if len(ticks) == 0:
        story = f'{body.body_id} never {never}'
        return Missing(reason=Reason.EMPTY_PHASE, story=story)
    good = bound_error(values, arguments.wanted, arguments.bound) <= arguments.sample_tolerance
    what = f'{body.body_id} kept its speed'
    return share_of(context, ticks, good, values, what, _topics(condition))


def _free_road(context: Context, condition: Condition) -> BoolArray:
    view, arguments = context.view, condition.arguments
    body, *followed = (view.body(name) for name in condition.of)
    besides = tuple(other.body_id for other in followed)
    free = free_road.under_way(view, body, arguments.slow_mps, arguments.low)
    free &= free_road.free_of_junctions(view, body, arguments.high)
    free &= free_road.free_of_leaders(view, body, arguments.high, arguments.offset_m, besides)
    return free


def measure_speed(context: Context, condition: Condition) -> Evaluation:
    """Samples of the speed.

    Aspects: `horizontal`, `commanded`, `greatest` (of several bodies), `after_moving` (from when
    it first moved), `greatest_deceleration` and `greatest_drop` (one number), `free` (share on a
    free road, the second body being no leader), `walking` (share while it walks), `before_event`
    (until the trigger of what lets it set off).
    """
    aspect = condition.arguments.aspect
    if aspect == 'before_event':
        return measure_speed_before_event(context, condition)
    if aspect in ('free', 'walking'):
        return _free_speed(context, condition)
    if aspect == 'greatest_drop':
        return measure_greatest_drop(context, condition)
    if aspect not in ('after_moving', 'greatest_deceleration'):
        return _measure(context, condition, _speed)
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    body = context.view.body(condition.of[0])
    if aspect == 'greatest_deceleration':
        end = context.together_until(condition)
        if isinstance(end, Missing):
            return end
        loss = motion.deceleration(context.view, body)[:end]
        hardest = int(np.argmax(loss))
        most_mps2 = float(loss[hardest])
        return at_tick(hardest, most_mps2, evidence=_topics(condition), later=Later.RISES)
    ticks = context.with_bodies(condition, ticks)
    if isinstance(ticks, Missing):
        return ticks
    values = motion.speed(context.view, body)
    moved = first_tick(values >= condition.arguments.slow_mps, 0, int(ticks[-1]) + 1)
    if moved is None:
        return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
    later = ticks[ticks >= moved]
    return Measured(ticks=later, values=values[later], evidence=_topics(condition))
