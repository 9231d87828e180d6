# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Complete how flights end: when a UAV lands that returns home."""

from __future__ import annotations

from aurora_core.spec.events import Event, UavAction
from aurora_core.spec.scenario import ScenarioSpec


def landing(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with landings that come no sooner than the return they belong to.

    "15 s after it stops the drone returns home and lands": two events with one trigger, of which
    the first alone has the delay. Who has landed flies nowhere.

    Args:
        spec: The request, whoever read it; it is not changed.
    """
    events = tuple(_no_sooner(event, spec.events) for event in spec.events)
    return ScenarioSpec.model_validate({**dict(spec), 'events': events})


def _no_sooner(event: Event, events: tuple[Event, ...]) -> Event:
    action = event.action
    if event.delay_s is not None or event.trigger is None:
        return event
    if not isinstance(action, UavAction) or action.do != 'land':
        return event
    for other in events:
        home = other.action
        if other.trigger != event.trigger or not isinstance(home, UavAction):
            continue
        if (home.do, home.uav) == ('return_home', action.uav) and other.waits_s > 0.0:
            return event.model_copy(update={'delay_s': other.delay_s})
    return event
