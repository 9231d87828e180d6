# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse places that exclude each other, or that lie inside a no-fly zone of the map."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import shapely

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import limit_facts, map_fact, says, tolerance_facts
from aurora_core.feasibility.stated import is_stated, least, most
from aurora_core.feasibility.verdict import Certificate, Fact, Rule
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Landmark, NoFlyZone
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import GroundAgent, Placement, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode, Pattern, Relation

# Axis and side of the relations that have an opposite.
_SIDES = {
    Relation.AHEAD: ('along the route', 1),
    Relation.BEHIND: ('along the route', -1),
    Relation.LEFT: ('across', 1),
    Relation.RIGHT: ('across', -1),
}
_LANDMARK = 'landmark:'


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


def check_zones(
    spec: ScenarioSpec,
    zones: Sequence[NoFlyZone],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
) -> Iterator[Certificate]:
    """Return flights at a landmark that enter a no-fly zone wherever their centre may lie."""
    known = {f'{_LANDMARK}{mark.name}': mark for mark in landmarks}
    for mission in spec.missions:
        mark = known.get(mission.target or '')
        if mark is None:
            continue
        stated = mission.altitude_m
        slack = tolerances.altitude_m.of(stated.value, approximate=stated.approximate)
        low = least(stated, slack, limits.uav_altitude_min_m)
        high = most(stated, slack, limits.uav_altitude_max_m)
        for zone in zones:
            is_level = zone.floor_m <= low and high <= zone.ceiling_m
            hovers = mission.mode is MissionMode.HOVER
            beside = 'hover_drift_calm_m' if hovers else 'standoff_m'
            if is_level and _enters(mission, mark, zone, tolerances):
                yield Certificate(
                    kind='geometric_contradiction',
                    reason='geofence',
                    path=f'missions/{mission.id}',
                    word=zone.name,
                    span=mission.span,
                    sentence=f'{mission.uav} would enter the no-fly zone {zone.name!r} '
                    f'({zone.floor_m:g} m to {zone.ceiling_m:g} m) at {mark.name}.',
                    rule=Rule.ZONE,
                    facts=(
                        *says(f'missions/{mission.id}/target', mission.target),
                        *says(f'missions/{mission.id}/altitude_m', mission.altitude_m),
                        *says(f'missions/{mission.id}/radius_m', mission.radius_m),
                        map_fact(f'{zone.id}/name', zone.name),
                        map_fact(f'{zone.id}/floor_m', zone.floor_m),
                        map_fact(f'{zone.id}/ceiling_m', zone.ceiling_m),
                        *limit_facts(limits, 'uav_altitude_min_m', 'uav_altitude_max_m'),
                        *tolerance_facts(tolerances, 'altitude_m', beside),
                    ),
                )


def _enters(mission: UavMission, mark: Landmark, zone: NoFlyZone, tolerances: Tolerances) -> bool:
    centre = shapely.Point(mark.x_m, mark.y_m)
    radius = mission.radius_m
    orbit = mission.pattern is Pattern.ORBIT and radius is not None and is_stated(radius)
    if mission.mode is MissionMode.HOVER:
        core = shapely.Polygon(zone.ring).buffer(-tolerances.hover_drift_calm_m)
        return bool(core.covers(centre))
    if not orbit or radius is None:
        return False
    slack = tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
    core = shapely.Polygon(zone.ring).buffer(-slack)
    return bool(core.intersects(centre.buffer(radius.value, quad_segs=45).exterior))
