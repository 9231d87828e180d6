# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What of a realisation helps which quantity: the knowledge behind the fault localization.

Written once per quantity, not per request: how a place, a height or a distance works on it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from aurora_core.spec.quantity import QuantityName as Q

# A field of the grounding: where on the map the scene is.
ANCHOR = 'grounding/anchor'


@dataclass(frozen=True, slots=True, kw_only=True)
class Help:
    """How one kind of value works on a quantity.

    Attributes:
        name: Last name of the parameter's path, or a field of the grounding.
        direction: 1: more of it helps, -1: less, 0: another one.
        weight: How often it is what is at fault, compared with others on the same quantity.
        because: In English.
    """

    name: str
    direction: int = 0
    weight: float = 1.0
    because: str


def _place(weight: float, because: str) -> Help:
    return Help(name=ANCHOR, weight=weight, because=because)


def _higher(weight: float, because: str) -> Help:
    return Help(name='altitude_m', direction=1, weight=weight, because=because)


def _lower(weight: float, because: str) -> Help:
    return Help(name='altitude_m', direction=-1, weight=weight, because=because)


def _nearer(weight: float, because: str) -> Help:
    return Help(name='standoff_m', direction=-1, weight=weight, because=because)


def _closer(weight: float, because: str) -> Help:
    return Help(name='distance_m', direction=-1, weight=weight, because=because)


def _farther(weight: float, because: str) -> Help:
    return Help(name='distance_m', direction=1, weight=weight, because=because)


def _smaller(weight: float, because: str) -> tuple[Help, ...]:
    return tuple(
        Help(name=name, direction=-1, weight=weight, because=because)
        for name in ('0', '1', 'radius_m')
    )


def _faster(weight: float, because: str) -> Help:
    return Help(name='speed_mps', direction=1, weight=weight, because=because)


_ROAD = 'the road there, its signals and its traffic decide what vehicles can do'
_SIGHT = 'what stands there takes the sight'
_WALLS = 'what stands there is in the way'
_FAR = 'from farther away it is seen and heard less'
_LATE = 'a longer way takes longer'

_DRIVEN = (
    _place(3.0, _ROAD),
    _closer(1.0, 'who is farther behind has longer to go'),
    _farther(0.5, 'who is nearer has less room'),
)
_SEEN = (
    _higher(2.0, 'a steeper line of sight clears what stands between'),
    _nearer(1.5, _FAR),
    _place(1.5, _SIGHT),
    _lower(0.5, _FAR),
)
_FLOWN = (
    *_smaller(1.5, _LATE),
    _faster(1.0, 'a slow flight does not get round in time'),
    _place(1.0, _WALLS),
    _lower(0.5, 'a long climb takes its time'),
)
_RADIO = (
    _nearer(1.5, _FAR),
    _place(1.5, 'what stands there takes the signal'),
    _lower(1.0, _FAR),
    _higher(0.5, 'a steeper path clears what stands between'),
)
_HAPPENS = (
    _place(2.0, 'there what is waited for may come'),
    _lower(1.0, 'a distance to a UAV counts its height'),
    _nearer(1.0, 'a distance to a UAV counts its standoff'),
    _closer(1.0, 'who starts too far away never comes there'),
    _farther(0.5, 'who starts too near is there from the start'),
)

