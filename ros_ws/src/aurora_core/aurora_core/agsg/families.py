# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which family of relations a success condition, an order or a prohibition belongs to."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from aurora_core.outcomes.agsg import EdgeType
from aurora_core.spec.prohibitions import Prohibition
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.requirements import StatedCondition

_QUANTITIES = {
    EdgeType.SPATIAL: (
        QuantityName.DISTANCE,
        QuantityName.HORIZONTAL_DISTANCE,
        QuantityName.SEPARATION,
        QuantityName.ALTITUDE,
        QuantityName.ALTITUDE_FRACTION,
        QuantityName.HOVER_DRIFT,
        QuantityName.WAYPOINTS_VISITED,
        QuantityName.ROUTE_CLOSED,
        QuantityName.OVER_CARRIAGEWAY,
        QuantityName.PATTERN_CENTRE,
        QuantityName.PLACEMENT,
        QuantityName.RELATION_FRACTION,
        QuantityName.COLLISION_CLEARANCE,
        QuantityName.OBSTACLE_CLEARANCE,
        QuantityName.NO_FLY_DISTANCE,
        QuantityName.PATTERN_EXTENT,
        QuantityName.ANGLE_SWEPT,
        QuantityName.SIDE_FRACTION,
        QuantityName.RETURN_DISTANCE,
        QuantityName.CLEARANCE,
        QuantityName.COUNT,
        QuantityName.TRAFFIC,
        QuantityName.WORLD_SETTING,
        QuantityName.WIND,
    ),
    EdgeType.TEMPORAL: (
        QuantityName.EVENT_TIME,
        QuantityName.EVENT_DELAY,
        QuantityName.CAPTURE_TIME,
        QuantityName.PHASE_DURATION,
        QuantityName.ENDURANCE,
        QuantityName.BATTERY,
        QuantityName.RUN_DURATION,
        QuantityName.COMPLETION_DELAY,
    ),
    EdgeType.PERCEPTUAL: (
        QuantityName.TRACKED_FRACTION,
        QuantityName.VISIBLE_TIME,
        QuantityName.VISIBLE_FRACTION,
        QuantityName.VISIBLE_AT_SEND,
        QuantityName.SENT_AFTER_CAPTURE,
    ),
    EdgeType.COMMUNICATION: (
        QuantityName.DELIVERED,
        QuantityName.DELIVERY_LATENCY,
        QuantityName.DELIVERY_RATIO,
        QuantityName.LINK_RANGE,
        QuantityName.ATTEMPTS,
        QuantityName.OUTAGE,
        QuantityName.REPORT_GAP,
        QuantityName.MESSAGE_TEXT,
    ),
    EdgeType.BEHAVIORAL: (
        QuantityName.SPEED,
        QuantityName.MISSION_COMPLETED,
        QuantityName.LANDED,
        QuantityName.FOLLOW_FRACTION,
        QuantityName.TIME_GAP,
        QuantityName.TURN,
        QuantityName.CROSSING,
        QuantityName.LANE_CHANGE,
        QuantityName.YIELDING,
        QuantityName.OVER_LIMIT,
        QuantityName.BEHAVIOR_TIME,
        QuantityName.DISTANCE_TRAVELLED,
        QuantityName.PRESENCE,
        QuantityName.JUMP,
        QuantityName.CLIMB_RATE,
        QuantityName.VERTICAL_SPEED,
        QuantityName.DECELERATION,
        QuantityName.TIME_HEADWAY,
        QuantityName.TIME_TO_COLLISION,
        QuantityName.ROUTE_SPEED,
        QuantityName.UNDONE,
    ),
}
_FAMILY_OF_QUANTITY: Mapping[str, EdgeType] = MappingProxyType(
    {name.value: family for family, names in _QUANTITIES.items() for name in names}
)
_FAMILY_OF_PROHIBITION: Mapping[str, EdgeType] = MappingProxyType(
    {
        'world': EdgeType.SPATIAL,
        'agent': EdgeType.SPATIAL,
        'placement': EdgeType.SPATIAL,
        'behavior': EdgeType.BEHAVIORAL,
        'mission': EdgeType.BEHAVIORAL,
        'link': EdgeType.COMMUNICATION,
        'event': EdgeType.TEMPORAL,
        'order': EdgeType.TEMPORAL,
    }
)


def family_of_quantity(quantity: str) -> EdgeType:
    """Return the family of conditions on a quantity.

    Args:
        quantity: Name, see `QuantityName`.

    Raises:
        KeyError: There is no such quantity.
    """
    return _FAMILY_OF_QUANTITY[quantity]


def family_of_prohibition(prohibition: Prohibition) -> EdgeType:
    """Return the family of what is forbidden."""
    if isinstance(prohibition, StatedCondition):
        return family_of_quantity(prohibition.quantity)
    return _FAMILY_OF_PROHIBITION[prohibition.forbids]
