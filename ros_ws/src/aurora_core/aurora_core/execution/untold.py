# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When that happens of which nobody says when: not before what the rest of the request needs."""

from __future__ import annotations

from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.events import bodies_of_cause
from aurora_core.spec.parking import stands
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    SpeedTrigger,
)
from aurora_core.spec.vocabulary import AgentType

# Speed from which an agent can be seen to brake or stop (m/s).
_ON_THE_MOVE_MPS = 5.0
# The same of a person, who walks.
_WALKS_MPS = 0.5

# Loss of speed that shows as slowing down (m/s).
_SHOWS_MPS = 2.5


def on_the_move_mps(*, is_person: bool) -> float:
    """Return the speed from which a vehicle, or a person, can be seen to brake or stop."""
    return _WALKS_MPS if is_person else _ON_THE_MOVE_MPS


def least_mps(action: AgentAction, *, is_person: bool) -> float:
    """Return the speed from which what an agent does on the move can be seen."""
    least = on_the_move_mps(is_person=is_person)
    if is_person or action.do not in ('slow', 'brake') or action.value_mps is None:
        return least
    return max(least, action.value_mps.value + _SHOWS_MPS)


def heard_before(spec: ScenarioSpec) -> dict[str, frozenset[tuple[str, str]]]:
    """Return by event without a cause the messages (receiver, sender) that it comes after.

    "When the bus arrives, the drone tells the ego; the ego stops": who is told something, and
    then does something, does it upon that, unless the message waits for what he does.
    """
    found = {}
    for number, event in enumerate(spec.events):
        if event.trigger is not None or not isinstance(event.action, AgentAction):
            continue
        actor = event.action.agent
        found[event.id] = frozenset(
            (e.action.receiver, e.action.sender)
            for e in spec.events[:number]
            if isinstance(e.action, SendMessage)
            and e.action.receiver == actor
            and e.trigger is not None
            and not _may_need(e, event.action)
            and e not in _after(spec, event)
        )
    return found


def _may_need(event: Event, action: AgentAction) -> bool:
    """Tell whether an event may wait for what somebody does: he drives anyway, until he stops."""
    if action.agent not in bodies_of_cause(event):
        return False
    slow = isinstance(event.trigger, SpeedTrigger) and event.trigger.on == 'speed_below'
    return slow or action.do not in FROM_MOTION


def slowed_later(spec: ScenarioSpec) -> dict[str, frozenset[str]]:
    """Return by event without a cause which vehicles what follows it slows down or stops.

    It waits until they drive, or nothing would be seen of that. Whom an event sets off is left
    out: it may be this one that does so.
    """
    vehicles = {a.id for a in spec.agents if a.type is not AgentType.PEDESTRIAN and not stands(a)}
    started = {
        e.action.agent
        for e in spec.events
        if isinstance(e.action, AgentAction) and e.action.do == 'start'
    }
    found = {}
    for first in spec.events:
        chain = _after(spec, first) if first.trigger is None else []
        found[first.id] = frozenset(
            e.action.agent
            for e in chain
            if isinstance(e.action, AgentAction) and e.action.do in FROM_MOTION
        ) & (vehicles - started)
    return found


def _follows(event: Event, before: Event) -> bool:
    """Tell whether an event waits for another one, or for the receipt of its message."""
    trigger, sent = event.trigger, before.action
    if isinstance(trigger, EventDoneTrigger):
        return trigger.event == before.id
    return (
        isinstance(trigger, MessageTrigger)
        and isinstance(sent, SendMessage)
        and trigger.by == sent.receiver
        and trigger.sender in (None, sent.sender)
    )


def _after(spec: ScenarioSpec, first: Event) -> list[Event]:
    """Return the events that come after another one, by way of others or at once."""
    chain = [first]
    for event in chain:
        chain += [e for e in spec.events if e not in chain and _follows(e, event)]
    return chain[1:]
