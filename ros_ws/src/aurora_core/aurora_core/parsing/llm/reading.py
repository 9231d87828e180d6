# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Reading`: what a language model may answer.

Leaner than the specification. A model names what the prompt says and quotes the words; spans,
domains, defaults, roles, groups and ids are ours.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, FiniteFloat, StringConstraints

from aurora_core.document import Document
from aurora_core.spec.parameter import Unit
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    ClauseStatus,
    LaneSide,
    LinkOcclusion,
    MissionMode,
    Pattern,
    Relation,
    RelativeWind,
    Side,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

Name = Annotated[str, StringConstraints(pattern=r'^[a-z][a-z0-9_]{0,31}$')]
Reference = Annotated[str, StringConstraints(min_length=1, max_length=80)]
Quote = Annotated[str, StringConstraints(max_length=8192)]


class Number(Document):
    """A number in SI units (degrees for angles, ratios 0 to 1).

    Attributes:
        provenance: `explicit` when the prompt states it; then `quote` is where.
        quote: Words of the prompt, number and unit.
    """

    value: FiniteFloat
    unit: Unit
    provenance: Literal['explicit', 'inferred'] = 'explicit'
    quote: Quote = ''


class WorldReading(Document):
    """What the prompt says about the world; null: nothing."""

    weather: Weather | None = None
    time_of_day: TimeOfDay | None = None
    traffic_density: TrafficDensity | None = None
    duration_s: Number | None = None
    wind_mps: Number | None = None
    gust_mps: Number | None = None
    wind_from_deg: Number | None = None
    wind: RelativeWind | None = None


class PlacementReading(Document):
    relation: Relation
    of: Reference | None = None
    distance_m: Number | None = None
    bearing_deg: Number | None = None
    kept_in_motion: bool = False
    quote: Quote


class BehaviorReading(Document):
    kind: BehaviorKind
    target: Reference | None = None
    speed_mps: Number | None = None
    closing_from_m: Number | None = None
    headway_s: Number | None = None
    side: LaneSide | None = None
    duration_s: Number | None = None
    quote: Quote


class AgentReading(Document):
    id: Name
    type: AgentType
    quote: Quote
    placements: tuple[PlacementReading, ...] = ()
    behaviors: tuple[BehaviorReading, ...] = ()


class UavReading(Document):
    id: Name
    quote: Quote


class MissionReading(Document):
    """One phase; the phases of a UAV are flown in the order listed."""

    id: Name
    uav: Name
    mode: MissionMode
    target: Reference | None = None
    start: Reference | None = None
    altitude_m: Number | None = None
    standoff_m: Number | None = None
    bearing_deg: Number | None = None
    side: Side | None = None
    duration_s: Number | None = None
    pattern: Pattern | None = None
    length_m: Number | None = None
    width_m: Number | None = None
    radius_m: Number | None = None
    waypoint_count: Number | None = None
    turns: Number | None = None
    speed_mps: Number | None = None
    dwell_s: Number | None = None
    over_streets: bool = False
    ends_in_flight: bool = False
    quote: Quote


class LinkReading(Document):
    id: Name
    sender: Name
    receiver: Name
    loss: Number | None = None
    latency_s: Number | None = None
    range_m: Number | None = None
    retransmissions: Number | None = None
    retry_interval_s: Number | None = None
    occlusion: LinkOcclusion | None = None
    outage_from_s: Number | None = None
    outage_to_s: Number | None = None
    rate_hz: Number | None = None
    quote: Quote


class TriggerReading(Document):
    """A cause; which fields it needs depends on `on` (see `events._TRIGGERS`)."""

    on: Literal[
        'distance_below',
        'distance_above',
        'headway_below',
        'ttc_below',
        'time',
        'altitude_reached',
        'visible',
        'occluded',
        'arrives',
        'message_received',
        'speed_below',
        'speed_above',
        'event_done',
        'event_begun',
        'behavior_done',
        'mission_done',
        'battery_below',
    ]
    subject: Name | None = None
    other: Reference | None = None
    behavior: BehaviorKind | None = None
    value: Number | None = None


