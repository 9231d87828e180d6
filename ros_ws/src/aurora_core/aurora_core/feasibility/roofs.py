# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse hovers at a landmark that are inside a building, or too near it, wherever they may be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import shapely

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, map_fact, says, tolerance_facts
from aurora_core.feasibility.geometry import altitude_changes
from aurora_core.feasibility.operands import AT_MOST, whole
from aurora_core.feasibility.zones import hover_area, is_half_read, roof_of
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Building, Landmark
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.stated import is_stated, most
from aurora_core.spec.vocabulary import MissionMode


def check_roofs(
    spec: ScenarioSpec,
    buildings: Sequence[Building],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
) -> Iterator[Certificate]:
    """Return hovers that are lower than the roof that they are over, wherever they may be."""
    known = {f'{LANDMARK}{mark.name}': mark for mark in landmarks}
    gap = limits.clearance_min_m
    for mission in spec.missions:
        mark, altitude = known.get(mission.target or ''), mission.altitude_m
        if mark is None or mission.mode is not MissionMode.HOVER or is_half_read(spec, mission):
            continue
        if not is_stated(altitude) or altitude.bound is Bound.AT_LEAST:
            continue
        slack = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
        high = most(altitude, slack, limits.uav_altitude_max_m)
        roof = roof_of(mark, buildings)
        area = hover_area(mission, (mark.x_m, mark.y_m), limits, tolerances, roof)
        west, south, east, north = area.bounds
        for building in (b for b in buildings if high < b.height_m + gap):
            if not all(building.has_in_box(*c, gap) for c in ((west, south), (east, north))):
                continue
            outline = shapely.Polygon(building.ring, building.holes)
            # Beside a wall the gap is to the side; above the edge of a roof it need not be.
            beside = high <= building.height_m
            if not (outline.buffer(gap) if beside else outline).covers(area):
                continue
            base, name = f'missions/{mission.id}', building.name or building.id
            yield beyond(
                Rule.ROOF,
                'clearance',
                altitude,
                f'{base}/altitude_m',
                ('clearance_min_m', gap),
                f'{mission.uav} would fly at {high:g} m at most at {mark.name}, where {name} is '
                f'{building.height_m:g} m high; {gap:g} m are kept from it.',
                (
                    *says(f'{base}/target', mission.target),
                    *says(f'{base}/altitude_m', altitude),
                    *says(f'{base}/standoff_m', mission.standoff_m),
                    *says(f'{base}/bearing_deg', mission.bearing_deg),
                    map_fact(f'{building.id}/height_m', building.height_m),
                    *limit_facts(limits, 'clearance_min_m', 'uav_standoff_max_m'),
                    *tolerance_facts(
                        tolerances,
                        'altitude_m',
                        'standoff_m',
                        'pattern_centre_m',
                        'hover_drift_wind_m',
                        'bearing_deg',
                    ),
                ),
            ).model_copy(update={'word': building.id})
            break


def check_walls(
    spec: ScenarioSpec, buildings: Sequence[Building], limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return conditions that keep a UAV nearer to a wall than it may be.

    Clearance is horizontal: over the roof there is none, and more than enough room. So it is
    refused only of a UAV that has to fly below the roof.

    Args:
        spec: The request.
        buildings: Of its map.
        limits: Limits in force.
        tolerances: How far stated altitudes may be missed.
    """
    gap = limits.clearance_min_m
    tall = {f'{LANDMARK}{b.name}': b for b in buildings if b.name}
    for condition in spec.conditions:
        asked, near = condition.value, condition.op in AT_MOST and whole(condition)
        if condition.quantity != QuantityName.CLEARANCE or not (near and is_stated(asked)):
            continue
        building = tall.get(condition.of[1])
        if building is None or asked.value >= gap * (1.0 - tolerances.limit_margin):
            continue
        for mission in (m for m in spec.missions if m.uav == condition.of[0]):
            altitude = mission.altitude_m
            if mission.uav in altitude_changes(spec):
                continue
            if not is_stated(altitude) or is_half_read(spec, mission):
                continue
            slack = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
            high = most(altitude, slack, limits.uav_altitude_max_m)
            if high > building.height_m:
                continue
            yield beyond(
                Rule.WALL,
                'clearance',
                asked,
                f'conditions/{condition.id}/value',
                ('clearance_min_m', gap),
                f'{mission.uav} flies at {high:g} m at most, below the roof of {building.name} '
                f'({building.height_m:g} m), and is to be {asked.value:g} m from it at most; '
                f'{gap:g} m are kept from it.',
                (
                    *says(f'conditions/{condition.id}/value', asked),
                    *says(f'missions/{mission.id}/altitude_m', altitude),
                    map_fact(f'{building.id}/height_m', building.height_m),
                    *limit_facts(limits, 'clearance_min_m', 'uav_altitude_max_m'),
                    *tolerance_facts(tolerances, 'altitude_m', 'limit_margin'),
                ),
            ).model_copy(update={'word': building.id})
            break
