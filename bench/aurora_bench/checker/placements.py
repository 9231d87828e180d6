# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where bodies are relative to others and to places: at t = 0, and on the way."""

from __future__ import annotations

import numpy as np
import shapely
from shapely.ops import substring

from aurora_bench.checker import limits
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    all_of,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.on_the_way import abreast, beside_on_the_way, on_the_way
from aurora_bench.checker.paths import ahead_of, frame, lane_of, project, way
from aurora_bench.checker.places import Spot

# The contract gives words like "at" and "near" no figure: surely within the first, surely not
# beyond the second.
AT_M = (15.0, 50.0)
NEAR_M = (60.0, 160.0)
BESIDE_M = (15.0, 30.0)
AHEAD_MOST_M = 300.0
# A lane beside one's own: share of the lane's width between the two.
ADJACENT = (0.6, 1.7)
T0 = np.zeros(1)

# So far ahead the route of a body leads past a place for the first time.
_FIRST_PASS_M = 200.0


def placement(case: Case, requirement: Requirement) -> Judged:
    """Return whether bodies are placed as annotated (every one of a group)."""
    agent, of = requirement.get('agent'), requirement.get('of')
    gone = case.missing(agent, of)
    bodies = case.bodies(agent)
    if gone or not bodies:
        return does_not(f'there is no {gone or agent}')
    if case.unknown_place(of):
        return cannot_tell(f'no place {of!r} in the recorded world')
    parts = []
    for body in bodies:
        things = [t for t in case.things(of) if t != body]
        if of is not None and not things:
            return does_not(f'there is nothing that {of!r} names')
        if things:
            parts.append(any_of([_one(case, requirement, body, t) for t in things]))
        else:
            parts.append(_one(case, requirement, body, None))
    return all_of(parts)


def _one(case: Case, requirement: Requirement, body: str, thing: str | None) -> Judged:
    relation = requirement.get('relation')
    if case.scene.bodies[body].is_uav:
        return _of_uav(case, requirement, body, thing)
    if relation == 'parked_at':
        return _parked(case, requirement, body, thing)
    if thing is None:
        return cannot_tell(f'{relation} without of')
    if case.scene.is_body(thing):
        return _to_body(case, requirement, body, thing)
    return _to_place(case, requirement, body, thing)


def _distance(case: Case, requirement: Requirement, *bodies: str) -> Wanted | None:
    still = any(
        case.scene.is_person(b) or case.scene.stands_throughout(b)
        for b in bodies
        if case.scene.is_body(b)
    )
    rule = limits.PLACEMENT_OTHER if still else limits.PLACEMENT_VEHICLE
    return wanted(requirement, 'distance_m', case.variation, rule)


def _straight(case: Case, requirement: Requirement, body: str, thing: str) -> Judged:
    asked = _distance(case, requirement, body, thing)
    if asked is None:
        return holds('')
    gap = float(case.scene.distance(body, thing, horizontal=True)[0])
    return decide(asked.counts(gap), f'{body} {gap:.2f} m from {thing}, asked {asked.text()} m')


