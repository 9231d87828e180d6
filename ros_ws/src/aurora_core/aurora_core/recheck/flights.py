# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by where a stated flight can be: sight, separation, conditions."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.operands import SLOWS, is_split
from aurora_core.recheck.request import Request, left_open, names_of, sent_to, stated
from aurora_core.recheck.zones import farthest, read_whole

# What is looked at stands at most this high above the ground.
TOP_OF_TARGET_M = 2.0
_AT = ('at', 'near', 'parked_at')
# From a landmark to the middle of whoever stands where the road to it ends, at most.
_ROAD_M = 160.0


def heights(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    floor, ceiling = request.limit('uav_altitude_min_m'), request.limit('uav_altitude_max_m')
    ranges = [
        left_open(number, request.slack('altitude_m', number), floor, ceiling)
        for number in (mission['altitude_m'], *sent_to(request, mission['uav']))
    ]
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def _aside(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    number = mission.get('standoff_m')
    return left_open(number, request.slack('standoff_m', number) if number else 0.0)


def straight(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    low, high = heights(request, mission)
    near, far = _aside(request, mission)
    if mission.get('target') in names_of(request, 'uavs'):
        # It flies as well, and may be level with the other one or far above it.
        return near, math.sqrt(request.limit('uav_altitude_max_m') ** 2 + far**2)
    drop = max(0.0, low - TOP_OF_TARGET_M)
    return math.sqrt(drop**2 + near**2), math.sqrt(high**2 + far**2)


def is_partial(condition: dict[str, Any]) -> bool:
    """Return whether a condition is asked of a share, a stretch or one moment only."""
    return any(condition.get(name) is not None for name in ('fraction', 'hold_s', 'by_s'))


def same(proof: Certificate, limit: float) -> Step:
    return proof.limit == limit, f'{proof.limit_name} is {limit:g}'


def asked(proof: Certificate, *numbers: Any) -> Step:
    values = [n['value'] for n in numbers if stated(n)]
    return proof.requested in values, f'{proof.requested:g} is stated' if (
        proof.requested is not None
    ) else 'a number is named'


def sensing(proof: Certificate, request: Request) -> list[Step]:
    """The camera does not reach the target from any place that the flight allows."""
    world = request.spec['world']
    reach = float(request.limits['sensing_range_m'][world['weather']])
    reach *= float(request.limits['sensing_factor'][world['time_of_day']])
    if proof.path.startswith('conditions/'):
        return [same(proof, reach), *_place_in_sight(proof, request, reach)]
    mission = request.one(proof.path)
    if mission is None or mission.get('target') is None or mission['mode'] == 'navigate':
        return [(False, f'{proof.path} looks at a target')]
    kept = _kept_off(request, mission)
    near = max(straight(request, mission)[0], _kept_straight(request, mission, kept))
    return [
        same(proof, reach),
        asked(
            proof, mission['altitude_m'], mission.get('standoff_m'), *(c['value'] for c in kept)
        ),
        (near > reach, f'it is {near:.1f} m away at least, the camera reaches {reach:g} m'),
    ]


def _kept_off(request: Request, mission: dict[str, Any]) -> list[dict[str, Any]]:
    """Return conditions on a UAV's height, or its distance from its target, all the time."""
    if is_split(request, {mission['uav']}):
        return []
    pair = {mission['uav'], mission['target']}
    flies = mission['target'] in names_of(request, 'uavs')
    return [
        c
        for c in request.all('conditions')
        if c['op'] in ('>', '>=') and not is_partial(c) and stated(c['value'])
        if (c['quantity'] in ('distance', 'horizontal_distance') and set(c['of']) == pair)
        or (c['quantity'] == 'altitude' and list(c['of']) == [mission['uav']] and not flies)
    ]


def _kept_straight(request: Request, mission: dict[str, Any], kept: list[dict[str, Any]]) -> float:
    """Return the least straight distance that conditions leave to the target of a phase."""

    def most(quantity: str, otherwise: float) -> float:
        values = [float(c['value']['value']) for c in kept if c['quantity'] == quantity]
        return max([otherwise, *values])

    up = 0.0
    if mission['target'] not in names_of(request, 'uavs'):
        up = max(0.0, most('altitude', heights(request, mission)[0]) - TOP_OF_TARGET_M)
    aside = most('horizontal_distance', _aside(request, mission)[0])
    # A distance is measured to the ground, sight to the middle of a body.
    return max(most('distance', 0.0) - TOP_OF_TARGET_M, math.sqrt(up**2 + aside**2))


def _place_in_sight(proof: Certificate, request: Request, reach: float) -> list[Step]:
    """A landmark is to be seen from hovers at landmarks that are all too far away."""
    condition = request.one(proof.path)
    if condition is None or not str(condition.get('quantity')).startswith('visible_'):
        return [(False, f'{proof.path} is about what is seen')]
    observer, target = condition['of']
    flown = [m for m in request.all('missions') if m['uav'] == observer]
    away = [_along_ground(request, m, target)[0] for m in flown] or [0.0]
    seen = condition['op'] in ('>', '>=', '==') and float(condition['value']['value']) > 0.0
    return [
        asked(proof, condition['value']),
        (seen and stated(condition['value']), f'{target} is to be seen'),
        *(read_whole(request, m) for m in flown),
        (min(away) > reach, f'{observer} is {min(away):.1f} m from {target} at least'),
    ]


def _stands_at(request: Request, target: str) -> tuple[str, float]:
    """Return the landmark that something is at, and how far from it that may be."""
    agent = request.one(f'agents/{target}')
    actions = [e.get('action') or {} for e in request.all('events')]
    if agent is None or any(a.get('agent') == target for a in actions):
        return target, 0.0
    if [b['kind'] for b in agent.get('behaviors', ())] != ['park']:
        return '', 0.0
    places = [p for p in agent.get('placements', ()) if p['relation'] in _AT]
    # Whoever is at a place or near it is near the end of the road to it.
    beside = float(request.tolerances['near_m']) + _ROAD_M
    return next(((p['of'], beside) for p in places if p.get('of')), ('', 0.0))


def _along_ground(request: Request, mission: dict[str, Any], target: str) -> tuple[float, float]:
    """Return the least and greatest way from a hover at a landmark to what is at another one."""
    marks, (place, aside) = request.landmarks(), _stands_at(request, target)
    centre, seen = marks.get(mission.get('target') or ''), marks.get(place)
    if centre is None or seen is None or mission['mode'] != 'hover':
        return 0.0, math.inf
    apart, either = math.dist(centre, seen), farthest(request, mission) + aside
    return max(0.0, apart - either), apart + either


def closeness(proof: Certificate, request: Request) -> list[Step]:
    """A condition asks for two UAVs closer than they may come."""
    parts = proof.path.split('/')
    condition = request.one('/'.join(parts[:2])) if parts[0] == 'conditions' else None
    if condition is None or condition['quantity'] not in ('separation', 'distance'):
        return [(False, f'{proof.path} is about the separation')]
    least = request.limit('separation_min_m')
    value = float(condition['value']['value'])
    exact = condition['value'].get('bound', 'exactly') == 'exactly'
    # `2 m apart` asks for 2 m and no more.
    upward = condition['quantity'] == 'separation' and condition['op'] == '>=' and exact
    return [
        same(proof, least),
        asked(proof, condition['value']),
        (set(condition['of']) <= names_of(request, 'uavs'), 'it is about UAVs'),
        (
            (condition['op'] in ('<', '<=', '==') or upward) and value < least,
            f'it asks for {condition["op"]} {value:g} m, at least {least:g} m are kept',
        ),
    ]


def stacking(proof: Certificate, request: Request) -> list[Step]:
    """A UAV is to fly over another one, closer than two may come."""
    parts = proof.path.split('/')
    upper = request.one('/'.join(parts[:2])) if parts[0] == 'missions' else None
    if upper is None or not stated(upper['altitude_m']):
        return [(False, f'{proof.path} is a stated altitude')]
    least = request.limit('separation_min_m')
    aside = upper.get('standoff_m')
    # A place that nothing states can be chosen; hovering over something is a place.
    above = aside is None and upper['mode'] == 'hover'
    away = 0.0 if above else left_open(aside, 0.0)[1]
    fixed = math.isfinite(away)
    low, high = left_open(upper['altitude_m'], 0.0)
    gaps = []
    for other in (m for m in request.all('missions') if m['uav'] == upper.get('target')):
        floor, ceiling = left_open(other['altitude_m'], 0.0)
        gaps.append(math.hypot(max(abs(high - floor), abs(ceiling - low)), away))
    return [
        same(proof, least),
        asked(proof, upper['altitude_m']),
        (fixed, 'its place beside the other is fixed'),
        (
            not any(sent_to(request, uav) for uav in (upper['uav'], upper.get('target'))),
            'no event sends either of them to another height',
        ),
        (
            bool(gaps) and max(gaps) < least,
            f'the two may be {max(gaps, default=math.inf):g} m apart, {least:g} m are kept',
        ),
    ]


def flight_band(proof: Certificate, request: Request) -> list[Step]:
    """A stated condition leaves no value that a stated flight can have."""
    condition = request.one(proof.path)
    if condition is None or condition.get('quantity') is None:
        return [(False, f'{proof.path} is a condition')]
    free = is_partial(condition)
    value, op = float(condition['value']['value']), condition['op']
    excluded = [
        (op in ('<', '<=') and low > value) or (op in ('>', '>=') and high < value)
        for low, high in _bands(condition, request)
    ]
    return [
        (not free and stated(condition['value']), 'the condition is for the whole flight'),
        (
            bool(excluded) and all(excluded),
            f'{condition["quantity"]} {op} {value:g} is out of reach of every phase and drive',
        ),
    ]


def _bands(condition: dict[str, Any], request: Request) -> list[tuple[float, float]]:
    bodies, quantity = set(condition['of']), condition['quantity']
    if quantity == 'altitude':
        return [heights(request, m) for m in request.all('missions') if {m['uav']} == bodies]
    if quantity == 'speed':
        return _speeds(condition, request)
    if quantity not in ('distance', 'horizontal_distance'):
        return []
    found = []
    for mission in (m for m in request.all('missions') if m['uav'] in bodies):
        (other,) = bodies - {mission['uav']}
        watched = mission['mode'] != 'navigate' and mission.get('target') == other
        flies = other in names_of(request, 'uavs')
        if flies and not watched:
            continue
        near, far = (0.0, math.inf) if flies else _along_ground(request, mission, other)
        if not read_whole(request, mission)[0]:
            near, far = 0.0, math.inf
        if watched:
            beside = _aside(request, mission)
            near, far = max(near, beside[0]), min(far, beside[1])
        if quantity == 'horizontal_distance':
            found.append((near, far))
        elif flies:
            found.append(straight(request, mission))
        else:
            # It is on the ground, wherever it is.
            low, high = heights(request, mission)
            found.append((math.hypot(max(0.0, low - TOP_OF_TARGET_M), near),
                          math.hypot(high, far)))  # fmt: skip
    return found


def _speeds(condition: dict[str, Any], request: Request) -> list[tuple[float, float]]:
    """Return the stated speeds of a route or a drive, which hold for most of it."""
    (name,) = condition['of']
    if is_split(request, {name}):
        return []
    numbers = [
        m['speed_mps']
        for m in request.all('missions')
        if m['uav'] == name and m['mode'] == 'navigate' and stated(m.get('speed_mps'))
    ]
    agent = request.one(f'agents/{name}')
    if agent is not None and condition['op'] in ('<', '<='):
        behaviors = agent.get('behaviors', ())
        if not any(b['kind'] in SLOWS for b in behaviors):
            numbers += [b['speed_mps'] for b in behaviors if stated(b.get('speed_mps'))]
    return [left_open(n, request.slack('route_speed_mps', n)) for n in numbers]


def afar(proof: Certificate, request: Request) -> list[Step]:
    """A condition keeps a tracked target farther away than any standoff, at all times."""
    parts = proof.path.split('/')
    condition = request.one('/'.join(parts[:2])) if parts[0] == 'conditions' else None
    if condition is None or condition['quantity'] != 'horizontal_distance':
        return [(False, f'{proof.path} is about a horizontal distance')]
    most = request.limit('uav_standoff_max_m')
    farthest = most + request.limit('tracking_horizontal_m')
    value = float(condition['value']['value'])
    tracked = [
        m
        for m in request.all('missions')
        if m['mode'] == 'track' and [m['uav'], m.get('target')] == list(condition['of'])
    ]
    unset = bool(tracked) and not any(stated(m.get('standoff_m')) for m in tracked)
    always = not is_partial(condition)
    return [
        same(proof, most),
        asked(proof, condition['value']),
        (unset, 'one of them tracks the other, from no stated standoff'),
        (always, 'it is asked of the whole time'),
        (
            condition['op'] in ('>', '>=', '==')
            and (value > farthest or (value == farthest and condition['op'] == '>')),
            f'it asks for {condition["op"]} {value:g} m, tracking reaches {farthest:g} m',
        ),
    ]
