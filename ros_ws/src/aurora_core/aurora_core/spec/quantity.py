# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Names of the quantities that conditions speak about (defined over traces in `quantities`)."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

# How a condition compares, in words.
OP_WORDS: Mapping[str, str] = MappingProxyType(
    {'<=': 'at most', '<': 'less than', '>=': 'at least', '>': 'more than', '==': 'exactly'}
)


class QuantityName(StrEnum):
    """Stated by prompts (contract) or implied by every run."""

    DISTANCE = 'distance'
    HORIZONTAL_DISTANCE = 'horizontal_distance'
    SEPARATION = 'separation'
    ALTITUDE = 'altitude'
    SPEED = 'speed'
    TRACKED_FRACTION = 'tracked_fraction'
    VISIBLE_TIME = 'visible_time'
    VISIBLE_FRACTION = 'visible_fraction'
    DELIVERY_LATENCY = 'delivery_latency'
    DELIVERED = 'delivered'
    DELIVERY_RATIO = 'delivery_ratio'
    EVENT_TIME = 'event_time'
    HOVER_DRIFT = 'hover_drift'
    WAYPOINTS_VISITED = 'waypoints_visited'
    MISSION_COMPLETED = 'mission_completed'
    LANDED = 'landed'
    CAPTURE_TIME = 'capture_time'
    ALTITUDE_FRACTION = 'altitude_fraction'
    ROUTE_CLOSED = 'route_closed'
    OVER_CARRIAGEWAY = 'over_carriageway'
    PATTERN_CENTRE = 'pattern_centre'
    PHASE_DURATION = 'phase_duration'
    PLACEMENT = 'placement'
    RELATION_FRACTION = 'relation_fraction'
    FOLLOW_FRACTION = 'follow_fraction'
    TIME_GAP = 'time_gap'
    TURN = 'turn'
    CROSSING = 'crossing'
    LANE_CHANGE = 'lane_change'
    YIELDING = 'yielding'
    OVER_LIMIT = 'over_limit'
    BEHAVIOR_TIME = 'behavior_time'
    DISTANCE_TRAVELLED = 'distance_travelled'
    EVENT_DELAY = 'event_delay'
    SENT_AFTER_CAPTURE = 'sent_after_capture'
    VISIBLE_AT_SEND = 'visible_at_send'
    COLLISION_CLEARANCE = 'collision_clearance'
    OBSTACLE_CLEARANCE = 'obstacle_clearance'
    PRESENCE = 'presence'
    JUMP = 'jump'
    CLIMB_RATE = 'climb_rate'
    VERTICAL_SPEED = 'vertical_speed'
    DECELERATION = 'deceleration'
    TIME_HEADWAY = 'time_headway'
    TIME_TO_COLLISION = 'time_to_collision'
    NO_FLY_DISTANCE = 'no_fly_distance'
    ROUTE_SPEED = 'route_speed'
    ENDURANCE = 'endurance'
    COUNT = 'count'
    WORLD_SETTING = 'world_setting'
    RUN_DURATION = 'run_duration'
    TRAFFIC = 'traffic'
    COMPLETION_DELAY = 'completion_delay'
    LINK_RANGE = 'link_range'
    ATTEMPTS = 'attempts'
    PATTERN_EXTENT = 'pattern_extent'
    ANGLE_SWEPT = 'angle_swept'
    SIDE_FRACTION = 'side_fraction'
    WIND = 'wind'
    RETURN_DISTANCE = 'return_distance'
    OUTAGE = 'outage'
    BATTERY = 'battery'
    CLEARANCE = 'clearance'
    REPORT_GAP = 'report_gap'
    UNDONE = 'undone'
    MESSAGE_TEXT = 'message_text'


# Shares of a time that are told by a verb: somebody sees somebody for so much of it.
SHARE_VERBS: Mapping[str, str] = MappingProxyType(
    {QuantityName.VISIBLE_FRACTION: 'sees', QuantityName.TRACKED_FRACTION: 'tracks'}
)
# What people tell in per cent.
IN_PERCENT = frozenset({*SHARE_VERBS, QuantityName.DELIVERY_RATIO, QuantityName.BATTERY})