class ActionReading(Document):
    """An effect; `subject` acts."""

    do: Literal[
        'send_message',
        'brake',
        'stop',
        'slow',
        'accelerate',
        'change_lane',
        'yield',
        'start',
        'cross',
        'land',
        'return_home',
        'ascend',
        'change_mission',
    ]
    subject: Name
    receiver: Name | None = None
    text: Annotated[str, StringConstraints(max_length=200)] | None = None
    value: Number | None = None
    deceleration_mps2: Number | None = None
    vertical_mps: Number | None = None
    mission: Name | None = None
    side: LaneSide | None = None


class EventReading(Document):
    """Without a trigger its cause is left open, without an action it is a milestone."""

    id: Name
    trigger: TriggerReading | None = None
    action: ActionReading | None = None
    delay_s: Number | None = None
    quote: Quote


class OrderReading(Document):
    """One event or mission comes before another one."""

    id: Name
    first: Name
    then: Name
    within_s: Number | None = None
    quote: Quote


class ConditionReading(Document):
    """Something that the prompt demands: `stays within 20 m of the bus`.

    Attributes:
        of: Whom or what it is about, in the order of `operands`.
        op: None, as `value`, where the quantity is done or not (`landed`): then it is to be done.
    """

    id: Name
    quantity: Literal[
        'distance',
        'horizontal_distance',
        'separation',
        'altitude',
        'speed',
        'vertical_speed',
        'deceleration',
        'time_headway',
        'time_to_collision',
        'tracked_fraction',
        'visible_fraction',
        'visible_time',
        'hover_drift',
        'event_time',
        'delivery_latency',
        'delivery_ratio',
        'delivered',
        'clearance',
        'battery',
        'landed',
        'mission_completed',
        'waypoints_visited',
    ]
    of: tuple[Reference, ...]
    op: Literal['<=', '<', '>=', '>', '=='] | None = None
    value: Number | None = None
    hold_s: Number | None = None
    by_s: Number | None = None
    fraction: Number | None = None
    quote: Quote


class CountReading(Document):
    """How many of a kind there are in the whole scene: `exactly two cars`, `no other drone`."""

    id: Name
    kind: AgentType | Literal['uav', 'vehicle', 'person', 'body']
    value: Number
    quote: Quote


class ForbiddenReading(Document):
    """Something that must not be so; with the fields of exactly one kind.

    Attributes:
        agent: Ground agent that must never do `kind` (to `target`).
        type: No agent of this type, or no UAV, is there at all.
        sender: Who must send no message to `receiver`.
        weather: Not in this weather.
    """

    id: Name
    agent: Name | None = None
    kind: BehaviorKind | None = None
    target: Reference | None = None
    type: AgentType | Literal['uav'] | None = None
    sender: Name | None = None
    receiver: Name | None = None
    weather: Weather | None = None
    time_of_day: TimeOfDay | None = None
    traffic_density: TrafficDensity | None = None
    quote: Quote


class ClauseReading(Document):
    """A piece of the prompt and the ids that it became (`world` for weather and time)."""

    quote: Quote
    status: Literal[ClauseStatus.ENCODED, ClauseStatus.NO_REQUIREMENT, ClauseStatus.NOT_ENCODED]
    ids: tuple[Name, ...] = ()
    note: Annotated[str, StringConstraints(max_length=300)] = ''


class MissingReading(Document):
    """Something that the prompt names and that does not exist here."""

    quote: Quote
    kind: Literal['agent_type', 'landmark']


class Reading(Document):
    """The whole answer: a scene with its clauses, or a question, or what is missing."""

    world: WorldReading = WorldReading()
    agents: tuple[AgentReading, ...] = Field(default=(), max_length=201)
    uavs: tuple[UavReading, ...] = Field(default=(), max_length=50)
    missions: tuple[MissionReading, ...] = ()
    links: tuple[LinkReading, ...] = ()
    events: tuple[EventReading, ...] = ()
    orders: tuple[OrderReading, ...] = ()
    conditions: tuple[ConditionReading, ...] = ()
    counts: tuple[CountReading, ...] = ()
    forbidden: tuple[ForbiddenReading, ...] = ()
    clauses: tuple[ClauseReading, ...] = ()
    missing: tuple[MissingReading, ...] = ()
    question: Annotated[str, StringConstraints(max_length=1000)] | None = None
