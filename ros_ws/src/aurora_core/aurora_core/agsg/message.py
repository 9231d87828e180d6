# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as an `Agsg` message and back; JSON is the truth, a mismatch is refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import SpecError, VerificationError
from aurora_core.judging.codec import conditions_from_json
from aurora_core.outcomes.agsg import Agsg, AgsgParameter, AgsgTexts, EdgeType, NodeType, Stage
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec

_NODES = tuple(NodeType)
_EDGES = tuple(EdgeType)
_STAGES = tuple(Stage)
_PROVENANCES = tuple(Provenance)

_RESEND = 'send the graph as it was received'

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
        spec_json=agsg.texts.spec,
        grounding_json=agsg.texts.grounding,
        schedule_json=agsg.texts.schedule,
        conditions_json=agsg.texts.conditions,
        sha256=agsg.texts.sha256,
    )


def read_agsg(message: Any) -> Agsg:
    """Return the graph of an `Agsg` message.

    Args:
        message: Decoded message.

    Raises:
        SpecError: The documents cannot be read, or the digest or a typed field does not match
            them.
    """
    texts = AgsgTexts(
        spec=str(message.spec_json),
        grounding=str(message.grounding_json),
        schedule=str(message.schedule_json),
        conditions=str(message.conditions_json),
    )
    if texts.sha256 != str(message.sha256):
        raise SpecError('the graph does not match its digest', hint='send it as it was received')
    try:
        agsg = _built(message, texts)
    except (ValueError, LookupError, TypeError, AttributeError, VerificationError) as err:
        raise SpecError(f"the graph's documents cannot be read: {err}", hint=_RESEND) from err
    typed = (
        [agsg.map_name, _grounded_on(agsg)],
        [(n.id, _NODES.index(n.type), n.label) for n in agsg.nodes],
        [(e.source, e.target, _EDGES.index(e.type), e.label) for e in agsg.edges],
        [_typed_parameter(p) for p in agsg.parameters],
    )
    found = (
        [str(message.map_name), str(message.map_digest)],
        [(str(n.id), int(n.type), str(n.label)) for n in message.nodes],
        [(str(e.source), str(e.target), int(e.type), str(e.label)) for e in message.edges],
        [_found_parameter(p) for p in message.parameters],
    )
    names = ('map', 'nodes', 'edges', 'parameters')
    for name, ours, theirs in zip(names, typed, found, strict=True):
        if ours != theirs:
            raise SpecError(
                f"the graph's {name} do not match its documents",
                hint='derive them from the JSON documents, or leave the message unchanged',
            )
    return agsg


def _built(message: Any, texts: AgsgTexts) -> Agsg:
    grounding = texts.grounding and GroundedScenario.model_validate_json(texts.grounding)
    schedule = texts.schedule and Schedule.model_validate_json(texts.schedule)
    build = partial(
        build_agsg,
        ScenarioSpec.model_validate_json(texts.spec),
        map_digest=str(message.map_digest),
        stage=_STAGES[int(message.stage)],
        iteration=int(message.iteration),
        grounding=grounding or None,
        schedule=schedule or None,
        conditions=conditions_from_json(texts.conditions),
    )
    agsg = build()
    # Another version may have written its documents otherwise: they are told by their own digest.
    return agsg if agsg.texts == texts else build(recorded_sha256=texts.sha256)


def _grounded_on(agsg: Agsg) -> str:
    """Return the map digest of the grounding; before it the message's own is all there is."""
    return agsg.map_digest if agsg.grounding is None else agsg.grounding.map_digest


# One parameter as it is compared; what is not there is None on both sides.
_Row = tuple[str, str, float, float | None, float, float, str, int, int, int]


def _typed_parameter(p: AgsgParameter) -> _Row:
    start, end = (-1, -1) if p.span is None else (p.span.start, p.span.end)
    provenance = _PROVENANCES.index(p.provenance)
    numbers = (p.requested, p.realised, p.low, p.high)
    return (p.path, p.owner, *numbers, p.unit.value, provenance, start, end)


def _found_parameter(p: Any) -> _Row:
    realised = None if math.isnan(p.realised) else float(p.realised)
    numbers = (float(p.requested), realised, float(p.low), float(p.high))
    places = (int(p.provenance), int(p.span_start), int(p.span_end))
    return (str(p.path), str(p.owner), *numbers, str(p.unit), *places)
