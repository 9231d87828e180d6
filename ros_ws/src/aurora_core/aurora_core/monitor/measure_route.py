# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of route conditions: waypoints, closing, streets below, centre, speed."""

from __future__ import annotations

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    Later,
    Measured,
    Missing,
    at_tick,
)
from aurora_core.monitor.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import bound_error, distance_2d
from aurora_core.quantities.waypoints import (
    Leg,
    Passage,
    approach,
    cruising,
    extent,
    legs,
    passages,
    pattern_centre,
)


def route_flown(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Passage, ...]:
    """Return the passages of a mission's waypoints; its phase has samples."""
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if phase.capture_tick is None:
        raise VerificationError(f'{condition.id}: the phase of {mission.mission} has no sample')
    return passages(
        context.view,
        context.view.body(mission.uav),
        mission.waypoints,
        (mission.waypoint_horizontal_m, mission.altitude_tolerance_m),
        phase.capture_tick,
        phase.stop_tick,
    )


def _mission(condition: Condition) -> MissionArguments:
    if condition.arguments.mission is None:
        raise VerificationError(f'condition {condition.id} names no mission')
    return condition.arguments.mission


def _flown_legs(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Leg, ...]:
    return legs(mission.waypoints, route_flown(context, condition, mission))


def _topics(condition: Condition) -> tuple[str, ...]:
    return tuple(f'uav/state[{name}]' for name in condition.of[:1])


def measure_waypoints_visited(context: Context, condition: Condition) -> Evaluation:
    """`distance`: closest approach of each waypoint in order; `count`: how many were visited."""
    mission = _mission(condition)
    missing = context.phase_missing(condition, mission)
    if missing is not None:
        return missing
    flown = route_flown(context, condition, mission)
    visited = sum(passage.tick is not None for passage in flown)
    story = f'{mission.uav} visited {visited} of {len(flown)} route points in order'
    if condition.arguments.aspect == 'count':
        points = mission.waypoints
        # A closing point is the first one again, not another waypoint.
        again = points[0] == points[-1] and flown[-1].tick is not None
        count = float(visited - 1 if again else visited)
        last_tick = flown[-1].nearest_tick
        return at_tick(last_tick, count, story, _topics(condition), later=Later.RISES)
    worst = int(np.argmax([passage.nearest_m for passage in flown]))
    story += (
        f', point {worst + 1} with {flown[worst].nearest_m:.2f} m at '
        f'{context.time_s(flown[worst].nearest_tick):.2f} s as the farthest'
    )
    return Measured(
        ticks=np.array([passage.nearest_tick for passage in flown], dtype=np.intp),
        values=np.array([passage.nearest_m for passage in flown]),
        story=story,
        evidence=_topics(condition),
        later=Later.ANY,
    )


def measure_route_closed(context: Context, condition: Condition) -> Evaluation:
    """Closest approach of the first point again, after the others.

    While another point is missed the route cannot be closed on the way: then the place at the end
    of the phase counts.
    """
    mission = _mission(condition)
    missing = context.phase_missing(condition, mission)
    if missing is not None:
        return missing
    flown = route_flown(context, condition, mission)
    tick, off_m = flown[-1].nearest_tick, flown[-1].nearest_m
    if any(passage.tick is None for passage in flown[:-1]):
        tick = context.phase(mission, condition.arguments.touchdown_m).stop_tick - 1
        end = context.view.reference(mission.uav)[tick : tick + 1]
        tolerances_m = (mission.waypoint_horizontal_m, mission.altitude_tolerance_m)
        off_m = float(approach(end, mission.waypoints[-1], *tolerances_m)[0])
    story = f'{mission.uav} came within {off_m:.2f} m of where its route began'
    return at_tick(tick, off_m, story, _topics(condition))


def measure_over_carriageway(context: Context, condition: Condition) -> Evaluation:
    """Share of the samples of the best leg that lie over a carriageway."""
    mission = _mission(condition)
    missing = context.phase_missing(condition, mission)
    if missing is not None:
        return missing
    flown = _flown_legs(context, condition, mission)
    if not flown:
        return Missing(reason=Reason.EMPTY_PHASE, story=f'{mission.uav} flew no leg of its route')
    driving = context.view.geometry.surfaces(SurfaceKind.DRIVING)
    first, last = flown[0].start, flown[-1].stop
    over = np.zeros(context.view.ticks, dtype=np.bool_)
    over[first:last] = driving.contains(context.view.reference(mission.uav)[first:last, :2])
    shares = [
        int(np.count_nonzero(over[leg.start : leg.stop])) / (leg.stop - leg.start) for leg in flown
    ]
    best = int(np.argmax(shares))
    ticks = np.arange(flown[best].start, flown[best].stop, dtype=np.intp)
    what = f'on its best leg {mission.uav} was over a carriageway'
    return share_of(context, ticks, over, None, what, _topics(condition), growing=False)


def measure_pattern_centre(context: Context, condition: Condition) -> Evaluation:
    """Metres from the centre of the pattern to the target at t = 0."""
    mission = _mission(condition)
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    target = condition.of[1]
    if not context.view.present(target)[0]:
        return Missing(reason=Reason.TARGET_GONE, story=f'{target} is absent at t = 0', tick=0)
    x, y = pattern_centre(mission.waypoints)
    at = context.view.reference(target)[0]
    value = float(distance_2d(float(at[0]) - x, float(at[1]) - y))
    story = f'the centre of the pattern is {value:.2f} m from {target} at t = 0'
    return at_tick(0, value, story, (f'state[{target}]',))


def measure_pattern_extent(context: Context, condition: Condition) -> Evaluation:
    """Metres that the flown route extends along an axis of the pattern."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    mission, axis = _mission(condition), condition.arguments.axis
    if axis is None:
        raise VerificationError(f'condition {condition.id} names no axis')
    flown = context.view.reference(mission.uav)[ticks]
    value = extent(flown, axis)
    story = f'{mission.uav} flew {value:.2f} m far along that side of its pattern'
    return at_tick(int(ticks[-1]), value, story, _topics(condition), later=Later.RISES)


def measure_route_speed(context: Context, condition: Condition) -> Evaluation:
    """Share of the samples on legs, away from their ends, at the requested speed."""
    mission = _mission(condition)
    missing = context.phase_missing(condition, mission)
    if missing is not None:
        return missing
    arguments = condition.arguments
    uav = context.view.body(mission.uav)
    flown = _flown_legs(context, condition, mission)
    ticks = np.flatnonzero(cruising(context.view, uav, flown, arguments.low))
    if len(ticks) == 0:
        return Missing(
            reason=Reason.EMPTY_PHASE,
            story=f'{mission.uav} flew no leg longer than its acceleration and braking distances',
        )
    values = motion.speed(context.view, uav)
    off = bound_error(values, arguments.wanted, arguments.bound)
    what = f'{mission.uav} kept its speed'
    good = off <= arguments.sample_tolerance
    return share_of(context, ticks, good, values, what, _topics(condition), growing=False)
