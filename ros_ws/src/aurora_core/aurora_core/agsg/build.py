# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Derive the graph's nodes, edges and parameters from its documents, deterministically."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

from aurora_core.agsg.edges import Edges
from aurora_core.agsg.nodes import nodes_of
from aurora_core.agsg.parameters import parameters_of
from aurora_core.judging.codec import conditions_from_json
from aurora_core.outcomes.agsg import Agsg, AgsgParameter, Stage
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import ScenarioSpec


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
        nodes=tuple(nodes_of(spec, conditions)),
        edges=Edges(spec).all(conditions),
        parameters=tuple(
            _parameters(spec, _realised(grounding_json) if realised is None else realised)
        ),
    )


def _parameters(spec: ScenarioSpec, realised: Mapping[str, float]) -> Iterator[AgsgParameter]:
    for path, owner, parameter in parameters_of(spec):
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
