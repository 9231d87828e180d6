# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds on the times of flights: climb, missions in their order, landing, battery."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import pairwise

from aurora_core.geometry.kernel import norm2
from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.spec.flight_order import begun_by, stays_where_it_is
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode, Pattern
from aurora_core.temporal.links import START, Basis, Link, Spot


def captured(mission: str) -> str:
    """Return the point at which a mission begins: its tolerance is met for the first time."""
    return f'missions/{mission}/captured'


def over(mission: str) -> str:
    """Return the point at which the phase after a mission is commanded."""
    return f'missions/{mission}/over'


def flown_by(basis: Basis, uav: str) -> list[UavMission]:
    """Return the missions of a UAV in their order."""
    return [m for m in basis.spec.missions if m.uav == uav]


def home_point(last: UavMission) -> str:
    """Return what a flight with this last mission has to come to: its landing, if it lands."""
    return over(last.id) if last.ends_in_flight else f'uavs/{last.uav}/landed'


def flight_links(basis: Basis) -> Iterator[Link]:
    """Yield the bounds on the flights of all UAVs."""
    for uav in basis.spec.uavs:
        flown = flown_by(basis, uav.id)
        yield Link(
            earlier=START,
            later=f'uavs/{uav.id}/takeoff',
            least_s=0.0,
            kind=BoundKind.START,
            of=f'uavs/{uav.id}',
            words=f'{uav.id} stands on the ground at the start',
        )
        if flown:
            yield from _flight(basis, uav.id, flown)


def battery_links(basis: Basis) -> Iterator[Link]:
    """Yield how long each UAV may be in the air."""
    most_s = basis.limits.uav_endurance_s
    for uav in basis.spec.uavs:
        flown = flown_by(basis, uav.id)
        if flown:
            yield Link(
                earlier=f'uavs/{uav.id}/takeoff',
                later=home_point(flown[-1]),
                most_s=most_s,
                kind=BoundKind.BATTERY,
                of=f'uavs/{uav.id}',
                words=f'the battery of {uav.id} lasts {most_s:g} s',
                limits=('uav_endurance_s',),
            )
    yield from _charge_links(basis)


def _charge_links(basis: Basis) -> Iterator[Link]:
    """Yield how long a UAV may be in the air that is to keep a share of its battery throughout.

    It is full at take-off and empty after the endurance, linear in between.
    """
    for condition in basis.spec.conditions:
        kept, op = condition.value, condition.op
        asked = condition.quantity == QuantityName.BATTERY and op in ('>', '>=')
        partly = (condition.fraction, condition.hold_s, condition.by_s) != (None, None, None)
        if not asked or partly or not is_stated(kept) or len(condition.of) != 1:
            continue
        flown = flown_by(basis, condition.of[0])
        if flown:
            of = f'conditions/{condition.id}'
            most_s = max(0.0, 1.0 - kept.value) * basis.limits.uav_endurance_s
            yield Link(
                earlier=f'uavs/{condition.of[0]}/takeoff',
                later=home_point(flown[-1]),
                most_s=most_s,
                kind=BoundKind.BATTERY,
                of=of,
                words=f'the battery of {condition.of[0]} is down to {kept.value:g} after '
                f'{most_s:g} s',
                stated=((f'{of}/op', op), (f'{of}/value', kept)),
                limits=('uav_endurance_s',),
            )


def _flight(basis: Basis, uav: str, flown: list[UavMission]) -> Iterator[Link]:
    # Whom an event gives something else to do may leave out the rest of what it was at.
    whole = uav not in basis.redirected
    yield _climb(basis, flown[0], whole=whole)
    before = f'uavs/{uav}/up'
    for mission in flown:
        of = f'missions/{mission.id}'
        yield Link(
            earlier=before,
            later=captured(mission.id),
            least_s=0.0,
            kind=BoundKind.SEQUENCE,
            of=of,
            words=f'{mission.id} is the next that {uav} does',
        )
        event = begun_by(basis.spec, mission)
        if event is not None:
            yield Link(
                earlier=f'events/{event.id}',
                later=captured(mission.id),
                least_s=0.0,
                kind=BoundKind.BEGUN,
                of=of,
                words=f'{event.id} begins {mission.id}',
            )
        yield from _phase(basis, mission, whole=whole)
        before = over(mission.id)
    yield from _ways(basis, flown)
    if whole:
        yield from _between_landmarks(basis, flown)
    yield _sink(basis, flown[-1], whole=whole)


