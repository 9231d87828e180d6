# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by placements: the relation and the distance at t = 0, and in motion."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    condition,
    number,
    number_target,
)
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent, Placement
from aurora_core.spec.vocabulary import Place, Relation

_ALONG = (Relation.AHEAD, Relation.BEHIND, Relation.BEFORE)
# Relations of two agents with a slack in metres (`oncoming`: cosine) at every sample.
RELATION_WORDS = {
    Relation.AHEAD: 'ahead of',
    Relation.BEHIND: 'behind',
    Relation.SAME_LANE: 'in the lane of',
    Relation.LEFT: 'to the left of',
    Relation.RIGHT: 'to the right of',
    Relation.BESIDE: 'beside',
    Relation.ONCOMING: 'oncoming to',
    Relation.NEAR: 'near',
    Relation.AT: 'at',
    Relation.ADJACENT_LANE: 'in a lane next to that of',
    Relation.BEFORE: 'before',
    Relation.ON: 'on',
    Relation.PARKED_AT: 'parked at',
}
_OF_PLACES = frozenset(
    {Relation.NEAR, Relation.AT, Relation.BEFORE, Relation.ON, Relation.PARKED_AT}
)
_OF_AGENTS = frozenset(RELATION_WORDS) - {Relation.ON, Relation.PARKED_AT}
# The measured world has no ground of this kind.
_NO_SURFACE = frozenset({Place.SIDEWALK})


def placement_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all placements of ground agents."""
    agents = {agent.id for agent in inputs.spec.agents}
    for agent in inputs.spec.agents:
        for index, placement in enumerate(agent.placements):
            known = _OF_AGENTS if placement.of in agents else _OF_PLACES
            on_ground = placement.relation is Relation.ON and placement.of in _NO_SURFACE
            if placement.of is None or placement.relation not in known or on_ground:
                place = '' if placement.of is None else f' {placement.of}'
                yield Underivable(
                    element=agent.id,
                    what=f'placement {placement.relation.value}{place}',
                    span=placement.span,
                )
                continue
            name = placement_id(agent, index)
            yield from _placement(inputs, agent, placement, placement.of, name)


def placement_id(agent: GroundAgent, index: int) -> str:
    """Return the id of the condition that a placement of an agent implies."""
    return f'{agent.id}.placed' + ('' if index == 0 else str(index + 1))


def _placement(
    inputs: Inputs, agent: GroundAgent, placement: Placement, of: str, name: str
) -> Iterator[Condition]:
    source = Source(
        ids=(agent.id,), spans=(placement.span or agent.span,), provenance=Provenance.INFERRED
    )
    relation, words = placement.relation, RELATION_WORDS[placement.relation]
    offset_m = _offset_m(inputs, relation)
    near_m = _near_m(inputs, relation, of)
    yield condition(
        id=name,
        sentence=f'{agent.id} is {words} {of} at t = 0',
        quantity=QuantityName.PLACEMENT,
        signal=f'{relation.value}({agent.id},{of})',
        of=(agent.id, of),
        target=Target(op='>' if relation in _ALONG else '>=', threshold=0.0, unit='m'),
        arguments=inputs.arguments(
            Window.START, relation=relation, offset_m=offset_m, high=near_m
        ),
        source=source,
        every_sample=False,
    )
    distance = placement.distance_m
    if distance is not None and distance.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{name}.distance',
            sentence=f'{agent.id} is {number(distance.value)} m {words} {of} at t = 0',
            quantity=QuantityName.PLACEMENT,
            signal=f'distance_{relation.value}({agent.id},{of})',
            of=(agent.id, of),
            target=number_target(distance, inputs.placement_tolerance(agent.id)),
            arguments=inputs.arguments(Window.START, aspect='distance', relation=relation),
            source=Source(ids=(agent.id,), spans=(distance.span,), provenance=distance.provenance),
            every_sample=False,
        )
    bearing = placement.bearing_deg
    if bearing is not None and bearing.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{name}.bearing',
            sentence=f'{agent.id} is at bearing {number(bearing.value)} deg from {of} at t = 0',
            quantity=QuantityName.PLACEMENT,
            signal=f'bearing_error({agent.id},{of})',
            of=(agent.id, of),
            target=Target(op='<=', threshold=inputs.tolerances.bearing_deg, unit='deg'),
            arguments=inputs.arguments(
                Window.START, aspect='bearing', relation=relation, wanted=bearing.value
            ),
            source=Source(ids=(agent.id,), spans=(bearing.span,), provenance=bearing.provenance),
            every_sample=False,
        )
    if placement.kept_in_motion:
        share = inputs.tolerances.relation_fraction
        yield condition(
            id=f'{name}.kept',
            sentence=(
                f'{agent.id} stays {words} {of} for {number(100 * share)} % of the time until the '
                'last mission ends'
            ),
            quantity=QuantityName.RELATION_FRACTION,
            signal=f'{relation.value}_fraction({agent.id},{of})',
            of=(agent.id, of),
            target=Target(op='>=', threshold=share, unit='1'),
            fraction=share,
            arguments=inputs.arguments(
                Window.MISSIONS, relation=relation, offset_m=offset_m, high=near_m
            ),
            source=source,
            every_sample=False,
        )


def _offset_m(inputs: Inputs, relation: Relation) -> float:
    if relation in (Relation.SAME_LANE, Relation.ADJACENT_LANE):
        return inputs.tolerances.lane_offset_m
    return inputs.tolerances.route_offset_m


def _near_m(inputs: Inputs, relation: Relation, of: str) -> float:
    if relation is Relation.NEAR:
        return inputs.tolerances.near_m
    on = relation in (Relation.ON, Relation.PARKED_AT)
    strip = on and of == Place.ROADSIDE
    return inputs.tolerances.roadside_m if strip else inputs.tolerances.arrival_m
