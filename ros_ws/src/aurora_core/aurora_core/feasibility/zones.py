# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse flights at a landmark that are inside a no-fly zone wherever they may be flown.

A flight is refused only when every position that meets the stated distance and bearing, with
their tolerances, lies in the zone. Where the request leaves the place open, or part of the clause
that tells of the flight was not read, nothing is proven.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

import shapely

from aurora_core.feasibility.facts import limit_facts, map_fact, says, tolerance_facts
from aurora_core.feasibility.quotes import unread_spans
from aurora_core.geometry.frames import offset_at_bearing
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Building, Landmark, NoFlyZone
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec, UavAction, UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode, Pattern

# Corners of the polygons that stand for circles.
_STEP_DEG = 1.0
_ROUNDING_M = 1e-6
# A landmark so near to a building stands in it.
BESIDE_M = 1.0


def check_zones(
    spec: ScenarioSpec,
    zones: Sequence[NoFlyZone],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
    buildings: Sequence[Building] = (),
) -> Iterator[Certificate]:
    """Return flights at a landmark that enter a no-fly zone wherever their place may be.

    Args:
        spec: The request.
        zones: No-fly zones of its map.
        landmarks: Its landmarks.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
        buildings: Of the map: over the roof of a landmark is over it.
    """
    known = {f'{LANDMARK}{mark.name}': mark for mark in landmarks}
    for mission in spec.missions:
        mark = known.get(mission.target or '')
        if mark is None or is_half_read(spec, mission):
            continue
        stated = mission.altitude_m
        slack = tolerances.altitude_m.of(stated.value, approximate=stated.approximate)
        low = least(stated, slack, limits.uav_altitude_min_m)
        high = most(stated, slack, limits.uav_altitude_max_m)
        level = [zone for zone in zones if zone.floor_m <= low and high <= zone.ceiling_m]
        roof = roof_of(mark, buildings) if level else None
        for zone in level:
            if _enters(mission, mark, zone, limits, tolerances, roof):
                yield Certificate(
                    kind='geometric_contradiction',
                    reason='geofence',
                    path=f'missions/{mission.id}',
                    word=zone.name,
                    span=mission.span,
                    sentence=f'{mission.uav} would enter the no-fly zone {zone.name!r} '
                    f'({zone.floor_m:g} m to {zone.ceiling_m:g} m) at {mark.name}.',
                    rule=Rule.ZONE,
                    facts=_facts(mission, zone, limits, tolerances),
                )


def _facts(
    mission: UavMission, zone: NoFlyZone, limits: Limits, tolerances: Tolerances
) -> tuple[Fact, ...]:
    base = f'missions/{mission.id}'
    hovers = mission.mode is MissionMode.HOVER
    beside = ('pattern_centre_m', 'hover_drift_wind_m', 'bearing_deg') if hovers else ()
    return (
        *says(f'{base}/target', mission.target),
        *says(f'{base}/altitude_m', mission.altitude_m),
        *says(f'{base}/standoff_m', mission.standoff_m),
        *says(f'{base}/bearing_deg', mission.bearing_deg),
        *says(f'{base}/radius_m', mission.radius_m),
        map_fact(f'{zone.id}/name', zone.name),
        map_fact(f'{zone.id}/floor_m', zone.floor_m),
        map_fact(f'{zone.id}/ceiling_m', zone.ceiling_m),
        *limit_facts(limits, 'uav_altitude_min_m', 'uav_altitude_max_m', 'uav_standoff_max_m'),
        *tolerance_facts(tolerances, 'altitude_m', 'standoff_m', *beside),
    )


def hover_area(
    mission: UavMission,
    centre: tuple[float, float],
    limits: Limits,
    tolerances: Tolerances,
    roof: shapely.Geometry | None,
) -> shapely.Geometry:
    """Return what holds every place where a hover at a landmark may be.

    Args:
        mission: The hover.
        centre: The landmark, metres.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
        roof: Outline of its building: who is over the roof is over it.
    """
    near, far = place_distances(mission, limits, tolerances)
    area = _sector(centre, near, far, *_bearings(mission, tolerances))
    return area if roof is None or not is_over(mission) else shapely.union(area, roof)


def is_over(mission: UavMission) -> bool:
    """Tell whether a hover is over its landmark, not at a distance from it."""
    return mission.standoff_m is None and mission.bearing_deg is None


