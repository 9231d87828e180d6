# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which parameters can affect a condition, in what order; and which conditions a parameter.

A parameter affects a condition when the graph leads from its owner to the condition. How near it
is counts in steps: 0 for the parameters of the element that the condition is about, otherwise
the cheapest way, where an edge of the condition's own family (a perceptual edge below a
perceptual condition) costs 1 and any other edge 2.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from aurora_core.agsg.parameters import element_of
from aurora_core.document import Document
from aurora_core.errors import SpecError
from aurora_core.outcomes.agsg import Agsg, EdgeType, NodeType
from aurora_core.spec.parameter import Provenance

if TYPE_CHECKING:
    import networkx as nx

_OWN_FAMILY, _OTHER_FAMILY = 1, 2
# What repair may move comes first, what the prompt states last.
_FREEDOM = (Provenance.DEFAULT, Provenance.INFERRED, Provenance.EXPLICIT)


class Influence(Document):
    """A parameter that can affect a condition.

    Attributes:
        condition: Id of the condition's node.
        parameter: Path in the specification.
        owner: Node that owns it.
        distance: Steps, see the module; near ones first.
        provenance: Who chose the value; explicit ones are never changed.
        way: Nodes from the owner to the condition.
    """

    condition: str
    parameter: str
    owner: str
    distance: int
    provenance: Provenance
    way: tuple[str, ...]


def parameters_affecting(agsg: Agsg, condition: str) -> tuple[Influence, ...]:
    """Return the parameters that can affect a condition, the most influential first.

    Ordered by distance, then free ones (default, inferred) before explicit ones, then by path.

    Args:
        agsg: The graph.
        condition: Id of a condition's node.

    Raises:
        SpecError: The graph has no such condition.
    """
    known = [node.id for node in agsg.nodes if node.type is NodeType.CONDITION]
    if condition not in known:
        raise SpecError(
            f'the graph has no condition {condition!r}',
            hint=f'it has {", ".join(known)}' if known else 'it has none: ground it first',
        )
    return _influences(agsg, _upstream(agsg), _own_elements(agsg), condition)


def parameters_by_condition(agsg: Agsg) -> dict[str, tuple[Influence, ...]]:
    """Return for every condition what `parameters_affecting` does."""
    upstream, own = _upstream(agsg), _own_elements(agsg)
    return {
        node.id: _influences(agsg, upstream, own, node.id)
        for node in agsg.nodes
        if node.type is NodeType.CONDITION
    }


def conditions_affected(agsg: Agsg, parameter: str) -> tuple[Influence, ...]:
    """Return the conditions that a parameter can affect, the nearest first, then by id.

    Args:
        agsg: The graph.
        parameter: Path of the parameter.

    Raises:
        SpecError: The graph has no such parameter.
    """
    if all(row.path != parameter for row in agsg.parameters):
        raise SpecError(
            f'the graph has no parameter {parameter!r}',
            hint='name it by its path, such as missions/m1/altitude_m',
        )
    found = [
        influence
        for influences in parameters_by_condition(agsg).values()
        for influence in influences
        if influence.parameter == parameter
    ]
    return tuple(sorted(found, key=lambda i: (i.distance, i.condition)))


def _upstream(agsg: Agsg) -> nx.MultiDiGraph:
    """Return the graph with its edges turned round: from effects to causes."""
    # Whoever runs a prompt imports this file, and only who repairs or asks needs networkx.
    import networkx as nx

    graph = nx.MultiDiGraph()
    graph.add_nodes_from(node.id for node in agsg.nodes)
    for edge in agsg.edges:
        graph.add_edge(edge.target, edge.source, type=edge.type)
    return graph


def _own_elements(agsg: Agsg) -> Mapping[str, tuple[str, ...]]:
    """Return the elements of the specification that each condition is about."""
    conditions = agsg.conditions
    spec = agsg.spec
    stated = (*spec.conditions, *spec.orders, *spec.counts, *spec.prohibitions)
    return {c.id: c.spec_ids for c in conditions} | {s.id: (s.id,) for s in stated}


def _cost(family: EdgeType, _effect: str, _cause: str, edges: Mapping[Any, Any]) -> int:
    same = any(edge['type'] is family for edge in edges.values())
    return _OWN_FAMILY if same else _OTHER_FAMILY


def _influences(
    agsg: Agsg, upstream: nx.MultiDiGraph, own: Mapping[str, tuple[str, ...]], condition: str
) -> tuple[Influence, ...]:
    import networkx as nx

    families = {edge['type'] for *_, edge in upstream.out_edges(condition, data=True)}
    if not families:
        return ()
    # All edges into a condition are of its own family.
    weight = partial(_cost, families.pop())
    distances, ways = nx.single_source_dijkstra(upstream, condition, weight=weight)
    elements = own.get(condition, ())
    found = []
    for row in agsg.parameters:
        if row.owner in distances:
            about = element_of(row.path) in elements
            found.append(
                Influence(
                    condition=condition,
                    parameter=row.path,
                    owner=row.owner,
                    distance=0 if about else int(distances[row.owner]),
                    provenance=row.provenance,
                    way=tuple(reversed(ways[row.owner])),
                )
            )
    return tuple(sorted(found, key=_order))


def _order(influence: Influence) -> tuple[int, int, str]:
    return influence.distance, _FREEDOM.index(influence.provenance), influence.parameter
