# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by several buildings: they hide a landmark from a hover, or cut an orbit.

A hover: seen from the landmark, the bearings that it may have are parted where a building has a
corner or a wall is met at a right angle. Between two such bearings every wall comes nearer or goes
farther all the way, so its distances at both ends bound it.

An orbit: squares hold every place of its centre. Of each the ring that may be flown is looked at,
or how much of the circle that the points of the orbit lie on is too deep inside for any of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

from shapely.geometry import LineString, Point, Polygon, shape
from shapely.ops import linemerge, unary_union

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, stated
from aurora_core.recheck.zones import Place, how_far, read_whole

# A place is looked at 1 m above the ground; whoever looks at a place in a building looks at that.
_PLACE_M = 1.0
_ROUNDING_M = 1e-6
# A landmark so near to a building stands in it.
_BESIDE_M = 1.0
# A time off the altitude may begin before the sample that shows it.
_BETWEEN_S = 0.5
# Bearings are not parted any more when they are so near to each other.
_NARROW_DEG = 0.001
_WIDER_DEG = 0.5
# Squares are not parted any more from this half side on.
_LEAST_M = 0.7
_SIDE_M = 1.0
_CORNERS = 72
# The points of an orbit are no farther apart on its circle.
_STEP_DEG = 10.0
# Arcs are made of so many chords; that of one chord and more counts for nothing.
_CHORDS = 1440


def _near(request: Request, centre: Place, far: float) -> list[dict[str, Any]]:
    """Return the buildings of the map so near to a landmark, whichever the proof names."""
    features = request.features('buildings.geojson')
    return [f for f in features if shape(f['geometry']).distance(Point(centre)) <= far]


def _top(feature: dict[str, Any]) -> float:
    return float(feature['properties']['height_m'])


def _gap(request: Request) -> float:
    return request.limit('clearance_min_m') * (1.0 - float(request.tolerances['limit_margin']))


def _flight(
    proof: Certificate, request: Request
) -> tuple[dict[str, Any], Place, float, list[Step]] | None:
    """Return a mission at a landmark, the landmark, its greatest height, and what holds of it."""
    parts = proof.path.split('/')
    mission = request.one('/'.join(parts[:2])) if parts[-1] == 'altitude_m' else None
    centre = request.landmarks().get((mission or {}).get('target') or '')
    if mission is None or centre is None:
        return None
    altitude = mission['altitude_m']
    ceiling = request.limit('uav_altitude_max_m')
    high = left_open(altitude, request.slack('altitude_m', altitude), 0.0, ceiling)[1]
    told = stated(altitude) and proof.requested == altitude['value']
    actions = [e.get('action') or {} for e in request.all('events')]
    others = [a for a in actions if a.get('uav') == mission['uav']]
    alone = all(a.get('mission') == mission['id'] for a in others)
    return mission, centre, high, [
        read_whole(request, mission),
        (told, f'{proof.requested} m is the stated altitude'),
        (alone, f'no event ends {mission["id"]}, or sends {mission["uav"]} elsewhere'),
    ]  # fmt: skip


def hidden(proof: Certificate, request: Request) -> list[Step]:
    """From wherever a hover may be, buildings hide its landmark or are too near."""
    found = _flight(proof, request)
    if found is None or found[0]['mode'] != 'hover':
        return [(False, f'{proof.path} is of a hover at a landmark')]
    mission, centre, high, steps = found
    near, far = how_far(request, mission)
    # A distance that may not be missed is a circle: it is widened, so as to have a part to take.
    far /= math.cos(math.radians(_WIDER_DEG))
    gap, bearing = _gap(request), mission.get('bearing_deg')
    either = float(request.tolerances['bearing_deg']) if stated(bearing) else 180.0
    towards = float(bearing['value']) if stated(bearing) else 0.0
    shares = [float(request.tolerances[n]) for n in ('altitude_share', 'visible_fraction')]
    shares += [float(request.tolerances['relation_fraction'])] if stated(bearing) else []
    limit = request.limit('uav_altitude_max_m')
    walls = [_Wall(f, centre, high, gap) for f in _near(request, centre, far + gap)]
    return [
        *steps,
        (proof.limit == limit, f'{proof.limit_name} is {limit:g}'),
        (stated(mission.get('standoff_m')), 'how far from the landmark it hovers is stated'),
        (sum(shares) > len(shares) - 1, 'sight, height and bearing are asked at one time'),
        (
            all(_taken(walls, a, b, near, far) for a, b in _sectors(walls, towards, either)),
            f'buildings hide it or are too near wherever it is {near:.1f} m to {far:.1f} m away',
        ),
    ]


