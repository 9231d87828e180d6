# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse orbits of a landmark that buildings cut, wherever the tolerances let them be flown.

The centre may be missed, and so may radius and altitude. Squares hold all places of the centre; of
each, the ring that holds every way round all its points is cut by the buildings that are too tall
to be passed over. Where no piece of the ring that is left goes far enough round, the square is
done; else it is quartered. So this is an exhaustion over intervals, not over samples.

A UAV may leave its altitude for a share of its phase. Buildings that it could rise above in that
time are not counted, so that nothing is proven so of an orbit that may last for any time.

However long it lasts, the points of an orbit lie on its circle, none farther from the next one
than a step, and it passes each of them at its altitude. Where buildings fill more than a step of
the circle about every centre, it misses one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, map_fact, says, tolerance_facts
from aurora_core.feasibility.zones import BESIDE_M, is_half_read, is_redirected, roof_of
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Building, Landmark
from aurora_core.mission.orbits import part_of_lap_deg
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.quantities.waypoints import ORBIT_STEP_DEG
from aurora_core.spec.parameter import Bound
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import Pattern

_TURN_DEG = 360.0
# Squares are quartered down to this half side.
_SMALLEST_M = 0.7
# In so many directions the centre is moved, to choose which buildings are told of.
_LOOKED = 8
# Between the corners of a ring (degrees).
_CORNER_DEG = 5.0
# Sides of what is left of a ring are looked at in pieces of this length.
_PIECE_M = 1.0
# What happens between two samples adds to the time off the altitude.
_BETWEEN_S = 0.5
# So often a circle is looked at.
_SAMPLES = 1440

_Place = tuple[float, float]


def check_rounds(
    spec: ScenarioSpec,
    buildings: Sequence[Building],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
) -> Iterator[Certificate]:
    """Return orbits of a stated radius and altitude that buildings cut.

    Args:
        spec: The request.
        buildings: Of its map.
        landmarks: Of its map.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
    """
    known = {f'{LANDMARK}{mark.name}': mark for mark in landmarks}
    for mission in spec.missions:
        mark = known.get(mission.target or '')
        if mark is None or mission.start is not None or mission.pattern is not Pattern.ORBIT:
            continue
        if not (is_stated(mission.radius_m) and is_stated(mission.altitude_m)):
            continue
        if is_half_read(spec, mission) or is_redirected(spec, mission):
            continue
        radius_m = 0.0 if mission.radius_m is None else mission.radius_m.value
        if part_of_lap_deg(mission, radius_m, limits, tolerances) is not None:
            continue  # it may pass what stands on the rest of its circle
        for way, least_m in _ways(mission, limits, tolerances):
            around = tuple(b for b in buildings if b.height_m >= least_m and way.reaches(b, mark))
            if cutting := _cutting(way, _centres(mark, buildings), around, mark):
                yield _proof(mission, mark, way, cutting, limits, tolerances)
                break


def _ways(
    mission: UavMission, limits: Limits, tolerances: Tolerances
) -> Iterator[tuple[_Ring | _Circle, float]]:
    """Yield what an orbit has to keep to, and how high the buildings are that count for it."""
    radius, altitude, turns = mission.radius_m, mission.altitude_m, mission.turns
    assert radius is not None
    rise_m = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
    high_m = most(altitude, rise_m, limits.uav_altitude_max_m)
    ring = _ring(mission, high_m, limits, tolerances)
    if is_stated(mission.duration_s) and math.isfinite(ring.far_m):
        yield ring, _over_m(mission, high_m, limits, tolerances)
    if radius.bound is Bound.EXACTLY and (turns is None or least(turns, 0.0, 0.0) >= 1.0):
        circle = _Circle(
            radius_m=radius.value,
            high_m=high_m,
            off_m=tolerances.pattern_centre_m,
            gap_m=ring.gap_m,
            pass_m=tolerances.waypoint_horizontal_m,
        )
        yield circle, high_m - ring.gap_m


