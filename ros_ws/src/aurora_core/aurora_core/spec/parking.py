# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who drives to a place and parks there, and does not stand there from the start."""

from __future__ import annotations

from aurora_core.spec.events import ArrivalTrigger
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind

_GOES_THERE = frozenset({BehaviorKind.DRIVE, BehaviorKind.EMERGENCY_RUN})


def parks_after(spec: ScenarioSpec, agent: GroundAgent) -> str | None:
    """Return the place to which a vehicle drives to park, None of all others."""
    parking = (b.target for b in agent.behaviors if b.kind is BehaviorKind.PARK)
    place = next((target for target in parking if target is not None), None)
    if place is None or agent.type is AgentType.PEDESTRIAN:
        return None
    awaited = any(
        isinstance(e.trigger, ArrivalTrigger)
        and (e.trigger.who, e.trigger.place) == (agent.id, place)
        for e in spec.events
    )
    goes = any(b.kind in _GOES_THERE for b in agent.behaviors)
    return place if awaited or goes else None