class _Wall:
    """A building as seen from a landmark, its corners relative to that."""

    def __init__(self, feature: dict[str, Any], eye: Place, high: float, gap: float) -> None:
        area, top = shape(feature['geometry']), _top(feature)
        own = Polygon(area.exterior).distance(Point(eye)) <= _ROUNDING_M
        self.times = None
        if not own and top > _PLACE_M:
            self.times = max(1.0, (high - _PLACE_M) / (top - _PLACE_M))
        self.walls = _relative(area, eye)
        self.too_near = _relative(area.buffer(gap, 4), eye) if high <= top else []

    def bearings(self) -> Iterator[float]:
        """Yield where a side begins, and where it is met at a right angle."""
        for a, b in (*self.walls, *self.too_near):
            yield math.degrees(math.atan2(a[0], a[1]))
            east, north = b[0] - a[0], b[1] - a[1]
            yield from (math.degrees(math.atan2(north * s, -east * s)) for s in (1.0, -1.0))

    def taken(self, first: float, last: float) -> Iterator[tuple[float, float]]:
        """Yield the distances that it takes from all bearings between two, from and to."""
        met = _met(self.walls, first, last)
        if met and self.times is not None:
            yield max(met[0]) * self.times, math.inf
        met = _met(self.too_near, first, last)
        if len(met) % 2:  # the landmark itself is too near
            yield 0.0, min(met[0])
            met = met[1:]
        for entered, left in zip(met[::2], met[1::2], strict=True):
            yield max(entered), min(left)


def _relative(area: Any, eye: Place) -> list[tuple[Place, Place]]:
    """Return the sides of a polygon, seen from a point."""
    rings = [[(x - eye[0], y - eye[1]) for x, y in ring.coords]
             for ring in (area.exterior, *area.interiors)]  # fmt: skip
    return [side for ring in rings for side in pairwise(ring)]


def _met(sides: list[tuple[Place, Place]], first: float, last: float) -> list[list[float]]:
    """Return the sides that rays between two bearings meet: how far away at both, in order."""
    ends, middle = [math.radians(first), math.radians(last)], math.radians((first + last) / 2.0)
    found = []
    for a, b in sides:
        if (between := _along(a, b, middle, 0.0)) is not None:
            away = [d for angle in ends if (d := _along(a, b, angle, 1e-6)) is not None]
            found.append((between, away if len(away) == len(ends) else [0.0, math.inf]))
    return [away for _, away in sorted(found)]


def _along(a: Place, b: Place, angle: float, beyond: float) -> float | None:
    """Return how far away a ray from the origin meets a side; None: it misses it.

    `beyond`: by so much of its length the side is longer at both ends.
    """
    east, north = math.sin(angle), math.cos(angle)
    dx, dy = b[0] - a[0], b[1] - a[1]
    across = east * dy - north * dx
    if abs(across) < 1e-12:
        return None
    away = (a[0] * dy - a[1] * dx) / across
    share = (a[0] * north - a[1] * east) / across
    return away if away >= 0.0 and -beyond <= share <= 1.0 + beyond else None


def _sectors(walls: list[_Wall], towards: float, either: float) -> Iterator[tuple[float, float]]:
    """Yield the bearings of the hover in parts, from one to the next (degrees)."""
    cuts = {-either, either}
    for wall in walls:
        for bearing in wall.bearings():
            turn = (bearing - towards + 180.0) % 360.0 - 180.0
            if abs(turn) < either:
                cuts.add(turn)
    for a, b in pairwise(sorted(cuts)):
        yield towards + a, towards + b


