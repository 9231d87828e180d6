# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is in the scene: world, ground agents, UAVs with their missions, message links."""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from aurora_core.document import omitted
from aurora_core.spec.parameter import Bound, Element, Parameter, Provenance, Span
from aurora_core.spec.reference import Id, PlaceRef
from aurora_core.spec.seed import Seed
from aurora_core.spec.vocabulary import (
    MOVING,
    STANDING,
    AgentType,
    BehaviorKind,
    LaneSide,
    LinkOcclusion,
    MissionMode,
    Pattern,
    Place,
    Relation,
    RelativeWind,
    Role,
    Side,
    TimeOfDay,
    TrafficDensity,
    Weather,
)


class World(Element):
    """Where and when: map name, weather, time of day, traffic, horizon (None = inferred).

    A wind that is named, in one of three ways or several, replaces that of the weather; so do
    gusts whose speed is named.

    Attributes:
        wind_mps: Mean speed of the wind.
        gust_mps: Speed of the wind at the height of a gust.
        wind_from_deg: Compass bearing that it comes from; None: open.
        wind: How it meets the longest leg, or the way of a tracked vehicle at capture.
        seed: The seed that the prompt asks for; None: that of the run.
    """

    map_name: str = 'downtown'
    weather: Weather = Weather.CLEAR
    weather_span: Span | None = None
    time_of_day: TimeOfDay = TimeOfDay.NOON
    time_of_day_span: Span | None = None
    traffic_density: TrafficDensity | None = None
    duration_s: Parameter | None = None
    wind_mps: Parameter | None = omitted(None)
    gust_mps: Parameter | None = omitted(None)
    wind_from_deg: Parameter | None = omitted(None)
    wind: RelativeWind | None = omitted(None)
    wind_span: Span | None = omitted(None)
    seed: Seed | None = omitted(None)
    span: Span | None = None

    @property
    def names_wind(self) -> bool:
        """Tell whether the request says something of the wind itself."""
        return not (self.wind_mps is None and self.wind_from_deg is None and self.wind is None)


class Placement(Element):
    """A place relative to an agent or a place.

    Attributes:
        relation: See `Relation`; ahead, behind, before, same_lane are measured along the route.
        of: Agent id or place; None when the relation needs none (e.g. `on` the road).
        distance_m: Between reference points.
        bearing_deg: Compass bearing from `of`, when stated.
        kept_in_motion: "drives ahead of", "follows behind": must hold along the route.
        throughout: "always", "never more than", "stays": not most of the time, but all along.
        distance_at_start: What the two do changes an exact distance, which therefore holds at
            t = 0 only (`planning.kept_distances`).
    """

    relation: Relation
    of: Id | PlaceRef | None = None
    distance_m: Parameter | None = None
    bearing_deg: Parameter | None = None
    kept_in_motion: bool = False
    throughout: bool = omitted(False)
    distance_at_start: bool = omitted(False)
    span: Span | None = None

    @property
    def keeps_distance(self) -> bool:
        """Tell whether the stated distance holds on the way, and not at t = 0 only.

        "Drives 20 m behind" does, unless one of the two then does what changes that; "always" and
        "at most" hold whatever they do.
        """
        distance = self.distance_m
        if distance is None or distance.provenance is not Provenance.EXPLICIT:
            return False
        bounded = distance.bound is not Bound.EXACTLY
        steady = self.throughout or bounded or not self.distance_at_start
        return self.kept_in_motion and steady


# Who does this has somebody ahead, and may be told how far in time.
KEEPS_HEADWAY = frozenset({BehaviorKind.FOLLOW, BehaviorKind.TAILGATE})


