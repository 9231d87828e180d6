# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse hovers beside a landmark from which buildings hide it, wherever they may be.

Who is higher sees no less, so the greatest altitude is looked at. A building hides the landmark
from all that lies behind it, seen from there, as soon as a line over its roof is so high.
What is not hidden may be inside a building, or too near to its wall. The shares of the phase for
which sight, bearing and altitude are asked overlap, and the distance is kept all along.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import shapely

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, map_fact, says, tolerance_facts
from aurora_core.feasibility.zones import hover_area, is_half_read, is_redirected
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Building, Landmark
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.quantities.kernels import PLACE_SIGHT_M
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.stated import is_stated, most
from aurora_core.spec.vocabulary import MissionMode

_ROUNDING_M = 1e-6


def check_hidden(
    spec: ScenarioSpec,
    buildings: Sequence[Building],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
) -> Iterator[Certificate]:
    """Return hovers beside a landmark that cannot see it from anywhere that they may be.

    Args:
        spec: The request.
        buildings: Of its map.
        landmarks: Of its map.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
    """
    known = {f'{LANDMARK}{mark.name}': mark for mark in landmarks}
    for mission in spec.missions:
        mark, altitude = known.get(mission.target or ''), mission.altitude_m
        if mark is None or mission.mode is not MissionMode.HOVER:
            continue
        if not (is_stated(altitude) and is_stated(mission.standoff_m)):
            continue
        if is_half_read(spec, mission) or is_redirected(spec, mission):
            continue
        slack = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
        high_m = most(altitude, slack, limits.uav_altitude_max_m)
        area = hover_area(mission, (mark.x_m, mark.y_m), limits, tolerances, None)
        hiding = _hiding(mark, area, high_m, buildings, _gap_m(limits, tolerances))
        if not hiding:
            continue
        base = f'missions/{mission.id}'
        names = ', '.join(f'{b.name or b.id} ({b.height_m:g} m)' for b in hiding)
        yield beyond(
            Rule.HIDDEN,
            'spatial_contradiction',
            altitude,
            f'{base}/altitude_m',
            ('uav_altitude_max_m', limits.uav_altitude_max_m),
            f'{mission.uav} would hover beside {mark.name}, {high_m:g} m high at most; wherever '
            f'that may be, {names} would hide it or be too near.',
            (
                *says(f'{base}/target', mission.target),
                *says(f'{base}/altitude_m', altitude),
                *says(f'{base}/standoff_m', mission.standoff_m),
                *says(f'{base}/bearing_deg', mission.bearing_deg),
                *(map_fact(f'{b.id}/height_m', b.height_m) for b in hiding),
                *limit_facts(
                    limits, 'clearance_min_m', 'uav_altitude_max_m', 'uav_standoff_max_m'
                ),
                *tolerance_facts(
                    tolerances,
                    'altitude_m',
                    'altitude_share',
                    'bearing_deg',
                    'limit_margin',
                    'relation_fraction',
                    'standoff_m',
                    'visible_fraction',
                ),
            ),
        )


def _gap_m(limits: Limits, tolerances: Tolerances) -> float:
    return limits.clearance_min_m * (1.0 - tolerances.limit_margin)


def _hiding(
    mark: Landmark,
    area: shapely.Geometry,
    high_m: float,
    buildings: Sequence[Building],
    gap_m: float,
) -> tuple[Building, ...]:
    """Return few buildings that hide a landmark from a whole area; none where some of it sees."""
    eye = (mark.x_m, mark.y_m)
    west, south, east, north = shapely.union(area, shapely.Point(eye)).bounds
    reach_m = 2.0 * max(east - west, north - south)
    found: dict[str, tuple[Building, shapely.Geometry]] = {}
    for building in buildings:
        left, low, right, high = building.box_m
        beside = left <= east + gap_m and right >= west - gap_m
        if not (beside and low <= north + gap_m and high >= south - gap_m):
            continue
        taken = shapely.intersection(_taken(building, eye, high_m, reach_m, gap_m), area)
        if taken.area > 0.0:
            found[building.id] = (building, shapely.buffer(taken, _ROUNDING_M))
    if not _cover([shape for _, shape in found.values()], area):
        return ()
    for name in sorted(found, key=lambda n: float(found[n][1].area)):
        rest = [shape for other, (_, shape) in found.items() if other != name]
        if _cover(rest, area):
            del found[name]
    return tuple(building for building, _ in found.values())


def _cover(shapes: Sequence[shapely.Geometry], area: shapely.Geometry) -> bool:
    return bool(shapes) and bool(shapely.union_all(list(shapes)).covers(area))


def _taken(
    building: Building, eye: tuple[float, float], high_m: float, reach_m: float, gap_m: float
) -> shapely.Geometry:
    """Return where a UAV is in a building, too near to it, or has it before the landmark.

    Args:
        building: Who looks at what is in it looks at the building, which does not hide itself.
        eye: The landmark, metres.
        high_m: Altitude of the UAV.
        reach_m: No place that is asked about is farther away.
        gap_m: That is kept from walls, and not above roofs.
    """
    outline, top_m = shapely.Polygon(building.ring, building.holes), building.height_m
    parts = []
    if high_m <= top_m:
        parts.append(outline.buffer(gap_m, quad_segs=4))
    itself = shapely.Polygon(building.ring).distance(shapely.Point(eye)) <= _ROUNDING_M
    if not itself and top_m > PLACE_SIGHT_M:
        # A line that leaves the roof at its edge is so high only so many times farther away.
        times = max(1.0, (high_m - PLACE_SIGHT_M) / (top_m - PLACE_SIGHT_M))
        parts += _behind(building, eye, times, reach_m)
    return shapely.union_all(parts)


def _behind(
    building: Building, eye: tuple[float, float], times: float, reach_m: float
) -> Iterator[shapely.Geometry]:
    """Yield what lies behind each wall, seen from a point, from so many times its distance on."""
    ring = [*building.ring, building.ring[0]]
    for a, b in pairwise(ring):
        near = [(eye[0] + times * (x - eye[0]), eye[1] + times * (y - eye[1])) for x, y in (a, b)]
        away_m = shapely.LineString([a, b]).distance(shapely.Point(eye))
        more = max(times, 1.0 + reach_m / away_m)
        far = [(eye[0] + more * (x - eye[0]), eye[1] + more * (y - eye[1])) for x, y in (b, a)]
        shadow = shapely.Polygon([*near, *far])
        if shadow.is_valid and shadow.area > 0.0:
            yield shadow