@dataclass(frozen=True, kw_only=True)
class _Ring:
    """What the tolerances leave of one orbit.

    Attributes:
        near_m: Least distance from its centre.
        far_m: Greatest one.
        high_m: Greatest altitude but for a while.
        sweep_deg: So far round it goes at least.
        off_m: So far from its landmark its centre may be.
        gap_m: That is kept from walls.
    """

    near_m: float
    far_m: float
    high_m: float
    sweep_deg: float
    off_m: float
    gap_m: float

    def reaches(self, building: Building, mark: Landmark) -> bool:
        """Tell whether a building may be in the way."""
        return away_m(building, mark) <= self.far_m + 2.0 * self.off_m + self.gap_m

    def solid(self, around: Sequence[Building]) -> shapely.Geometry:
        """Return where a UAV is inside one of the buildings, or too near to its wall."""
        return shapely.union_all([_walled(b, self.gap_m) for b in around])

    def is_cut(self, at: _Place, off_m: float, solid: shapely.Geometry) -> bool:
        """Tell whether no way round a point, or round one so near to it, is left."""
        near_m, far_m = self.near_m - off_m, self.far_m + off_m
        if self.sweep_deg <= 0.0 or near_m <= off_m:
            return False
        # Seen from the point itself, such a way goes a little less far round.
        sweep_deg = self.sweep_deg - 2.0 * math.degrees(math.asin(off_m / near_m))
        left = shapely.difference(_ring_around(at, near_m, far_m), solid)
        pieces = shapely.get_parts(shapely.segmentize(left, _PIECE_M))
        return all(_seen_deg(piece, at) < sweep_deg for piece in pieces if not piece.is_empty)

    def told(self) -> str:
        """Return where it is flown, in words."""
        return f'{self.near_m:g} m to {self.far_m:g} m from its centre'


@dataclass(frozen=True, kw_only=True)
class _Circle:
    """On which the points of one orbit lie.

    Attributes:
        radius_m: Stated.
        high_m: Greatest altitude at which a point is passed.
        off_m: So far from its landmark its centre may be.
        gap_m: That is kept from walls.
        pass_m: So far from a point it may be passed.
    """

    radius_m: float
    high_m: float
    off_m: float
    gap_m: float
    pass_m: float

    def reaches(self, building: Building, mark: Landmark) -> bool:
        """Tell whether a building may be in the way."""
        return (
            away_m(building, mark) <= self.radius_m + self.pass_m + 2.0 * self.off_m + self.gap_m
        )

    def solid(self, around: Sequence[Building]) -> shapely.Geometry:
        """Return where a UAV is inside one of the buildings, or too near to it."""
        # Just above a roof one has to be less far away to the side.
        rises = (max(0.0, self.high_m - b.height_m) for b in around)
        gaps = (math.sqrt(max(0.0, self.gap_m * self.gap_m - r * r)) for r in rises)
        solid = shapely.union_all([_walled(b, gap) for b, gap in zip(around, gaps, strict=True)])
        shapely.prepare(solid)
        return solid

    def is_cut(self, at: _Place, off_m: float, solid: shapely.Geometry) -> bool:
        """Tell whether more than a step of it has no point that can be passed.

        About a point, and about every one so near to it.
        """
        angles = np.radians(np.arange(0.0, _TURN_DEG, _TURN_DEG / _SAMPLES))
        x, y = at[0] + self.radius_m * np.cos(angles), at[1] + self.radius_m * np.sin(angles)
        # Between two samples it is as deep but for half the arc.
        deep_m = self.pass_m + off_m + self.radius_m * math.pi / _SAMPLES
        inside = shapely.contains_xy(solid, x, y)
        points = shapely.points(x[inside], y[inside])
        inside[inside] = shapely.distance(solid.boundary, points) > deep_m
        # Between two that are not, all round: the circle is looked at twice over.
        free = np.flatnonzero(~np.tile(inside, 2))
        longest = _SAMPLES if len(free) == 0 else int(np.max(np.diff(free))) - 1
        return longest * _TURN_DEG / _SAMPLES > ORBIT_STEP_DEG

    def told(self) -> str:
        """Return where it is flown, in words."""
        return f'through points {self.radius_m:g} m from its centre'


