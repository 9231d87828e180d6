# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A prompt with its annotated requirements, as one line of a prompt file holds it.

Numbers are in metres, seconds and metres per second, angles in degrees. A field that is left out
is not required. The models are closed: an unknown field is an error. What came later than the
shipped files (wind, counts of the scene, sides, outages, `beyond`, ...) is optional everywhere:
files without it stay valid.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, FiniteFloat, NonNegativeInt, StrictBool, StringConstraints

from aurora_core.document import Document
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Relation,
)

Id = Annotated[str, StringConstraints(pattern=r'^[a-z0-9]+(-[a-z0-9]+)*$')]
Ref = Annotated[str, StringConstraints(min_length=1, max_length=64)]
Category = Literal[
    'hover', 'track', 'patrol', 'spatial', 'multi_agent', 'environment', 'communication',
    'perception', 'sequential', 'conditional', 'boundary', 'infeasible', 'multi_uav',
]  # fmt: skip
Feasibility = Literal['feasible', 'boundary', 'infeasible']
Because = Literal[
    'altitude_limit', 'speed_limit', 'endurance', 'geofence', 'sensing_range', 'standoff',
    'duration', 'count', 'clearance', 'separation', 'temporal_contradiction',
    'spatial_contradiction', 'comm_range', 'missing_element', 'unsupported',
]  # fmt: skip
Side = Literal['ahead', 'behind', 'left', 'right']
# Patterns of the product, and those that annotations name beside them.
PatternName = Pattern | Literal['facade', 'street']
LowHigh = tuple[FiniteFloat, FiniteFloat]
QuantityName = Literal[
    'distance', 'horizontal_distance', 'separation', 'altitude', 'speed', 'tracked_fraction',
    'visible_time', 'visible_fraction', 'delivery_latency', 'delivered', 'delivery_ratio',
    'event_time', 'hover_drift', 'waypoints_visited', 'mission_completed', 'landed',
    'clearance', 'battery', 'wind', 'deceleration',
    'time_headway', 'time_to_collision', 'vertical_speed',
]  # fmt: skip


class _Requirement(Document):
    """What every requirement has.

    Attributes:
        id: Unique in the prompt.
        negate: It must not be so.
        tol: Absolute tolerance of the only number, or of each number by field name; 1 % of the
            value where none is given.
    """

    id: Id
    negate: bool = False
    tol: FiniteFloat | dict[str, FiniteFloat] | None = None


class WorldRequirement(_Requirement):
    """One field of the world; `wind_from_deg` is the compass bearing that it blows from."""

    kind: Literal['world']
    field: Literal[
        'weather', 'time_of_day', 'map', 'traffic_density', 'duration_s', 'wind_mps',
        'gust_mps', 'wind_from_deg', 'wind',
    ]  # fmt: skip
    value: str | FiniteFloat


class AgentRequirement(_Requirement):
    """A ground agent or a group of equal ones; a count of 0 means that none may appear."""

    kind: Literal['agent']
    ref: Ref
    type: AgentType
    count: NonNegativeInt = 1
    role: Literal['ego', 'target', 'background'] | None = None


class CountRequirement(_Requirement):
    """How many there are, of a type or of what names stand for.

    Attributes:
        type: `vehicle` is every type that drives, `uav` every UAV.
        of: In place of the type.
        scope: `scene`: in the whole run, background included.
    """

    kind: Literal['count']
    type: AgentType | Literal['vehicle', 'uav'] | None = None
    of: Ref | tuple[Ref, ...] | None = None
    value: NonNegativeInt
    scope: Literal['scene'] | None = None


class PlacementRequirement(_Requirement):
    """Where an agent is, relative to a body or a place.

    Attributes:
        kept: It is told with motion ("drives 30 m behind") and holds along the route, too.
    """

    kind: Literal['placement']
    agent: Ref
    relation: Relation
    of: Ref | None = None
    distance_m: FiniteFloat | None = None
    bearing_deg: FiniteFloat | None = None
    kept: StrictBool | None = None


class BehaviorRequirement(_Requirement):
    """What an agent does."""

    kind: Literal['behavior']
    agent: Ref
    behavior: BehaviorKind
    target: Ref | None = None
    speed_mps: FiniteFloat | None = None
    headway_s: FiniteFloat | None = None  # of who follows or tailgates
    side: Literal['left', 'right'] | None = None  # of the lane that change_lane goes to
    duration_s: FiniteFloat | None = None  # how long it stands, or goes on


class UavRequirement(_Requirement):
    """A UAV or a group of equal ones."""

    kind: Literal['uav']
    ref: Ref
    count: NonNegativeInt = 1


