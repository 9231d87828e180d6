# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distances that are told with motion, and whether what the two do leaves them as they are.

"A car drives 30 m behind a bus" holds on the way. When the bus then brakes, or the car closes in,
the request says itself that the distance becomes another one: it holds at t = 0 only.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.spec.events import DistanceTrigger
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.parking import parks, stands
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import AgentAction, Behavior, GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind

# What one does to the other that makes their distance another one.
_TO_THE_OTHER = frozenset(
    {BehaviorKind.TAILGATE, BehaviorKind.OVERTAKE, BehaviorKind.APPROACH, BehaviorKind.YIELD}
)
# What one of them does that has the same effect.
_ALONE = frozenset(
    {
        BehaviorKind.BRAKE,
        BehaviorKind.CROSS,
        BehaviorKind.EMERGENCY_RUN,
        BehaviorKind.PARK,
        BehaviorKind.SLOW,
        BehaviorKind.STOP,
        BehaviorKind.WAIT,
        BehaviorKind.YIELD,
    }
)
# They part where only one of them turns, or drives there.
_WAYS = frozenset({BehaviorKind.DRIVE, BehaviorKind.TURN_LEFT, BehaviorKind.TURN_RIGHT})
# Who changes lane only stays as far ahead as it was.
_KEEPS_ON = frozenset({'change_lane'})


def at_start_where_changed(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with the stated distances marked that its own story changes.

    Args:
        spec: The request, whoever read it; returned as it is when nothing changes.
    """
    agents = {agent.id: agent for agent in spec.agents}

    def marked(agent: GroundAgent) -> GroundAgent:
        return agent.model_copy(
            update={
                'placements': tuple(
                    p.model_copy(update={'distance_at_start': _is_changed(spec, agents, agent, p)})
                    for p in agent.placements
                )
            }
        )

    found = tuple(map(marked, spec.agents))
    if found == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': found})


def _is_changed(
    spec: ScenarioSpec, agents: dict[str, GroundAgent], agent: GroundAgent, placement: Placement
) -> bool:
    """Tell whether the request says of two on the way that their distance becomes another one."""
    other = agents.get(placement.of or '')
    if other is None or not placement.kept_in_motion or placement.distance_m is None:
        return False
    pair = (agent, other)
    return (
        any(parks(spec, one) or stands(one) for one in pair)
        or any(_changes(b, pair) for one in pair for b in one.behaviors)
        or (len({_way(one) for one in pair}) > 1 and not _follow(pair))
        or len(set(_speeds_mps(pair))) > 1
        or any(_acts(spec, one) or _is_passed(spec, one) for one in pair)
        or _comes_to(spec, pair, placement.distance_m)
    )


def _changes(behavior: Behavior, pair: tuple[GroundAgent, GroundAgent]) -> bool:
    to_other = behavior.target in (pair[0].id, pair[1].id)
    closes = behavior.closing_from_m is not None
    return closes or behavior.kind in _ALONE or (to_other and behavior.kind in _TO_THE_OTHER)


def _follow(pair: tuple[GroundAgent, GroundAgent]) -> bool:
    """Tell whether one of two goes wherever the other one goes."""
    ids = {one.id for one in pair}
    return any(
        b.kind is BehaviorKind.FOLLOW and b.target in ids for one in pair for b in one.behaviors
    )


def _way(agent: GroundAgent) -> frozenset[tuple[BehaviorKind, str]]:
    """Return where an agent turns or drives to, which another one need not."""
    return frozenset(
        (b.kind, b.target or '')
        for b in agent.behaviors
        if b.kind in _WAYS and (b.kind is not BehaviorKind.DRIVE or is_landmark(b.target))
    )


def _speeds_mps(pair: tuple[GroundAgent, GroundAgent]) -> Iterator[float]:
    for agent in pair:
        for b in agent.behaviors:
            if b.speed_mps is not None:
                yield b.speed_mps.value


def _acts(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether an event has an agent drive otherwise."""
    return any(
        isinstance(e.action, AgentAction)
        and e.action.agent == agent.id
        and e.action.do not in _KEEPS_ON
        for e in spec.events
    )


def _is_passed(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether somebody overtakes an agent, and may then be between it and the other one."""
    return any(
        b.kind is BehaviorKind.OVERTAKE and b.target == agent.id
        for other in spec.agents
        for b in other.behaviors
    )


def _comes_to(
    spec: ScenarioSpec, pair: tuple[GroundAgent, GroundAgent], stated: Parameter
) -> bool:
    """Tell whether something waits for the two to be at another distance."""
    ids = {one.id for one in pair}
    for event in spec.events:
        trigger = event.trigger
        if not isinstance(trigger, DistanceTrigger) or {trigger.a, trigger.b} != ids:
            continue
        nearer = trigger.on == 'distance_below'
        if nearer == (trigger.value_m.value < stated.value):
            return True
    return False