def _walled(building: Building, gap_m: float) -> shapely.Geometry:
    return shapely.Polygon(building.ring, building.holes).buffer(gap_m, quad_segs=4)


def _ring(mission: UavMission, high_m: float, limits: Limits, tolerances: Tolerances) -> _Ring:
    """Return where an orbit may be flown."""
    radius, turns = mission.radius_m, mission.turns
    assert radius is not None
    slack_m = tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
    round_deg = _TURN_DEG if turns is None else _TURN_DEG * least(turns, 0.0, 0.0)
    return _Ring(
        near_m=least(radius, slack_m, 0.0),
        far_m=most(radius, slack_m, math.inf),
        high_m=high_m,
        sweep_deg=min(_TURN_DEG, round_deg) - tolerances.orbit_deg,
        off_m=tolerances.pattern_centre_m,
        gap_m=limits.clearance_min_m * (1.0 - tolerances.limit_margin),
    )


def _over_m(mission: UavMission, high_m: float, limits: Limits, tolerances: Tolerances) -> float:
    """Return how high a building is that is not risen above in the time off the altitude."""
    time = mission.duration_s
    assert time is not None
    slack_s = tolerances.duration_s.of(time.value, approximate=time.approximate)
    off_s = (1.0 - tolerances.altitude_share) * most(time, slack_s, limits.uav_endurance_s)
    climb_mps = (1.0 + tolerances.limit_margin) * limits.uav_climb_max_mps
    # It need not come down again before its phase ends.
    return high_m + climb_mps * (off_s + _BETWEEN_S)


def _proof(
    mission: UavMission,
    mark: Landmark,
    way: _Ring | _Circle,
    cutting: Sequence[Building],
    limits: Limits,
    tolerances: Tolerances,
) -> Certificate:
    base, gap = f'missions/{mission.id}', limits.clearance_min_m
    names = ', '.join(f'{b.name or b.id} ({b.height_m:g} m)' for b in cutting)
    leave = 'leaves' if len(cutting) == 1 else 'leave'
    return beyond(
        Rule.ROUND,
        'clearance',
        mission.altitude_m,
        f'{base}/altitude_m',
        ('clearance_min_m', gap),
        f'{mission.uav} would go round {mark.name} {way.told()} and {way.high_m:g} m high at '
        f'most; {names} {leave} no way round from which {gap:g} m are kept.',
        (
            *says(f'{base}/target', mission.target),
            *says(f'{base}/altitude_m', mission.altitude_m),
            *says(f'{base}/radius_m', mission.radius_m),
            *says(f'{base}/turns', mission.turns),
            *(map_fact(f'{b.id}/height_m', b.height_m) for b in cutting),
            *_facts_of(way, mission, limits, tolerances),
        ),
    )


def _facts_of(
    way: _Ring | _Circle, mission: UavMission, limits: Limits, tolerances: Tolerances
) -> tuple[Fact, ...]:
    common = ('altitude_m', 'limit_margin', 'pattern_centre_m')
    if isinstance(way, _Circle):
        return (
            *limit_facts(limits, 'clearance_min_m'),
            *tolerance_facts(tolerances, *common, 'waypoint_horizontal_m'),
        )
    return (
        *says(f'missions/{mission.id}/duration_s', mission.duration_s),
        *limit_facts(limits, 'clearance_min_m', 'uav_climb_max_mps'),
        *tolerance_facts(
            tolerances, *common, 'altitude_share', 'duration_s', 'orbit_deg', 'standoff_m'
        ),
    )


