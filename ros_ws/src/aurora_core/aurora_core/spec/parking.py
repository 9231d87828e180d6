# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who stands: for the whole run, or once it has driven to a place to park there."""

from __future__ import annotations

from aurora_core.spec.events import ArrivalTrigger, BehaviorDoneTrigger, Event, EventDoneTrigger
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Place, Relation

# Inside a stated bound on a time this much is aimed at (s), but no less than half of it.
_INSIDE_S = 1.0

_GOES_THERE = frozenset({BehaviorKind.DRIVE, BehaviorKind.EMERGENCY_RUN})

_STILL = frozenset({BehaviorKind.WAIT, BehaviorKind.PARK})
_MOVES = frozenset(BehaviorKind) - _STILL


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


def parks(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a vehicle stands beside the traffic for the whole run."""
    told = any(b.kind is BehaviorKind.PARK for b in agent.behaviors)
    told = told or any(p.relation is Relation.PARKED_AT for p in agent.placements)
    moved = any(
        isinstance(e.action, AgentAction) and e.action.agent == agent.id for e in spec.events
    )
    later = parks_after(spec, agent) is not None or stands_first_s(agent) is not None
    return told and not moved and not later and not any(b.kind in _MOVES for b in agent.behaviors)


def stands(agent: GroundAgent) -> bool:
    """Tell whether an agent stands at t = 0, until its time is over or an event sets it off."""
    moves = any(b.kind in _MOVES for b in agent.behaviors)
    still = any(b.kind in _STILL for b in agent.behaviors)
    return stands_first_s(agent) is not None or (still and not moves)


def stands_first_s(agent: GroundAgent) -> Parameter | None:
    """Return for how long an agent stands before it sets off; None where nobody says."""
    goes = any(b.kind in _GOES_THERE for b in agent.behaviors)
    return next(
        (
            b.duration_s
            for b in agent.behaviors
            if b.duration_s is not None
            and (b.kind is BehaviorKind.WAIT or (b.kind is BehaviorKind.PARK and not goes))
        ),
        None,
    )


def stops_for_s(agent: GroundAgent) -> Parameter | None:
    """Return how long an agent stands where it stops or parks on its way; None: to the end."""
    first = stands_first_s(agent)
    stopping = (BehaviorKind.STOP, BehaviorKind.PARK)
    lasting = (b.duration_s for b in agent.behaviors if b.kind in stopping)
    return next((s for s in lasting if s is not None and s is not first), None)


def stands_s(stated: Parameter) -> float:
    """Return for how long somebody stands who is asked to do so, seconds."""
    return max(stated.inside(_INSIDE_S), stated.value / 2.0)


def stop_time_s(agent: GroundAgent) -> float | None:
    """Return how long an agent stands by plan where it stops on its way; None: to the end."""
    stated = stops_for_s(agent)
    return None if stated is None else stands_s(stated)


def stops_for_good(agent: GroundAgent) -> bool:
    """Tell whether an agent stops on its way and stays where it does."""
    return any(b.kind is BehaviorKind.STOP and b.duration_s is None for b in agent.behaviors)


def crosses_rested(spec: ScenarioSpec, person: GroundAgent) -> bool:
    """Tell whether somebody walks up to the crosswalk, rests there, and crosses after that.

    He does so by himself, or by an event that waits for nothing but his stop.
    """
    here = (None, Place.CROSSWALK)
    rests = [b for b in person.behaviors if b.kind is BehaviorKind.STOP and b.target in here]
    if not rests:
        return False
    itself = any(b.kind is BehaviorKind.CROSS for b in person.behaviors)
    return crosses_after_stop(spec, person) or (itself and stops_for_s(person) is not None)


def crosses_after_stop(spec: ScenarioSpec, person: GroundAgent) -> bool:
    """Tell whether an event lets somebody cross for which it only has to have stopped."""
    own = [
        e for e in spec.events if isinstance(e.action, AgentAction) and e.action.agent == person.id
    ]
    stops = {e.id for e in own if _does(e, 'stop') and e.trigger is None}
    return any(
        (isinstance(e.trigger, EventDoneTrigger) and e.trigger.event in stops)
        or (
            isinstance(e.trigger, BehaviorDoneTrigger)
            and (e.trigger.who, e.trigger.behavior) == (person.id, BehaviorKind.STOP)
        )
        for e in own
        if _does(e, 'cross')
    )


def crosses_from_wait(spec: ScenarioSpec, event: Event) -> bool:
    """Tell whether somebody crosses when his own wait is over, which he has stood from t = 0.

    Where he stands he sets off for the kerb then; everybody else is there before.
    """
    action, trigger = event.action, event.trigger
    if not isinstance(action, AgentAction) or not isinstance(trigger, BehaviorDoneTrigger):
        return False
    person = next((a for a in spec.agents if a.id == action.agent), None)
    waits = person is not None and stands_first_s(person) is not None
    return waits and action.do == 'cross' and trigger.who == action.agent


def _does(event: Event, action: str) -> bool:
    return isinstance(event.action, AgentAction) and event.action.do == action
