# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of mission conditions: phases, tracking, sight, hover, landing."""

from __future__ import annotations

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    Later,
    Measured,
    Missing,
    at_tick,
)
from aurora_core.monitor.measure_route import route_flown
from aurora_core.monitor.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import bound_error, distance_2d
from aurora_core.quantities.phases import tracked
from aurora_core.quantities.view import Body


def mission_of(condition: Condition) -> MissionArguments:
    """Return the mission of a condition.

    Raises:
        VerificationError: It has none.
    """
    if condition.arguments.mission is None:
        raise VerificationError(f'condition {condition.id} names no mission')
    return condition.arguments.mission


def _uav(context: Context, condition: Condition) -> Body:
    return context.view.body(condition.of[0])


def _topics(condition: Condition) -> tuple[str, ...]:
    mission = mission_of(condition)
    return (f'uav/state[{mission.uav}]', f'uav/command[{mission.uav}].phase')


def measure_capture_time(context: Context, condition: Condition) -> Evaluation:
    """Seconds from the end of the ascent (a later mission: from its first command) to capture."""
    mission = mission_of(condition)
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if phase.capture_tick is not None and phase.ready_tick is not None:
        value = context.time_s(phase.capture_tick - phase.ready_tick)
        story = (
            f'{mission.uav} captured at {context.time_s(phase.capture_tick):.2f} s, '
            f'{value:.2f} s after {context.time_s(phase.ready_tick):.2f} s'
        )
        return at_tick(phase.capture_tick, value, story, _topics(condition))
    missing = context.phase_missing(condition, mission)
    if missing is None:
        raise VerificationError(f'{condition.id}: a phase without capture must be missing')
    lasted = phase.end_tick is None and phase.ready_tick is not None
    if lasted and missing.reason is not Reason.TARGET_GONE:
        # Not by the end of the record: at the earliest with the next tick.
        waited_s = context.time_s(context.view.ticks - (phase.ready_tick or 0))
        if waited_s > condition.threshold or context.complete(condition):
            story = f'{mission.uav} had not captured after {waited_s:.2f} s'
            tick, topics = context.view.ticks - 1, _topics(condition)
            return _not_yet(context, condition, tick, waited_s, story, topics)
        return context.short(condition)
    return missing