def _climb(basis: Basis, first: UavMission, *, whole: bool) -> Link:
    height_m = basis.lowest_m(first) if whole else 0.0
    rate_mps = basis.limits.uav_climb_max_mps
    return Link(
        earlier=f'uavs/{first.uav}/takeoff',
        later=f'uavs/{first.uav}/up',
        least_s=height_m / rate_mps,
        kind=BoundKind.CLIMB,
        of=f'uavs/{first.uav}',
        words=f'{first.uav} climbs {height_m:g} m at {rate_mps:g} m/s at most',
        stated=((f'missions/{first.id}/altitude_m', first.altitude_m),),
        limits=('uav_climb_max_mps',),
        tolerances=('altitude_m',),
    )


def _sink(basis: Basis, last: UavMission, *, whole: bool) -> Link:
    floor_m = basis.tolerances.touchdown_height_m
    height_m = max(0.0, basis.lowest_m(last) - floor_m) if whole else 0.0
    rate_mps = basis.limits.uav_descent_max_mps
    return Link(
        earlier=over(last.id),
        later=f'uavs/{last.uav}/landed',
        least_s=height_m / rate_mps,
        kind=BoundKind.SINK,
        of=f'uavs/{last.uav}',
        words=f'{last.uav} sinks {height_m:g} m at {rate_mps:g} m/s at most',
        stated=((f'missions/{last.id}/altitude_m', last.altitude_m),),
        limits=('uav_descent_max_mps',),
        tolerances=('altitude_m', 'touchdown_height_m'),
    )


def _phase(basis: Basis, mission: UavMission, *, whole: bool) -> Iterator[Link]:
    of = f'missions/{mission.id}'
    during = partial(Link, earlier=captured(mission.id), later=over(mission.id), of=of)
    least_s, most_s = basis.phase_s(mission) if whole else (0.0, math.inf)
    stated = ((f'{of}/duration_s', mission.duration_s),)
    yield during(
        least_s=least_s,
        kind=BoundKind.PHASE,
        words=f'{mission.id} at its shortest',
        stated=stated,
        tolerances=('duration_s',),
    )
    if mission.mode is MissionMode.NAVIGATE:
        if whole:
            yield _route(basis, mission)
    elif math.isfinite(most_s):
        yield during(
            most_s=most_s,
            kind=BoundKind.PHASE,
            words=f'{mission.id} lasts {most_s:g} s at most',
            stated=stated,
            tolerances=('duration_s',),
        )


def _route(basis: Basis, mission: UavMission) -> Link:
    """Return the time along a pattern as fast as it may be flown, its corners cut."""
    of = f'missions/{mission.id}'
    facts = basis.plan.get(mission.id)
    legs = _legs_m(basis, mission) if facts is None else _legs_of(facts)
    # A waypoint is visited from as far away on both sides.
    cut_m = 2.0 * basis.tolerances.waypoint_horizontal_m
    ways_m = [max(0.0, leg - cut_m) for leg in legs]
    rate_mps = basis.limits.uav_speed_max_mps
    speed = mission.speed_mps
    if facts is not None or speed is None or not _holds_back(speed, rate_mps):
        speed = None
    seconds = sum(way / rate_mps for way in ways_m)
    if speed is not None:
        seconds = sum(_leg_s(basis, way, speed) for way in ways_m)
    sides = [(f'{of}/size_m/{k}', side) for k, side in enumerate(mission.size_m or ())]
    pace = f'{speed.value:g} m/s' if speed is not None else f'{rate_mps:g} m/s at most'
    slack = ('route_speed_mps', 'route_speed_share', 'route_acceleration_mps2')
    return Link(
        earlier=captured(mission.id),
        later=over(mission.id),
        least_s=seconds,
        kind=BoundKind.ROUTE,
        of=of,
        words=f'{mission.uav} flies {sum(ways_m):g} m of {mission.id} at {pace}',
        stated=(
            *sides,
            (f'{of}/radius_m', mission.radius_m),
            (f'{of}/turns', mission.turns),
            (f'{of}/speed_mps', speed),
        ),
        limits=('uav_speed_max_mps',),
        tolerances=('waypoint_horizontal_m', *(slack if speed is not None else ())),
    )


def _holds_back(speed: Parameter, rate_mps: float) -> bool:
    """Tell whether a stated speed keeps a UAV from flying as fast as it can."""
    return is_stated(speed) and speed.bound is not Bound.AT_LEAST and 0.0 < speed.value < rate_mps


def _leg_s(basis: Basis, way_m: float, speed: Parameter) -> float:
    """Return the least time along a leg with a stated speed.

    It is kept for a share of the samples away from the ends of the leg; elsewhere nothing but the
    limit counts.
    """
    tolerances, rate_mps = basis.tolerances, basis.limits.uav_speed_max_mps
    slack = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
    share = tolerances.route_speed_share
    kept_mps = min(rate_mps, speed.value + slack)
    settle_m = speed.value * speed.value / tolerances.route_acceleration_mps2
    cruise_m = max(0.0, way_m - settle_m)
    return (way_m - cruise_m) / rate_mps + cruise_m / (share * kept_mps + (1.0 - share) * rate_mps)


