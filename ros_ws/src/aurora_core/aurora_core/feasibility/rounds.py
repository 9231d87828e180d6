# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse orbits of a landmark that buildings cut, wherever the tolerances let them be flown.

The centre may be missed, and so may radius and altitude. Squares hold all places of the centre; of
each, the ring that holds every way round all its points is cut by the buildings that are too tall
to be passed over. Where no piece of the ring that is left goes far enough round, the square is
done; else it is quartered. So this is an exhaustion over intervals, not over samples.

A UAV may leave its altitude for a share of its phase. Buildings that it could rise above in that
time are not counted, so nothing is proven of an orbit that may last for any time.
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
from aurora_core.feasibility.zones import is_half_read, is_redirected, roof_of
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_types import Building, Landmark
from aurora_core.outcomes.feasibility import Certificate, Rule
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

_Place = tuple[float, float]


def check_rounds(
    spec: ScenarioSpec,
    buildings: Sequence[Building],
    landmarks: Sequence[Landmark],
    limits: Limits,
    tolerances: Tolerances,
) -> Iterator[Certificate]:
    """Return orbits of a stated radius, altitude and duration that buildings cut.

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
        if not all(map(is_stated, (mission.radius_m, mission.altitude_m, mission.duration_s))):
            continue
        if is_half_read(spec, mission) or is_redirected(spec, mission):
            continue
        ring, high_m = _ring(mission, limits, tolerances)
        if not math.isfinite(ring.far_m):
            continue
        over_m = _over_m(mission, high_m, limits, tolerances)
        around = tuple(b for b in buildings if b.height_m >= over_m and ring.reaches(b, mark))
        if cutting := _cutting(ring, _centres(mark, buildings), around, mark):
            yield _proof(mission, mark, ring, high_m, cutting, limits, tolerances)


@dataclass(frozen=True, kw_only=True)
class _Ring:
    """What the tolerances leave of one orbit.

    Attributes:
        near_m: Least distance from its centre.
        far_m: Greatest one.
        sweep_deg: So far round it goes at least.
        off_m: So far from its landmark its centre may be.
        gap_m: That is kept from walls.
    """

    near_m: float
    far_m: float
    sweep_deg: float
    off_m: float
    gap_m: float

    def reaches(self, building: Building, mark: Landmark) -> bool:
        """Tell whether a building may be in the way."""
        return away_m(building, mark) <= self.far_m + 2.0 * self.off_m + self.gap_m


def _ring(mission: UavMission, limits: Limits, tolerances: Tolerances) -> tuple[_Ring, float]:
    """Return where an orbit may be flown, and its greatest altitude but for a while."""
    radius, altitude, turns = mission.radius_m, mission.altitude_m, mission.turns
    assert radius is not None
    slack_m = tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
    rise_m = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
    round_deg = _TURN_DEG if turns is None else _TURN_DEG * least(turns, 0.0, 0.0)
    ring = _Ring(
        near_m=least(radius, slack_m, 0.0),
        far_m=most(radius, slack_m, math.inf),
        sweep_deg=min(_TURN_DEG, round_deg) - tolerances.orbit_deg,
        off_m=tolerances.pattern_centre_m,
        gap_m=limits.clearance_min_m * (1.0 - tolerances.limit_margin),
    )
    return ring, most(altitude, rise_m, limits.uav_altitude_max_m)


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
    ring: _Ring,
    high_m: float,
    cutting: Sequence[Building],
    limits: Limits,
    tolerances: Tolerances,
) -> Certificate:
    base, gap = f'missions/{mission.id}', limits.clearance_min_m
    names = ', '.join(f'{b.name or b.id} ({b.height_m:g} m)' for b in cutting)
    return beyond(
        Rule.ROUND,
        'clearance',
        mission.altitude_m,
        f'{base}/altitude_m',
        ('clearance_min_m', gap),
        f'{mission.uav} would go round {mark.name} {ring.near_m:g} m to {ring.far_m:g} m from '
        f'its centre and {high_m:g} m high at most; {names} leave no way round from '
        f'which {gap:g} m are kept.',
        (
            *says(f'{base}/target', mission.target),
            *says(f'{base}/altitude_m', mission.altitude_m),
            *says(f'{base}/radius_m', mission.radius_m),
            *says(f'{base}/turns', mission.turns),
            *says(f'{base}/duration_s', mission.duration_s),
            *(map_fact(f'{b.id}/height_m', b.height_m) for b in cutting),
            *limit_facts(limits, 'clearance_min_m', 'uav_climb_max_mps'),
            *tolerance_facts(
                tolerances,
                'altitude_m',
                'altitude_share',
                'duration_s',
                'limit_margin',
                'orbit_deg',
                'pattern_centre_m',
                'standoff_m',
            ),
        ),
    )


@lru_cache(maxsize=64)
def _cutting(
    ring: _Ring, centres: tuple[_Place, ...], around: tuple[Building, ...], mark: Landmark
) -> tuple[Building, ...]:
    """Return few buildings that cut the orbit about every centre; none where it may be.

    Kept: the same few are asked about again for every altitude that could be asked for instead.
    """
    solid = _solid(ring, around)
    # Where the very centre leaves a way, no square needs to be looked at.
    if ring.sweep_deg <= 0.0 or not all(_is_cut(ring, c, 0.0, solid) for c in centres):
        return ()
    kept = list(around)
    # Those farthest away are the least needed. Where the centre may be farthest off tells most.
    tried = [c for centre in centres for c in (centre, *_ends(centre, ring.off_m))]
    for building in sorted(around, key=lambda b: -away_m(b, mark)):
        rest = [b for b in kept if b is not building]
        if rest and all(_is_cut(ring, c, 0.0, _solid(ring, rest)) for c in tried):
            kept = rest
    sets = (kept, around) if len(kept) < len(around) else (kept,)
    for few in sets:
        solid = _solid(ring, few)
        if all(_square(ring, c, c, ring.off_m, solid) for c in centres):
            return tuple(few)
    return ()


def _solid(ring: _Ring, around: Sequence[Building]) -> shapely.Geometry:
    """Return where a UAV is inside one of the buildings, or too near to its wall."""
    return shapely.union_all(
        [shapely.Polygon(b.ring, b.holes).buffer(ring.gap_m, quad_segs=4) for b in around]
    )


def _square(
    ring: _Ring, centre: _Place, at: _Place, half_m: float, solid: shapely.Geometry
) -> bool:
    """Tell whether the orbit is cut about every centre in a square.

    Args:
        ring: What is left of the orbit.
        centre: Of the disc in which the centre of the orbit may be.
        at: Middle of the square.
        half_m: Half its side.
        solid: Where no UAV may be.
    """
    corner_m = half_m * math.sqrt(2.0)
    if math.dist(centre, at) - corner_m > ring.off_m or _is_cut(ring, at, corner_m, solid):
        return True
    if half_m <= _SMALLEST_M:
        return False
    half_m /= 2.0
    quarters = [(at[0] + i * half_m, at[1] + j * half_m) for i in (-1, 1) for j in (-1, 1)]
    return all(_square(ring, centre, quarter, half_m, solid) for quarter in quarters)


def _is_cut(ring: _Ring, at: _Place, off_m: float, solid: shapely.Geometry) -> bool:
    """Tell whether no way round a point, or round one so near to it, is left."""
    near_m, far_m = ring.near_m - off_m, ring.far_m + off_m
    if near_m <= off_m:
        return False
    # Seen from the point itself, such a way goes a little less far round.
    sweep_deg = ring.sweep_deg - 2.0 * math.degrees(math.asin(off_m / near_m))
    left = shapely.difference(_ring_around(at, near_m, far_m), solid)
    pieces = shapely.get_parts(shapely.segmentize(left, _PIECE_M))
    return all(_seen_deg(piece, at) < sweep_deg for piece in pieces if not piece.is_empty)


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
    own = [b for b in buildings if b.name == mark.name or roof_of(mark, (b,)) is not None]
    return tuple(dict.fromkeys([(mark.x_m, mark.y_m), *(b.centre for b in own)]))