class MissionRequirement(_Requirement):
    """A phase of a UAV's flight; altitude above ground, standoff horizontal.

    Attributes:
        altitude_m: A pair is the lowest and the highest one (of a facade).
        side: Of the target's heading.
        start, end: Places.
        turns: Number of orbits.
        avoid, avoid_m: Places to keep away from, and how far.
    """

    kind: Literal['mission']
    ref: Ref
    uav: Ref
    mode: MissionMode
    target: Ref | None = None
    altitude_m: FiniteFloat | LowHigh | None = None
    standoff_m: FiniteFloat | None = None
    bearing_deg: FiniteFloat | None = None
    duration_s: FiniteFloat | None = None
    pattern: PatternName | None = None
    size_m: tuple[FiniteFloat, FiniteFloat] | None = None
    radius_m: FiniteFloat | None = None
    waypoint_count: FiniteFloat | None = None
    speed_mps: FiniteFloat | None = None
    side: Side | None = None
    start: Ref | None = None
    end: Ref | None = None
    turns: FiniteFloat | None = None
    avoid: tuple[Ref, ...] | None = None
    avoid_m: FiniteFloat | None = None


class LinkRequirement(_Requirement):
    """A directed radio link, perhaps with an outage or with a stream of reports at a rate."""

    kind: Literal['link']
    sender: Ref
    receiver: Ref
    loss: FiniteFloat | None = None
    latency_s: FiniteFloat | None = None
    range_m: FiniteFloat | None = None
    retransmissions: FiniteFloat | None = None
    outage_s: LowHigh | None = None
    rate_hz: FiniteFloat | None = None


class Trigger(Document):
    """What makes an event happen; which fields go with `on` is in `FIELDS_OF_TRIGGER`."""

    on: Literal[
        'distance_below', 'distance_above', 'visible', 'occluded', 'time', 'altitude_reached',
        'arrives', 'message_received', 'speed_below', 'speed_above', 'event_done', 'mission_done',
        'battery_below', 'headway_below', 'ttc_below', 'behavior_done', 'event_begun',
    ]  # fmt: skip
    a: Ref | None = None
    b: Ref | None = None
    value_m: FiniteFloat | None = None
    value_s: FiniteFloat | None = None
    observer: Ref | None = None
    target: Ref | None = None
    at_s: FiniteFloat | None = None
    uav: Ref | None = None
    who: Ref | None = None
    place: Ref | None = None
    by: Ref | None = None
    from_: Annotated[Ref | None, Field(alias='from')] = None
    value_mps: FiniteFloat | None = None
    event: Ref | None = None
    after_s: FiniteFloat | None = None
    behavior: BehaviorKind | None = None  # of `who`, for a stated time
    value: FiniteFloat | None = None  # share of a full battery


FIELDS_OF_TRIGGER: dict[str, frozenset[str]] = {
    'distance_below': frozenset({'a', 'b', 'value_m'}),
    'distance_above': frozenset({'a', 'b', 'value_m'}),
    'headway_below': frozenset({'a', 'b', 'value_s'}),
    'ttc_below': frozenset({'a', 'b', 'value_s'}),
    'visible': frozenset({'observer', 'target'}),
    'occluded': frozenset({'observer', 'target'}),
    'time': frozenset({'at_s'}),
    'altitude_reached': frozenset({'uav', 'value_m'}),
    'arrives': frozenset({'who', 'place'}),
    'message_received': frozenset({'by', 'from'}),
    'speed_below': frozenset({'who', 'value_mps'}),
    'speed_above': frozenset({'who', 'value_mps'}),
    'event_done': frozenset({'event', 'after_s'}),
    'event_begun': frozenset({'event', 'after_s'}),
    'behavior_done': frozenset({'who', 'behavior'}),
    'mission_done': frozenset({'uav'}),
    'battery_below': frozenset({'uav', 'value'}),
}


class Action(Document):
    """What an event does; which fields go with `do` is in `fields_of_action`."""

    do: Literal[
        'send_message', 'brake', 'stop', 'slow', 'accelerate', 'change_lane', 'yield', 'start',
        'cross', 'change_mission', 'land', 'ascend', 'return_home', 'hand_over',
    ]  # fmt: skip
    sender: Ref | None = None
    receiver: Ref | None = None
    text: Annotated[str, StringConstraints(min_length=1)] | None = None
    agent: Ref | None = None
    value_mps: FiniteFloat | None = None
    deceleration_mps2: FiniteFloat | None = None
    vertical_mps: FiniteFloat | None = None  # of ascend, up or down
    uav: Ref | None = None
    to: Ref | None = None
    mode: MissionMode | None = None
    target: Ref | None = None
    altitude_m: FiniteFloat | LowHigh | None = None
    standoff_m: FiniteFloat | None = None
    bearing_deg: FiniteFloat | None = None
    duration_s: FiniteFloat | None = None
    pattern: PatternName | None = None
    size_m: tuple[FiniteFloat, FiniteFloat] | None = None
    radius_m: FiniteFloat | None = None
    waypoint_count: FiniteFloat | None = None
    speed_mps: FiniteFloat | None = None
    side: Side | None = None
    start: Ref | None = None
    end: Ref | None = None
    turns: FiniteFloat | None = None
    avoid: tuple[Ref, ...] | None = None
    avoid_m: FiniteFloat | None = None