def roof_of(mark: Landmark, buildings: Sequence[Building]) -> shapely.Geometry | None:
    """Return the outline of the buildings that a landmark stands in, None in the open."""
    point = shapely.Point(mark.x_m, mark.y_m)
    near = (b for b in buildings if b.has_in_box(mark.x_m, mark.y_m, BESIDE_M))
    found = [
        outline
        for outline in (shapely.Polygon(b.ring) for b in near)
        if outline.distance(point) <= BESIDE_M
    ]
    return shapely.union_all(found) if found else None


def roof_reach_m(mark: Landmark, buildings: Sequence[Building]) -> float:
    """Return how far from a landmark the roof of its building reaches, metres."""
    roof = roof_of(mark, buildings)
    if roof is None:
        return 0.0
    return float(shapely.hausdorff_distance(shapely.Point(mark.x_m, mark.y_m), roof))


def is_half_read(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Return whether words that may say where a flight is were not read."""
    at = mission.span
    return any(
        at is None or (words.start < at.end and at.start < words.end)
        for words in unread_spans(spec)
    )


def is_redirected(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Return whether an event may end a flight, or send its UAV to another height or place."""
    return any(
        isinstance(e.action, UavAction)
        and e.action.uav == mission.uav
        and e.action.mission != mission.id
        for e in spec.events
    )


def _enters(
    mission: UavMission,
    mark: Landmark,
    zone: NoFlyZone,
    limits: Limits,
    tolerances: Tolerances,
    roof: shapely.Geometry | None,
) -> bool:
    area = shapely.Polygon(zone.ring)
    centre = (mark.x_m, mark.y_m)
    if mission.mode is MissionMode.HOVER:
        return bool(area.covers(hover_area(mission, centre, limits, tolerances, roof)))
    radius = mission.radius_m
    if mission.pattern is not Pattern.ORBIT or radius is None or not is_stated(radius):
        return False
    slack = tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
    low, high = least(radius, slack, 0.0), most(radius, slack, math.inf)
    if not math.isfinite(high):
        return False
    # Whoever goes round the centre between the two distances has to cross a piece of the zone
    # that reaches from one to the other.
    inside = area.intersection(_sector(centre, low, high, 0.0, 180.0))
    point = shapely.Point(centre)
    return any(
        point.distance(piece) <= low + _ROUNDING_M
        and float(shapely.hausdorff_distance(point, piece)) >= high
        for piece in shapely.get_parts(inside)
        if not piece.is_empty
    )


def place_distances(
    mission: UavMission, limits: Limits, tolerances: Tolerances
) -> tuple[float, float]:
    """Return the least and greatest horizontal distance from the landmark that is asked for."""
    standoff, far = mission.standoff_m, limits.uav_standoff_max_m
    if standoff is not None and is_stated(standoff):
        slack = tolerances.standoff_m.of(standoff.value, approximate=standoff.approximate)
        return least(standoff, slack, 0.0), most(standoff, slack, max(far, standoff.value))
    if is_over(mission):
        return 0.0, tolerances.pattern_centre_m + tolerances.hover_drift_wind_m
    return 0.0, far


def _bearings(mission: UavMission, tolerances: Tolerances) -> tuple[float, float]:
    """Return the compass bearing from the landmark and by how much it may be missed, degrees."""
    bearing = mission.bearing_deg
    if bearing is None or not is_stated(bearing):
        return 0.0, 180.0
    return bearing.value, tolerances.bearing_deg


# Mends are looked for by asking again and again with other numbers, mostly at the same place.
@lru_cache(maxsize=64)
def _sector(
    centre: tuple[float, float], near_m: float, far_m: float, bearing_deg: float, either_deg: float
) -> shapely.Geometry:
    """Return a polygon that holds all points at these distances and bearings."""
    steps = max(1, math.ceil(2.0 * either_deg / _STEP_DEG))
    width = 2.0 * either_deg / steps
    whole = either_deg >= 180.0
    # Corners of the outer arc lie beyond it, so that its sides touch the circle.
    beyond = far_m / math.cos(math.radians(width) / 2.0)
    angles = [bearing_deg - either_deg + width * k for k in range(steps if whole else steps + 1)]
    outer = [_at(centre, beyond, a) for a in angles]
    inner = [_at(centre, near_m, a) for a in angles]
    if not whole:
        return shapely.Polygon([*outer, *(reversed(inner) if near_m > 0.0 else [centre])])
    return shapely.Polygon(outer, [inner] if near_m > 0.0 else [])


def _at(centre: tuple[float, float], radius_m: float, bearing_deg: float) -> tuple[float, float]:
    east_m, north_m = offset_at_bearing(radius_m, bearing_deg)
    return centre[0] + east_m, centre[1] + north_m
