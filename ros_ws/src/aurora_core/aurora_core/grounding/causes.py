# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What events come of: one after the other, back to what nobody in the request causes."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    VisibilityTrigger,
)


def causes(spec: ScenarioSpec, event: Event) -> Iterator[Event]:
    """Yield an event and, one after the other, those that it comes of."""
    events = {e.id: e for e in spec.events}
    seen: set[str] = set()
    cause: Event | None = event
    while cause is not None and cause.id not in seen:
        yield cause
        seen.add(cause.id)
        cause = events.get(_cause_of(spec, cause) or '')


def slows_at_sight(spec: ScenarioSpec, agent: str, uav: str) -> bool:
    """Tell whether an agent slows down because a UAV sees somebody, itself or another one.

    A UAV looks out once it is up: who is to slow down then has set off before.
    """
    return any(
        isinstance(event.action, AgentAction)
        and event.action.agent == agent
        and event.action.do in FROM_MOTION
        and any(_is_sighting(cause, uav) for cause in causes(spec, event))
        for event in spec.events
    )


def _is_sighting(event: Event, uav: str) -> bool:
    trigger = event.trigger
    sees = isinstance(trigger, VisibilityTrigger) and trigger.on == 'visible'
    return sees and getattr(trigger, 'observer', '') == uav


def _cause_of(spec: ScenarioSpec, event: Event) -> str | None:
    """Return the event that another one waits for: by name, or for its message."""
    trigger = event.trigger
    if isinstance(trigger, EventDoneTrigger):
        return trigger.event
    if not isinstance(trigger, MessageTrigger):
        return None
    return next(
        (
            other.id
            for other in spec.events
            if isinstance(other.action, SendMessage)
            and other.action.receiver == trigger.by
            and trigger.sender in (None, other.action.sender)
        ),
        None,
    )
