# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Derive the graph's nodes, edges and parameters from its documents, deterministically."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

from pydantic import BaseModel

from aurora_core.agsg.graph import (
    Agsg,
    AgsgEdge,
    AgsgNode,
    AgsgParameter,
    EdgeType,
    NodeType,
    Stage,
)
from aurora_core.conditions.condition import Condition, conditions_from_json
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec, SendMessage

ENVIRONMENT_ID = 'world'


def build_agsg(
    spec: ScenarioSpec,
    *,
    map_digest: str = '',
    stage: Stage = Stage.PARSED,
    iteration: int = 0,
    grounding_json: str = '',
    schedule_json: str = '',
    conditions: tuple[Condition, ...] = (),
    conditions_json: str = '[]',
    realised: Mapping[str, float] | None = None,
) -> Agsg:
    """Return the graph of a specification (and of its grounding, once there is one).

    Args:
        spec: The request.
        map_digest: sha256 (hex) of the map.
        stage: How far it has come.
        iteration: Repair iteration.
        grounding_json: Canonical JSON of the grounding.
        schedule_json: Canonical JSON of the schedule.
        conditions: Success conditions; they become nodes.
        conditions_json: The same, canonical JSON.
        realised: Realised values by parameter path; by default those of the grounding.
    """
    return Agsg(
        iteration=iteration,
        stage=stage,
        map_name=spec.world.map_name,
        map_digest=map_digest,
        spec=spec,
        grounding_json=grounding_json,
        schedule_json=schedule_json,
        conditions_json=conditions_json,
        nodes=tuple(_nodes(spec, conditions)),
        edges=tuple(_edges(spec, conditions)),
        parameters=tuple(
            _parameters(spec, _realised(grounding_json) if realised is None else realised)
        ),
    )


def _nodes(spec: ScenarioSpec, conditions: tuple[Condition, ...]) -> Iterator[AgsgNode]:
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
        trigger = event.trigger.on if event.trigger is not None else ''
        action = event.action.do if event.action is not None else ''
        label = ' then '.join(part for part in (trigger, action) if part)
        yield AgsgNode(id=event.id, type=NodeType.EVENT, label=label)
    for stated in spec.conditions:
        label = f'{stated.quantity} of {", ".join(stated.of)} {stated.op} {stated.value.value:g}'
        yield AgsgNode(id=stated.id, type=NodeType.CONDITION, label=label)
    for condition in conditions:
        yield AgsgNode(id=condition.id, type=NodeType.CONDITION, label=condition.sentence)


def _edges(spec: ScenarioSpec, conditions: tuple[Condition, ...]) -> Iterator[AgsgEdge]:
    for agent in spec.agents:
        yield _edge(ENVIRONMENT_ID, agent.id, EdgeType.SPATIAL, 'on the road of')
        for placement in agent.placements:
            source = placement.of if _is_body(spec, placement.of) else ENVIRONMENT_ID
            yield _edge(
                source or ENVIRONMENT_ID, agent.id, EdgeType.SPATIAL, placement.relation.value
            )
        for behavior in agent.behaviors:
            if behavior.target is not None and _is_body(spec, behavior.target):
                yield _edge(behavior.target, agent.id, EdgeType.BEHAVIORAL, behavior.kind.value)
    for mission in spec.missions:
        source = mission.target if _is_body(spec, mission.target) else ENVIRONMENT_ID
        kind = EdgeType.SPATIAL if mission.mode.value == 'navigate' else EdgeType.PERCEPTUAL
        yield _edge(source or ENVIRONMENT_ID, mission.uav, kind, mission.mode.value)
    for link in spec.links:
        yield _edge(link.sender, link.id, EdgeType.COMMUNICATION, 'sends over')
        yield _edge(link.id, link.receiver, EdgeType.COMMUNICATION, 'delivers to')
    for event in spec.events:
        yield from _event_edges(spec, event.id)
    for stated in spec.conditions:
        for reference in dict.fromkeys(stated.of):
            source = reference if _is_named(spec, reference) else ENVIRONMENT_ID
            yield _edge(source, stated.id, EdgeType.BEHAVIORAL, 'is judged by')
    known = {ENVIRONMENT_ID, *(n.id for n in _nodes(spec, ()))}
    for condition in conditions:
        for reference in dict.fromkeys(condition.of):
            if reference in known:
                yield _edge(reference, condition.id, EdgeType.BEHAVIORAL, 'is judged by')