def _taken(walls: list[_Wall], first: float, last: float, near: float, far: float) -> bool:
    """Whether every distance is taken, all the way between two bearings."""
    if last - first < _NARROW_DEG / 10.0:
        return True
    reached = near
    for start, end in sorted(part for wall in walls for part in wall.taken(first, last)):
        if start > reached + _ROUNDING_M:
            break
        reached = max(reached, end)
        if reached >= far:
            return True
    if last - first <= _NARROW_DEG:
        return False
    middle = (first + last) / 2.0
    return all(_taken(walls, a, b, near, far) for a, b in ((first, middle), (middle, last)))


def cut_round(proof: Certificate, request: Request) -> list[Step]:
    """Wherever the centre of an orbit may be, buildings cut it, or take a point of it away."""
    found = _flight(proof, request)
    if found is None or found[0].get('pattern') != 'orbit' or found[0].get('start') is not None:
        return [(False, f'{proof.path} is of an orbit of a landmark')]
    mission, centre, high, steps = found
    if not stated(mission.get('radius_m')):
        return [(False, 'the radius of the orbit is stated')]
    limit = request.limit('clearance_min_m')
    middles = [centre, *_own_middles(request, mission['target'], centre)]
    step = _no_way(request, mission, high, middles)
    if not step[0]:
        other = _no_points(request, mission, high, middles)
        step = other if other[0] else step
    known = (proof.limit == limit, f'{proof.limit_name} is {limit:g}')
    return [*steps, known, _has_time(request, mission), step]


def _has_time(request: Request, mission: dict[str, Any]) -> Step:
    """What is flown in part, for want of time, may leave out what buildings cut."""
    words = 'its stated time, if any, has room for a lap'
    radius, time, speed = mission['radius_m'], mission.get('duration_s'), mission.get('speed_mps')
    if mission.get('turns') is not None or not stated(time) or time.get('bound') == 'at_least':
        return True, words
    slack = request.slack('route_speed_mps', speed) if stated(speed) else 0.0
    top = left_open(speed, slack, 0.0, request.limit('uav_speed_max_mps'))[1]
    gains = top / float(request.tolerances['route_acceleration_mps2'])
    return math.tau * float(radius['value']) / top + gains <= float(time['value']), words


def _no_way(request: Request, mission: dict[str, Any], high: float, middles: list[Place]) -> Step:
    """Buildings that it cannot rise above in its time leave no way round."""
    radius, time, turns = mission['radius_m'], mission.get('duration_s'), mission.get('turns')
    if not stated(time):
        return False, 'the duration of the orbit is stated'
    near, far = left_open(radius, request.slack('standoff_m', radius))
    if not math.isfinite(far):
        return False, 'the radius of the orbit has an upper bound'
    longest = request.limit('uav_endurance_s')
    longest = left_open(time, request.slack('duration_s', time), 0.0, longest)[1]
    margin = float(request.tolerances['limit_margin'])
    # It need not come down again before its phase ends.
    off = (1.0 - float(request.tolerances['altitude_share'])) * longest + _BETWEEN_S
    least_top = high + (1.0 + margin) * request.limit('uav_climb_max_mps') * off
    often = 1.0 if turns is None else left_open(turns, 0.0)[0]
    swept = min(360.0, 360.0 * often) - float(request.tolerances['orbit_deg'])
    shift = float(request.tolerances['pattern_centre_m'])
    reach = far + 2.0 * shift + request.limit('clearance_min_m')
    tall = [f for f in _near(request, middles[0], reach) if _top(f) >= least_top]
    solid = unary_union([shape(f['geometry']).buffer(_gap(request), 4) for f in tall])

    def cut(at: Place, corner: float) -> bool:
        if near - corner <= corner:
            return False
        seen = swept - 2.0 * math.degrees(math.asin(corner / (near - corner)))
        return all(turn < seen for turn in _turns(at, near - corner, far + corner, solid))

    return (
        swept > 0.0 and all(_cut_about(m, m, shift, shift, cut) for m in middles),
        f'buildings of {least_top:.1f} m and more leave no way {swept:g} degrees round, '
        f'{near:.1f} m to {far:.1f} m from any centre',
    )


