# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ScenarioSpec`: the request as typed data.

References between elements are ids (`ego`, `van1`, `uav1`, `e1`); places are `Place` values or
`landmark:<name>`. Ids match `[a-z][a-z0-9_]{0,31}`.
"""

from __future__ import annotations

import json
from typing import Annotated, Literal, Self

from pydantic import Field, StringConstraints, model_validator

from aurora_core.spec.parameter import Document, Parameter, Span
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    ClauseStatus,
    MissionMode,
    Pattern,
    Relation,
    Role,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

Id = Annotated[str, StringConstraints(pattern=r'^[a-z][a-z0-9_]{0,31}$')]
PlaceRef = Annotated[
    str,
    StringConstraints(
        pattern=r'^(intersection|crosswalk|sidewalk|roadside|main_road|landmark:.{1,64})$'
    ),
]


class World(Document):
    """Where and when: map name, weather, time of day, traffic, horizon (None = inferred)."""

    map_name: str = 'downtown'
    weather: Weather = Weather.CLEAR
    weather_span: Span | None = None
    time_of_day: TimeOfDay = TimeOfDay.NOON
    time_of_day_span: Span | None = None
    traffic_density: TrafficDensity | None = None
    duration_s: Parameter | None = None
    span: Span | None = None


class Placement(Document):
    """A place relative to an agent or a place.

    Attributes:
        relation: See `Relation`; ahead, behind, before, same_lane are measured along the route.
        of: Agent id or place; None when the relation needs none (e.g. `on` the road).
        distance_m: Between reference points.
        bearing_deg: Compass bearing from `of`, when stated.
        kept_in_motion: "drives ahead of", "follows behind": must hold along the route.
    """

    relation: Relation
    of: Id | PlaceRef | None = None
    distance_m: Parameter | None = None
    bearing_deg: Parameter | None = None
    kept_in_motion: bool = False
    span: Span | None = None


class Behavior(Document):
    """What an agent does.

    Attributes:
        kind: See `BehaviorKind`.
        target: Agent id or place it refers to.
        speed_mps: Stated speed.
        closing_from_m: Tailgate or approach: distance to `target` at t = 0 and when the
            closing starts.
    """

    kind: BehaviorKind
    target: Id | PlaceRef | None = None
    speed_mps: Parameter | None = None
    closing_from_m: Parameter | None = None
    span: Span | None = None


class GroundAgent(Document):
    """One ground agent (a group of n is written as n agents with one `group` name)."""

    id: Id
    type: AgentType
    role: Role = Role.OTHER
    group: Id | None = None
    placements: tuple[Placement, ...] = ()
    behaviors: tuple[Behavior, ...] = ()
    span: Span | None = None


class UavMission(Document):
    """One mission phase of one UAV; several of one UAV are flown in the order listed.

    Attributes:
        target: Agent id or place that is tracked, observed or flown around (None: the scene).
        target_inferred: The prompt names no target; the scene rules chose it.
        altitude_m: Above ground.
        standoff_m: Horizontal distance from the target (track).
        bearing_deg: Compass bearing of the UAV from the target, when stated.
        duration_s: Of the mission phase alone.
        size_m: Pattern size (length, width), metres.
        over_streets: "over the streets": at least one leg lies over a carriageway.
        ends_in_flight: The request does not end with a landing.
    """

    id: Id
    uav: Id
    mode: MissionMode
    target: Id | PlaceRef | None = None
    target_inferred: bool = False
    altitude_m: Parameter
    standoff_m: Parameter | None = None
    bearing_deg: Parameter | None = None
    duration_s: Parameter | None = None
    pattern: Pattern | None = None
    size_m: tuple[Parameter, Parameter] | None = None
    radius_m: Parameter | None = None
    waypoint_count: Parameter | None = None
    speed_mps: Parameter | None = None
    over_streets: bool = False
    ends_in_flight: bool = False
    span: Span | None = None

    @model_validator(mode='after')
    def _mode_has_its_fields(self) -> Self:
        if self.mode is MissionMode.TRACK and (self.target is None or self.standoff_m is None):
            raise ValueError(f'mission {self.id}: track needs target and standoff_m')
        if self.mode is MissionMode.NAVIGATE and (self.pattern is None or self.speed_mps is None):
            raise ValueError(f'mission {self.id}: navigate needs pattern and speed_mps')
        if self.mode is not MissionMode.NAVIGATE and self.duration_s is None:
            raise ValueError(f'mission {self.id}: {self.mode} needs duration_s')
        return self


class Uav(Document):
    """One UAV."""

    id: Id
    span: Span | None = None


class Link(Document):
    """A directed message link."""

    id: Id
    sender: Id
    receiver: Id
    loss: Parameter
    latency_s: Parameter
    range_m: Parameter | None = None
    retransmissions: Parameter
    retransmission_interval_s: Parameter
    span: Span | None = None


class DistanceTrigger(Document):
    """3-D distance of two agents crosses a threshold."""

    on: Literal['distance_below', 'distance_above']
    a: Id
    b: Id | PlaceRef
    value_m: Parameter


class TimeTrigger(Document):
    """Scenario time reached."""

    on: Literal['time']
    at_s: Parameter


class AltitudeTrigger(Document):
    """A UAV reaches an altitude."""

    on: Literal['altitude_reached']
    uav: Id
    value_m: Parameter


class VisibilityTrigger(Document):
    """A UAV sees (or loses sight of) a target."""

    on: Literal['visible', 'occluded']
    observer: Id
    target: Id | PlaceRef


class ArrivalTrigger(Document):
    """An agent arrives at a place."""

    on: Literal['arrives']
    who: Id
    place: PlaceRef


class MessageTrigger(Document):
    """A message is received."""

    on: Literal['message_received']
    by: Id
    sender: Id | None = None


class SpeedTrigger(Document):
    """Speed crosses a threshold."""

    on: Literal['speed_below', 'speed_above']
    who: Id
    value_mps: Parameter


class EventDoneTrigger(Document):
    """Another event is done, plus a delay."""

    on: Literal['event_done']
    event: Id
    after_s: Parameter | None = None


class MissionDoneTrigger(Document):
    """A UAV has finished its missions."""

    on: Literal['mission_done']
    uav: Id


Trigger = Annotated[
    DistanceTrigger
    | TimeTrigger
    | AltitudeTrigger
    | VisibilityTrigger
    | ArrivalTrigger
    | MessageTrigger
    | SpeedTrigger
    | EventDoneTrigger
    | MissionDoneTrigger,
    Field(discriminator='on'),
]


class SendMessage(Document):
    """Send a message over the link between the two."""

    do: Literal['send_message']
    sender: Id
    receiver: Id


class AgentAction(Document):
    """A ground agent changes what it does."""

    do: Literal['brake', 'stop', 'slow', 'accelerate', 'change_lane', 'yield', 'start', 'cross']
    agent: Id
    value_mps: Parameter | None = None


class UavAction(Document):
    """A UAV changes what it does."""

    do: Literal['land', 'ascend', 'change_mission']
    uav: Id
    altitude_m: Parameter | None = None
    mission: Id | None = None


EventAction = Annotated[SendMessage | AgentAction | UavAction, Field(discriminator='do')]


class Event(Document):
    """When `trigger` then `action`, within 1 s plus `delay_s`."""

    id: Id
    trigger: Trigger | None = None
    action: EventAction | None = None
    delay_s: Parameter | None = None
    span: Span | None = None


def bodies_of(event: Event) -> frozenset[str]:
    """Return every agent and UAV that an event's trigger and action refer to by id."""
    names = ('a', 'b', 'uav', 'observer', 'target', 'who', 'by', 'sender', 'receiver', 'agent')
    found = {getattr(part, name, None) for part in (event.trigger, event.action) for name in names}
    return frozenset(n for n in found if n is not None and not is_place(n))


