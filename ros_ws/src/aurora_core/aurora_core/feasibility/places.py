# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse places of ground agents that exclude each other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import says, tolerance_facts
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import Relation

# Axis and side of the relations that have an opposite.
_SIDES = {
    Relation.AHEAD: ('along the route', 1),
    Relation.BEHIND: ('along the route', -1),
    Relation.LEFT: ('across', 1),
    Relation.RIGHT: ('across', -1),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Side:
    """`first` is on the positive side of `second` on an axis, so far away if stated."""

    axis: str
    first: str
    second: str
    distance: Parameter | None
    path: str
    placement: Placement


def check_placements(spec: ScenarioSpec, tolerances: Tolerances) -> Iterator[Certificate]:
    """Return pairs that are asked to be on two sides, or at two distances, of each other."""
    sides = [s for a in spec.agents for s in _sides(a)]
    for k, one in enumerate(sides):
        for other in sides[:k]:
            if one.axis != other.axis or {one.first, one.second} != {other.first, other.second}:
                continue
            if one.first != other.first or _apart(one, other, tolerances):
                yield contradiction(
                    Rule.PLACEMENT,
                    'spatial_contradiction',
                    one.path,
                    f'{one.first} and {one.second} are placed twice {one.axis}, '
                    'and both cannot hold at once.',
                    one.placement.span,
                    (
                        *_says(one),
                        *_says(other),
                        *tolerance_facts(tolerances, 'placement_other_m'),
                    ),
                )


def _sides(agent: GroundAgent) -> Iterator[_Side]:
    for k, placement in enumerate(agent.placements):
        known = _SIDES.get(placement.relation)
        if known is None or placement.of is None:
            continue
        axis, sign = known
        pair = (agent.id, placement.of) if sign > 0 else (placement.of, agent.id)
        yield _Side(
            axis=axis,
            first=pair[0],
            second=pair[1],
            distance=placement.distance_m,
            path=f'agents/{agent.id}/placements/{k}',
            placement=placement,
        )


def _says(side: _Side) -> tuple[Fact, ...]:
    return (
        *says(f'{side.path}/relation', side.placement.relation.value),
        *says(f'{side.path}/of', side.placement.of),
        *says(f'{side.path}/distance_m', side.distance),
    )


def _apart(one: _Side, other: _Side, tolerances: Tolerances) -> bool:
    a, b = one.distance, other.distance
    if a is None or b is None or not (is_stated(a) and is_stated(b)):
        return False
    if a.bound is not Bound.EXACTLY or b.bound is not Bound.EXACTLY:
        return False
    slack = sum(
        tolerances.placement_other_m.of(p.value, approximate=p.approximate) for p in (a, b)
    )
    return abs(a.value - b.value) > slack
