# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the specification can say and no run carries out yet.

The conditions of such elements are left out of a run, which ends as `incomplete`: that nobody
does it is no violation.
"""

from __future__ import annotations

from collections.abc import Mapping

from aurora_core.conditions.behaviors import behavior_id
from aurora_core.conditions.placements import placement_id
from aurora_core.grounding.convoy import can_be_placed
from aurora_core.grounding.nearby import ON_SIDEWALKS, can_stand
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.flight_order import begun_by
from aurora_core.spec.own_events import ONCE, is_once, keeps_to_lanes
from aurora_core.spec.scenario import (
    AgentAction,
    Behavior,
    Event,
    EventAction,
    EventDoneTrigger,
    GroundAgent,
    MessageTrigger,
    Placement,
    ScenarioSpec,
    SendMessage,
    UavAction,
    bodies_of,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind

# What persons do, beside standing; walking and crossing a street are for them alone.
_ON_FOOT = frozenset(
    {
        BehaviorKind.CROSS,
        BehaviorKind.WALK,
        BehaviorKind.STOP,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
    }
)


def unsupported(spec: ScenarioSpec, grounded: GroundedScenario) -> tuple[str, ...]:
    """Return what the specification says and nobody carries out, as `id: what`."""
    found = list(grounded.unsupported)
    for agent in spec.agents:
        kinds = [b.kind for b in agent.behaviors if not _can_do(spec, agent, b)]
        found += [f'{agent.id}: behaviour {kind.value}' for kind in kinds]
        if agent.type in ON_SIDEWALKS:
            odd = [p for p in agent.placements if not can_stand(agent, p, spec)]
            found += [f'{agent.id}: placement {p.relation.value} {p.of or ""}' for p in odd]
    undone = undone_events(spec, grounded)
    return (*found, *(f'{name}: {what}' for name, what in undone.items() if what))


def judgeable(
    conditions: tuple[Condition, ...],
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    agent: str | None = None,
) -> tuple[Condition, ...]:
    """Leave out what cannot be placed or carried out yet; its clauses are `incomplete`.

    Args:
        conditions: Those of a request, or of the placements and behaviours of `agent` alone.
        spec: The request.
        grounded: What has a place.
        agent: The one ground agent that the conditions are derived from, None: all of them.
    """
    agents = [a for a in spec.agents if agent in (None, a.id)]
    absent = {a.id for a in spec.agents} - {a.id for a in grounded.agents}
    events = undone_events(spec, grounded)
    undone = [
        behavior_id(a, index)
        for a in agents
        for index, behavior in enumerate(a.behaviors)
        if not _can_do(spec, a, behavior)
    ]
    undone += [
        placement_id(a, index)
        for a in agents
        for index, placement in enumerate(a.placements)
        if not _can_be_placed(a, placement, spec)
    ]
    return tuple(
        c
        for c in conditions
        if not absent & set(c.of)
        and c.arguments.event not in events
        and not events.keys() & set(c.of)
        and not any(c.id == name or c.id.startswith(f'{name}.') for name in undone)
    )


def undone_events(spec: ScenarioSpec, grounded: GroundedScenario) -> dict[str, str]:
    """Return the events that cannot happen, with what is missing ('' is said elsewhere)."""
    absent = {a.id for a in spec.agents} - {a.id for a in grounded.agents}
    undone: dict[str, str] = {}
    for event in spec.events:
        if event.action is not None and not _can_act(event.action, spec):
            undone[event.id] = f'action {event.action.do}'
        elif bodies_of(event) & absent:
            undone[event.id] = ''
        elif _flies_after_landing(event, spec):
            undone[event.id] = 'a flight after a landing'
    while blocked := [
        e for e in spec.events if e.id not in undone and _is_blocked(e, spec, undone)
    ]:
        for event in blocked:
            names = ' and '.join(_waits_for(event, spec))
            undone[event.id] = f'waits for {names}, which nobody carries out'
    return undone


def _can_do(spec: ScenarioSpec, agent: GroundAgent, behavior: Behavior) -> bool:
    kind = behavior.kind
    if agent.type is AgentType.PEDESTRIAN:
        return kind in _ON_FOOT
    if kind in ONCE:
        return is_once(spec, agent, behavior)
    return kind not in (BehaviorKind.CROSS, BehaviorKind.WALK)


def _can_act(action: EventAction, spec: ScenarioSpec) -> bool:
    if isinstance(action, AgentAction) and action.do == 'cross':
        persons = {a.id for a in spec.agents if a.type is AgentType.PEDESTRIAN}
        return action.agent in persons and action.value_mps is None
    if isinstance(action, UavAction) and action.mission is not None:
        return _can_change(action, spec)
    if isinstance(action, AgentAction) and action.do == 'change_lane':
        drivers = {a.id for a in spec.agents if keeps_to_lanes(a)}
        return action.agent in drivers and action.value_mps is None
    return True


def _can_be_placed(agent: GroundAgent, placement: Placement, spec: ScenarioSpec) -> bool:
    if agent.type in ON_SIDEWALKS:
        return can_stand(agent, placement, spec)
    return can_be_placed(agent.id, placement, spec)


def _can_change(action: UavAction, spec: ScenarioSpec) -> bool:
    """Tell whether a UAV can be sent on a mission: it is its own, and has its place in the order.

    One that waits for an event and is listed before another that waits for none would have to be
    flown first: which one the request means to be first nobody can tell.
    """
    own = [m for m in spec.missions if m.uav == action.uav]
    waits = [begun_by(spec, m) is not None for m in own]
    ids = [m.id for m in own]
    return action.mission in ids and (not waits[0] or all(waits))


def _flies_after_landing(event: Event, spec: ScenarioSpec) -> bool:
    """Tell whether a UAV that an event has let land is to fly on then: it stays down."""
    action, over = event.action, event.trigger
    if not isinstance(action, UavAction) or not isinstance(over, EventDoneTrigger):
        return False
    before = next(e.action for e in spec.events if e.id == over.event)
    lands = isinstance(before, UavAction) and before.do == 'land' and before.uav == action.uav
    return lands and action.do != 'land'


def _is_blocked(event: Event, spec: ScenarioSpec, undone: Mapping[str, str]) -> bool:
    causes = _waits_for(event, spec)
    return bool(causes) and all(cause in undone for cause in causes)


def _waits_for(event: Event, spec: ScenarioSpec) -> tuple[str, ...]:
    """Return the events of which one has to happen before: by name, or by their message."""
    match event.trigger:
        case EventDoneTrigger(event=cause):
            return (cause,)
        case MessageTrigger(by=receiver, sender=sender):
            return tuple(
                e.id
                for e in spec.events
                if isinstance(e.action, SendMessage)
                and e.action.receiver == receiver
                and sender in (None, e.action.sender)
            )
        case _:
            return ()