class Behavior(Element):
    """What an agent does.

    Attributes:
        kind: See `BehaviorKind`.
        target: Agent id or place it refers to.
        target_inferred: The prompt names no target; it was completed.
        speed_mps: Stated speed.
        closing_from_m: Tailgate or approach: distance to `target` at t = 0 and when the
            closing starts.
        headway_s: Follow or tailgate: bumper gap to the target divided by one's own speed.
        side: Of the lane that is changed to.
        duration_s: How long it does so: who stands drives on then, of the others nobody says that
            it ends.
    """

    kind: BehaviorKind
    target: Id | PlaceRef | None = None
    target_inferred: bool = omitted(False)
    speed_mps: Parameter | None = None
    closing_from_m: Parameter | None = None
    headway_s: Parameter | None = omitted(None)
    side: LaneSide | None = omitted(None)
    duration_s: Parameter | None = omitted(None)
    span: Span | None = None

    @model_validator(mode='after')
    def _side_is_of_a_lane(self) -> Self:
        if self.side is not None and self.kind is not BehaviorKind.CHANGE_LANE:
            raise ValueError(f'a side belongs to change_lane alone, found it with {self.kind}')
        if self.headway_s is not None and self.kind not in KEEPS_HEADWAY:
            raise ValueError(f'a headway belongs to following, found it with {self.kind}')
        return self

    @model_validator(mode='after')
    def _duration_is_of_what_lasts(self) -> Self:
        duration = self.duration_s
        if duration is not None and not lasts(self.kind, duration.bound):
            raise ValueError(f'{self.kind} lasts for no time, {duration.bound} {duration.value} s')
        return self


def lasts(kind: BehaviorKind, bound: Bound) -> bool:
    """Tell whether somebody does something for a time; that motion ends nobody sees to."""
    goes_on = kind in MOVING or kind is BehaviorKind.TAILGATE
    return kind in STANDING or (goes_on and bound is not Bound.AT_MOST)


class GroundAgent(Element):
    """One ground agent (a group of n is written as n agents with one `group` name)."""

    id: Id
    type: AgentType
    role: Role = Role.OTHER
    group: Id | None = None
    placements: tuple[Placement, ...] = ()
    behaviors: tuple[Behavior, ...] = ()
    span: Span | None = None


class UavMission(Element):
    """One mission phase of one UAV; several of one UAV are flown in the order listed.

    Attributes:
        target: Agent id or place that is tracked, observed or flown around (None: the scene).
        target_inferred: The prompt names no target; the scene rules chose it.
        start: Place that the way to the target begins at (`from A to B`); None: anywhere.
        altitude_m: Above ground.
        way_at_altitude: The way there is told with it ("flies to the tower at 40 m and hovers
            there"); see `has_a_level_way`.
        standoff_m: Horizontal distance from the target (track).
        bearing_deg: Compass bearing of the UAV from the target, when stated.
        side: Of the moving target, relative to its heading (track).
        duration_s: Of the mission phase alone.
        dwell_s: How long the UAV stays at each waypoint of a route.
        size_m: Pattern size (length, width), metres.
        turns: How often round an orbit goes; None: once, or as often as its time allows.
        over_streets: "over the streets"; see `over_a_road`.
        ends_in_flight: The request does not end with a landing.
    """

    id: Id
    uav: Id
    mode: MissionMode
    target: Id | PlaceRef | None = None
    target_inferred: bool = False
    start: PlaceRef | None = omitted(None)
    altitude_m: Parameter
    way_at_altitude: bool = omitted(False)
    standoff_m: Parameter | None = None
    bearing_deg: Parameter | None = None
    side: Side | None = omitted(None)
    duration_s: Parameter | None = None
    pattern: Pattern | None = None
    size_m: tuple[Parameter, Parameter] | None = None
    radius_m: Parameter | None = None
    waypoint_count: Parameter | None = None
    turns: Parameter | None = omitted(None)
    speed_mps: Parameter | None = None
    dwell_s: Parameter | None = omitted(None)
    over_streets: bool = False
    ends_in_flight: bool = False
    span: Span | None = None

    @property
    def over_a_road(self) -> bool:
        """Tell whether at least one leg has to lie over a carriageway.

        "Over the streets", and any pattern with legs over the main road: a road is no point that
        it would do to be centred on.
        """
        straight = self.pattern not in (None, Pattern.ORBIT)
        return self.over_streets or (straight and self.target == Place.MAIN_ROAD.value)

    @property
    def has_a_level_way(self) -> bool:
        """Tell whether the stated altitude is that of the way to where it begins, too.

        "Flies to the tower at 40 m" is nothing but a way. How high a UAV comes to where it hovers,
        tracks or begins a pattern at 40 m is open, unless the way itself is told so.
        """
        if self.altitude_m.provenance is not Provenance.EXPLICIT:
            return False
        count = self.waypoint_count
        there = self.pattern is Pattern.WAYPOINTS and self.target is not None
        is_way = there and self.start is None and count is not None and count.value == 1.0
        return is_way or self.way_at_altitude

    @model_validator(mode='after')
    def _mode_has_its_fields(self) -> Self:
        if self.mode is MissionMode.TRACK and (self.target is None or self.standoff_m is None):
            raise ValueError(f'mission {self.id}: track needs target and standoff_m')
        if self.mode is MissionMode.NAVIGATE and (self.pattern is None or self.speed_mps is None):
            raise ValueError(f'mission {self.id}: navigate needs pattern and speed_mps')
        if self.mode is not MissionMode.NAVIGATE and self.duration_s is None:
            raise ValueError(f'mission {self.id}: {self.mode} needs duration_s')
        if self.mode is not MissionMode.NAVIGATE and self.dwell_s is not None:
            raise ValueError(f'mission {self.id}: only a route has waypoints to dwell at')
        if self.mode is not MissionMode.TRACK and self.side is not None:
            raise ValueError(f'mission {self.id}: only who tracks keeps to a side')
        if self.mode is not MissionMode.HOVER and self.way_at_altitude:
            raise ValueError(f'mission {self.id}: only a hover is told with the way to it')
        if self.pattern is not Pattern.ORBIT and self.turns is not None:
            raise ValueError(f'mission {self.id}: only an orbit has turns')
        if self.start is not None and (
            self.pattern is not Pattern.WAYPOINTS or self.target in (None, self.start)
        ):
            raise ValueError(f'mission {self.id}: a way from {self.start} has to lead elsewhere')
        return self


