# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What triggers wait for that is stated to last: somebody does something for so long."""

from __future__ import annotations

from aurora_core.spec.events import BehaviorDoneTrigger, Event, TimeTrigger
from aurora_core.spec.scenario import Behavior, GroundAgent, ScenarioSpec


def doing(spec: ScenarioSpec, trigger: BehaviorDoneTrigger) -> tuple[GroundAgent, Behavior] | None:
    """Return who does what a trigger waits for, None where nobody does so for a stated time."""
    return next(
        (
            (agent, behavior)
            for agent in spec.agents
            for behavior in agent.behaviors
            if agent.id == trigger.who
            and behavior.kind is trigger.behavior
            and behavior.duration_s is not None
        ),
        None,
    )


def dated_s(spec: ScenarioSpec, event: Event) -> float | None:
    """Return the scenario time (s) that an event states, None where it states none.

    What somebody does for some time it may begin later: the trigger then is later, too.
    """
    if isinstance(event.trigger, TimeTrigger):
        return event.trigger.at_s.value
    found = doing(spec, event.trigger) if isinstance(event.trigger, BehaviorDoneTrigger) else None
    if found is None or found[1].duration_s is None:
        return None
    return found[1].duration_s.value