class StatedCondition(Document):
    """A condition the prompt itself states; quantity names are those of the contract."""

    id: Id
    quantity: str
    of: tuple[Id | PlaceRef, ...]
    op: Literal['<=', '<', '>=', '>', '==']
    value: Parameter
    hold_s: Parameter | None = None
    by_s: Parameter | None = None
    fraction: Parameter | None = None
    span: Span | None = None


class Clause(Document):
    """A piece of the prompt and what became of it."""

    text: str
    span: Span
    status: ClauseStatus
    ids: tuple[str, ...] = ()
    note: str = ''


class ScenarioSpec(Document):
    """The whole request. Built and edited only through validation."""

    schema_version: Literal[1] = 1
    prompt: str
    world: World = World()
    agents: tuple[GroundAgent, ...] = ()
    uavs: tuple[Uav, ...] = ()
    missions: tuple[UavMission, ...] = ()
    links: tuple[Link, ...] = ()
    events: tuple[Event, ...] = ()
    conditions: tuple[StatedCondition, ...] = ()
    clauses: tuple[Clause, ...] = ()

    @model_validator(mode='after')
    def _references_resolve(self) -> Self:
        ids = [
            element.id
            for group in (
                self.agents,
                self.uavs,
                self.missions,
                self.links,
                self.events,
                self.conditions,
            )
            for element in group
        ]
        repeated = sorted({i for i in ids if ids.count(i) > 1})
        if repeated:
            raise ValueError(f'ids must be unique, repeated: {", ".join(repeated)}')
        bodies = {a.id for a in self.agents} | {u.id for u in self.uavs}
        for owner, reference in self._body_references():
            if reference not in bodies and not is_place(reference):
                raise ValueError(f'{owner} refers to {reference!r}, which is not in the scene')
        uavs = {u.id for u in self.uavs}
        for mission in self.missions:
            if mission.uav not in uavs:
                raise ValueError(f'mission {mission.id} refers to unknown UAV {mission.uav!r}')
        events = {e.id for e in self.events}
        for event in self.events:
            after = event.trigger.event if isinstance(event.trigger, EventDoneTrigger) else None
            if after is not None and after not in events:
                raise ValueError(f'event {event.id} waits for unknown event {after!r}')
            for part in (event.trigger, event.action):
                for name in ('uav', 'observer'):
                    flyer = getattr(part, name, None)
                    if flyer is not None and flyer not in uavs:
                        raise ValueError(f'event {event.id} refers to unknown UAV {flyer!r}')
        if sum(a.role is Role.EGO for a in self.agents) > 1:
            raise ValueError('there can be one ego only')
        return self

    def _body_references(self) -> list[tuple[str, str]]:
        found: list[tuple[str, str]] = []
        for agent in self.agents:
            found += [(agent.id, p.of) for p in agent.placements if p.of is not None]
            found += [(agent.id, b.target) for b in agent.behaviors if b.target is not None]
        found += [(m.id, m.target) for m in self.missions if m.target is not None]
        for link in self.links:
            found += [(link.id, link.sender), (link.id, link.receiver)]
        for event in self.events:
            if event.trigger is not None:
                names = ('a', 'b', 'uav', 'observer', 'target', 'who', 'by', 'sender')
                values = (getattr(event.trigger, name, None) for name in names)
                found += [(event.id, value) for value in values if value is not None]
            if isinstance(event.action, SendMessage):
                found += [(event.id, event.action.sender), (event.id, event.action.receiver)]
            if isinstance(event.action, AgentAction):
                found.append((event.id, event.action.agent))
            if isinstance(event.action, UavAction):
                found.append((event.id, event.action.uav))
        return found

    def canonical_json(self) -> str:
        """Return the one byte-exact JSON text (sorted keys, no blanks) that digests use."""
        return json.dumps(
            self.model_dump(mode='json'), sort_keys=True, separators=(',', ':'), ensure_ascii=False
        )


def is_place(reference: str) -> bool:
    """Tell whether a reference names a place, not an element of the scene."""
    return reference.startswith('landmark:') or reference in (
        'intersection',
        'crosswalk',
        'sidewalk',
        'roadside',
        'main_road',
    )
