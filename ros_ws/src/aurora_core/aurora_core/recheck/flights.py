# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by where a stated flight can be: sight, radio, separation, conditions, pursuit."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, stated

# What is looked at stands at most this high above the ground.
_TOP_OF_TARGET_M = 2.0


def _heights(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    number = mission['altitude_m']
    low, high = request.limit('uav_altitude_min_m'), request.limit('uav_altitude_max_m')
    return left_open(number, request.slack('altitude_m', number), low, high)


def _aside(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    number = mission.get('standoff_m')
    return left_open(number, request.slack('standoff_m', number) if number else 0.0)


def _straight(request: Request, mission: dict[str, Any]) -> tuple[float, float]:
    low, high = _heights(request, mission)
    near, far = _aside(request, mission)
    if mission.get('target') in _uavs(request):
        # It flies as well, and may be level with the other one or far above it.
        return near, math.sqrt(request.limit('uav_altitude_max_m') ** 2 + far**2)
    drop = max(0.0, low - _TOP_OF_TARGET_M)
    return math.sqrt(drop**2 + near**2), math.sqrt(high**2 + far**2)


def _uavs(request: Request) -> set[str]:
    return {u[key] for u in request.all('uavs') for key in ('id', 'group') if u.get(key)}


def _is_partial(condition: dict[str, Any]) -> bool:
    """Return whether a condition is asked of a share, a stretch or one moment only."""
    return any(condition.get(name) is not None for name in ('fraction', 'hold_s', 'by_s'))


def _same(proof: Certificate, limit: float) -> Step:
    return proof.limit == limit, f'{proof.limit_name} is {limit:g}'


def _asked(proof: Certificate, *numbers: Any) -> Step:
    values = [n['value'] for n in numbers if stated(n)]
    return proof.requested in values, f'{proof.requested:g} is stated' if (
        proof.requested is not None
    ) else 'a number is named'


def sensing(proof: Certificate, request: Request) -> list[Step]:
    """The camera does not reach the target from any place that the flight allows."""
    mission = request.one(proof.path)
    if mission is None or mission.get('target') is None or mission['mode'] == 'navigate':
        return [(False, f'{proof.path} looks at a target')]
    world = request.spec['world']
    reach = float(request.limits['sensing_range_m'][world['weather']])
    reach *= float(request.limits['sensing_factor'][world['time_of_day']])
    near, _ = _straight(request, mission)
    return [
        _same(proof, reach),
        _asked(proof, mission['altitude_m'], mission.get('standoff_m')),
        (near > reach, f'it is {near:.1f} m away at least, the camera reaches {reach:g} m'),
    ]


def radio(proof: Certificate, request: Request) -> list[Step]:
    """The two ends of a link stay out of its stated range in every phase."""
    parts = proof.path.split('/')
    link = request.one('/'.join(parts[:2])) if parts[-1] == 'range_m' else None
    if link is None or not stated(link.get('range_m')):
        return [(False, f'{proof.path} is a stated range')]
    ends = {link['sender'], link['receiver']}
    sends = any(
        (e.get('action') or {}).get('do') == 'send_message'
        and e['action']['sender'] == link['sender']
        and e['action']['receiver'] == link['receiver']
        for e in request.all('events')
    )
    reach = float(link['range_m']['value'])
    common: list[Step] = [
        _same(proof, reach),
        _asked(proof, link['range_m']),
        (sends, 'a message is to be sent over the link'),
        (link['range_m'].get('bound') != 'at_least', 'the range is not "at least"'),
    ]
    kept = _kept_apart(request, ends)
    if kept > reach:
        return [*common, (True, f'they are to stay {kept:g} m apart, it reaches {reach:g} m')]
    flown = [m for m in request.all('missions') if m['uav'] in ends]
    bound = bool(flown) and all(m.get('target') in ends for m in flown)
    near = min((_straight(request, m)[0] for m in flown), default=0.0)
    return [
        *common,
        (bound, 'in every phase one end flies at the other'),
        (near > reach, f'they are {near:.1f} m apart at least, the link reaches {reach:g} m'),
    ]


def _kept_apart(request: Request, ends: set[str]) -> float:
    """Return the greatest distance that a condition keeps between two, all the time."""
    return max(
        (
            float(c['value']['value'])
            for c in request.all('conditions')
            if c['quantity'] in ('distance', 'horizontal_distance', 'separation')
            and c['op'] in ('>', '>=')
            and set(c['of']) == ends
            and not _is_partial(c)
        ),
        default=0.0,
    )


def closeness(proof: Certificate, request: Request) -> list[Step]:
    """A condition asks for two UAVs closer than they may come."""
    parts = proof.path.split('/')
    condition = request.one('/'.join(parts[:2])) if parts[0] == 'conditions' else None
    if condition is None or condition['quantity'] != 'separation':
        return [(False, f'{proof.path} is about the separation')]
    least = request.limit('separation_min_m')
    value = float(condition['value']['value'])
    exact = condition['value'].get('bound', 'exactly') == 'exactly'
    upward = condition['op'] == '>=' and exact  # `2 m apart` asks for 2 m and no more
    return [
        _same(proof, least),
        _asked(proof, condition['value']),
        (set(condition['of']) <= _uavs(request), 'it is about UAVs'),
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
        _same(proof, least),
        _asked(proof, upper['altitude_m']),
        (fixed, 'its place beside the other is fixed'),
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
    free = _is_partial(condition)
    value, op = float(condition['value']['value']), condition['op']
    excluded = [
        (op in ('<', '<=') and low > value) or (op in ('>', '>=') and high < value)
        for low, high in _bands(condition, request)
    ]
    return [
        (not free, 'the condition is for the whole flight'),
        (any(excluded), f'{condition["quantity"]} {op} {value:g} m is out of reach of a flight'),
    ]


def _bands(condition: dict[str, Any], request: Request) -> list[tuple[float, float]]:
    bodies, quantity = set(condition['of']), condition['quantity']
    if quantity == 'altitude':
        return [_heights(request, m) for m in request.all('missions') if {m['uav']} == bodies]
    measured = {'distance': _straight, 'horizontal_distance': _aside}.get(quantity)
    if measured is None:
        return []
    return [
        measured(request, m)
        for m in request.all('missions')
        if m['mode'] != 'navigate' and {m['uav'], m.get('target')} == bodies
    ]


def pursuit(proof: Certificate, request: Request) -> list[Step]:
    """What is tracked is asked to be faster than UAVs fly."""
    parts = proof.path.split('/')
    mission = request.one('/'.join(parts[:2])) if parts[-1] == 'target' else None
    if mission is None or mission.get('mode') != 'track':
        return [(False, f'{proof.path} is the target of a pursuit')]
    top = request.limit('uav_speed_max_mps')
    agent = request.one(f'agents/{mission["target"]}') or {}
    speeds = [b['speed_mps'] for b in agent.get('behaviors', ()) if b.get('speed_mps')]
    slowest = [left_open(s, request.slack('route_speed_mps', s))[0] for s in speeds]
    slowing = [
        e
        for e in request.all('events')
        if (e.get('action') or {}).get('agent') == mission['target']
        and e['action']['do'] in ('brake', 'slow', 'stop', 'yield')
    ]
    return [
        (not slowing, 'no event makes it slower'),
        _same(proof, top),
        _asked(proof, *speeds),
        (
            any(low > top for low in slowest),
            f'{mission["target"]} drives at {max(slowest, default=0.0):g} m/s at least, '
            f'UAVs fly at most {top:g} m/s',
        ),
    ]


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
    always = not _is_partial(condition)
    return [
        _same(proof, most),
        _asked(proof, condition['value']),
        (unset, 'one of them tracks the other, from no stated standoff'),
        (always, 'it is asked of the whole time'),
        (
            condition['op'] in ('>', '>=', '==') and value > farthest,
            f'it asks for {condition["op"]} {value:g} m, tracking reaches {farthest:g} m',
        ),
    ]