@lru_cache(maxsize=64)
def _cutting(
    way: _Ring | _Circle,
    centres: tuple[_Place, ...],
    around: tuple[Building, ...],
    mark: Landmark,
) -> tuple[Building, ...]:
    """Return few buildings that cut the orbit about every centre; none where it may be.

    Kept: the same few are asked about again for every altitude that could be asked for instead.
    """
    # Where the very centre leaves a way, no square needs to be looked at.
    solid = way.solid(around)
    if not around or not all(way.is_cut(c, 0.0, solid) for c in centres):
        return ()
    kept = list(around)
    # Those farthest away are the least needed. Where the centre may be farthest off tells most.
    tried = [c for centre in centres for c in (centre, *_ends(centre, way.off_m))]
    for building in sorted(around, key=lambda b: -away_m(b, mark)):
        rest = [b for b in kept if b is not building]
        if rest:
            solid = way.solid(rest)
            kept = rest if all(way.is_cut(c, 0.0, solid) for c in tried) else kept
    sets = (kept, around) if len(kept) < len(around) else (kept,)
    for few in sets:
        solid = way.solid(few)
        if all(_square(way, c, c, way.off_m, solid) for c in centres):
            return tuple(few)
    return ()


def _square(
    way: _Ring | _Circle, centre: _Place, at: _Place, half_m: float, solid: shapely.Geometry
) -> bool:
    """Tell whether the orbit is cut about every centre in a square.

    Args:
        way: What it has to keep to.
        centre: Of the disc in which the centre of the orbit may be.
        at: Middle of the square.
        half_m: Half its side.
        solid: Where no UAV may be.
    """
    corner_m = half_m * math.sqrt(2.0)
    if math.dist(centre, at) - corner_m > way.off_m or way.is_cut(at, corner_m, solid):
        return True
    if half_m <= _SMALLEST_M:
        return False
    half_m /= 2.0
    quarters = [(at[0] + i * half_m, at[1] + j * half_m) for i in (-1, 1) for j in (-1, 1)]
    return all(_square(way, centre, quarter, half_m, solid) for quarter in quarters)


def _ends(at: _Place, far_m: float) -> Iterator[_Place]:
    """Yield points that are so far from a point, all round."""
    for k in range(_LOOKED):
        angle = 2.0 * math.pi * k / _LOOKED
        yield at[0] + far_m * math.cos(angle), at[1] + far_m * math.sin(angle)


def _ring_around(at: _Place, near_m: float, far_m: float) -> shapely.Geometry:
    """Return a polygon that holds all points between two distances."""
    angles = np.radians(np.arange(0.0, _TURN_DEG, _CORNER_DEG))
    circle = np.column_stack((np.cos(angles), np.sin(angles)))
    # Corners of the outer circle lie beyond it, so that its sides touch it.
    beyond_m = far_m / math.cos(math.radians(_CORNER_DEG / 2.0))
    return shapely.Polygon(circle * beyond_m + at, [circle * near_m + at])


def _seen_deg(piece: shapely.Geometry, at: _Place) -> float:
    """Return the angle that a piece of a ring fills, seen from the middle of the ring."""
    away = shapely.get_coordinates(piece) - np.array(at)
    bearings = np.sort(np.degrees(np.arctan2(away[:, 1], away[:, 0])))
    gaps = np.diff(np.append(bearings, bearings[0] + _TURN_DEG))
    return _TURN_DEG - float(gaps.max())


def away_m(building: Building, mark: Landmark) -> float:
    """Return how far the box around a building is from a landmark, metres."""
    west, south, east, north = building.box_m
    aside = max(west - mark.x_m, mark.x_m - east, 0.0)
    ahead = max(south - mark.y_m, mark.y_m - north, 0.0)
    return math.hypot(aside, ahead)


def _centres(mark: Landmark, buildings: Sequence[Building]) -> tuple[_Place, ...]:
    """Return what may be gone round when a landmark is: where it is, and its building's middle."""
    own = [
        b
        for b in buildings
        if b.name == mark.name
        or (b.has_in_box(mark.x_m, mark.y_m, BESIDE_M) and roof_of(mark, (b,)) is not None)
    ]
    return tuple(dict.fromkeys([(mark.x_m, mark.y_m), *(b.centre for b in own)]))