# What describes the flight itself: `change_mission` takes these fields too.
MISSION_FIELDS = frozenset(MissionRequirement.model_fields) - {
    *_Requirement.model_fields, 'kind', 'ref', 'uav',
}  # fmt: skip


def fields_of_action(do: str) -> frozenset[str]:
    """Return the fields that an action of this kind may have."""
    if do == 'send_message':
        return frozenset({'sender', 'receiver', 'text'})
    if do == 'change_mission':
        return MISSION_FIELDS | {'uav'}
    if do == 'ascend':
        return frozenset({'uav', 'altitude_m', 'vertical_mps'})
    if do == 'land':
        return frozenset({'uav', 'altitude_m'})
    if do == 'return_home':
        return frozenset({'uav'})
    if do == 'hand_over':
        return frozenset({'uav', 'to'})
    if do == 'change_lane':
        return frozenset({'agent', 'value_mps', 'side'})
    if do in ('brake', 'stop', 'slow'):
        return frozenset({'agent', 'value_mps', 'deceleration_mps2'})
    return frozenset({'agent', 'value_mps'})


class EventRequirement(_Requirement):
    """A trigger and what follows, `once` or every time; one of the two may be missing.

    Attributes:
        within_s: So soon after the trigger the action is done, or sets in where it has no end.
    """

    kind: Literal['event']
    ref: Ref
    trigger: Trigger | None = None
    action: Action | None = None
    once: StrictBool | None = None
    within_s: FiniteFloat | None = None


class OrderRequirement(_Requirement):
    """One event or mission comes before another."""

    kind: Literal['order']
    first: Ref
    then: Ref
    within_s: FiniteFloat | None = None


class ConditionRequirement(_Requirement):
    """A condition that the prompt states."""

    kind: Literal['condition']
    quantity: QuantityName
    of: tuple[Ref, ...] = ()
    op: Literal['<=', '<', '>=', '>', '==']
    value: StrictBool | FiniteFloat
    hold_s: FiniteFloat | None = None
    by_s: FiniteFloat | None = None
    fraction: FiniteFloat | None = None


class RejectRequirement(_Requirement):
    """The request must be refused, for this reason."""

    kind: Literal['reject']
    because: Because


class BeyondRequirement(_Requirement):
    """Something asked for that no field holds: listed, never scored."""

    kind: Literal['beyond']
    text: Annotated[str, StringConstraints(min_length=1)]


class AnyOfRequirement(_Requirement):
    """One of several fair readings suffices."""

    kind: Literal['any_of']
    any_of: Annotated[tuple[Requirement, ...], Field(min_length=2)]


Requirement = Annotated[
    WorldRequirement
    | AgentRequirement
    | CountRequirement
    | PlacementRequirement
    | BehaviorRequirement
    | UavRequirement
    | MissionRequirement
    | LinkRequirement
    | EventRequirement
    | OrderRequirement
    | ConditionRequirement
    | RejectRequirement
    | BeyondRequirement
    | AnyOfRequirement,
    Field(discriminator='kind'),
]


class AnnotatedPrompt(Document):
    """One line of a prompt file.

    Attributes:
        paraphrase_group: Prompts of one group ask for the same in other words.
        end_to_end: Executed, not only parsed.
        reference: A specification that says the same.
        realization: Values that are known to work.
        variation: By `<requirement id>.<field>`: the range in which a number still counts.
    """

    id: Id
    category: Category
    prompt: Annotated[str, StringConstraints(min_length=1)]
    feasibility: Feasibility
    paraphrase_group: Id | None
    end_to_end: bool
    requirements: Annotated[tuple[Requirement, ...], Field(min_length=1)]
    reference: dict[str, Any] | None = None
    realization: dict[str, Any] | None = None
    variation: dict[str, tuple[FiniteFloat, FiniteFloat]] = Field(default_factory=dict)


AnyOfRequirement.model_rebuild()
AnnotatedPrompt.model_rebuild()


def everything(requirements: tuple[Requirement, ...]) -> tuple[Requirement, ...]:
    """Return all requirements: each `any_of`, followed by its readings."""
    found: list[Requirement] = []
    for requirement in requirements:
        found.append(requirement)
        if isinstance(requirement, AnyOfRequirement):
            found += everything(requirement.any_of)
    return tuple(found)


def flat(requirements: tuple[Requirement, ...]) -> tuple[Requirement, ...]:
    """Return requirements with the readings of every `any_of` in place of it."""
    return tuple(r for r in everything(requirements) if not isinstance(r, AnyOfRequirement))


def beyond(prompt: AnnotatedPrompt) -> tuple[BeyondRequirement, ...]:
    """Return what a prompt asks for that no field of an annotation holds."""
    return tuple(r for r in flat(prompt.requirements) if isinstance(r, BeyondRequirement))


def stated_fields(value: Document) -> dict[str, Any]:
    """Return the fields that an annotation states, by their names in the file."""
    return {
        ('from' if name == 'from_' else name): item
        # In the order of the model: a set has none, and results must be the same every time.
        for name in type(value).model_fields
        if name in value.model_fields_set and (item := getattr(value, name)) is not None
    }