def _no_points(
    request: Request, mission: dict[str, Any], high: float, middles: list[Place]
) -> Step:
    """Whichever points of its circle it has, one is where nobody can pass it at its altitude."""
    number, turns = mission['radius_m'], mission.get('turns')
    radius = float(number['value'])
    if number.get('bound', 'exactly') != 'exactly':
        return False, 'the radius of the orbit is stated as it is'
    if turns is not None and left_open(turns, 0.0)[0] < 1.0:
        return False, 'it goes the whole way round'
    gap, miss = _gap(request), float(request.tolerances['waypoint_horizontal_m'])
    shift = float(request.tolerances['pattern_centre_m'])
    reach = radius + miss + 2.0 * shift + gap
    walled = []
    for feature in _near(request, middles[0], reach):
        above = max(0.0, high - _top(feature))
        if above <= gap:
            walled.append(shape(feature['geometry']).buffer(math.sqrt(gap**2 - above**2), 4))
    solid = unary_union(walled)
    chord = math.tau * radius / _CHORDS

    def cut(at: Place, corner: float) -> bool:
        deep = solid.buffer(-1.001 * (miss + corner), 32)
        corners = [
            (at[0] + radius * math.cos(k * math.tau / _CHORDS),
             at[1] + radius * math.sin(k * math.tau / _CHORDS))
            for k in range(_CHORDS + 1)
        ]  # fmt: skip
        arcs = LineString(corners).intersection(deep)
        joined = linemerge(arcs) if arcs.geom_type == 'MultiLineString' else arcs
        longest = max((a.length for a in getattr(joined, 'geoms', [joined])), default=0.0)
        return bool(longest - 2.0 * chord > radius * math.radians(_STEP_DEG))

    return (
        all(_cut_about(m, m, shift, shift, cut) for m in middles),
        f'buildings take more than {_STEP_DEG:g} degrees of the circle of {radius:g} m about any '
        f'centre, {high:.1f} m high',
    )


def _own_middles(request: Request, target: str, centre: Place) -> list[Place]:
    """Return the middles of the buildings that a landmark stands in, or that have its name."""
    found = []
    for feature in request.features('buildings.geojson'):
        outline = Polygon(shape(feature['geometry']).exterior)
        named = target == f'landmark:{feature["properties"].get("name")}'
        if named or outline.distance(Point(centre)) <= _BESIDE_M:
            found.append((outline.centroid.x, outline.centroid.y))
    return found


def _cut_about(
    middle: Place, at: Place, half: float, off: float, cut: Callable[[Place, float], bool]
) -> bool:
    """Whether an orbit is cut about every centre in a square.

    Args:
        middle: Of the disc that holds all centres.
        at: Of the square.
        half: Half a side of it.
        off: Radius of the disc.
        cut: Whether it is about every centre so near to a place.
    """
    corner = math.hypot(half, half)
    if math.dist(middle, at) - corner > off or cut(at, corner):
        return True
    if half <= _LEAST_M:
        return False
    quarter = half / 2.0
    return all(
        _cut_about(middle, (at[0] + i, at[1] + j), quarter, off, cut)
        for i in (-quarter, quarter)
        for j in (-quarter, quarter)
    )


def _turns(at: Place, near: float, far: float, solid: Any) -> Iterator[float]:
    """Yield how many degrees of a ring each piece fills that nothing solid takes."""
    width = math.tau / _CORNERS
    beyond = far / math.cos(width / 2.0)
    rings = [
        [(at[0] + r * math.cos(k * width), at[1] + r * math.sin(k * width))
         for k in range(_CORNERS)]
        for r in (beyond, near)
    ]  # fmt: skip
    left = Polygon(rings[0], [rings[1]]).difference(solid)
    for piece in getattr(left, 'geoms', [left]):
        corners = [
            spot
            for ring in (piece.exterior, *piece.interiors)
            for spot in LineString(ring.coords).segmentize(_SIDE_M).coords
        ] if not piece.is_empty else []  # fmt: skip
        bearings = sorted(math.degrees(math.atan2(y - at[1], x - at[0])) for x, y in corners)
        if bearings:
            gaps = [b - a for a, b in pairwise([*bearings, bearings[0] + 360.0])]
            yield 360.0 - max(gaps)
