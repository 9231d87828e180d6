# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by where things are placed: twice beside each other, or inside a no-fly zone."""

from __future__ import annotations

from typing import Any

from shapely.geometry import Point, shape

from aurora_cli.recheck.finding import Step
from aurora_cli.recheck.request import Request, left_open, stated
from aurora_core.feasibility.verdict import Certificate

# Relation -> axis, and where on it the placed one is, seen from the other one.
_WHERE = {
    'ahead': ('length', 1),
    'behind': ('length', -1),
    'left': ('width', 1),
    'right': ('width', -1),
}


def placement(proof: Certificate, request: Request) -> list[Step]:
    """Another placement of the same two is on the other side, or at another distance."""
    parts = proof.path.split('/')
    is_one = len(parts) == 4 and (parts[0], parts[2]) == ('agents', 'placements')
    one = request.one(proof.path) if is_one else None
    if one is None or one.get('relation') not in _WHERE:
        return [(False, f'{proof.path} places an agent on a side')]
    others = [
        (agent['id'], p)
        for agent in request.all('agents')
        for p in agent.get('placements', ())
        if p is not one and p.get('relation') in _WHERE
    ]
    against = any(_exclude(request, (parts[1], one), other) for other in others)
    return [(against, f'another placement of {parts[1]} and {one.get("of")} excludes this one')]


def _exclude(
    request: Request, one: tuple[str, dict[str, Any]], other: tuple[str, dict[str, Any]]
) -> bool:
    (name, a), (second, b) = one, other
    if (axis := _WHERE[a['relation']])[0] != _WHERE[b['relation']][0]:
        return False
    sign, other_sign = axis[1], _WHERE[b['relation']][1]
    if (second, b.get('of')) == (a.get('of'), name):
        other_sign = -other_sign
    elif (second, b.get('of')) != (name, a.get('of')):
        return False
    if sign != other_sign:
        return True
    far, away = a.get('distance_m'), b.get('distance_m')
    if not (stated(far) and stated(away)):
        return False
    if any(number.get('bound', 'exactly') != 'exactly' for number in (far, away)):
        return False
    low, high = left_open(far, request.slack('placement_other_m', far))
    least, most = left_open(away, request.slack('placement_other_m', away))
    return low > most or least > high


def zone(proof: Certificate, request: Request) -> list[Step]:
    """Wherever the tolerances let the flight be, it is inside the zone."""
    mission = request.one(proof.path)
    marks = {
        f'landmark:{f["properties"]["name"]}': Point(f['geometry']['coordinates'])
        for f in request.features('landmarks.geojson')
    }
    zones = [
        f
        for f in request.features('zones.geojson')
        if f['properties'].get('kind') == 'no_fly' and f['properties']['name'] == proof.word
    ]
    centre = marks.get((mission or {}).get('target') or '')
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
    inside, how = _inside(request, mission, centre, area)
    return [
        (
            floor <= low and high <= ceiling,
            f'{low:g} m to {high:g} m lie between {floor:g} m and {ceiling:g} m',
        ),
        (inside, how),
    ]


def _inside(
    request: Request, mission: dict[str, Any], centre: Point, area: Any
) -> tuple[bool, str]:
    edge = float(centre.distance(area.boundary))
    if mission['mode'] == 'hover':
        drift = float(request.tolerances['hover_drift_calm_m'])
        deep = area.covers(centre) and edge >= drift
        return deep, f'the place is {edge:.1f} m inside the edge, the drift {drift:g} m'
    radius = mission.get('radius_m')
    if mission.get('pattern') != 'orbit' or not stated(radius):
        return False, 'the flight hovers or flies around the place at a stated radius'
    core = area.buffer(-request.slack('standoff_m', radius))
    value = float(radius['value'])
    # A circle meets a connected area when its radius lies between the nearest and farthest point.
    reaches = [
        (centre.distance(part), max(centre.distance(Point(c)) for c in part.exterior.coords))
        for part in getattr(core, 'geoms', [core])
        if not part.is_empty
    ]
    shown = ', '.join(f'{near:.1f} m to {far:.1f} m' for near, far in reaches)
    meets = any(near <= value <= far for near, far in reaches)
    return meets, f'the circle of {value:g} m meets the zone, which is {shown or "too small"} away'
