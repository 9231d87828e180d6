# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether what events wait for can come about on a site: not so at t = 0, and on the way later.

"When the car is within 30 m of a pedestrian at the crosswalk": the crosswalk is ahead of the car,
and farther than that.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aurora_core.comm.reach import reach_of
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.awaited import awaited_at, is_kept_away, kept_away_m
from aurora_core.grounding.kept_apart import kept_apart
from aurora_core.grounding.nearby import ON_SIDEWALKS
from aurora_core.grounding.places import ROADS, MapPlaces, has_point
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson, Site, samples_along
from aurora_core.grounding.watched import looks
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.events import least_due_s, sets_off
from aurora_core.spec.parking import stands
from aurora_core.spec.scenario import (
    DistanceTrigger,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode

Pose = tuple[float, float, float, float]

# Two that are to come near each other start at least so much farther apart (m).
_APART_M = 3.0
# A vehicle gets to a person on the next stretch of its way: so long, in such steps (m).
_WAY_M = 300.0
_STEP_M = 4.0
# So much of the way of two who are to stay apart is looked at, in such steps (m).
_APART_WAY_M, _APART_STEP_M = 600.0, 10.0
# So fast somebody may drive until a stated time (m/s); who does one of these does not.
_PACES_MPS = (6.0, 9.0, 12.0)
# Who is told something later than that is met half way, no farther than so much ahead (s, m).
_SOON_S, _MOST_AHEAD_M = 20.0, 250.0
_STAYS = (BehaviorKind.WAIT, BehaviorKind.PARK, BehaviorKind.STOP)
# Of the range of a link so much is counted on; beyond that of a hidden one it may be hidden.
_RANGE_SHARE = 0.9
_HIDDEN, _FAR = 0.6, 0.5
# From so high one looks at what is so high (m).
_EYES_M, _LOOKED_AT_M = 1.2, 1.0


def comes_about(spec: ScenarioSpec, site: Site, places: MapPlaces, airspace: Airspace) -> bool:
    """Tell whether what a request waits for can come about on a site.

    Every two that an event waits for can come near each other, and who is to look at what stays
    where it is sees it from where it starts.

    Args:
        spec: The request.
        site: Where its vehicles and persons stand.
        places: Of the map.
        airspace: For lines of sight between buildings.
    """
    return _sees_at_first(spec, site, places, airspace) and all(
        _can_meet(one, other, event.trigger.value_m.value)
        for event in spec.events
        if isinstance(event.trigger, DistanceTrigger)
        and event.trigger.on == 'distance_below'
        and (one := site.seat(event.trigger.a)) is not None
        and (other := site.seat(event.trigger.b)) is not None
    )


def starts_out_of_reach(spec: ScenarioSpec, site: Site, places: MapPlaces, range_m: float) -> bool:
    """Tell whether who ends a route at a place by coming near, or into view, is not there yet.

    Args:
        spec: The request.
        site: Where the vehicles stand.
        places: Of the map.
        range_m: Of sight.
    """
    for awaited in awaited_at(spec):
        patrol, seat = awaited.mission, site.seat(awaited.agent)
        if patrol is None or seat is None or not is_kept_away(spec, patrol):
            continue
        x, y, *_ = seat.path.position_at(seat.arc_m)
        point_x, point_y = places.itself(awaited.place, site.origin()[:2])
        if norm2(x - point_x, y - point_y) < kept_away_m(spec, patrol, range_m):
            return False
    return True


def middle_of_route(spec: ScenarioSpec, mission: UavMission, site: Site, range_m: float) -> Pose:
    """Return where a route is that is at no place (x, y in m, unit heading): where the scene is.

    Who ends it by coming there, or into view, has the way there before it.

    Args:
        spec: The request.
        mission: The route.
        site: Where the vehicles stand.
        range_m: Of sight.
    """
    return site.origin_path.position_at(_route_arc_m(spec, mission, site, range_m))


def anchor_arc_m(spec: ScenarioSpec, site: Site, range_m: float) -> float:
    """Return where on its way the street is that places of the scene are looked for at (m).

    That is where the scene begins, or where a route over the street is flown.

    Args:
        spec: The request.
        site: Where the vehicles stand.
        range_m: Of sight.
    """
    routes = [m for m in spec.missions if m.target in ROADS and is_kept_away(spec, m)]
    arcs = [_route_arc_m(spec, mission, site, range_m) for mission in routes]
    return max(arcs, default=site.origin_arc_m)


def _route_arc_m(spec: ScenarioSpec, mission: UavMission, site: Site, range_m: float) -> float:
    if not site.seated or not is_kept_away(spec, mission):
        way_m = site.origin_path.length_m - site.origin_arc_m
        return site.origin_arc_m + min(way_m, _talks_ahead_m(spec, mission, site))
    away_m = site.origin_arc_m + kept_away_m(spec, mission, range_m)
    return min(away_m, site.origin_path.length_m)


def _talks_ahead_m(spec: ScenarioSpec, mission: UavMission, site: Site) -> float:
    """Return how far ahead a UAV hovers at no place that later talks with who drives on (m)."""
    if mission.mode is not MissionMode.HOVER or mission.target is not None:
        return 0.0
    due_s = [
        at_s
        for sender, receiver, at_s in _messages(spec)
        if mission.uav in (sender, receiver)
        and isinstance(
            seat := site.seat(receiver if sender == mission.uav else sender), SeatedAgent
        )
        and not stands(seat.agent)
        and sets_off(spec.events, seat.agent.id) is None
    ]
    last_s = max(due_s, default=0.0)
    return min(_MOST_AHEAD_M, last_s * _PACES_MPS[-1] / 2.0) if last_s > _SOON_S else 0.0


def heard(spec: ScenarioSpec, site: Site, places: MapPlaces, limits: Limits) -> float:
    """Return how well who talks by radio with somebody at a place stands to it, in [0, 1].

    That counts at t = 0 or, of who is told at a stated time, where it may have come to by then.
    Persons, who are not placed yet, will be near the vehicles.

    Args:
        spec: The request.
        site: Where the vehicles stand.
        places: Of the map.
        limits: With the ranges of radio links.
    """
    share, origin = 1.0, site.origin()[:2]
    reaches = {(k.sender, k.receiver): reach_of(k, limits) for k in spec.links}
    for sender, receiver, due_s in _messages(spec):
        reach = reaches.get((sender, receiver))
        seen_m = limits.link_range_sight_m if reach is None else reach.sight_m
        hidden_m = limits.link_range_blocked_m if reach is None else reach.blocked_m
        # Whoever of the two stays at a place: it is as far from one to the other and back.
        ends = (sender, receiver) if _place_of(spec, sender) else (receiver, sender)
        place = _place_of(spec, ends[0])
        if place is None:
            continue
        of, height_m = place
        point_x, point_y = places.itself(of, origin)
        scores = []
        for x, y, up_m in _heard_at(spec, site, places, ends[1], due_s):
            away_m = norm2(norm2(x - point_x, y - point_y), height_m - up_m)
            sight_m = _RANGE_SHARE * min(seen_m, limits.link_range_sight_m)
            near = away_m <= _RANGE_SHARE * min(hidden_m, limits.link_range_blocked_m)
            # Beyond the range nearer is better still: some of that share is left.
            far = _FAR * sight_m / away_m if away_m > sight_m else _HIDDEN
            scores.append(1.0 if near else far)
        share = min(share, sum(scores) / len(scores)) if scores else share
    return share


def _heard_at(
    spec: ScenarioSpec, site: Site, places: MapPlaces, receiver: str, due_s: float
) -> Iterator[tuple[float, float, float]]:
    """Yield where who is told something may be (x, y, height in m), as far as a site says it."""
    told, origin = site.seat(receiver), site.origin()[:2]
    agent = next((a for a in spec.agents if a.id == receiver), None)
    if told is not None:
        goes = _drives_from_start(spec, told.agent)
        for pace_mps in _PACES_MPS if goes else (0.0,):
            way_m = pace_mps * due_s
            arc_m = min(told.arc_m + way_m, told.path.length_m)
            yield *told.path.position_at(arc_m)[:2], 0.0
    elif agent is None or agent.type in ON_SIDEWALKS:
        there = _place_of(spec, receiver)
        if there is not None:
            yield *places.itself(there[0], origin), there[1]
        elif agent is not None:
            yield *origin, 0.0


def _messages(spec: ScenarioSpec) -> Iterator[tuple[str, str, float]]:
    """Yield sender, receiver and earliest time (s) of all that is sent."""
    for event in spec.events:
        if isinstance(event.action, SendMessage):
            due_s = least_due_s(spec.events, event.id)
            yield event.action.sender, event.action.receiver, due_s
    yield from ((k.sender, k.receiver, 0.0) for k in spec.links if k.rate_hz is not None)


def _place_of(spec: ScenarioSpec, body: str) -> tuple[str, float] | None:
    """Return the place at which a body stays, and its height (m), None where it has none."""
    first = next((m for m in spec.missions if m.uav == body), None)
    if first is not None:
        return (str(first.target), first.altitude_m.value) if has_point(first.target) else None
    units = (a for a in spec.agents if a.id == body and a.type in ON_SIDEWALKS)
    placed = (p.of for unit in units for p in unit.placements)
    return next(((str(of), 0.0) for of in placed if has_point(of)), None)


def _drives_from_start(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether somebody drives whom no event sets off."""
    drives = any(b.kind not in _STAYS for b in agent.behaviors)
    return drives and agent.type is not AgentType.RSU and sets_off(spec.events, agent.id) is None


def _sees_at_first(spec: ScenarioSpec, site: Site, places: MapPlaces, airspace: Airspace) -> bool:
    """Tell whether who is to see something for a time has it before its eyes at t = 0.

    Who drives looks ahead, who walks all round.
    """
    for name, target, _ in looks(spec):
        seat, seen = site.seat(name), site.seat(target)
        if seat is None:
            continue
        x, y, ahead_x, ahead_y = seat.path.position_at(seat.arc_m)
        if seen is not None:
            to_x, to_y, *_ = seen.path.position_at(seen.arc_m)
        elif has_point(target):
            to_x, to_y = places.itself(target, site.origin()[:2])
        else:
            continue
        if isinstance(seat, SeatedAgent) and (to_x - x) * ahead_x + (to_y - y) * ahead_y <= 0.0:
            return False
        sight = airspace.sight.around(to_x, to_y)
        line = np.array([[x, y, _EYES_M]]), np.array([[to_x, to_y, _LOOKED_AT_M]])
        if sight.clearance_series(*line)[0] <= 0.0:
            return False
    return True


def _can_meet(
    one: SeatedAgent | SeatedPerson, other: SeatedAgent | SeatedPerson, within_m: float
) -> bool:
    """Tell whether two are apart at t = 0, and a vehicle's way leads to a person."""
    x, y, *_ = one.path.position_at(one.arc_m)
    other_x, other_y, *_ = other.path.position_at(other.arc_m)
    if norm2(x - other_x, y - other_y) < within_m + _APART_M:
        return False
    for vehicle, person in ((one, other), (other, one)):
        if isinstance(vehicle, SeatedAgent) and isinstance(person, SeatedPerson):
            way = samples_along(vehicle.path, vehicle.arc_m, _WAY_M, _STEP_M)[:, :2]
            away_m = np.linalg.norm(way - person.path.position_at(person.arc_m)[:2], axis=1)
            return bool(away_m.min() < within_m)
    return True


def stays_apart(spec: ScenarioSpec, site: Site) -> float:
    """Return on which share of their way such vehicles are far enough apart, in [0, 1].

    Both drive as fast as each other: where the road turns back they come near again.

    Args:
        spec: The request.
        site: Where the vehicles stand.
    """
    share = 1.0
    for pair in kept_apart(spec, [seat.agent.id for seat in site.seated]):
        back, front = site.seat(pair.behind), site.seat(pair.ahead)
        assert back is not None
        assert front is not None  # they are seated
        way_m = min(_APART_WAY_M, front.path.length_m - max(back.arc_m, front.arc_m))
        ways = [samples_along(s.path, s.arc_m, way_m, _APART_STEP_M)[:, :2] for s in (back, front)]
        count = min(map(len, ways))
        away_m = np.linalg.norm(ways[0][:count] - ways[1][:count], axis=1)
        share = min(share, float(np.mean(away_m > pair.least_m)))
    return share
