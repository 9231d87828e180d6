# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The closed vocabulary of the specification, in the words of the contract."""

from __future__ import annotations

from enum import StrEnum


class AgentType(StrEnum):
    CAR = 'car'
    TRUCK = 'truck'
    BUS = 'bus'
    VAN = 'van'
    MOTORCYCLE = 'motorcycle'
    BICYCLE = 'bicycle'
    PEDESTRIAN = 'pedestrian'
    POLICE = 'police'
    AMBULANCE = 'ambulance'
    FIRETRUCK = 'firetruck'
    RSU = 'rsu'


class Role(StrEnum):
    EGO = 'ego'
    TARGET = 'target'
    BACKGROUND = 'background'
    OTHER = 'other'


class Weather(StrEnum):
    CLEAR = 'clear'
    CLOUDY = 'cloudy'
    RAIN = 'rain'
    HEAVY_RAIN = 'heavy_rain'
    FOG = 'fog'
    SNOW = 'snow'


class TimeOfDay(StrEnum):
    DAWN = 'dawn'
    NOON = 'noon'
    DUSK = 'dusk'
    NIGHT = 'night'


class TrafficDensity(StrEnum):
    LOW = 'low'
    MEDIUM = 'medium'
    HIGH = 'high'


class RelativeWind(StrEnum):
    """How a wind meets who flies."""

    CROSSWIND = 'crosswind'
    HEADWIND = 'headwind'
    TAILWIND = 'tailwind'


class Place(StrEnum):
    """Place kinds; landmark names of the map are written `landmark:<name>`."""

    INTERSECTION = 'intersection'
    CROSSWALK = 'crosswalk'
    SIDEWALK = 'sidewalk'
    ROADSIDE = 'roadside'
    MAIN_ROAD = 'main_road'


class Relation(StrEnum):
    AHEAD = 'ahead'
    BEHIND = 'behind'
    LEFT = 'left'
    RIGHT = 'right'
    ADJACENT_LANE = 'adjacent_lane'
    SAME_LANE = 'same_lane'
    ONCOMING = 'oncoming'
    BESIDE = 'beside'
    AT = 'at'
    ON = 'on'
    NEAR = 'near'
    BEFORE = 'before'
    PARKED_AT = 'parked_at'


class BehaviorKind(StrEnum):
    DRIVE = 'drive'
    CIRCULATE = 'circulate'
    FOLLOW = 'follow'
    TAILGATE = 'tailgate'
    OVERTAKE = 'overtake'
    APPROACH = 'approach'
    STOP = 'stop'
    BRAKE = 'brake'
    SLOW = 'slow'
    YIELD = 'yield'
    CROSS = 'cross'
    WALK = 'walk'
    WAIT = 'wait'
    PARK = 'park'
    CHANGE_LANE = 'change_lane'
    TURN_LEFT = 'turn_left'
    TURN_RIGHT = 'turn_right'
    EMERGENCY_RUN = 'emergency_run'


# What somebody does for some time: standing, moving, or close behind somebody.
STANDING = frozenset({BehaviorKind.STOP, BehaviorKind.WAIT, BehaviorKind.PARK})
MOVING = frozenset(
    {
        BehaviorKind.DRIVE,
        BehaviorKind.WALK,
        BehaviorKind.CIRCULATE,
        BehaviorKind.FOLLOW,
        BehaviorKind.EMERGENCY_RUN,
    }
)


class MissionMode(StrEnum):
    HOVER = 'hover'
    TRACK = 'track'
    NAVIGATE = 'navigate'


class Pattern(StrEnum):
    RECTANGLE = 'rectangle'
    LINE = 'line'
    LAWNMOWER = 'lawnmower'
    ORBIT = 'orbit'
    WAYPOINTS = 'waypoints'


class Side(StrEnum):
    """Of a moving target, relative to its heading."""

    AHEAD = 'ahead'
    BEHIND = 'behind'
    LEFT = 'left'
    RIGHT = 'right'


class LaneSide(StrEnum):
    """Of a lane, in its direction of travel."""

    LEFT = 'left'
    RIGHT = 'right'


class LinkOcclusion(StrEnum):
    """What it does to a message that something stands in the line of sight."""

    SHORTENS = 'shortens'  # the range without sight counts
    BLOCKS = 'blocks'  # nothing passes
    IGNORED = 'ignored'  # as with sight


class ClauseStatus(StrEnum):
    """What became of a clause of the prompt."""

    ENCODED = 'encoded'
    NO_REQUIREMENT = 'no_requirement'
    NOT_ENCODED = 'not_encoded'
    NOT_JUDGED = 'not_judged'  # encoded, and no condition of the run depends on it

    @property
    def is_open(self) -> bool:
        """Whether a run with such a clause is incomplete."""
        return self in (ClauseStatus.NOT_ENCODED, ClauseStatus.NOT_JUDGED)
