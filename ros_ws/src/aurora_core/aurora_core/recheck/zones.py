# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by no-fly zones: wherever the tolerances let a flight be, it is inside the zone.

The edge of the zone is walked in short pieces. Where no piece lies at a distance and bearing that
the request allows, all allowed places are on one side of the edge, and one of them tells which.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from shapely.geometry import Point, shape

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, sent_to, stated

_PIECE_M = 0.25
_RAYS = 720

Place = tuple[float, float]


def zone(proof: Certificate, request: Request) -> list[Step]:
    """Wherever the tolerances let the flight be, it is inside the zone."""
    mission = request.one(proof.path)
    zones = [
        f
        for f in request.features('zones.geojson')
        if f['properties'].get('kind') == 'no_fly' and f['properties']['name'] == proof.word
    ]
    centre = request.landmarks().get((mission or {}).get('target') or '')
    if mission is None or centre is None or len(zones) != 1:
        return [(False, f'{proof.path} is at a landmark, and {proof.word!r} is a no-fly zone')]
    properties, area = zones[0]['properties'], shape(zones[0]['geometry'])
    altitude = mission['altitude_m']
    low, high = left_open(
        altitude,
        request.slack('altitude_m', altitude),
        request.limit('uav_altitude_min_m'),
        request.limit('uav_altitude_max_m'),
    )
    floor, ceiling = float(properties['floor_m']), float(properties['ceiling_m'])
    return [
        read_whole(request, mission),
        (
            floor <= low and high <= ceiling,
            f'{low:g} m to {high:g} m lie between {floor:g} m and {ceiling:g} m',
        ),
        _inside(request, mission, centre, area),
    ]


def roof(proof: Certificate, request: Request) -> list[Step]:
    """Wherever the tolerances let the hover be, it is inside a building or too near its wall."""
    parts = proof.path.split('/')
    mission = request.one('/'.join(parts[:2])) if parts[-1] == 'altitude_m' else None
    centre = request.landmarks().get((mission or {}).get('target') or '')
    found = [
        f for f in request.features('buildings.geojson') if f['properties']['id'] == proof.word
    ]
    if mission is None or centre is None or mission['mode'] != 'hover' or len(found) != 1:
        return [(False, f'{proof.path} is of a hover at a landmark, {proof.word!r} a building')]
    altitude, gap = mission['altitude_m'], request.limit('clearance_min_m')
    high = left_open(altitude, request.slack('altitude_m', altitude))[1]
    top = float(found[0]['properties']['height_m'])
    area = shape(found[0]['geometry'])
    if high <= top:
        area = area.buffer(gap)
    return [
        read_whole(request, mission),
        (proof.limit == gap, f'{proof.limit_name} is {gap:g}'),
        (
            stated(altitude) and proof.requested == altitude['value'],
            f'{proof.requested} m is the stated altitude',
        ),
        (high < top + gap, f'it flies at {high:g} m at most, the building has {top:g} m'),
        _inside(request, mission, centre, area),
    ]


def wall(proof: Certificate, request: Request) -> list[Step]:
    """A UAV that flies below a roof is to be nearer to the wall than the limit, all the time."""
    condition = request.one(proof.path.rpartition('/')[0])
    found = [
        f for f in request.features('buildings.geojson') if f['properties']['id'] == proof.word
    ]
    if condition is None or condition.get('quantity') != 'clearance' or len(found) != 1:
        return [(False, f'{proof.path} asks for a clearance, {proof.word!r} is a building')]
    uav, place = condition['of']
    properties, value = found[0]['properties'], condition['value']
    top, gap = float(properties['height_m']), request.limit('clearance_min_m')
    allowed = gap * (1.0 - float(request.tolerances['limit_margin']))
    partly = any(condition.get(name) is not None for name in ('fraction', 'hold_s', 'by_s'))
    ceiling = request.limit('uav_altitude_max_m')
    named = [
        m
        for m in request.all('missions')
        if m['uav'] == uav and any(f.path == f'missions/{m["id"]}/altitude_m' for f in proof.facts)
    ]
    highest = [
        left_open(m['altitude_m'], request.slack('altitude_m', m['altitude_m']), 0.0, ceiling)[1]
        for m in named
    ]
    return [
        *(read_whole(request, m) for m in named),
        (place == f'landmark:{properties.get("name")}', f'{place} is this building'),
        (proof.limit == gap, f'{proof.limit_name} is {gap:g}'),
        (stated(value) and proof.requested == value['value'], f'{proof.requested} m is stated'),
        (
            condition['op'] in ('<', '<=') and float(value['value']) < allowed and not partly,
            f'{condition["op"]} {value["value"]:g} m is always under {allowed:g} m',
        ),
        (not sent_to(request, uav), f'no event sends {uav} to another height'),
        (
            bool(highest) and all(h <= top for h in highest),
            f'it stays below {max(highest, default=math.inf):g} m, the roof is at {top:g} m',
        ),
    ]


