# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which function takes the samples of which quantity."""

from __future__ import annotations

from collections.abc import Callable

from aurora_core.errors import VerificationError
from aurora_core.monitor import (
    measure_actions,
    measure_events,
    measure_lanes,
    measure_links,
    measure_manoeuvres,
    measure_missions,
    measure_motion,
    measure_relations,
    measure_route,
    measure_safety,
    measure_scene,
    measure_yielding,
)
from aurora_core.monitor.evaluation import Context, Evaluation
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.quantity import QuantityName as Q

_MEASURES: dict[Q, Callable[[Context, Condition], Evaluation]] = {
    Q.DISTANCE: measure_motion.measure_distance,
    Q.HORIZONTAL_DISTANCE: measure_motion.measure_horizontal_distance,
    Q.ALTITUDE: measure_motion.measure_altitude,
    Q.SPEED: measure_motion.measure_speed,
    Q.CLIMB_RATE: measure_motion.measure_climb_rate,
    Q.SEPARATION: measure_motion.measure_separation,
    Q.TRACKED_FRACTION: measure_missions.measure_tracked_fraction,
    Q.VISIBLE_FRACTION: measure_missions.measure_visible_fraction,
    Q.VISIBLE_TIME: measure_missions.measure_visible_time,
    Q.HOVER_DRIFT: measure_missions.measure_hover_drift,
    Q.MISSION_COMPLETED: measure_missions.measure_mission_completed,
    Q.LANDED: measure_missions.measure_landed,
    Q.CAPTURE_TIME: measure_missions.measure_capture_time,
    Q.ALTITUDE_FRACTION: measure_missions.measure_altitude_fraction,
    Q.PHASE_DURATION: measure_missions.measure_phase_duration,
    Q.ENDURANCE: measure_missions.measure_endurance,
    Q.WAYPOINTS_VISITED: measure_route.measure_waypoints_visited,
    Q.ROUTE_CLOSED: measure_route.measure_route_closed,
    Q.OVER_CARRIAGEWAY: measure_route.measure_over_carriageway,
    Q.PATTERN_CENTRE: measure_route.measure_pattern_centre,
    Q.ROUTE_SPEED: measure_route.measure_route_speed,
    Q.PLACEMENT: measure_relations.measure_placement,
    Q.RELATION_FRACTION: measure_relations.measure_relation_fraction,
    Q.FOLLOW_FRACTION: measure_relations.measure_follow_fraction,
    Q.TURN: measure_manoeuvres.measure_turn,
    Q.CROSSING: measure_manoeuvres.measure_crossing,
    Q.LANE_CHANGE: measure_lanes.measure_lane_change,
    Q.OVER_LIMIT: measure_lanes.measure_over_limit,
    Q.YIELDING: measure_yielding.measure_yielding,
    Q.TIME_GAP: measure_relations.measure_time_gap,
    Q.DISTANCE_TRAVELLED: measure_relations.measure_distance_travelled,
    Q.EVENT_DELAY: measure_events.measure_event_delay,
    Q.EVENT_TIME: measure_events.measure_event_time,
    Q.SENT_AFTER_CAPTURE: measure_events.measure_sent_after_capture,
    Q.VISIBLE_AT_SEND: measure_events.measure_visible_at_send,
    Q.DELIVERED: measure_events.measure_delivered,
    Q.DELIVERY_LATENCY: measure_events.measure_delivery_latency,
    Q.DELIVERY_RATIO: measure_events.measure_delivery_ratio,
    Q.COLLISION_CLEARANCE: measure_safety.measure_collision_clearance,
    Q.OBSTACLE_CLEARANCE: measure_safety.measure_obstacle_clearance,
    Q.PRESENCE: measure_safety.measure_presence,
    Q.JUMP: measure_safety.measure_jump,
    Q.NO_FLY_DISTANCE: measure_safety.measure_no_fly,
    Q.COUNT: measure_scene.measure_count,
    Q.WORLD_SETTING: measure_scene.measure_world_setting,
    Q.RUN_DURATION: measure_scene.measure_run_duration,
    Q.COMPLETION_DELAY: measure_actions.measure_completion_delay,
    Q.LINK_RANGE: measure_links.measure_link_range,
    Q.ATTEMPTS: measure_links.measure_attempts,
    Q.PATTERN_EXTENT: measure_route.measure_pattern_extent,
}


def measure(context: Context, condition: Condition) -> Evaluation:
    """Return the samples of a condition's signal, or why there are none.

    Raises:
        VerificationError: The quantity has no measure.
    """
    function = _MEASURES.get(condition.quantity)
    if function is None:
        raise VerificationError(
            f'condition {condition.id} is about {condition.quantity.value}, which has no measure'
        )
    return function(context, condition)
