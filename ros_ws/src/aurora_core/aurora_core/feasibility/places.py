# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse places of ground agents that exclude each other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import says, tolerance_facts
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import Relation
from aurora_core.temporal.stn import Edge, Stn

_MICRO = 1_000_000

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
    yield from _circle(sides, tolerances)
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


def _circle(sides: Sequence[_Side], tolerances: Tolerances) -> Iterator[Certificate]:
    """Three or more in a row, each ahead of the next by so much, that do not close.

    Placements of one pair twice are told of by `check_placements` itself.
    """
    for axis in dict.fromkeys(s.axis for s in sides):
        edges = [e for s in sides if s.axis == axis for e in _edges(s, tolerances)]
        circle = Stn(edges).negative_cycle() if edges else ()
        used = list(dict.fromkeys(edge.reason.path for edge in circle))
        if len({frozenset((e.reason.first, e.reason.second)) for e in circle}) < 3:
            continue
        last = max((edge.reason for edge in circle), key=lambda s: s.path)
        names = ', '.join(dict.fromkeys(n for e in circle for n in (e.earlier, e.later)))
        yield contradiction(
            Rule.PLACEMENT,
            'spatial_contradiction',
            last.path,
            f'{names} are placed in a row {axis} that does not close: the placements add up to '
            'something else.',
            last.placement.span,
            (
                *(fact for s in sides if s.path in used for fact in _says(s)),
                *tolerance_facts(tolerances, 'placement_other_m'),
            ),
        )


def _edges(side: _Side, tolerances: Tolerances) -> Iterator[Edge[_Side]]:
    """Yield how far `first` is beyond `second`, in micrometres: at least, and at most."""
    slack, stated = 0.0, side.distance
    if stated is not None and is_stated(stated):
        slack = tolerances.placement_other_m.of(stated.value, approximate=stated.approximate)
    low, high = least(stated, slack, 0.0), most(stated, slack, math.inf)
    # Being ahead is more than nothing, however little.
    yield Edge(side.first, side.second, min(-1, -math.floor(low * _MICRO)), side)
    if math.isfinite(high):
        yield Edge(side.second, side.first, math.ceil(high * _MICRO), side)


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
