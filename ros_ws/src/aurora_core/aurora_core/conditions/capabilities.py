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
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import (
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    UavAction,
    bodies_of,
)
from aurora_core.spec.vocabulary import BehaviorKind

# The monitor can judge all of these.
_NO_BEHAVIORS = frozenset(
    {
        BehaviorKind.SLOW,
        BehaviorKind.YIELD,
        BehaviorKind.TURN_LEFT,
        BehaviorKind.TURN_RIGHT,
        BehaviorKind.CROSS,
        BehaviorKind.CHANGE_LANE,
        BehaviorKind.EMERGENCY_RUN,
    }
)
_NO_ACTIONS = frozenset({'change_lane', 'cross', 'ascend', 'change_mission'})


def unsupported(spec: ScenarioSpec, grounded: GroundedScenario) -> tuple[str, ...]:
    """Return what the specification says and nobody carries out, as `id: what`."""
    found = list(grounded.unsupported)
    for agent in spec.agents:
        kinds = [b.kind for b in agent.behaviors if b.kind in _NO_BEHAVIORS]
        found += [f'{agent.id}: behaviour {kind.value}' for kind in kinds]
    undone = _undone_events(spec, grounded)
    return (*found, *(f'{name}: {what}' for name, what in undone.items() if what))


def judgeable(
    conditions: tuple[Condition, ...], spec: ScenarioSpec, grounded: GroundedScenario
) -> tuple[Condition, ...]:
    """Leave out what cannot be placed or carried out yet; its clauses are `incomplete`."""
    absent = {a.id for a in spec.agents} - {a.id for a in grounded.agents}
    events = _undone_events(spec, grounded)
    undone = [
        behavior_id(agent, index)
        for agent in spec.agents
        for index, behavior in enumerate(agent.behaviors)
        if behavior.kind in _NO_BEHAVIORS
    ]
    undone += [
        placement_id(agent, index)
        for agent in spec.agents
        for index, placement in enumerate(agent.placements)
        if not can_be_placed(agent.id, placement, spec)
    ]
    return tuple(
        c
        for c in conditions
        if not absent & set(c.of)
        and c.arguments.event not in events
        and not events.keys() & set(c.of)
        and not any(c.id == name or c.id.startswith(f'{name}.') for name in undone)
    )


def _undone_events(spec: ScenarioSpec, grounded: GroundedScenario) -> dict[str, str]:
    """Return the events that cannot happen, with what is missing ('' is said elsewhere)."""
    absent = {a.id for a in spec.agents} - {a.id for a in grounded.agents}
    undone: dict[str, str] = {}
    for event in spec.events:
        refused = event.action is not None and event.action.do in _NO_ACTIONS
        if event.action is not None and refused and not _climbs_last(event):
            undone[event.id] = f'action {event.action.do}'
        elif bodies_of(event) & absent:
            undone[event.id] = ''
    while blocked := [
        e for e in spec.events if e.id not in undone and _is_blocked(e, spec, undone)
    ]:
        for event in blocked:
            names = ' and '.join(_waits_for(event, spec))
            undone[event.id] = f'waits for {names}, which nobody carries out'
    return undone


def _climbs_last(event: Event) -> bool:
    """Tell whether a UAV is to climb once its missions are over, and not during one of them."""
    trigger, action = event.trigger, event.action
    return (
        isinstance(action, UavAction)
        and action.do == 'ascend'
        and isinstance(trigger, MissionDoneTrigger)
        and trigger.uav == action.uav
    )


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
