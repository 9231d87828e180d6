# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether persons leave their places: to cross, to arrive somewhere, or at all."""

from __future__ import annotations

from aurora_core.grounding.places import arrivals, has_point
from aurora_core.spec.events import sets_off
from aurora_core.spec.own_events import let_cross
from aurora_core.spec.parking import stands, stands_first_s
from aurora_core.spec.scenario import (
    AgentAction,
    Behavior,
    DistanceTrigger,
    GroundAgent,
    ScenarioSpec,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Relation

# Who is to arrive somewhere comes from so far away, or so much farther than a trigger says (m).
_ARRIVES_FROM_M, _FARTHER_M = 18.0, 4.0

# A roadside unit stands so far off the middle of the sidewalk, away from the road (m).
_POST_ASIDE_M = 0.9

# These lead to a place.
_LEADS = frozenset(
    {BehaviorKind.DRIVE, BehaviorKind.WALK, BehaviorKind.EMERGENCY_RUN, BehaviorKind.APPROACH}
)
_SIDES = frozenset({Relation.BESIDE, Relation.LEFT, Relation.RIGHT})


def comes_to(agent: GroundAgent, behavior: Behavior) -> bool:
    """Tell whether a behaviour leads an agent to a place where it is not at t = 0."""
    there = behavior.kind in _LEADS and has_point(behavior.target)
    return there and all(p.of != behavior.target for p in agent.placements)


def heads_for(agent: GroundAgent) -> str | None:
    """Return the first place that an agent comes to, None where it goes to none."""
    return next((b.target for b in agent.behaviors if comes_to(agent, b)), None)


def crosses(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether an agent is to cross a street: by itself, by an event, or let pass."""
    if any(person == agent.id for _, person in let_cross(spec)):
        return True
    return any(b.kind is BehaviorKind.CROSS for b in agent.behaviors) or any(
        isinstance(e.action, AgentAction) and e.action.agent == agent.id and e.action.do == 'cross'
        for e in spec.events
    )


def arrives_from_m(spec: ScenarioSpec, agent: GroundAgent) -> float | None:
    """Return from how far off a person comes whom an event waits for somewhere (m).

    He is not there yet at t = 0, nor as near as that event says. None where none waits for him.
    """
    near = [
        trigger.value_m.value
        for trigger in (event.trigger for event in spec.events)
        if isinstance(trigger, DistanceTrigger)
        and trigger.on == 'distance_below'
        and agent.id in (trigger.a, trigger.b)
        and any(has_point(name) for name in (trigger.a, trigger.b))
    ]
    if near:
        return max(_ARRIVES_FROM_M, max(near) + _FARTHER_M)
    return None if next(arrivals(spec, agent), None) is None else _ARRIVES_FROM_M


def aside_of_walkers_m(spec: ScenarioSpec, agent: GroundAgent) -> float:
    """Return how far left of the middle of a sidewalk one stands there (m): a post, off the way.

    That is where somebody comes along who is awaited there.
    """
    post = agent.type is AgentType.RSU
    comes = any(arrives_from_m(spec, a) is not None for a in spec.agents if a is not agent)
    return -_POST_ASIDE_M if post and comes else 0.0


def awaits_its_moment(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether an event says when a person steps onto the road: he is at the kerb by then.

    Who stands for a stated time first sets off from there.
    """
    told = any(
        isinstance(e.action, AgentAction) and (e.action.agent, e.action.do) == (agent.id, 'cross')
        for e in spec.events
    )
    later = sets_off(spec.events, agent.id) is not None or stands_first_s(agent) is not None
    return told and not later


def goes(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a person is to leave its place at some time."""
    if crosses(spec, agent) or sets_off(spec.events, agent.id) is not None:
        return True
    if arrives_from_m(spec, agent) is not None or stands_first_s(agent) is not None:
        return True
    return bool(agent.behaviors) and not stands(agent)


def does_at_a_place(agent: GroundAgent) -> bool:
    """Tell whether a behaviour of an agent names a place that it is done at, or leads to."""
    return any(has_point(b.target) for b in agent.behaviors)


def keeps_beside(spec: ScenarioSpec, person: GroundAgent) -> bool:
    """Tell whether a person is to walk beside a vehicle."""
    vehicles = {a.id for a in spec.agents if a.type is not AgentType.PEDESTRIAN}
    return any(
        p.kept_in_motion and p.relation in _SIDES and p.of in vehicles for p in person.placements
    )
