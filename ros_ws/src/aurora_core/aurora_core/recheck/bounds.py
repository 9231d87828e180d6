# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by conditions: bounds that exclude each other, a hover that moves, sight, latency."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

from aurora_core.outcomes.feasibility import Certificate, FactSource
from aurora_core.recheck.finding import Step
from aurora_core.recheck.operands import is_split
from aurora_core.recheck.request import Request, left_open, names_of, stated

_UP = ('>', '>=')
_DOWN = ('<', '<=')


def is_whole(condition: dict[str, Any]) -> bool:
    """Whether a condition is asked of all the time."""
    return all(condition.get(name) is None for name in ('fraction', 'hold_s', 'by_s'))


def bounds(proof: Certificate, request: Request) -> list[Step]:
    """Two conditions that the proof names leave no common value, and each holds long enough."""
    ids = {
        f.path.split('/')[1]
        for f in proof.facts
        if f.source is FactSource.REQUEST and f.path.startswith('conditions/')
    }
    ids.add(proof.path.rpartition('/')[2])
    named = [c for c in request.all('conditions') if c['id'] in ids]
    among = any(f'conditions/{c["id"]}' == proof.path for c in named)
    clash = any(_exclude(request, a, b) for a, b in combinations(named, 2))
    return [
        (among and len(named) == 2, 'it names two conditions'),
        (clash, ' and '.join(_words(c) for c in named) + ' exclude each other'),
    ]


def _words(condition: dict[str, Any]) -> str:
    of = ', '.join(condition['of'])
    return f'{condition["quantity"]} of {of} {condition["op"]} {condition["value"]["value"]:g}'


def _exclude(request: Request, one: dict[str, Any], other: dict[str, Any]) -> bool:
    below = [c for c in (one, other) if c['op'] in _DOWN]
    above = [c for c in (one, other) if c['op'] in _UP]
    if len(below) != 1 or len(above) != 1:
        return False
    low, high = above[0], below[0]
    if not (stated(low['value']) and stated(high['value'])):
        return False
    if any(c.get(name) is not None for c in (low, high) for name in ('hold_s', 'by_s')):
        return False
    if is_split(request, {*low['of'], *high['of']}) or not _comparable(request, low, high):
        return False
    shares = [float((c.get('fraction') or {'value': 1.0})['value']) for c in (low, high)]
    least, most = float(low['value']['value']), float(high['value']['value'])
    touching = least == most and '=' not in low['op'] + high['op']
    half_open = least == most and (low['op'] == '>' or high['op'] == '<')
    return sum(shares) > 1.0 and (least > most or touching or half_open)


def _comparable(request: Request, low: dict[str, Any], high: dict[str, Any]) -> bool:
    """Whether what is to be at least so much can be no more than what is to be at most so much."""
    same = low['quantity'] == high['quantity']
    if same and low['quantity'] in ('distance', 'horizontal_distance', 'separation'):
        return set(low['of']) == set(high['of'])
    if same:
        return bool(list(low['of']) == list(high['of']) and low['quantity'] != 'event_time')
    if high['quantity'] != 'distance':
        return False
    if low['quantity'] == 'horizontal_distance':
        return set(low['of']) == set(high['of'])
    others = set(high['of']) - set(low['of'])
    beside = low['quantity'] == 'altitude' and set(low['of']) < set(high['of'])
    return beside and not others & names_of(request, 'uavs')


def still(proof: Certificate, request: Request) -> list[Step]:
    """Who only hovers over places is asked to be fast all the time."""
    condition = request.one(proof.path)
    if condition is None or condition.get('quantity') != 'speed':
        return [(False, f'{proof.path} is about a speed')]
    uav = condition['of'][0]
    flown = [m for m in request.all('missions') if m['uav'] == uav]
    bodies = names_of(request, 'uavs') | names_of(request, 'agents')
    hovers = all(m['mode'] == 'hover' and m.get('target') not in bodies for m in flown)
    least = float(request.tolerances['route_speed_mps']['absolute'])
    value = float(condition['value']['value'])
    return [
        (bool(flown) and hovers, f'{uav} hovers over places and does nothing else'),
        (not _is_sent(request, uav), f'no event gives {uav} something else to do'),
        (is_whole(condition), 'the speed is asked of all the time'),
        (
            stated(condition['value']) and condition['op'] in (*_UP, '==') and value > least,
            f'{condition["op"]} {value:g} m/s is asked; {least:g} m/s may be missed',
        ),
    ]


def _is_sent(request: Request, uav: str) -> bool:
    return any((e.get('action') or {}).get('uav') == uav for e in request.all('events'))


def watch(proof: Certificate, request: Request) -> list[Step]:
    """More time of sight, or a longer stretch, than there is in the phases or the scenario."""
    parts = proof.path.split('/')
    condition = request.one('/'.join(parts[:2])) if parts[0] == 'conditions' else None
    field = parts[-1]
    if condition is None or field not in ('value', 'hold_s'):
        return [(False, f'{proof.path} is a time that a condition needs')]
    need = condition.get(field)
    if not stated(need) or need.get('bound') == 'at_most':
        return [(False, f'{proof.path} is stated')]
    seen = condition['quantity'] == 'visible_time' and condition['op'] in (*_UP, '==')
    room = left_open((request.spec.get('world') or {}).get('duration_s'), 0.0)[1]
    if field == 'value':
        room = min(room, _phases(request, condition['of'][0]))
    elif seen:
        return [(False, 'a time of sight is compared by its value')]
    seconds = float(need['value'])
    return [
        (field == 'hold_s' or seen, 'it is a time of sight, or a stretch'),
        (seconds > room, f'{seconds:g} s are needed, {room:g} s are there at most'),
    ]


def _phases(request: Request, observer: str) -> float:
    flown = [m for m in request.all('missions') if m['uav'] == observer]
    if not flown or _is_sent(request, observer):
        return math.inf
    total = 0.0
    for mission in flown:
        duration = mission.get('duration_s')
        if mission['mode'] == 'navigate' or not stated(duration):
            return math.inf
        total += left_open(duration, request.slack('duration_s', duration))[1]
    return total


def latency(proof: Certificate, request: Request) -> list[Step]:
    """A message is due before the stated latency of its link has passed."""
    condition = request.one(proof.path)
    if condition is None or condition.get('quantity') != 'delivery_latency':
        return [(False, f'{proof.path} is about a latency')]
    due = float(condition['value']['value'])
    links = [
        k
        for k in request.all('links')
        if [k['sender'], k['receiver']] == list(condition['of']) and stated(k['latency_s'])
    ]
    least = max(
        (float(k['latency_s']['value']) for k in links
         if k['latency_s'].get('bound') != 'at_most'),
        default=0.0,
    )  # fmt: skip
    return [
        (stated(condition['value']) and condition['op'] in (*_DOWN, '=='), 'it is due by a time'),
        (due < least, f'it is due after {due:g} s, the link takes {least:g} s'),
    ]
