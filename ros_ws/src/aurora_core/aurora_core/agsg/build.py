# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Derive the graph's nodes, edges and parameters from its documents, deterministically."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_core.agsg.edges import Edges
from aurora_core.agsg.nodes import nodes_of
from aurora_core.agsg.parameters import parameters_of
from aurora_core.outcomes.agsg import Agsg, AgsgParameter, Stage
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.spec.scenario import ScenarioSpec


def build_agsg(
    spec: ScenarioSpec,
    *,
    map_digest: str = '',
    stage: Stage = Stage.PARSED,
    iteration: int = 0,
    grounding: GroundedScenario | None = None,
    schedule: Schedule | None = None,
    conditions: tuple[Condition, ...] = (),
    recorded_sha256: str = '',
) -> Agsg:
    """Return the graph of a specification (and of its grounding, once there is one).

    Args:
        spec: The request.
        map_digest: sha256 (hex) of the map.
        stage: How far it has come.
        iteration: Repair iteration.
        grounding: Places and flights.
        schedule: When things have to be done.
        conditions: Success conditions; they become nodes.
        recorded_sha256: See `Agsg`.
    """
    realised = grounding.realised if grounding is not None else ()
    return Agsg(
        iteration=iteration,
        stage=stage,
        map_name=spec.world.map_name,
        map_digest=map_digest,
        spec=spec,
        grounding=grounding,
        schedule=schedule,
        conditions=conditions,
        nodes=tuple(nodes_of(spec, conditions)),
        edges=Edges(spec).all(conditions),
        parameters=tuple(_parameters(spec, {r.path: r.realised for r in realised})),
        recorded_sha256=recorded_sha256,
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
