# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom an event waits for at a place: a request whose premise never comes true is not realised.

"Upon seeing a police car the drone over the school …", "when the bus is within 80 m of the station
…": nobody says where they start, so they start where their way leads there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, sqrt

from aurora_core.grounding.places import ROADS, arrivals, has_point
from aurora_core.spec.events import (
    SLOWS,
    AgentAction,
    ArrivalTrigger,
    DistanceTrigger,
    Event,
    SendMessage,
    UavAction,
    VisibilityTrigger,
    bodies_of_cause,
)
from aurora_core.spec.flight_order import left_by
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec, UavMission
from aurora_core.spec.scene import Placement
from aurora_core.spec.vocabulary import AgentType, MissionMode, Pattern, Relation

# Out of reach of a route one starts so much farther off (m).
_BEYOND_M = 15.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Awaited:
    """Somebody who has to come near a place for an event to happen.

    Attributes:
        agent: Who.
        place: Where, a place with a point.
        event: What waits for it.
        within_m: Horizontal distance that is near enough; None: it has to come into view.
        mission: Of the UAV that waits there, None where none does.
    """

    agent: str
    place: str
    event: Event
    within_m: float | None
    mission: UavMission | None = None


def awaited_at(spec: ScenarioSpec) -> tuple[Awaited, ...]:
    """Return whom events wait for at places, of those to whom nothing else gives a place."""
    free = {
        agent.id
        for agent in spec.agents
        if agent.type is not AgentType.RSU and not _has_place(spec, agent)
    }
    return tuple(found for found in _awaited(spec) if found.agent in free)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leaving:
    """Somebody who has to get far from a place for an event to happen, and is near it before."""

    agent: str
    place: str
    event: Event
    beyond_m: float


def leaving(spec: ScenarioSpec) -> tuple[Leaving, ...]:
    """Return who is to get far from places, of those to whom nothing else gives a place.

    A UAV that hovers at a place is as far as that, and as it is high.
    """
    free = {agent.id for agent in spec.agents if not _has_place(spec, agent)}
    return tuple(
        found
        for event in spec.events
        if isinstance(event.trigger, DistanceTrigger) and event.trigger.on == 'distance_above'
        for agent, other in (
            (event.trigger.a, event.trigger.b),
            (event.trigger.b, event.trigger.a),
        )
        if agent in free
        for found in _leaving(spec, event, agent, other, event.trigger.value_m.value)
    )


def _leaving(
    spec: ScenarioSpec, event: Event, agent: str, other: str, value_m: float
) -> Iterator[Leaving]:
    if has_point(other):
        yield Leaving(agent=agent, place=other, event=event, beyond_m=value_m)
        return
    mission = _waiting_there(spec, event, other)
    hovers = mission is not None and mission.mode is MissionMode.HOVER
    if mission is None or not hovers or mission.target is None:
        return
    square = value_m * value_m - mission.altitude_m.value**2
    if square > 0.0:
        yield Leaving(agent=agent, place=mission.target, event=event, beyond_m=sqrt(square))


def is_kept_away(spec: ScenarioSpec, patrol: UavMission) -> bool:
    """Tell whether who ends a route by coming into view of it, or near, is far off before.

    A route over a street goes where that body drives: it begins so much farther on.
    """
    event = _comes_to(spec, patrol)
    trigger = None if event is None else event.trigger
    near = isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below'
    seen = isinstance(trigger, VisibilityTrigger) and trigger.on == 'visible'
    ours = event is not None and patrol.uav in bodies_of_cause(event)
    where = patrol.target
    return ours and (near or seen) and (where is None or where in ROADS or has_point(where))


def _comes_to(spec: ScenarioSpec, patrol: UavMission) -> Event | None:
    """Return the event that ends a flight, or that slows down who comes near one at no place."""
    event = left_by(spec, patrol)
    if event is not None or patrol.target is not None or patrol.mode is not MissionMode.HOVER:
        return event
    for event in spec.events:
        trigger, action = event.trigger, event.action
        near = isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below'
        slows = isinstance(action, AgentAction) and action.do in SLOWS
        if near and slows and bodies_of_cause(event) == {patrol.uav, getattr(action, 'agent', '')}:
            return event
    return None