def _legs_m(basis: Basis, mission: UavMission) -> tuple[float, ...]:
    """Return the legs of a stated pattern at least; patterns that can be laid freely have none."""
    radius, turns, size = mission.radius_m, mission.turns, mission.size_m
    if mission.pattern is Pattern.ORBIT:
        if radius is None or turns is None or not (is_stated(radius) and is_stated(turns)):
            return ()
        slack = basis.tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
        swept_deg = max(0.0, 360.0 * least(turns, 0.0, 0.0) - basis.tolerances.orbit_deg)
        return (math.radians(swept_deg) * least(radius, slack, 0.0),)
    # A line has no width that anybody would state.
    needed = size[:1] if size is not None and mission.pattern is Pattern.LINE else size
    if size is None or not needed or not all(is_stated(side) for side in needed):
        return ()
    length, width = (least(side, 0.0, 0.0) for side in size)
    if mission.pattern is Pattern.RECTANGLE:
        return length, width, length, width
    if mission.pattern is Pattern.LAWNMOWER:
        # However its rows lie, it gets from one side of the area to the other.
        return (max(length, width),)
    return (length,) if mission.pattern is Pattern.LINE else ()


def _legs_of(facts: MissionFacts) -> tuple[float, ...]:
    return tuple(norm2(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(facts.waypoints))


def _ways(basis: Basis, flown: list[UavMission]) -> Iterator[Link]:
    """Yield the time to where each mission begins, as it was grounded; a target may come near."""
    rate_mps = basis.limits.uav_speed_max_mps
    # Both ends of the way are met by a tolerance.
    slack_m = 2.0 * max(
        basis.tolerances.waypoint_horizontal_m,
        basis.tolerances.hover_drift_calm_m,
        basis.tolerances.hover_drift_wind_m,
    )
    before = f'uavs/{flown[0].uav}/takeoff'
    for mission in flown:
        facts = basis.plan.get(mission.id)
        if facts is not None and mission.mode is not MissionMode.TRACK:
            way_m = max(0.0, facts.transit_m - slack_m)
            yield Link(
                earlier=before,
                later=captured(mission.id),
                least_s=way_m / rate_mps,
                kind=BoundKind.WAY,
                of=f'missions/{mission.id}',
                words=f'{mission.uav} flies {way_m:g} m to {mission.id} at {rate_mps:g} m/s at '
                'most',
            )
        if mission.mode is MissionMode.TRACK or stays_where_it_is(basis.spec, mission):
            return  # where the next way begins is not known
        before = over(mission.id)


def _between_landmarks(basis: Basis, flown: list[UavMission]) -> Iterator[Link]:
    """Yield the time from a hover at a landmark to the next one at another, before grounding."""
    rate_mps = basis.limits.uav_speed_max_mps
    for before, mission in pairwise(flown):
        here, there = (basis.landmarks.get(m.target or '') for m in (before, mission))
        hover = before.mode is mission.mode is MissionMode.HOVER
        if here is None or there is None or not hover:
            continue
        apart_m = norm2(there.x_m - here.x_m, there.y_m - here.y_m)
        aside_m = _aside_m(basis, before, here) + _aside_m(basis, mission, there)
        way_m = max(0.0, apart_m - aside_m)
        yield Link(
            earlier=over(before.id),
            later=captured(mission.id),
            least_s=way_m / rate_mps,
            kind=BoundKind.WAY,
            of=f'missions/{mission.id}',
            words=f'{mission.uav} flies {way_m:.0f} m to {mission.id} at {rate_mps:g} m/s at most',
            stated=tuple(
                pair
                for m in (before, mission)
                for pair in (
                    (f'missions/{m.id}/target', m.target),
                    (f'missions/{m.id}/standoff_m', m.standoff_m),
                )
            ),
            limits=('uav_speed_max_mps', 'uav_standoff_max_m'),
            tolerances=('pattern_centre_m', 'hover_drift_wind_m', 'standoff_m'),
        )


def _aside_m(basis: Basis, mission: UavMission, spot: Spot) -> float:
    """Return how far from its landmark a hover may be."""
    standoff, far_m = mission.standoff_m, basis.limits.uav_standoff_max_m
    if standoff is not None and is_stated(standoff):
        slack = basis.tolerances.standoff_m.of(standoff.value, approximate=standoff.approximate)
        return most(standoff, slack, max(far_m, standoff.value))
    if standoff is None and mission.bearing_deg is None:
        over_m = basis.tolerances.pattern_centre_m + basis.tolerances.hover_drift_wind_m
        return max(over_m, spot.roof_m)
    return far_m