class Uav(Element):
    """One UAV (a group of n is written as n UAVs with one `group` name)."""

    id: Id
    group: Id | None = omitted(None)
    span: Span | None = None


class Link(Element):
    """A directed message link.

    Attributes:
        sender: Agent or UAV; a roadside unit is an agent of the type `rsu`.
        loss: Probability that one transmission is lost; one that is not stated, and 0, rises
            towards the range where none is stated either.
        range_m: The same with and without sight; None: the limits' ranges.
        retransmissions: Further transmissions of a message that was lost.
        occlusion: What a building or vehicle between the two does: `shortens` the range to that
            without sight, `blocks` all, or is `ignored`.
        outage_s: From when to when nothing passes, in scenario time.
        rate_hz: Reports per second that the sender sends by itself; None: what events send.
    """

    id: Id
    sender: Id
    receiver: Id
    loss: Parameter
    latency_s: Parameter
    range_m: Parameter | None = None
    retransmissions: Parameter
    retransmission_interval_s: Parameter
    occlusion: LinkOcclusion = omitted(LinkOcclusion.SHORTENS)
    outage_s: tuple[Parameter, Parameter] | None = omitted(None)
    rate_hz: Parameter | None = omitted(None)
    span: Span | None = None

    @property
    def outage(self) -> tuple[float, float] | None:
        """From when to when nothing passes (s, scenario time), None for no outage."""
        return None if self.outage_s is None else (self.outage_s[0].value, self.outage_s[1].value)

    @model_validator(mode='after')
    def _outage_has_a_length(self) -> Self:
        if (
            self.outage_s is not None
            and not 0.0 <= self.outage_s[0].value < self.outage_s[1].value
        ):
            raise ValueError(f'link {self.id}: an outage begins at 0 s or later and then ends')
        if self.rate_hz is not None and self.rate_hz.value <= 0.0:
            raise ValueError(f'link {self.id}: rate_hz is above 0')
        return self