def _event_edges(spec: ScenarioSpec, event_id: str) -> Iterator[AgsgEdge]:
    event = next(e for e in spec.events if e.id == event_id)
    if event.trigger is not None:
        fields = event.trigger.model_dump()
        for name in ('a', 'b', 'uav', 'observer', 'target', 'who', 'by', 'event'):
            reference = fields.get(name)
            if isinstance(reference, str) and _is_named(spec, reference):
                kind = (
                    EdgeType.PERCEPTUAL
                    if event.trigger.on in ('visible', 'occluded')
                    else EdgeType.TEMPORAL
                )
                yield _edge(reference, event.id, kind, event.trigger.on)
    if isinstance(event.action, SendMessage):
        for link in spec.links:
            if (link.sender, link.receiver) == (event.action.sender, event.action.receiver):
                yield _edge(event.id, link.id, EdgeType.COMMUNICATION, 'sends message')
    elif event.action is not None:
        body = getattr(event.action, 'agent', None) or getattr(event.action, 'uav', None)
        if body is not None:
            yield _edge(event.id, body, EdgeType.BEHAVIORAL, event.action.do)


def _edge(source: str, target: str, kind: EdgeType, label: str) -> AgsgEdge:
    return AgsgEdge(source=source, target=target, type=kind, label=label)


def _is_body(spec: ScenarioSpec, reference: str | None) -> bool:
    return any(a.id == reference for a in spec.agents) or any(u.id == reference for u in spec.uavs)


def _is_named(spec: ScenarioSpec, reference: str) -> bool:
    return _is_body(spec, reference) or any(e.id == reference for e in spec.events)


def _parameters(spec: ScenarioSpec, realised: Mapping[str, float]) -> Iterator[AgsgParameter]:
    for path, owner, parameter in _walk(spec, '', ENVIRONMENT_ID):
        yield AgsgParameter(
            path=path,
            owner=owner,
            requested=parameter.value,
            realised=realised.get(path),
            low=parameter.low,
            high=parameter.high,
            unit=parameter.unit,
            provenance=parameter.provenance,
            span=parameter.span,
        )


def _walk(value: object, path: str, owner: str) -> Iterator[tuple[str, str, Parameter]]:
    """Yield every parameter below a value with its path; list items are named by their id."""
    if isinstance(value, Parameter):
        yield path, owner, value
    elif isinstance(value, BaseModel):
        # A mission's parameters belong to its UAV: missions are no nodes of their own.
        owner = getattr(value, 'uav', None) or getattr(value, 'id', None) or owner
        for name in type(value).model_fields:
            if name == 'trigger' or name == 'action':
                yield from _walk_keeping_owner(getattr(value, name), f'{path}/{name}', owner)
            else:
                yield from _walk(getattr(value, name), f'{path}/{name}'.lstrip('/'), owner)
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            key = getattr(item, 'id', None) or str(index)
            yield from _walk(item, f'{path}/{key}', owner)


def _walk_keeping_owner(
    value: object, path: str, owner: str
) -> Iterator[tuple[str, str, Parameter]]:
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _walk(getattr(value, name), f'{path}/{name}', owner)


def _realised(grounding_json: str) -> dict[str, float]:
    rows = json.loads(grounding_json).get('realised', []) if grounding_json else []
    return {row['path']: row['realised'] for row in rows}


def derived(documents: Agsg) -> Agsg:
    """Return a graph with nodes, edges and parameters derived from its documents."""
    return build_agsg(
        documents.spec,
        map_digest=documents.map_digest,
        stage=documents.stage,
        iteration=documents.iteration,
        grounding_json=documents.grounding_json,
        schedule_json=documents.schedule_json,
        conditions=conditions_from_json(documents.conditions_json),
        conditions_json=documents.conditions_json,
    )
