# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Carry out orders: what comes later, and for which nothing else is said, waits for the earlier.

"The pedestrian crosses, and only afterwards the car starts": the car awaits the end of the
crossing. Between two UAVs the later one waits on the ground for the end of the other's flight.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.planning.ids import free_ids
from aurora_core.spec.events import (
    AgentAction,
    BehaviorDoneTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    SendMessage,
    UavAction,
)
from aurora_core.spec.flight_order import begun_by, end_of
from aurora_core.spec.scenario import Behavior, GroundAgent, Order, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MOVING, STANDING


def waiting(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the request with a trigger for every event and mission that an order alone times.

    Args:
        spec: The request, whoever read it; returned as it is when no order needs that.
    """
    events = spec.events
    ids = free_ids(spec, 'e')
    for order in spec.orders:
        events = _waits(spec, events, order, ids)
    if events == spec.events:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'events': events})


def following(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the request in which what nobody dates follows what its agent does for some time.

    "Drives at 10 m/s for 20 s and then accelerates to 15 m/s": it does so when the 20 s are over.

    Args:
        spec: The request, whoever read it; returned as it is when nothing follows so.
    """
    ordered = {order.then for order in spec.orders}
    waited = {e.trigger.who for e in spec.events if isinstance(e.trigger, BehaviorDoneTrigger)}
    over = {agent.id: _lasting_one(agent) for agent in spec.agents if agent.id not in waited}

    def timed(event: Event) -> Event:
        action = event.action
        if not isinstance(action, AgentAction) or event.trigger or event.id in ordered:
            return event
        lasting = over.get(action.agent)
        if lasting is None or not _is_told_before(lasting, event):
            return event
        del over[action.agent]  # what it does next follows that
        done = BehaviorDoneTrigger(on='behavior_done', who=action.agent, behavior=lasting.kind)
        return Event.model_validate({**dict(event), 'trigger': done})

    events = tuple(map(timed, spec.events))
    if events == spec.events:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'events': events})


def _lasting_one(agent: GroundAgent) -> Behavior | None:
    """Return what an agent does for a stated time, None where that is nothing, or several."""
    found = [b for b in agent.behaviors if b.duration_s is not None]
    return found[0] if len(found) == 1 and found[0].kind in STANDING | MOVING else None


def _is_told_before(behavior: Behavior, event: Event) -> bool:
    lasts = behavior.duration_s
    told = None if lasts is None else lasts.span
    return told is not None and event.span is not None and told.end <= event.span.start


def _waits(
    spec: ScenarioSpec, events: tuple[Event, ...], order: Order, ids: Iterator[str]
) -> tuple[Event, ...]:
    trigger = end_of(spec, order.first)
    if trigger is None:
        return events
    later = next((e for e in events if e.id == order.then), None)
    if later is not None:
        if later.trigger is not None or later.action is None or _awaits(events, order):
            return events
        if isinstance(trigger, EventDoneTrigger) and not isinstance(later.action, AgentAction):
            return events  # what a UAV does has a moment of its own
        timed = Event.model_validate({**dict(later), 'trigger': _told(events, order) or trigger})
        return tuple(timed if e is later else e for e in events)
    mission = next((m for m in spec.missions if m.id == order.then), None)
    if mission is None or not _is_first_of_another(spec, mission, order.first):
        return events
    if begun_by(spec.model_copy(update={'events': events}), mission) is not None:
        return events
    takeoff = Event(
        id=next(ids),
        trigger=trigger,
        action=UavAction(do='change_mission', uav=mission.uav, mission=mission.id),
        span=order.span or mission.span,
    )
    return (*events, takeoff)


def _told(events: tuple[Event, ...], order: Order) -> MessageTrigger | None:
    """Return the receipt of the earlier message, where the one who is to act is told by it."""
    actions = {e.id: e.action for e in events}
    said, does = actions.get(order.first), actions.get(order.then)
    if not isinstance(said, SendMessage) or not isinstance(does, AgentAction):
        return None
    if said.receiver != does.agent:
        return None
    return MessageTrigger(on='message_received', by=said.receiver, sender=said.sender)


def _awaits(events: tuple[Event, ...], order: Order) -> bool:
    """Tell whether the earlier event waits for the later one already, by way of others."""
    awaited = {e.id: e.trigger.event for e in events if isinstance(e.trigger, EventDoneTrigger)}
    name: str | None = order.first
    while name is not None:
        if name == order.then:
            return True
        name = awaited.pop(name, None)
    return False


def _is_first_of_another(spec: ScenarioSpec, mission: UavMission, first: str) -> bool:
    own = [m.id for m in spec.missions if m.uav == mission.uav]
    return own[0] == mission.id and first not in own
