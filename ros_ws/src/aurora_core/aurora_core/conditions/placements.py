# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by placements: the relation and the distance at t = 0, and in motion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aurora_core.judging.build import Inputs, Source, Underivable
from aurora_core.judging.quantities import placement, relation_fraction
from aurora_core.judging.relations import RELATION_WORDS
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import GroundAgent
from aurora_core.spec.vocabulary import Place, Relation

_OF_PLACES = frozenset(
    {
        Relation.NEAR,
        Relation.AT,
        Relation.BESIDE,
        Relation.BEFORE,
        Relation.ON,
        Relation.PARKED_AT,
    }
)
_OF_AGENTS = frozenset(RELATION_WORDS) - {Relation.ON, Relation.PARKED_AT}


def placement_conditions(
    inputs: Inputs, whose: Sequence[GroundAgent]
) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all placements of some ground agents."""
    agents = {agent.id for agent in inputs.spec.agents}
    for agent in whose:
        for index, placed in enumerate(agent.placements):
            relation, of = placed.relation, placed.of
            if of is None and relation is Relation.PARKED_AT:
                of = Place.ROADSIDE.value
            known = _OF_AGENTS if of in agents else _OF_PLACES
            if of is None or relation not in known:
                what = f'placement {relation.value}' + ('' if of is None else f' {of}')
                yield Underivable(element=agent.id, what=what, span=placed.span)
                continue
            source = Source(
                ids=(agent.id,),
                spans=(placed.span or agent.span,),
                provenance=Provenance.INFERRED,
            )
            name = placement_id(agent, index)
            yield from placement.implied(inputs, agent, placed, of, name, source)
            if placed.kept_in_motion:
                yield relation_fraction.kept(inputs, agent, placed, of, name, source)
            distance = relation_fraction.distance_kept(inputs, agent, placed, of, name)
            if distance is not None:
                yield distance


def placement_id(agent: GroundAgent, index: int) -> str:
    """Return the id of the condition that a placement of an agent implies."""
    return f'{agent.id}.placed' + ('' if index == 0 else str(index + 1))
