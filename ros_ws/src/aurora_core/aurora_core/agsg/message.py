# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as an `Agsg` message and back; JSON is the truth, a mismatch is refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from aurora_core.agsg.graph import Agsg, EdgeType, NodeType, Stage
from aurora_core.errors import SpecError
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec

_NODES = tuple(NodeType)
_EDGES = tuple(EdgeType)
_STAGES = tuple(Stage)
_PROVENANCES = tuple(Provenance)

# Creates a message of a type: `create('aurora_msgs/msg/AgsgNode', id=..., ...)`.
Create = Callable[..., Any]


def agsg_message(create: Create, header: Any, run_id: str, agsg: Agsg) -> Any:
    """Return the `Agsg` message of a graph."""
    return create(
        'aurora_msgs/msg/Agsg',
        header=header,
        run_id=run_id,
        iteration=agsg.iteration,
        stage=_STAGES.index(agsg.stage),
        map_name=agsg.map_name,
        map_digest=agsg.map_digest,
        nodes=[
            create('aurora_msgs/msg/AgsgNode', id=n.id, type=_NODES.index(n.type), label=n.label)
            for n in agsg.nodes
        ],
        edges=[
            create(
                'aurora_msgs/msg/AgsgEdge',
                source=e.source,
                target=e.target,
                type=_EDGES.index(e.type),
                label=e.label,
            )
            for e in agsg.edges
        ],
        parameters=[
            create(
                'aurora_msgs/msg/AgsgParameter',
                path=p.path,
                owner=p.owner,
                requested=p.requested,
                realised=math.nan if p.realised is None else p.realised,
                low=p.low,
                high=p.high,
                unit=p.unit.value,
                provenance=_PROVENANCES.index(p.provenance),
                span_start=-1 if p.span is None else p.span.start,
                span_end=-1 if p.span is None else p.span.end,
            )
            for p in agsg.parameters
        ],
        spec_json=agsg.spec.canonical_json(),
        grounding_json=agsg.grounding_json,
        schedule_json=agsg.schedule_json,
        conditions_json=agsg.conditions_json,
        sha256=agsg.sha256,
    )


def read_agsg(message: Any, rebuild: Callable[[Agsg], Agsg]) -> Agsg:
    """Return the graph of an `Agsg` message.

    Args:
        message: Decoded message.
        rebuild: Derives nodes, edges and parameters from the documents (`agsg.build.derived`).

    Raises:
        SpecError: The digest or the typed fields do not match the documents.
    """
    documents = Agsg(
        iteration=int(message.iteration),
        stage=_STAGES[int(message.stage)],
        map_name=str(message.map_name),
        map_digest=str(message.map_digest),
        spec=ScenarioSpec.model_validate_json(str(message.spec_json)),
        grounding_json=str(message.grounding_json),
        schedule_json=str(message.schedule_json),
        conditions_json=str(message.conditions_json),
    )
    if documents.sha256 != str(message.sha256):
        raise SpecError('the graph does not match its digest', hint='send it as it was received')
    agsg = rebuild(documents)
    typed = (
        [(n.id, _NODES.index(n.type), n.label) for n in agsg.nodes],
        [(e.source, e.target, _EDGES.index(e.type), e.label) for e in agsg.edges],
        [(p.path, p.owner, p.requested, p.unit.value) for p in agsg.parameters],
    )
    found = (
        [(str(n.id), int(n.type), str(n.label)) for n in message.nodes],
        [(str(e.source), str(e.target), int(e.type), str(e.label)) for e in message.edges],
        [(str(p.path), str(p.owner), float(p.requested), str(p.unit)) for p in message.parameters],
    )
    for name, ours, theirs in zip(('nodes', 'edges', 'parameters'), typed, found, strict=True):
        if ours != theirs:
            raise SpecError(
                f"the graph's {name} do not match its documents",
                hint='derive them from the JSON documents, or leave the message unchanged',
            )
    return agsg
