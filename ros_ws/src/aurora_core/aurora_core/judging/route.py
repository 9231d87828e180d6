# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What of a route was flown."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile

from aurora_core.errors import VerificationError
from aurora_core.geometry.kernel import norm2
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.waypoints import Leg, Passage, legs, passages
from aurora_core.trace.layout import UavCommandColumn, UavPhase


def route_flown(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Passage, ...]:
    """Return the passages of a mission's waypoints; its phase has samples.

    Raises:
        VerificationError: It has none.
    """
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if phase.capture_tick is None:
        raise VerificationError(f'{condition.id}: the phase of {mission.mission} has no sample')
    return passages(
        context.position(mission),
        mission.waypoints,
        (mission.waypoint_horizontal_m, mission.altitude_tolerance_m),
        phase.capture_tick,
        phase.stop_tick,
    )


def flown_legs(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Leg, ...]:
    """Return the legs whose two ends were visited, and the one that an event cut short.

    The leg of a route with one point is the way to it, from the end of the ascent or of the
    mission before.
    """
    if len(mission.waypoints) == 1:
        return _way_there(context, condition, mission)
    flown = route_flown(context, condition, mission)
    found = legs(mission.waypoints, flown)
    if not is_broken_off(context, condition, mission):
        return found
    done, stop = visited(flown), context.phase(mission, condition.arguments.touchdown_m).stop_tick
    last = Leg(
        a=mission.waypoints[len(done) - 1],
        b=mission.waypoints[len(done)],
        start=done[-1].nearest_tick,
        stop=stop,
    )
    return (*(leg for leg in found if leg.stop <= last.start), last)


def _way_there(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Leg, ...]:
    phase = context.phase(mission, condition.arguments.touchdown_m)
    start, stop = phase.ready_tick, phase.capture_tick
    if start is None or stop is None or start >= stop:
        return ()
    x, y, z = context.position(mission)[start].tolist()
    return (Leg(a=(x, y, z), b=mission.waypoints[0], start=start, stop=stop),)


def visited(flown: Sequence[Passage]) -> tuple[Passage, ...]:
    """Return the passages up to the first waypoint that was missed."""
    return tuple(takewhile(lambda passage: passage.tick is not None, flown))


def is_broken_off(context: Context, condition: Condition, mission: MissionArguments) -> bool:
    """Tell whether an event let the next mission, or the landing, begin while on a route."""
    phase = context.phase(mission, condition.arguments.touchdown_m)
    if mission.left_by is None or phase.end_tick is None or phase.capture_tick is None:
        return False
    commands = context.view.commands(context.view.body(mission.uav))
    begins = commands[phase.end_tick, UavCommandColumn.PHASE]
    if (
        begins >= UavPhase.HOLDING
        and context.events.action_tick(mission.left_by) != phase.end_tick
    ):
        return False
    done = visited(route_flown(context, condition, mission))
    return 0 < len(done) < len(mission.waypoints)


def off_leg_m(context: Context, condition: Condition, mission: MissionArguments) -> float:
    """Return how far from its leg a UAV is when an event breaks its route off, metres."""
    leg = flown_legs(context, condition, mission)[-1]
    x, y, _ = context.position(mission)[leg.stop - 1].tolist()
    dx, dy = leg.b[0] - leg.a[0], leg.b[1] - leg.a[1]
    along = ((x - leg.a[0]) * dx + (y - leg.a[1]) * dy) / (dx * dx + dy * dy)
    at = min(max(along, 0.0), 1.0)
    return norm2(x - leg.a[0] - at * dx, y - leg.a[1] - at * dy)


def route_topics(condition: Condition) -> tuple[str, ...]:
    """Return the evidence of a condition on a route."""
    return tuple(f'uav/state[{name}]' for name in condition.of[:1])
