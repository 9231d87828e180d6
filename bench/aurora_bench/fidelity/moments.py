# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which missions and events of a specification come before which."""

from __future__ import annotations

import json
from typing import Any

from aurora_core.spec.scenario import (
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    Trigger,
    UavAction,
)


def precedence(spec: ScenarioSpec) -> frozenset[tuple[str, str]]:
    """Return all pairs (first, then) of mission and event ids that the specification fixes."""
    pairs = {
        (one.id, two.id)
        for k, one in enumerate(spec.missions)
        for two in spec.missions[k + 1 :]
        if one.uav == two.uav
    }
    # Every mission ends with a landing that no event has to tell.
    pairs |= {(m.id, landing_of(m.uav)) for m in spec.missions if not m.ends_in_flight}
    timed = [
        (e.trigger.at_s.value, e.id) for e in spec.events if isinstance(e.trigger, TimeTrigger)
    ]
    pairs |= {(a, b) for at_a, a in timed for at_b, b in timed if at_a < at_b}
    pairs |= {(order.first, order.then) for order in spec.orders}
    for event in spec.events:
        causes = _causes(event, spec)
        pairs |= {(before, event.id) for before in causes}
        if event.trigger is not None:
            onset = onset_of(event.trigger)
            pairs |= {(before, onset) for before in causes} | {(onset, event.id)}
        if isinstance(event.action, UavAction) and event.action.mission is not None:
            pairs.add((event.id, event.action.mission))
    return _closed(pairs)


def landing_of(uav: str) -> str:
    """Return the name of the landing that ends the last mission of a UAV."""
    return f'landing of {uav}'


def onset_of(trigger: Trigger) -> str:
    """Return the name of the moment at which a trigger comes true, the same for equal triggers."""
    return f'onset of {json.dumps(_plain(trigger.model_dump(mode="json")), sort_keys=True)}'


def _plain(value: Any) -> Any:
    """Return a trigger's document without what tells only where and how it was read."""
    if isinstance(value, dict):
        if 'provenance' in value:
            return value['value']
        return {k: _plain(v) for k, v in value.items()}
    return value


def _causes(event: Event, spec: ScenarioSpec) -> set[str]:
    trigger = event.trigger
    if isinstance(trigger, EventDoneTrigger):
        return {trigger.event}
    if isinstance(trigger, MissionDoneTrigger):
        # It comes true as the landing begins.
        return {*(m.id for m in spec.missions if m.uav == trigger.uav), landing_of(trigger.uav)}
    if isinstance(trigger, MessageTrigger):
        return {
            other.id
            for other in spec.events
            if isinstance(other.action, SendMessage)
            and other.action.receiver == trigger.by
            and trigger.sender in (None, other.action.sender)
        }
    return set()


def _closed(pairs: set[tuple[str, str]]) -> frozenset[tuple[str, str]]:
    closed = set(pairs)
    while True:
        more = {(a, d) for a, b in closed for c, d in closed if b == c and a != d} - closed
        if not more:
            return frozenset(closed)
        closed |= more
