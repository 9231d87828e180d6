# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What of a route was flown."""

from __future__ import annotations

from aurora_core.errors import VerificationError
from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.waypoints import Leg, Passage, legs, passages


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
        context.view,
        context.view.body(mission.uav),
        mission.waypoints,
        (mission.waypoint_horizontal_m, mission.altitude_tolerance_m),
        phase.capture_tick,
        phase.stop_tick,
    )


def flown_legs(
    context: Context, condition: Condition, mission: MissionArguments
) -> tuple[Leg, ...]:
    """Return the legs of a mission whose two ends were visited."""
    return legs(mission.waypoints, route_flown(context, condition, mission))


def route_topics(condition: Condition) -> tuple[str, ...]:
    """Return the evidence of a condition on a route."""
    return tuple(f'uav/state[{name}]' for name in condition.of[:1])