def read_whole(request: Request, mission: dict[str, Any]) -> Step:
    span = mission.get('span') or {'start': 0, 'end': math.inf}
    lost = [
        c['text']
        for c in request.all('clauses')
        if c['status'] == 'not_encoded'
        and c['text'].lower() != 'and'
        and max(c['span']['start'], span['start']) < min(c['span']['end'], span['end'])
    ]
    return not lost, f'nothing that is said of the flight was left out {lost or ""}'.rstrip()


def _inside(request: Request, mission: dict[str, Any], centre: Place, area: Any) -> Step:
    if mission['mode'] == 'hover':
        near, far = how_far(request, mission)
        bearing, either = mission.get('bearing_deg'), 180.0
        if stated(bearing):
            either = float(request.tolerances['bearing_deg'])
        towards = float(bearing['value']) if stated(bearing) else 0.0
        text = f'all places {near:.1f} m to {far:.1f} m away, {towards:g} +- {either:g} degrees'
        crossed = any(
            lowest <= far and highest >= near and abs(_turn(angle - towards)) <= either + width
            for lowest, highest, angle, width in _edge(area, centre)
        )
        middle = _towards(centre, (near + far) / 2.0, towards)
        roof = request.roof(mission['target']) if _is_over(mission) else None
        covered = roof is None or bool(area.covers(roof))
        inside = not crossed and bool(area.contains(Point(middle)))
        return inside and covered, f'{text}, and over the roof, are in the zone'
    radius = mission.get('radius_m')
    if mission.get('pattern') != 'orbit' or not stated(radius):
        return False, 'the flight hovers or flies around the place at a stated radius'
    near, far = left_open(radius, request.slack('standoff_m', radius))
    text = f'a way round at {near:.1f} m to {far:.1f} m has to cross the zone'
    if not math.isfinite(far):
        return False, text
    return any(_is_barred(centre, near, far, 360.0 * k / _RAYS, area) for k in range(_RAYS)), text


def _is_over(mission: dict[str, Any]) -> bool:
    return mission.get('standoff_m') is None and mission.get('bearing_deg') is None


def farthest(request: Request, mission: dict[str, Any]) -> float:
    """Return how far from its landmark a hover may be: over a roof it may be at its far end."""
    far = how_far(request, mission)[1]
    roof = request.roof(mission['target']) if _is_over(mission) else None
    if roof is None:
        return far
    centre = Point(request.landmarks()[mission['target']])
    parts = getattr(roof, 'geoms', [roof])
    corners = [c for p in parts for c in p.exterior.coords]
    return max(far, *(float(centre.distance(Point(c))) for c in corners))


def how_far(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    """Return how near and far from the landmark a hover may be."""
    standoff, most = mission.get('standoff_m'), request.limit('uav_standoff_max_m')
    if stated(standoff):
        ceiling = max(most, float(standoff['value']))
        return left_open(standoff, request.slack('standoff_m', standoff), 0.0, ceiling)
    if _is_over(mission):
        allowed = ('pattern_centre_m', 'hover_drift_wind_m')
        return 0.0, sum(float(request.tolerances[name]) for name in allowed)
    return 0.0, most


def _edge(area: Any, centre: Place) -> Iterator[tuple[float, float, float, float]]:
    """Yield of every piece least and greatest distance, bearing, half width in bearing."""
    rings = [area.exterior, *area.interiors]
    sides = [side for ring in rings for side in pairwise(ring.coords)]
    for (ax, ay), (bx, by) in sides:
        length = math.hypot(bx - ax, by - ay)
        count = max(1, math.ceil(length / _PIECE_M))
        for k in range(count):
            ends = [
                (ax + s * (bx - ax) - centre[0], ay + s * (by - ay) - centre[1])
                for s in (k / count, (k + 1) / count)
            ]
            east, north = (sum(part) / 2.0 for part in zip(*ends, strict=True))
            away, half = math.hypot(east, north), length / count / 2.0
            width = math.degrees(math.asin(half / away)) if away > half else 180.0
            far = max(math.hypot(*end) for end in ends)
            yield _nearest(*ends), far, math.degrees(math.atan2(east, north)), width


def _nearest(a: Place, b: Place) -> float:
    """Return how near a straight piece comes to the origin."""
    east, north = b[0] - a[0], b[1] - a[1]
    square = east * east + north * north
    along = -(a[0] * east + a[1] * north) / square if square > 0.0 else 0.0
    along = min(1.0, max(0.0, along))
    return math.hypot(a[0] + along * east, a[1] + along * north)


def _is_barred(centre: Place, near: float, far: float, bearing: float, area: Any) -> bool:
    """Return whether the zone holds all of a ray from one distance to the other."""
    count = max(1, math.ceil((far - near) / _PIECE_M))
    steps = (near + (far - near) * k / count for k in range(count + 1))
    return all(area.intersects(Point(_towards(centre, step, bearing))) for step in steps)


def _towards(centre: Place, away: float, bearing: float) -> Place:
    compass = math.radians(bearing)
    return centre[0] + away * math.sin(compass), centre[1] + away * math.cos(compass)


def _turn(degrees: float) -> float:
    """Return an angle between -180 and 180 degrees."""
    return (degrees + 180.0) % 360.0 - 180.0