HELPS: Mapping[str, tuple[Help, ...]] = MappingProxyType(
    {
        Q.VISIBLE_FRACTION: _SEEN,
        Q.VISIBLE_TIME: _SEEN,
        Q.VISIBLE_AT_SEND: _SEEN,
        Q.TRACKED_FRACTION: (
            _place(2.0, 'bends and fast roads leave a tracker behind'),
            _nearer(1.0, 'a standoff swings round with every turn of the target'),
        ),
        Q.SIDE_FRACTION: (_place(2.0, 'bends and fast roads leave a tracker behind'),),
        Q.CAPTURE_TIME: (
            _place(2.0, 'how far it is to the first point depends on the place'),
            _lower(1.0, 'a long climb takes its time'),
            _nearer(1.0, _LATE),
        ),
        Q.HOVER_DRIFT: (_place(1.0, 'the wind there'),),
        Q.SEPARATION: (
            _higher(2.0, 'UAVs of different heights do not meet'),
            _lower(2.0, 'UAVs of different heights do not meet'),
            Help(name='standoff_m', direction=1, weight=1.0, because='who is apart stays apart'),
            _place(1.0, 'ways that do not cross'),
        ),
        Q.OBSTACLE_CLEARANCE: (
            _higher(2.0, 'above the roofs nothing is in the way'),
            _place(2.0, _WALLS),
            *_smaller(1.0, 'a smaller pattern fits between'),
        ),
        Q.NO_FLY_DISTANCE: (
            _place(2.0, 'the zone is too near'),
            *_smaller(1.5, 'a smaller pattern keeps out of it'),
        ),
        Q.COLLISION_CLEARANCE: (*_DRIVEN, _higher(0.5, 'above them nothing is met')),
        Q.ALTITUDE: (_place(0.5, _WALLS),),
        Q.ALTITUDE_FRACTION: (_place(0.5, _WALLS),),
        Q.FOLLOW_FRACTION: _DRIVEN,
        Q.TIME_GAP: _DRIVEN,
        Q.SPEED: _DRIVEN,
        Q.DECELERATION: _DRIVEN,
        Q.TIME_HEADWAY: _DRIVEN,
        Q.TIME_TO_COLLISION: _DRIVEN,
        Q.OVER_LIMIT: _DRIVEN,
        Q.BEHAVIOR_TIME: _DRIVEN,
        Q.DISTANCE_TRAVELLED: _DRIVEN,
        Q.PLACEMENT: (_place(3.0, 'nobody can stand so there'), *_DRIVEN[1:]),
        Q.RELATION_FRACTION: _DRIVEN,
        Q.TURN: _DRIVEN,
        Q.CROSSING: _DRIVEN,
        Q.LANE_CHANGE: _DRIVEN,
        Q.YIELDING: _DRIVEN,
        Q.UNDONE: _DRIVEN,
        Q.PRESENCE: _DRIVEN,
        Q.JUMP: _DRIVEN,
        Q.COUNT: _DRIVEN,
        Q.TRAFFIC: _DRIVEN,
        Q.EVENT_DELAY: _HAPPENS,
        Q.EVENT_TIME: _HAPPENS,
        Q.COMPLETION_DELAY: _HAPPENS,
        Q.SENT_AFTER_CAPTURE: _HAPPENS,
        Q.LINK_RANGE: _RADIO,
        Q.DELIVERED: _RADIO,
        Q.DELIVERY_LATENCY: _RADIO,
        Q.DELIVERY_RATIO: _RADIO,
        Q.ATTEMPTS: _RADIO,
        Q.ENDURANCE: _FLOWN,
        Q.LANDED: _FLOWN,
        Q.MISSION_COMPLETED: _FLOWN,
        Q.WAYPOINTS_VISITED: (_place(1.5, _WALLS), *_FLOWN),
        Q.ROUTE_CLOSED: (_place(1.5, _WALLS), *_FLOWN),
        Q.PHASE_DURATION: (_place(1.0, _WALLS),),
        Q.RETURN_DISTANCE: (_place(1.0, _WALLS),),
        Q.ANGLE_SWEPT: (_place(1.0, _WALLS), *_FLOWN),
        Q.OVER_CARRIAGEWAY: (_place(2.0, 'no leg lies over a street there'),),
        Q.PATTERN_CENTRE: (
            _place(2.0, _WALLS),
            _higher(1.0, 'above the roofs nothing is in the way'),
            *_smaller(0.5, 'a smaller pattern fits between'),
        ),
        Q.PATTERN_EXTENT: (_place(2.0, _WALLS), _higher(1.0, 'above the roofs is room')),
        Q.ROUTE_SPEED: (
            _place(1.0, _WALLS),
            Help(name='0', direction=1, weight=1.0, because='a short leg shows no speed'),
            Help(name='1', direction=1, weight=1.0, because='a short leg shows no speed'),
        ),
        Q.CLIMB_RATE: (_place(0.5, _WALLS),),
        Q.VERTICAL_SPEED: (_place(0.5, _WALLS),),
        Q.WIND: (_place(0.5, 'the wind there'),),
        Q.CLEARANCE: (_place(1.5, _WALLS),),
        Q.BATTERY: _FLOWN,
        Q.OUTAGE: _RADIO,
        Q.REPORT_GAP: _RADIO,
    }
)

# A distance is helped by what brings two bodies together, or apart.
_TOGETHER = (
    _nearer(2.0, 'a distance to a UAV counts its standoff'),
    _closer(1.5, 'who starts farther away stays farther away'),
    _place(2.0, _ROAD),
)
_APART = (
    Help(name='standoff_m', direction=1, weight=2.0, because='who is apart stays apart'),
    _farther(1.5, 'who starts nearer stays nearer'),
    _place(2.0, _ROAD),
)
_HEIGHT = 'a distance to a UAV counts its height'
# What is not to happen before some moment is helped by what takes longer.
_LATER = (
    _place(2.0, 'there what is waited for may come later'),
    Help(name='speed_mps', direction=-1, weight=1.0, because='who flies slower is there later'),
    _farther(1.0, 'who starts farther away comes later'),
    _higher(0.5, 'a longer climb takes its time'),
)
# What waits for a distance to be exceeded is helped by what takes two bodies apart.
_GETS_FAR = (
    _place(2.0, 'there what is waited for may come'),
    _higher(1.0, _HEIGHT),
    Help(name='standoff_m', direction=1, weight=1.0, because='who is apart stays apart'),
    _farther(1.0, 'who starts nearer stays nearer'),
)
_DISTANCES: Mapping[tuple[Q, bool], tuple[Help, ...]] = MappingProxyType(
    {
        (Q.DISTANCE, True): (_lower(1.5, _HEIGHT), *_TOGETHER),
        (Q.DISTANCE, False): (_higher(1.5, _HEIGHT), *_APART),
        (Q.HORIZONTAL_DISTANCE, True): _TOGETHER,
        (Q.HORIZONTAL_DISTANCE, False): _APART,
    }
)


def helps(quantity: Q, op: str, *, gets_far: bool = False) -> tuple[Help, ...]:
    """Return what helps a quantity to hold its comparison (`<`, `<=`, `>`, `>=`, `==`).

    Args:
        quantity: Of the condition.
        op: Of the condition.
        gets_far: It waits for a distance to be exceeded, in vain.
    """
    if quantity is Q.EVENT_TIME and op in ('>', '>='):
        return _LATER
    if gets_far and HELPS.get(quantity) is _HAPPENS:
        return _GETS_FAR
    of_distance = _DISTANCES.get((quantity, op in ('<', '<=')))
    return HELPS.get(quantity, ()) if of_distance is None else of_distance