def _to_body(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    match relation := requirement.get('relation'):
        case 'ahead' | 'behind' | 'before':
            asked = _distance(case, requirement, body, other)
            at_first = _along(case, requirement, body, other, relation == 'ahead')
            return all_of([at_first, on_the_way(case, requirement, body, other, asked)])
        case 'same_lane':
            return _same_lane(case, requirement, body, other)
        case 'adjacent_lane':
            return _adjacent(case, requirement, body, other)
        case 'oncoming':
            return _oncoming(case, requirement, body, other)
        case 'left' | 'right' | 'beside':
            return _beside(case, requirement, body, other)
        case 'near' | 'at':
            gap = float(case.scene.distance(body, other, horizontal=True)[0])
            if requirement.get('distance_m') is not None:
                return _straight(case, requirement, body, other)
            sure, most = NEAR_M if relation == 'near' else AT_M
            return graded(gap <= sure, gap <= most, f'{body} {gap:.1f} m from {other}')
        case _:
            return cannot_tell(f'relation {relation!r} of two bodies')


def _along(case: Case, requirement: Requirement, body: str, other: str, front: bool) -> Judged:
    asked = _distance(case, requirement, body, other)
    gaps, lateral = ahead_of(case.scene, body, other, T0)
    gap = float(gaps[0]) if front else -float(gaps[0])
    word = 'ahead of' if front else 'behind'
    if np.isnan(gap):
        # On different ways: only the headings are left.
        forward, left = (float(v[0]) for v in frame(case.scene, body, other))
        gap = forward if front else -forward
        why = f'{body} is not on the way of {other}; {gap:.1f} m {word} it by heading'
        if gap < 0.0 or abs(left) > 2.0 * max(gap, 10.0):
            return does_not(why)
        if asked is None:
            return cannot_tell(why)
        straight = float(np.hypot(forward, left))
        near = asked.off(gap) < 3.0 or asked.off(straight) < 3.0
        return graded(False, near, why)
    why = f'{body} {gap:.2f} m {word} {other} along the way, {float(lateral[0]):.1f} m beside it'
    if asked is None:
        return graded(0.0 < gap <= AHEAD_MOST_M, gap > 0.0, why)
    return decide(asked.counts(gap), f'{why}, asked {asked.text()} m')


def _same_lane(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    gaps, laterals = ahead_of(case.scene, body, other, T0)
    lateral = abs(float(laterals[0]))
    asked = _distance(case, requirement, body, other)
    heading = _alignment(case, body, other)
    if np.isnan(lateral):
        return _by_lane(case, body, other, same=True)
    why = f'{body} {lateral:.2f} m beside the way of {other}, {abs(float(gaps[0])):.2f} m along it'
    by_way = graded(lateral <= 1.2 and heading > 0.7, lateral <= 1.8, why)
    # Who pulls out soon leaves the other's way; the lane at t = 0 is what counts.
    by_lane = _by_lane(case, body, other, same=True)
    parts = [by_lane if by_lane.outcome is Outcome.HOLDS else by_way]
    if asked is not None:
        parts.append(decide(asked.counts(abs(float(gaps[0]))), f'{why}, asked {asked.text()} m'))
    return all_of(parts)


def _by_lane(case: Case, body: str, other: str, same: bool) -> Judged:
    scene = case.scene
    lanes = [lane_of(scene, scene.xy(b)[0], scene.heading(b)[0]) for b in (body, other)]
    if lanes[0] is None or lanes[1] is None:
        return cannot_tell(f'{body} or {other} is on no lane')
    why = f'{body} on {lanes[0].lane_id}, {other} on {lanes[1].lane_id}'
    if lanes[0].lane_id == lanes[1].lane_id:
        return decide(same, why)
    return graded(False, lanes[0].street == lanes[1].street, why)


def _alignment(case: Case, body: str, other: str) -> float:
    """Return the cosine between the headings at t = 0."""
    return float(case.scene.heading(body)[0] @ case.scene.heading(other)[0])


def _adjacent(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    gaps, laterals = ahead_of(case.scene, body, other, T0)
    lateral, heading = abs(float(laterals[0])), _alignment(case, body, other)
    if np.isnan(lateral):
        return _by_lane(case, body, other, same=False)
    width = max((lane.width_m for lane in case.scene.world.lanes), default=3.3)
    why = f'{body} {lateral:.2f} m beside the way of {other}, cosine of headings {heading:.2f}'
    beside = ADJACENT[0] * width <= lateral <= ADJACENT[1] * width
    parts = [graded(beside and heading > 0.7, beside and heading > 0.5, why)]
    asked = _distance(case, requirement, body, other)
    if asked is not None:
        straight = float(case.scene.distance(body, other, horizontal=True)[0])
        along = abs(float(gaps[0]))
        # "10 m ahead in the next lane" is told along the way, "10 m beside" straight.
        ok = asked.counts(straight) or asked.counts(along)
        parts.append(decide(ok, f'{straight:.2f} m, {along:.2f} m along, asked {asked.text()} m'))
    return all_of(parts)


def _oncoming(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    heading = _alignment(case, body, other)
    forward, left = (float(v[0]) for v in frame(case.scene, body, other))
    own = way(case.scene, other)
    arc, lateral = project(own, case.scene.xy(body)[:1], own.own_m[:1])
    gap, beside = float(arc[0] - own.own_m[0]), abs(float(lateral[0]))
    if arc[0] >= own.arc_m[-1] - 1e-6:
        # Beyond the end of what is known of the way: straight on.
        gap, beside = forward, abs(left)
    why = f'{body} {gap:.1f} m ahead of {other}, {beside:.1f} m beside its way, '
    why += f'cosine of headings {heading:.2f}'
    # On a curve the headings at the two spots differ; that at the meeting point counts.
    sure = beside <= 15.0 and gap > 0.0 and heading < -0.7
    maybe = forward > 0.0 or (beside <= 15.0 and gap > 0.0)
    return all_of([graded(sure, maybe, why), _straight(case, requirement, body, other)])


def _comes_to_a_place(case: Case, body: str) -> bool:
    return any(
        r['kind'] == 'behavior'
        and r.get('behavior') == 'approach'
        and body in case.bodies(r.get('agent'))
        and not case.bodies(r.get('target'))
        for r in case.annotation.flat()
    )


def _beside(case: Case, requirement: Requirement, body: str, other: str) -> Judged:
    forward, left = (float(v[0]) for v in frame(case.scene, body, other))
    aside, level = abreast(case.scene, body, other, str(requirement.get('relation')))
    why = f'{body} {left:+.1f} m left and {forward:+.1f} m forward of {other}'
    parts = [
        graded(bool(aside[0]), bool(level[0]), why),
        _straight(case, requirement, body, other),
        beside_on_the_way(case, requirement, body, other),
    ]
    if requirement.get('distance_m') is None:
        gap = float(np.hypot(forward, left))
        sure, most = BESIDE_M
        # "From the left" to a place says a side; how far away that begins nobody says.
        near = gap <= most or _comes_to_a_place(case, body)
        parts.append(graded(gap <= sure, near, f'{gap:.1f} m away'))
    return all_of(parts)


def _to_place(case: Case, requirement: Requirement, body: str, place: str) -> Judged:
    scene, relation = case.scene, requirement.get('relation')
    point = scene.xy(body)[:1]
    if relation == 'before':
        return _upstream(case, requirement, body, place)
    asked = _distance(case, requirement, body)
    outline = float(scene.places.outline_distance(place, point, on_road=asked is None)[0])
    if asked is not None:
        spots = [float(np.linalg.norm(s.xy - point[0])) for s in scene.places.spots(place)]
        best = min([outline, *spots], key=asked.off)
        why = f'{body} {best:.2f} m from {place}, asked {asked.text()} m'
        return decide(asked.counts(best), why)
    why = f'{body} {outline:.1f} m from {place}'
    match relation:
        case 'on' if place.casefold() == 'main_road':
            return _on_main_road(case, body, why)
        case 'on':
            slack = 1.0 if place.casefold() != 'roadside' else 2.0
            return graded(outline <= slack, outline <= slack + 1.5, why)
        case 'at' | 'beside' if scene.places.is_region(place):
            # The roadside is a strip of its own; by a sidewalk means beside it, too.
            slack = 1.0 if place.casefold() == 'roadside' else 3.0
            return graded(outline <= slack, outline <= slack + 3.0, why)
        case 'at' | 'beside':
            # A junction is as wide as its roads: at it means at its edge.
            return graded(outline <= AT_M[0], outline <= AT_M[1], why)
        case 'near' | 'ahead' | 'behind' | 'left' | 'right':
            sure = outline <= NEAR_M[0] and relation == 'near'
            return graded(sure, outline <= NEAR_M[1], why)
        case _:
            return cannot_tell(f'relation {relation!r} to a place: {why}')


def at_place(case: Case, body: str, thing: str) -> Judged:
    """Return whether a body is at a place, or near another body, at t = 0."""
    if not case.scene.is_body(thing):
        return _to_place(case, {'relation': 'at'}, body, thing)
    gap = float(case.scene.distance(body, thing, horizontal=True)[0])
    return graded(gap <= AT_M[0], gap <= AT_M[1], f'{body} {gap:.1f} m from {thing}')


def _on_main_road(case: Case, body: str, why: str) -> Judged:
    """Return whether a body is on a main road: which roads are one the contract leaves open."""
    point = shapely.Point(case.scene.xy(body)[0])
    road = case.scene.places.carriageway()
    main = case.scene.places.area('main_road').distance(point)
    return graded(main <= 3.0, road.distance(point) <= 3.0, why)


def _upstream(case: Case, requirement: Requirement, body: str, place: str) -> Judged:
    """Return whether a body stands before a place, on its way to it."""
    scene, asked = case.scene, _distance(case, requirement, body)
    own = way(scene, body)
    start = float(own.own_m[0])
    line, gaps = shapely.LineString(own.xy_m), []
    if line.length < 30.0:
        # Who never moves and has no plan: its lane, straight on.
        end = own.xy_m[-1] + scene.heading(body)[0] * 300.0
        line = shapely.LineString([*own.xy_m, end])
    plan = scene.bodies[body].route_xy_m
    for spot in (*scene.places.spots(place), *scene.places.approaches(place)):
        driven = _to_spot(line, start, spot)
        gaps += driven
        # The contract measures along the route: who changes lanes on it drives a longer way.
        if driven and len(plan) >= 2:
            route = shapely.LineString(plan)
            here = route.project(shapely.Point(scene.xy(body)[0]))
            # A route that leads round comes by again: only its first pass is meant.
            gaps += _to_spot(substring(route, here, here + _FIRST_PASS_M), 0.0, spot)
    ahead = sorted(g for g in gaps if g >= -1.0)
    shown = [round(g, 1) for g in ahead[:4]]
    why = f'{body} is {shown} m before {place} along its way'
    if not ahead:
        return does_not(f'{place} does not lie ahead of {body} on its way')
    if asked is None:
        return graded(ahead[0] <= AHEAD_MOST_M, True, why)
    # The edge, the middle and the far side of a place are all called by its name.
    fits = any(asked.counts(g) for g in ahead[:12])
    return decide(fits, f'{why}, asked {asked.text()} m')


def _to_spot(line: shapely.LineString, start: float, spot: Spot) -> list[float]:
    """Return the ways to the edge, the middle and the far edge of a spot on the way."""
    point = shapely.Point(spot.x_m, spot.y_m)
    near = line.distance(point) if spot.outline is None else line.distance(spot.outline)
    if near > (25.0 if spot.outline is None else 6.0):
        return []
    arc = line.project(point)
    # The start of a way is the nearest point to all that lies behind it.
    found = [arc - start] if 1e-6 < arc < line.length - 1e-6 else []
    if spot.outline is not None:
        inside = line.intersection(spot.outline)
        if not inside.is_empty:
            ends = [
                line.project(shapely.Point(c)) - start for c in shapely.get_coordinates(inside)
            ]
            found += [min(ends), max(ends)]
    return found


def _parked(case: Case, requirement: Requirement, body: str, thing: str | None) -> Judged:
    speed = case.scene.speed(body)
    still = float(speed[0]) < limits.STOPPED_MPS
    moving = np.flatnonzero(speed >= limits.STOPPED_MPS)
    rest = float(case.scene.times[moving[0]]) if len(moving) else case.scene.end_s
    why = f'{body} stands until {rest:.1f} s'
    parts = [graded(still and not len(moving), still and rest >= 2.0, why)]
    if thing is not None and case.scene.is_body(thing):
        gap = float(case.scene.distance(body, thing, horizontal=True)[0])
        if requirement.get('distance_m') is not None:
            parts.append(_straight(case, requirement, body, thing))
        else:
            parts.append(graded(gap <= NEAR_M[0], gap <= NEAR_M[1], f'{gap:.1f} m from {thing}'))
    elif thing is not None:
        parts.append(_to_place(case, {**requirement, 'relation': 'at'}, body, thing))
    return all_of(parts)


def _of_uav(case: Case, requirement: Requirement, uav: str, thing: str | None) -> Judged:
    if thing is None:
        return cannot_tell('a UAV placed nowhere')
    gap = float(case.scene.distance(uav, thing, horizontal=True)[0])
    asked = _distance(case, requirement, uav, thing)
    why = f'{uav} starts {gap:.1f} m from {thing}'
    if asked is None:
        return graded(gap <= NEAR_M[0], True, why)
    # Where a UAV is placed may be told of its flight as well as of its start.
    return graded(asked.counts(gap), True, why)
