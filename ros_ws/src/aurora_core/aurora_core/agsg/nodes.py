# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""V and tau_V: a node for every element of a specification and for every condition."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.outcomes.agsg import AgsgNode, NodeType
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.prohibitions import (
    ForbiddenAgent,
    ForbiddenBehavior,
    ForbiddenLink,
    ForbiddenMission,
    ForbiddenPlacement,
    ForbiddenWorld,
    Prohibition,
)
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.scenario import Event, Order, ScenarioSpec, StatedCondition


def nodes_of(spec: ScenarioSpec, conditions: tuple[Condition, ...]) -> Iterator[AgsgNode]:
    """Yield the nodes in a fixed order: the environment, then by type."""
    world = spec.world
    yield AgsgNode(
        id=ENVIRONMENT_ID,
        type=NodeType.ENVIRONMENT,
        label=f'{world.map_name}, {world.weather.value}, {world.time_of_day.value}',
    )
    for agent in spec.agents:
        yield AgsgNode(id=agent.id, type=NodeType.GROUND_AGENT, label=agent.type.value)
    for uav in spec.uavs:
        modes = ' then '.join(m.mode.value for m in spec.missions if m.uav == uav.id)
        yield AgsgNode(id=uav.id, type=NodeType.UAV, label=modes or 'idle')
    for link in spec.links:
        label = f'{link.sender} to {link.receiver}'
        yield AgsgNode(id=link.id, type=NodeType.COMMUNICATION, label=label)
    for event in spec.events:
        yield AgsgNode(id=event.id, type=NodeType.EVENT, label=_event_label(event))
    for stated in spec.conditions:
        yield AgsgNode(id=stated.id, type=NodeType.CONDITION, label=_stated_label(stated))
    for order in spec.orders:
        label = f'{order.first} before {order.then}'
        yield AgsgNode(id=order.id, type=NodeType.CONDITION, label=label)
    for count in spec.counts:
        label = f'{count.value.bound.value} {count.value.value:g} {count.kind}'
        yield AgsgNode(id=count.id, type=NodeType.CONDITION, label=label)
    for prohibition in spec.prohibitions:
        label = f'no {_forbidden(prohibition)}'
        yield AgsgNode(id=prohibition.id, type=NodeType.CONDITION, label=label)
    for condition in conditions:
        yield AgsgNode(id=condition.id, type=NodeType.CONDITION, label=condition.sentence)


def _event_label(event: Event) -> str:
    trigger = event.trigger.on if event.trigger is not None else ''
    action = event.action.do if event.action is not None else ''
    return ' then '.join(part for part in (trigger, action) if part)


def _stated_label(stated: StatedCondition) -> str:
    return f'{stated.quantity} of {", ".join(stated.of)} {stated.op} {stated.value.value:g}'


def _forbidden(prohibition: Prohibition) -> str:
    match prohibition:
        case StatedCondition():
            return _stated_label(prohibition)
        case Event():
            return _event_label(prohibition) or 'event'
        case Order():
            return f'{prohibition.first} before {prohibition.then}'
        case ForbiddenWorld():
            fields = ('weather', 'time_of_day', 'traffic_density', 'map_name')
            return next(str(v) for n in fields if (v := getattr(prohibition, n)) is not None)
        case ForbiddenAgent():
            return prohibition.type
        case ForbiddenPlacement():
            return f'{prohibition.agent} {prohibition.relation} {prohibition.of or ""}'.rstrip()
        case ForbiddenBehavior():
            return f'{prohibition.agent} {prohibition.kind}'
        case ForbiddenMission():
            return f'{prohibition.uav or "UAV"} {prohibition.mode}'
        case ForbiddenLink():
            return f'message from {prohibition.sender} to {prohibition.receiver}'