def _not_yet(
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


def measure_mission_completed(context: Context, condition: Condition) -> Evaluation:
    """Aspects: `order` of the phases, `time` on the mission, `route` flown before its `end`."""
    if condition.arguments.aspect == 'order':
        return _order(context, condition)
    mission = mission_of(condition)
    missing = context.phase_missing(condition, mission)
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if condition.arguments.aspect == 'end':
        return _end(context, condition, missing)
    if missing is not None:
        return missing
    assert phase.capture_tick is not None  # nothing is missing
    if condition.arguments.aspect == 'time':
        value = context.time_s(phase.stop_tick - phase.capture_tick)
        story = f'{mission.mission} lasted {value:.2f} s after capture'
        last_tick = phase.stop_tick - 1
        return at_tick(last_tick, value, story, _topics(condition), later=Later.RISES)
    flown = route_flown(context, condition, mission)
    last = flown[-1]
    missed = [k for k, passage in enumerate(flown) if passage.tick is None]
    if missed or last.tick is None:
        # It ended at least one tick before the route was done.
        story = f'{mission.uav} had missed waypoint {missed[0] + 1} when the phase ended'
        return at_tick(phase.stop_tick - 1, -context.view.dt_s, story, _topics(condition))
    value = context.time_s(phase.stop_tick - last.tick)
    story = f'{mission.uav} had flown its route {value:.2f} s before the phase ended'
    return at_tick(last.tick, value, story, _topics(condition), later=Later.RISES)


def _end(context: Context, condition: Condition, missing: Missing | None) -> Evaluation:
    """Return the seconds from scenario start to the first command of the phase after a mission."""
    mission = mission_of(condition)
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if phase.end_tick is not None and missing is None:
        value = context.time_s(phase.end_tick)
        story = f'{mission.mission} was over at {value:.2f} s'
        return at_tick(phase.end_tick, value, story, _topics(condition))
    earliest_s = context.time_s(context.view.ticks)
    decided = earliest_s > condition.threshold or context.complete(condition)
    if phase.end_tick is None and phase.capture_tick is not None and decided:
        last_tick = context.view.ticks - 1
        story = f'{mission.mission} was not over at the end, {context.time_s(last_tick):.2f} s'
        return _not_yet(context, condition, last_tick, earliest_s, story, _topics(condition))
    return context.short(condition) if missing is None else missing


def _order(context: Context, condition: Condition) -> Evaluation:
    mission = mission_of(condition)
    touchdown_m = condition.arguments.touchdown_m
    flight = context.flight(mission, touchdown_m)
    phase = context.phase(mission, touchdown_m)
    before = [
        context.phase(other, touchdown_m)
        for other in context.mission_arguments
        if other.uav == mission.uav and other.index == mission.index - 1
    ]
    ready = flight.ascent_end_tick if mission.index == 0 else None
    if before:
        ready = before[0].end_tick
    if phase.command_tick is None or ready is None:
        if not context.complete(condition) and flight.landing_tick is None:
            return context.short(condition)
        what = 'was never commanded' if phase.command_tick is None else 'began too early'
        return Missing(reason=Reason.EMPTY_PHASE, story=f'{mission.mission} {what}')
    slack = phase.command_tick - ready
    if flight.landing_tick is not None:
        slack = min(slack, flight.landing_tick - phase.command_tick)
    story = (
        f'{mission.mission} was commanded at {context.time_s(phase.command_tick):.2f} s, '
        f'the phase before it ended at {context.time_s(ready):.2f} s'
    )
    return at_tick(
        phase.command_tick,
        context.time_s(slack),
        story,
        _topics(condition),
        later=Later.FALLS,
        provisional=flight.landing_tick is None,
    )


def measure_phase_duration(context: Context, condition: Condition) -> Evaluation:
    """Seconds from capture to the first command of the next phase."""
    mission = mission_of(condition)
    phase = context.phase(mission, condition.arguments.touchdown_m)
    missing = context.phase_missing(condition, mission)
    if missing is not None:
        return missing
    assert phase.capture_tick is not None
    value = context.time_s(phase.stop_tick - phase.capture_tick)
    story = (
        f'{mission.mission} lasted from {context.time_s(phase.capture_tick):.2f} s to '
        f'{context.time_s(phase.stop_tick):.2f} s, {value:.2f} s'
    )
    return at_tick(phase.stop_tick - 1, value, story, _topics(condition), later=Later.RISES)


def measure_tracked_fraction(context: Context, condition: Condition) -> Evaluation:
    """Share of the phase within the tracking tolerance."""
    mission = mission_of(condition)
    rule = mission.track_rule
    if rule is None or mission.target is None:
        raise VerificationError(f'condition {condition.id}: its mission does not track')
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    uav = _uav(context, condition)
    good = tracked(context.view, uav, condition.of[1], rule)
    apart = motion.horizontal_distance(context.view, uav.body_id, condition.of[1])
    what = f'{uav.body_id} tracked {condition.of[1]}'
    return share_of(context, ticks, good, apart, what, _topics(condition))


def measure_visible_fraction(context: Context, condition: Condition) -> Evaluation:
    """Share of the phase in which the target is visible."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    sight = context.sight(condition.of[0], condition.of[1])
    what = f'{condition.of[0]} saw {condition.of[1]}'
    return share_of(context, ticks, sight.visible, sight.margin_m, what, _topics(condition))


def measure_visible_time(context: Context, condition: Condition) -> Evaluation:
    """Seconds of sight in the phase; `longest`: in the longest unbroken stretch."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    seen = context.sight(condition.of[0], condition.of[1]).visible[ticks]
    count = int(np.count_nonzero(seen))
    if condition.arguments.aspect == 'longest':
        edges = np.flatnonzero(np.diff(np.concatenate(([False], seen, [False])).astype(np.int8)))
        count = int((edges[1::2] - edges[0::2]).max(initial=0))
    story = f'{condition.of[0]} saw {condition.of[1]} for {context.time_s(count):.2f} s'
    last_tick, seen_s = int(ticks[-1]), context.time_s(count)
    return at_tick(last_tick, seen_s, story, _topics(condition), later=Later.RISES)


def measure_altitude_fraction(context: Context, condition: Condition) -> Evaluation:
    """Share of the phase at the requested altitude."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    arguments = condition.arguments
    values = motion.altitude(context.view, _uav(context, condition))
    off = bound_error(values, arguments.wanted, arguments.bound)
    what = f'{condition.of[0]} kept its altitude'
    good = off <= arguments.sample_tolerance
    return share_of(context, ticks, good, values, what, _topics(condition))


def measure_hover_drift(context: Context, condition: Condition) -> Evaluation:
    """Metres from the hover point in the plane, every sample of the phase."""
    mission = mission_of(condition)
    if mission.point_m is None:
        raise VerificationError(f'condition {condition.id}: its mission has no hover point')
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    point = context.view.reference(condition.of[0])
    drift = distance_2d(point[:, 0] - mission.point_m[0], point[:, 1] - mission.point_m[1])
    return Measured(ticks=ticks, values=drift[ticks], evidence=_topics(condition))


def measure_landed(context: Context, condition: Condition) -> Evaluation:
    """Seconds from scenario start to the first sample on the ground after the landing command."""
    mission = condition.arguments.missions[0]
    flight = context.flight(mission, condition.arguments.touchdown_m)
    topics = (f'uav/state[{mission.uav}]',)
    if flight.landed_tick is not None:
        value = context.time_s(flight.landed_tick)
        return at_tick(
            flight.landed_tick, value, f'{mission.uav} was down at {value:.2f} s', topics
        )
    earliest_s = context.time_s(context.view.ticks)
    if earliest_s > condition.threshold or context.complete(condition):
        story = (
            f'{mission.uav} was not down at the end, {context.time_s(context.view.ticks - 1)} s'
        )
        last_tick = context.view.ticks - 1
        return _not_yet(context, condition, last_tick, earliest_s, story, topics)
    return context.short(condition)


def measure_endurance(context: Context, condition: Condition) -> Evaluation:
    """Seconds from the first to the last sample in the air."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    value = context.time_s(int(ticks[-1]) - int(ticks[0]) + 1)
    story = f'{condition.of[0]} was in the air for {value:.2f} s'
    topics = (f'uav/state[{condition.of[0]}]',)
    return at_tick(int(ticks[-1]), value, story, topics, later=Later.RISES)
