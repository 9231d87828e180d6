# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether persons leave their places: to cross, to arrive somewhere, or at all."""

from __future__ import annotations

from aurora_core.grounding.places import arrivals
from aurora_core.spec.events import sets_off
from aurora_core.spec.own_events import let_cross
from aurora_core.spec.parking import stands, stands_first_s
from aurora_core.spec.scenario import AgentAction, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind


def crosses(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether an agent is to cross a street: by itself, by an event, or let pass."""
    if any(person == agent.id for _, person in let_cross(spec)):
        return True
    return any(b.kind is BehaviorKind.CROSS for b in agent.behaviors) or any(
        isinstance(e.action, AgentAction) and e.action.agent == agent.id and e.action.do == 'cross'
        for e in spec.events
    )


def arrives(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether an event waits for a person to arrive somewhere."""
    return next(arrivals(spec, agent), None) is not None


def goes(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a person is to leave its place at some time."""
    if crosses(spec, agent) or sets_off(spec.events, agent.id) is not None:
        return True
    if arrives(spec, agent) or stands_first_s(agent) is not None:
        return True
    return bool(agent.behaviors) and not stands(agent)
