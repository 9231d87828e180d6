# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as a networkx multigraph that holds the whole specification, and the way back.

Nodes carry what they own: their elements with a hole for every parameter, and the parameters
(Theta) beside them. Nothing but nodes and graph attributes is read on the way back, so a round
trip shows that the graph loses nothing. Attributes are plain strings: GraphML keeps them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import networkx as nx
from pydantic import BaseModel

from aurora_core.agsg.parameters import item_path, owner_of, walk
from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.scenario import ScenarioSpec

# A hole in an element: the path of the parameter that belongs there.
_HOLE = 'theta'
# Lists of the specification whose items belong to nodes.
_LISTS = (
    'agents',
    'uavs',
    'missions',
    'links',
    'events',
    'conditions',
    'orders',
    'counts',
    'prohibitions',
)


def network(agsg: Agsg) -> nx.MultiDiGraph:
    """Return the graph with typed nodes and edges.

    Node attributes: `type`, `label`, `elements` and `parameters` (JSON). Edge attributes: `type`,
    `label`. Graph attributes: `prompt`, `clauses` and `reader` (JSON), `stage`, `map`, `sha256`.
    """
    spec = agsg.spec
    graph = nx.MultiDiGraph(
        prompt=json.dumps(spec.prompt),
        clauses=_json([_with_holes(clause, '') for clause in spec.clauses]),
        reader=_json(spec.reader),
        stage=agsg.stage.value,
        map=json.dumps(agsg.map_name),
        sha256=agsg.sha256,
    )
    elements: dict[str, list[tuple[str, Any]]] = {}
    for owner, place, element in _elements(spec):
        elements.setdefault(owner, []).append((place, element))
    parameters: dict[str, dict[str, Any]] = {}
    for path, owner, parameter in walk(spec, '', ENVIRONMENT_ID):
        parameters.setdefault(owner, {})[path] = parameter.model_dump(mode='json')
    for row in agsg.parameters:
        if row.realised is not None:
            parameters[row.owner][row.path]['realised'] = row.realised
    for node in agsg.nodes:
        graph.add_node(
            node.id,
            type=node.type.value,
            label=node.label,
            elements=_json(elements.get(node.id, [])),
            parameters=_json(parameters.get(node.id, {})),
        )
    for edge in agsg.edges:
        graph.add_edge(edge.source, edge.target, type=edge.type.value, label=edge.label)
    return graph


def spec_of(graph: nx.MultiDiGraph) -> ScenarioSpec:
    """Return the specification that a network was made of.

    Raises:
        SpecError: Something of it is missing, or it is not valid.
    """
    try:
        parameters: dict[str, Any] = {}
        for _, text in graph.nodes(data='parameters'):
            parameters |= json.loads(text)
        for value in parameters.values():
            value.pop('realised', None)
        placed = dict(
            item for _, text in graph.nodes(data='elements') for item in json.loads(text)
        )
        document: dict[str, Any] = {
            'prompt': json.loads(graph.graph['prompt']),
            'clauses': json.loads(graph.graph['clauses']),
            'reader': json.loads(graph.graph.get('reader', '""')),
            'world': placed.pop('world'),
        }
        for name in _LISTS:
            count = sum(place.startswith(f'{name}/') for place in placed)
            document[name] = [placed[f'{name}/{index}'] for index in range(count)]
        return ScenarioSpec.model_validate_json(json.dumps(_filled(document, parameters)))
    except (KeyError, ValueError, TypeError, AttributeError) as err:
        raise SpecError(
            f'the network does not hold a specification: {err}',
            hint='use one that AURORA wrote, as it was written',
        ) from err


def _elements(spec: ScenarioSpec) -> Iterator[tuple[str, str, Any]]:
    """Yield owner, place in the specification and content of every element."""
    yield ENVIRONMENT_ID, 'world', _with_holes(spec.world, 'world')
    for name in _LISTS:
        for index, item in enumerate(getattr(spec, name)):
            content = _with_holes(item, item_path(name, index, item))
            yield owner_of(item, ENVIRONMENT_ID), f'{name}/{index}', content


def _with_holes(value: Any, path: str) -> Any:
    """Return a value as JSON data without defaults; a parameter leaves its path."""
    if isinstance(value, Parameter):
        return {_HOLE: path}
    if isinstance(value, BaseModel):
        fields = type(value).model_fields
        said = {name: getattr(value, name) for name in fields}
        return {
            name: _with_holes(part, f'{path}/{name}')
            for name, part in said.items()
            if fields[name].is_required() or part != fields[name].default
        }
    if isinstance(value, tuple):
        return [_with_holes(item, item_path(path, k, item)) for k, item in enumerate(value)]
    return value


def _filled(value: Any, parameters: dict[str, Any]) -> Any:
    if isinstance(value, dict):
        if value.keys() == {_HOLE}:
            return parameters[value[_HOLE]]
        return {name: _filled(part, parameters) for name, part in value.items()}
    return [_filled(item, parameters) for item in value] if isinstance(value, list) else value


def _json(value: object) -> str:
    # ASCII only: XML has no way to write control characters.
    return json.dumps(value, separators=(',', ':'))
