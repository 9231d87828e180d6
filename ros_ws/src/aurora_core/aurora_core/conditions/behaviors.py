# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by behaviours: which function says what each of them means."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from aurora_core.conditions import own_behaviors, pair_behaviors
from aurora_core.conditions.build import Inputs, Source, Underivable
from aurora_core.conditions.driving_speed import speed_conditions
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind

_Derive = Callable[[Inputs, GroundAgent, Behavior, str, Source], Iterator[Condition]]


def behavior_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all behaviours of ground agents."""
    agents = {agent.id for agent in inputs.spec.agents}
    for agent in inputs.spec.agents:
        for index, behavior in enumerate(agent.behaviors):
            kind = behavior.kind
            if kind in _NEED_TARGET and behavior.target not in agents:
                yield Underivable(
                    element=agent.id, what=f'behaviour {kind.value}', span=behavior.span
                )
                continue
            name = behavior_id(agent, index)
            source = Source(ids=(agent.id,), spans=(behavior.span or agent.span,))
            yield from _REGISTRY[kind](inputs, agent, behavior, name, source)
            yield from pair_behaviors.closing_conditions(inputs, agent, behavior, name)
            if behavior.speed_mps is not None:
                yield from speed_conditions(inputs, agent, behavior, name)


def behavior_id(agent: GroundAgent, index: int) -> str:
    """Return the id of the condition that a behaviour of an agent implies."""
    return f'{agent.id}.{agent.behaviors[index].kind.value}' + (
        '' if index == 0 else str(index + 1)
    )


_REGISTRY: dict[BehaviorKind, _Derive] = {
    BehaviorKind.DRIVE: own_behaviors.drive_condition,
    BehaviorKind.WALK: own_behaviors.walk_condition,
    BehaviorKind.CIRCULATE: own_behaviors.circulate_condition,
    BehaviorKind.FOLLOW: pair_behaviors.follow_condition,
    BehaviorKind.TAILGATE: pair_behaviors.tailgate_condition,
    BehaviorKind.OVERTAKE: pair_behaviors.overtake_condition,
    BehaviorKind.APPROACH: pair_behaviors.approach_condition,
    BehaviorKind.YIELD: pair_behaviors.yield_conditions,
    BehaviorKind.STOP: own_behaviors.stop_condition,
    BehaviorKind.BRAKE: own_behaviors.brake_condition,
    BehaviorKind.SLOW: own_behaviors.slow_condition,
    BehaviorKind.TURN_LEFT: own_behaviors.turn_condition,
    BehaviorKind.TURN_RIGHT: own_behaviors.turn_condition,
    BehaviorKind.CROSS: own_behaviors.cross_condition,
    BehaviorKind.PARK: own_behaviors.park_condition,
    BehaviorKind.WAIT: own_behaviors.wait_condition,
    BehaviorKind.CHANGE_LANE: own_behaviors.change_lane_condition,
    BehaviorKind.EMERGENCY_RUN: own_behaviors.emergency_condition,
}
_NEED_TARGET = frozenset(
    {
        BehaviorKind.FOLLOW,
        BehaviorKind.TAILGATE,
        BehaviorKind.OVERTAKE,
        BehaviorKind.APPROACH,
        BehaviorKind.YIELD,
    }
)
