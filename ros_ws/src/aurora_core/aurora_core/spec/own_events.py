# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Behaviours that are one action at some time: the events that nobody listed."""

from __future__ import annotations

from typing import get_args

from aurora_core.spec.events import (
    AgentAction,
    AgentDo,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    SendMessage,
    bodies_of_cause,
)
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.scenario import Behavior, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind

# Behaviours that are carried out as the action of the same name.
ONCE = frozenset(
    {BehaviorKind.BRAKE, BehaviorKind.SLOW, BehaviorKind.YIELD, BehaviorKind.CHANGE_LANE}
)

# One yields to somebody who is this near (m).
YIELDS_WITHIN_M = 30.0

# These do not drive in the lanes for cars.
_NO_LANES = frozenset({AgentType.PEDESTRIAN, AgentType.RSU, AgentType.BICYCLE})
_ON_FOOT = frozenset({AgentType.PEDESTRIAN, AgentType.RSU})


def keeps_to_lanes(agent: GroundAgent) -> bool:
    """Tell whether an agent drives in the lanes for cars."""
    return agent.type not in _NO_LANES


def is_once(spec: ScenarioSpec, agent: GroundAgent, behavior: Behavior) -> bool:
    """Tell whether a behaviour is an action that the agent can take at some time."""
    if behavior.kind is BehaviorKind.YIELD:
        others = {a.id for a in spec.agents if a.type is not AgentType.RSU} - {agent.id}
        return agent.type not in _ON_FOOT and behavior.target in others
    if behavior.kind is BehaviorKind.CHANGE_LANE:
        return keeps_to_lanes(agent)
    slows = behavior.kind in (BehaviorKind.BRAKE, BehaviorKind.SLOW)
    return slows and agent.type not in _ON_FOOT and not _is_pushed(spec, agent, behavior)


def _is_pushed(spec: ScenarioSpec, agent: GroundAgent, behavior: Behavior) -> bool:
    """Tell whether one who brakes has somebody close behind, who could not stop in time."""
    return behavior.kind is BehaviorKind.BRAKE and any(
        b.kind is BehaviorKind.TAILGATE and b.target == agent.id
        for other in spec.agents
        for b in other.behaviors
    )


def own_events(spec: ScenarioSpec) -> tuple[Event, ...]:
    """Return the events that behaviours stand for, with ids that no listed event has.

    Nobody says when they happen, but one yields once the other one is near. What a listed event
    lets the same agent do is that behaviour.
    """
    listed = {
        (event.action.agent, event.action.do)
        for event in spec.events
        if isinstance(event.action, AgentAction)
    }
    taken = {event.id for event in spec.events}
    found: list[Event] = []
    for agent in spec.agents:
        for behavior in agent.behaviors:
            if not is_once(spec, agent, behavior) or (agent.id, behavior.kind.value) in listed:
                continue
            number = len(found) + 1
            while f'own{number}' in taken:
                number += 1
            taken.add(f'own{number}')
            found.append(_event(f'own{number}', agent, behavior))
    return tuple(found)


def overtakings(spec: ScenarioSpec) -> tuple[tuple[str, str], ...]:
    """Return who is to overtake whom, of those who keep to lanes."""
    ids = {agent.id for agent in spec.agents if agent.type is not AgentType.PEDESTRIAN}
    return tuple(
        (agent.id, behavior.target)
        for agent in spec.agents
        if keeps_to_lanes(agent)
        for behavior in agent.behaviors
        if behavior.kind is BehaviorKind.OVERTAKE and behavior.target in ids - {agent.id}
    )


def let_pass(spec: ScenarioSpec, event: Event) -> str | None:
    """Return the agent that an event makes another one yield to, None where it is not one.

    Where the event names none it is the one that its cause is about: of a message, what was told.
    """
    if not isinstance(event.action, AgentAction) or event.action.do != 'yield':
        return None
    cause: Event | None = event
    seen = {event.action.agent}
    while cause is not None and cause.id not in seen:
        seen.add(cause.id)
        others = [a.id for a in spec.agents if a.id in _about(cause) - seen and _may_pass(a)]
        if others:
            return others[0] if len(others) == 1 else None
        cause = _cause_of(spec, cause)
    return None


def _about(event: Event) -> frozenset[str]:
    """Return the bodies that an event is about; who only hears of it is none of them."""
    bodies = bodies_of_cause(event)
    if isinstance(event.trigger, MessageTrigger):
        bodies -= {event.trigger.by}
    return bodies | ({event.action.agent} if isinstance(event.action, AgentAction) else set())


def _may_pass(agent: GroundAgent) -> bool:
    return agent.type is not AgentType.RSU


def _cause_of(spec: ScenarioSpec, event: Event) -> Event | None:
    """Return the event that another one waits for: by its name, or by its message."""
    trigger = event.trigger
    for other in spec.events:
        action = other.action
        if isinstance(trigger, EventDoneTrigger) and other.id == trigger.event:
            return other
        if isinstance(trigger, MessageTrigger) and isinstance(action, SendMessage):
            told = action.receiver == trigger.by
            if told and trigger.sender in (None, action.sender):
                return other
    return None


def let_cross(spec: ScenarioSpec) -> tuple[tuple[str, str], ...]:
    """Return which vehicle is to let which person cross its way."""
    persons = {agent.id for agent in spec.agents if agent.type is AgentType.PEDESTRIAN}
    pairs = (
        (event.action.agent, let_pass(spec, event))
        for event in (*spec.events, *own_events(spec))
        if isinstance(event.action, AgentAction)
    )
    found = ((agent, other) for agent, other in pairs if other in persons and other is not None)
    return tuple(dict.fromkeys((a, b) for a, b in found if a not in persons))


def _event(event_id: str, agent: GroundAgent, behavior: Behavior) -> Event:
    do: AgentDo = next(do for do in get_args(AgentDo) if do == behavior.kind.value)
    trigger = None
    if behavior.kind is BehaviorKind.YIELD and behavior.target is not None:
        near = Parameter(
            value=YIELDS_WITHIN_M,
            unit=Unit.METRE,
            low=YIELDS_WITHIN_M,
            high=YIELDS_WITHIN_M,
            provenance=Provenance.DEFAULT,
        )
        trigger = DistanceTrigger(on='distance_below', a=behavior.target, b=agent.id, value_m=near)
    speed = behavior.speed_mps if behavior.kind is BehaviorKind.SLOW else None
    return Event(
        id=event_id,
        trigger=trigger,
        action=AgentAction(do=do, agent=agent.id, value_mps=speed, side=behavior.side),
        span=behavior.span,
    )


def told_to_change_lane(spec: ScenarioSpec) -> frozenset[str]:
    """Return the ids of those who change lane, by an event or by themselves."""
    return frozenset(
        e.action.agent
        for e in (*spec.events, *own_events(spec))
        if isinstance(e.action, AgentAction) and e.action.do == 'change_lane'
    )