def kept_away_m(spec: ScenarioSpec, patrol: UavMission, range_m: float) -> float:
    """Return how far from the middle of a route is out of its reach (m).

    Args:
        spec: The request.
        patrol: The route, which somebody ends by coming into view, or near.
        range_m: Of sight.
    """
    event = _comes_to(spec, patrol)
    trigger = None if event is None else event.trigger
    reach_m = trigger.value_m.value if isinstance(trigger, DistanceTrigger) else range_m
    sizes = [size.value / 2.0 for size in patrol.size_m or ()]
    sizes += [] if patrol.radius_m is None else [patrol.radius_m.value]
    return reach_m + hypot(*sizes) + _BEYOND_M


def near_its_partner(spec: ScenarioSpec, unit: GroundAgent) -> GroundAgent:
    """Return a roadside unit with a place where it can be told, and tell, what it is to.

    Nobody says where it is, but somebody's arrival is reported to it, or a UAV that stays at a
    place reports to it, or is told something by it: so near to that it is in reach of the radio.
    """
    if unit.type is not AgentType.RSU or unit.placements or unit.behaviors:
        return unit
    for event in spec.events:
        action = event.action
        if not isinstance(action, SendMessage) or unit.id not in (action.sender, action.receiver):
            continue
        told = action.receiver == unit.id
        stays = _waiting_there(spec, event, action.sender if told else action.receiver)
        place = None if stays is None else stays.target
        if told and isinstance(event.trigger, ArrivalTrigger):
            place = event.trigger.place
        if has_point(place):
            near = Placement(relation=Relation.NEAR, of=place)
            return unit.model_copy(update={'placements': (near,)})
    return unit


def bound_to_places(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a place decides where a vehicle stands or goes."""
    bound = {one.agent for one in awaited_at(spec)} | {one.agent for one in leaving(spec)}
    return _has_place(spec, agent) or agent.id in bound


def _has_place(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    names = [p.of for p in agent.placements] + [b.target for b in agent.behaviors]
    names += [t.place for t in arrivals(spec, agent)]
    return any(has_point(name) for name in names)


def _awaited(spec: ScenarioSpec) -> Iterator[Awaited]:
    agents = {agent.id for agent in spec.agents}
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, VisibilityTrigger) and trigger.on == 'visible':
            mission = _waiting_there(spec, event, trigger.observer)
            if mission is not None and mission.target is not None and trigger.target in agents:
                yield Awaited(
                    agent=trigger.target,
                    place=mission.target,
                    event=event,
                    within_m=None,
                    mission=mission,
                )
        elif isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below':
            for agent, other in ((trigger.a, trigger.b), (trigger.b, trigger.a)):
                if agent in agents:
                    yield from _near(spec, event, agent, other, trigger.value_m.value)


def _near(
    spec: ScenarioSpec, event: Event, agent: str, other: str, value_m: float
) -> Iterator[Awaited]:
    """Yield who is to come near a place, or a UAV that stays at one."""
    if has_point(other):
        yield Awaited(agent=agent, place=other, event=event, within_m=value_m)
        return
    mission = _waiting_there(spec, event, other)
    if mission is None or mission.target is None or value_m <= mission.altitude_m.value:
        return
    aside_m = sqrt(value_m * value_m - mission.altitude_m.value**2) + _out_to_m(mission)
    yield Awaited(
        agent=agent, place=mission.target, event=event, within_m=aside_m, mission=mission
    )


def _out_to_m(mission: UavMission) -> float:
    """Return how far from its middle a route passes on every side (m), 0 of a hover."""
    if mission.radius_m is not None and mission.pattern is Pattern.ORBIT:
        return mission.radius_m.value
    if mission.size_m is None or mission.pattern not in (Pattern.RECTANGLE, Pattern.LAWNMOWER):
        return 0.0
    return min(size.value for size in mission.size_m) / 2.0


def _waiting_there(spec: ScenarioSpec, event: Event, uav: str) -> UavMission | None:
    """Return the mission at a place in which a UAV awaits an event, None where there is none."""
    own = [m for m in spec.missions if m.uav == uav]
    ids = [m.id for m in own]
    action = event.action
    if isinstance(action, UavAction) and action.mission in ids[1:]:
        waiting = own[ids.index(action.mission) - 1]
    elif own:
        waiting = own[0]
    else:
        return None
    at_place = waiting.mode is not MissionMode.TRACK and has_point(waiting.target)
    return waiting if at_place else None
