# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a ground body does over the run, alone or with another."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping

import numpy as np

from aurora_bench.checker import headways, limits
from aurora_bench.checker.actions import Window, ground_action
from aurora_bench.checker.answers import (
    Judged,
    all_of,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.events import happened
from aurora_bench.checker.lasting import lasting
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.on_the_way import stated_between
from aurora_bench.checker.pairs import APPROACHED_M, approach, follow, overtake, tailgate
from aurora_bench.checker.paths import way
from aurora_bench.checker.phases import missions_end_s
from aurora_bench.checker.placements import AT_M, at_place
from aurora_bench.checker.recording import BoolArray
from aurora_bench.checker.roads import crossings_of, lane_changes
from aurora_bench.checker.scene import longest_s, runs_of, share

MOVED_M = 10.0
TURN_DEG = (60.0, 45.0)
TURN_WITHIN_M = 45.0
# Who goes to a place surely comes from elsewhere, surely does not (m nearer than before).
COMES_M = (10.0, 5.0)
# A bend is too tight where a speed would push passengers sideways like this.
LATERAL_MPS2 = 4.0
BEND_OVER_M = 10.0


def behavior(case: Case, requirement: Requirement) -> Judged:
    """Return whether bodies behave as annotated (every one of a group)."""
    agent, target = requirement.get('agent'), requirement.get('target')
    gone = case.missing(agent, target)
    bodies = case.bodies(agent)
    if gone or not bodies:
        return does_not(f'there is no {gone or agent}')
    if case.unknown_place(target):
        return cannot_tell(f'no place {target!r} in the recorded world')
    return all_of([_one(case, requirement, body) for body in bodies])


def _one(case: Case, requirement: Requirement, body: str) -> Judged:
    judged = all_of([_kind(case, requirement, body), _time(case, requirement, body)])
    if requirement.get('speed_mps') is None or requirement.get('behavior') in ('slow',):
        return judged
    return all_of([judged, driven_speed(case, requirement, body)])


def _time(case: Case, requirement: Requirement, body: str) -> Judged:
    targets = [t for t in case.things(requirement.get('target')) if t != body]
    spots = [t for t in targets if case.scene.is_body(t) or not case.scene.places.is_region(t)]

    def near(surely: bool) -> BoolArray:
        if not spots:
            return np.ones(case.scene.recording.ticks, dtype=bool)
        return _near(case, body, spots, AT_M[0 if surely else 1])

    return lasting(case, requirement, body, targets, near, lambda: _held_up(case, body))


def _kind(case: Case, requirement: Requirement, body: str) -> Judged:
    targets = [t for t in case.things(requirement.get('target')) if t != body]
    pairs: dict[str, Callable[..., Judged]] = {
        'tailgate': tailgate,
        'overtake': overtake,
        'approach': approach,
    }
    kind = str(requirement.get('behavior'))
    if kind in (*pairs, 'follow'):
        if not targets:
            return cannot_tell(f'{kind} whom is not annotated')
        number = wanted(requirement, 'headway_s', case.variation, limits.HEADWAY)
        if number is not None:
            kept = [headways.keeps(case.scene, body, t, number) for t in targets]
            # What is stated in seconds is as far as the fastest one drives in them.
            room = Wanted(number.value, 0.0, number.high * limits.VEHICLE_MPS, 0.0)
            pairs['follow'] = functools.partial(follow, stated=room)
            plain = [pairs[kind](case.scene, body, t) for t in targets]
            return all_of([any_of(plain), any_of(kept)])
        if kind == 'follow':
            gaps = [(t, stated_between(case, body, t)) for t in targets]
            return any_of([follow(case.scene, body, t, stated) for t, stated in gaps])
        judged = [pairs[kind](case.scene, body, t) for t in targets]
        return all_of(judged) if kind == 'overtake' else any_of(judged)
    match kind:
        case 'drive' | 'circulate' | 'walk' | 'emergency_run':
            return _moves(case, requirement, body, targets)
        case 'stop' | 'wait' | 'park':
            if requirement.get('duration_s') is not None:
                kind = 'wait'  # how long is told apart from that
            return _stands(case, kind, body, targets, never=bool(requirement.get('negate')))
        case 'brake' | 'slow' | 'yield':
            action = {'do': kind, 'value_mps': requirement.get('speed_mps')}
            others = tuple(t for t in targets if case.scene.is_body(t))
            window = Window(0.0, case.scene.end_s, free=True)
            return ground_action(case, action, body, window, others).judged
        case 'cross':
            return _crosses(case, body, targets)
        case 'change_lane':
            found = lane_changes(case, body, requirement.get('side'))
            held = any(one.held for one in found)
            seen = [round(float(case.scene.times[one.tick]), 1) for one in found]
            return graded(held, bool(found), f'{body} changes lane at {seen} s')
        case 'turn_left' | 'turn_right':
            return _turns(case, body, 1.0 if kind == 'turn_left' else -1.0, targets)
        case _:
            return cannot_tell(f'behaviour {kind!r} is not known')


def _moves(case: Case, requirement: Requirement, body: str, targets: list[str]) -> Judged:
    scene, kind = case.scene, str(requirement.get('behavior'))
    if kind == 'walk' and not scene.is_person(body):
        return does_not(f'{body} is no person')
    moved = float(way(scene, body).own_m[-1])
    why = f'{body} moves {moved:.1f} m'
    least = MOVED_M if kind != 'walk' else 3.0
    parts = [graded(moved >= least, moved >= 1.0, why)]
    if kind == 'circulate':
        active = share(scene.speed(body) > limits.STARTED_MPS)
        parts.append(graded(moved >= 100.0, moved >= 30.0, f'{why}, on the move for {active:.0%}'))
    if kind == 'emergency_run':
        # Right of way and signals are not in the states.
        parts.append(cannot_tell('an emergency run does not show in the states'))
    if targets:
        parts.append(any_of([_heads_for(case, body, t) for t in targets]))
    return all_of(parts)


def _heads_for(case: Case, body: str, target: str) -> Judged:
    scene = case.scene
    if not scene.is_body(target) and scene.places.is_region(target):
        moving = (scene.speed(body) > limits.STARTED_MPS) & scene.present(body)
        ticks = np.flatnonzero(moving)[:: max(1, round(0.5 / scene.dt_s))]
        if not len(ticks):
            return does_not(f'{body} does not move')
        on = scene.places.outline_distance(target, scene.xy(body)[ticks]) <= 3.0
        why = f'{body} on {target} for {share(on):.0%} of its way'
        surely = share(on) >= limits.FOLLOW_SHARE
        # Which street is a main road the contract leaves open.
        return graded(surely, bool(on.any()) or target.casefold() == 'main_road', why)
    if scene.is_body(target) or _is_placed_at(case, body, target):
        return approach(scene, body, target)
    return _comes_to(case, body, target)


def _is_placed_at(case: Case, body: str, place: str) -> bool:
    """Return whether it is annotated that a body is at, near or before a place at t = 0."""
    return any(
        r['kind'] == 'placement'
        and body in case.bodies(r.get('agent'))
        and place in case.things(r.get('of'))
        for r in case.annotation.flat()
    )


def _comes_to(case: Case, body: str, place: str) -> Judged:
    """Return whether a body gets near a place from elsewhere: who is there has not gone there."""
    scene = case.scene
    places, xy = scene.places, scene.xy(body)[scene.present(body)]
    away = places.distance(place, xy)
    for spot in places.approaches(place):
        away = np.minimum(away, np.linalg.norm(xy - spot.xy, axis=1))
    nearer = np.maximum.accumulate(away) - away
    there = away <= APPROACHED_M
    gain = float(nearer[there].max(initial=0.0))
    why = f'{body} gets {gain:.1f} m nearer to {place}, {away.min():.1f} m from it'
    return graded(gain >= COMES_M[0], gain >= COMES_M[1], why)


def _near(case: Case, body: str, targets: list[str], most: float) -> BoolArray:
    scene = case.scene
    near = np.zeros(scene.recording.ticks, dtype=bool)
    for target in targets:
        if scene.is_body(target):
            away = scene.distance(body, target, horizontal=True)
        else:
            away = scene.places.outline_distance(target, scene.xy(body), on_road=True)
        with np.errstate(invalid='ignore'):
            near |= away <= most
    return near


def _stands(case: Case, kind: str, body: str, targets: list[str], *, never: bool) -> Judged:
    scene = case.scene
    still = (scene.speed(body) < limits.STOPPED_MPS) & scene.present(body)
    first = runs_of(still)
    from_start = first[0][1] * scene.dt_s if first and first[0][0] == 0 else 0.0
    if kind == 'park' and targets and _is_to_arrive(case, body, targets[0]):
        return _parks_there(case, body, targets[0])
    if kind == 'park':
        why = f'{body} stands for the first {from_start:.1f} s of {scene.end_s:.1f} s'
        parts = [graded(bool(still.all()), from_start >= limits.STOPPED_S, why)]
        if targets:
            parts += [at_place(case, body, t) for t in targets[:1]]
        return all_of(parts)
    moved = scene.speed(body) > limits.STARTED_MPS
    if kind == 'stop' and never and moved.any():
        # "Never stops": who has not set off yet has not stopped.
        still = still & np.logical_or.accumulate(moved)
    longest = longest_s(still, scene.dt_s)
    why = f'{body} at rest for up to {longest:.1f} s'
    edge = limits.STOPPED_S - 2.0 * scene.dt_s
    if not targets:
        return decide(longest >= edge, why)
    at = longest_s(still & _near(case, body, targets, AT_M[0]), scene.dt_s)
    far = longest_s(still & _near(case, body, targets, AT_M[1]), scene.dt_s)
    return graded(at >= edge, far >= edge, f'{why}, {at:.1f} s of it at {targets[0]}')


def _is_to_arrive(case: Case, body: str, place: str) -> bool:
    """Return whether it is annotated that a body goes to a place before it parks there."""
    for other in case.annotation.flat():
        trigger = other.get('trigger') or {}
        arrives = trigger.get('on') == 'arrives' and body in case.bodies(trigger.get('who'))
        goes = other.get('behavior') in ('drive', 'emergency_run')
        if arrives and place in case.things(trigger.get('place')):
            return True
        if goes and body in case.bodies(other.get('agent')):
            return True
    return False


def _parks_there(case: Case, body: str, place: str) -> Judged:
    """Return whether a body comes to a place and stands there at the end of the run."""
    scene = case.scene
    moving = (scene.speed(body) >= limits.STOPPED_MPS) & scene.present(body)
    last = int(np.flatnonzero(moving)[-1]) + 1 if moving.any() else 0
    stood_s = (scene.recording.ticks - last) * scene.dt_s
    edge_s = limits.STOPPED_S - 2.0 * scene.dt_s
    why = f'{body} stands for the last {stood_s:.1f} s of {scene.end_s:.1f} s'
    if not moving.any():
        return does_not(f'{body} is to come to {place} and never moves')
    near = _near(case, body, [place], AT_M[0])[-1]
    nearly = _near(case, body, [place], AT_M[1])[-1]
    parts = [decide(stood_s >= edge_s, why)]
    parts.append(graded(bool(near), bool(nearly), f'{body} ends at {place}'))
    return all_of(parts)


def _crosses(case: Case, body: str, targets: list[str]) -> Judged:
    scene = case.scene
    found = [c for c in crossings_of(case, body) if c[2] >= 3.0]
    whole = [c for c in found if c[1] < scene.recording.ticks]
    if not found:
        return does_not(f'{body} never crosses a carriageway')
    a, _b, metres = (whole or found)[0]
    why = f'{body} crosses {metres:.1f} m from {scene.times[a]:.1f} s'
    parts = [graded(bool(whole), True, why)]
    places = [t for t in targets if not scene.is_body(t)]
    if places:
        away = min(
            float(scene.places.outline_distance(p, scene.xy(body)[x:y], on_road=True).min())
            for p in places
            for x, y, _ in whole or found
        )
        parts.append(graded(away <= 3.0, away <= AT_M[0], f'{away:.1f} m from {places[0]}'))
    return all_of(parts)


def _turns(case: Case, body: str, sign: float, targets: list[str]) -> Judged:
    scene = case.scene
    own = way(scene, body)
    marks = np.arange(0.0, float(own.own_m[-1]), 2.0)
    if len(marks) < 3:
        return does_not(f'{body} does not move')
    ticks = np.searchsorted(own.own_m, marks)
    ticks = np.minimum(ticks, len(own.own_m) - 1)
    heading = scene.heading(body)[ticks]
    angle = np.degrees(np.unwrap(np.arctan2(heading[:, 1], heading[:, 0]))) * sign
    span = round(TURN_WITHIN_M / 2.0)
    best = 0.0
    near = _near(case, body, targets, 25.0)[ticks] if targets else np.ones(len(ticks), dtype=bool)
    for i in range(len(angle)):
        later = angle[i : i + span]
        j = int(later.argmax())
        if near[i : i + j + 1].any():
            best = max(best, float(later[j] - angle[i]))
    side = 'left' if sign > 0 else 'right'
    why = f'{body} turns up to {best:.0f} degrees {side} within {TURN_WITHIN_M:.0f} m'
    return graded(TURN_DEG[0] <= best <= 150.0, best >= TURN_DEG[1], why)


def driven_speed(case: Case, requirement: Requirement, body: str) -> Judged:
    """Return whether a body drives at the annotated speed where nothing keeps it from that.

    No leader, no junction (so no signal either) within 50 m, not while it speeds up or slows, and
    not from an annotated action on.
    """
    rule = limits.WALKING if case.scene.is_person(body) else limits.SPEED
    asked = wanted(requirement, 'speed_mps', case.variation, rule)
    if asked is None:
        return holds('')
    scene, speed = case.scene, case.scene.speed(body)
    low, high = asked.low - asked.slack, asked.high + asked.slack
    good = (speed >= low) & (speed <= high)
    steady = (speed > limits.STARTED_MPS) & scene.present(body)
    steady &= np.abs(scene.acceleration(body)) < 0.3
    steady[_changed(case, body) :] = False
    # As with all that is stated with motion: it need not hold while UAVs land.
    steady[scene.tick(missions_end_s(scene)) :] = False
    free = steady & ~_held_up(case, body)
    top = float(speed.max())
    if free.sum() * scene.dt_s >= 1.0:
        ratio = share(good[free])
        middle = float(np.median(speed[free]))
        why = f'{body} at {asked.text()} m/s for {ratio:.1%} of its free way, median {middle:.2f}'
        reached = longest_s(good & steady, scene.dt_s) >= limits.STOPPED_S
        enough = ratio >= limits.SPEED_SHARE
        if asked.slack > 0.0 and not asked.counts(middle):
            return does_not(why)
        # The contract does not say whether a bend that nobody takes so fast, such as the loop at
        # the end of a street, is a junction.
        straight = free & ~_in_tight_bend(case, body, asked.low)
        told = max(ratio, share(good[straight]))
        return graded(enough, reached and told >= 0.5, why)
    reached_s = longest_s(good & steady, scene.dt_s)
    why = f'{body} is never free; at {asked.text()} m/s for {reached_s:.1f} s, fastest {top:.2f}'
    return graded(reached_s >= 5.0, True, why)


def _in_tight_bend(case: Case, body: str, speed_mps: float) -> BoolArray:
    """Return (ticks,) whether a bend too tight for a speed is within 50 m of way."""
    scene = case.scene
    heading, speed = scene.heading(body), scene.speed(body)
    sine = heading[:-1, 0] * heading[1:, 1] - heading[:-1, 1] * heading[1:, 0]
    turned = np.append(np.abs(np.arcsin(np.clip(sine, -1.0, 1.0))), 0.0)
    arc = np.concatenate([[0.0], np.cumsum(speed[:-1])]) * scene.dt_s
    # Over a length of way, so that a heading that jumps from one edge to the next is no bend.
    begin = np.searchsorted(arc, arc - BEND_OVER_M / 2.0)
    end = np.searchsorted(arc, arc + BEND_OVER_M / 2.0, side='right') - 1
    total = np.concatenate([[0.0], np.cumsum(turned)])
    curvature = (total[end] - total[begin]) / BEND_OVER_M
    tight = np.concatenate([[0], np.cumsum(speed_mps**2 * curvature > LATERAL_MPS2)])
    first = np.searchsorted(arc, arc - limits.FREE_AHEAD_M)
    last = np.searchsorted(arc, arc + limits.FREE_AHEAD_M, side='right')
    return np.asarray(tight[last] > tight[first])


def _changed(case: Case, body: str) -> int:
    """Return the tick from which an annotated action makes a body's speed another."""
    tick = case.scene.recording.ticks
    for event in case.annotation.flat():
        action: Mapping[str, object] = event.get('action') or {}
        if event['kind'] != 'event' or body not in case.bodies(action.get('agent')):
            continue
        if action.get('do') in ('brake', 'stop', 'slow', 'accelerate', 'yield'):
            start = happened(case, event).start_s
            if start is not None:
                tick = min(tick, case.scene.tick(start))
    return tick


def _held_up(case: Case, body: str) -> BoolArray:
    """Return (ticks,) whether somebody or a junction is within 50 m ahead."""
    key = ('held up', body)
    if key not in case.scene.memory:
        case.scene.memory[key] = _find_held_up(case, body)
    found = case.scene.memory[key]
    assert isinstance(found, np.ndarray)
    return found


def _find_held_up(case: Case, body: str) -> BoolArray:
    scene = case.scene
    xy, heading = scene.xy(body), scene.heading(body)
    held = np.zeros(len(xy), dtype=bool)

    def ahead(points: np.ndarray) -> BoolArray:
        delta = points - xy
        forward = np.einsum('ij,ij->i', delta, heading)
        beside = np.abs(heading[:, 0] * delta[:, 1] - heading[:, 1] * delta[:, 0])
        return np.asarray(
            (forward > 0.0) & (forward <= limits.FREE_AHEAD_M + 15.0) & (beside <= 15.0)
        )

    for spot in scene.places.spots('intersection'):
        if np.linalg.norm(xy - spot.xy, axis=1).min() <= limits.FREE_AHEAD_M + 20.0:
            held |= ahead(np.tile(spot.xy, (len(xy), 1)))
            held |= np.linalg.norm(xy - spot.xy, axis=1) <= 20.0
    for spot in scene.places.spots('crosswalk'):
        if not scene.is_person(body):
            near = np.linalg.norm(xy - spot.xy, axis=1)
            if near.min() <= limits.FREE_AHEAD_M + 20.0:
                held |= ahead(np.tile(spot.xy, (len(xy), 1)))
    for other in scene.bodies.values():
        if other.is_uav or other.body_id == body:
            continue
        held |= ahead(scene.xy(other.body_id)) & scene.present(other.body_id)
    return held
