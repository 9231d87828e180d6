# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by a link whose two ends are out of its range as long as a message may pass."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.bounds import is_whole
from aurora_core.recheck.finding import Step
from aurora_core.recheck.flights import TOP_OF_TARGET_M, asked, heights, same, straight
from aurora_core.recheck.request import Request, left_open, names_of, stated


def radio(proof: Certificate, request: Request) -> list[Step]:
    """The two ends of a link stay out of its range, or the sender is too far while it sends."""
    parts = proof.path.split('/')
    link = request.one('/'.join(parts[:2])) if parts[-1] == 'range_m' else None
    if link is None:
        return [(False, f'{proof.path} is a range')]
    pair = [link['sender'], link['receiver']]
    sending = [
        e
        for e in request.all('events')
        if (e.get('action') or {}).get('do') == 'send_message'
        and [e['action']['sender'], e['action']['receiver']] == pair
    ]
    number = link.get('range_m')
    reach = request.limit('link_range_sight_m') if number is None else float(number['value'])
    kept, numbers = 0.0, [number]
    for condition in _keeping_apart(request, set(pair)):
        kept = max(kept, float(condition['value']['value']))
        numbers += [condition['value']] if number is None else []
    common: list[Step] = [
        same(proof, reach),
        asked(proof, *numbers),
        (bool(sending), 'a message is to be sent over the link'),
        (not _is_to_fail(request, set(pair)), 'it is to arrive'),
        (number is None or stated(number), 'the range is stated, or that of the limits'),
        ((number or {}).get('bound') != 'at_least', 'the range is not "at least"'),
    ]
    if kept > reach:
        return [*common, (True, f'they are to stay {kept:g} m apart, it reaches {reach:g} m')]
    near = max((_near(request, link, event) for event in sending), default=0.0)
    return [
        *common,
        (near > reach, f'they are {near:.1f} m apart at least, the link reaches {reach:g} m'),
    ]


def _is_to_fail(request: Request, ends: set[str]) -> bool:
    return any(
        c['quantity'] == 'delivered' and set(c['of']) == ends and not c['value']['value']
        for c in request.all('conditions')
    )


def _keeping_apart(request: Request, ends: set[str]) -> list[dict[str, Any]]:
    """Return the conditions that keep two on the ground away from each other, all the time."""
    if ends & names_of(request, 'uavs'):
        return []  # asked of its missions, and a UAV sends while it lands, too
    return [
        c
        for c in request.all('conditions')
        if c['quantity'] in ('distance', 'horizontal_distance', 'separation')
        and c['op'] in ('>', '>=')
        and set(c['of']) == ends
        and is_whole(c)
        and stated(c['value'])
    ]


def _near(request: Request, link: dict[str, Any], event: dict[str, Any]) -> float:
    """Return how near a sender is to the receiver at least until its last attempt."""
    sender, receiver = link['sender'], link['receiver']
    flown = [m for m in request.all('missions') if m['uav'] == sender]
    trigger = event.get('trigger') or {}
    own_height = trigger.get('on') == 'altitude_reached' and trigger.get('uav') == sender
    if not flown or own_height:
        return 0.0
    late = _late(request, link, event, flown)
    return min(_at_mission(request, m, flown[-1], receiver, late) for m in flown)


def _at_mission(
    request: Request,
    mission: dict[str, Any],
    last: dict[str, Any],
    receiver: str,
    late: float,
) -> float:
    follows = mission['mode'] == 'track' and mission.get('target') == receiver
    if follows and late <= 0.0:
        return straight(request, mission)[0]
    if receiver in names_of(request, 'uavs'):
        return 0.0
    sinks = request.limit('uav_descent_max_mps') * (1.0 + request.tolerances['limit_margin'])
    up_there = last.get('ends_in_flight') and not _sent(request, mission['uav'])
    sunk = 0.0 if up_there or late <= 0.0 else late * sinks
    return max(0.0, heights(request, mission)[0] - sunk - TOP_OF_TARGET_M)


def _sent(request: Request, uav: str) -> bool:
    """Whether an event gives a UAV something else to do than what it begins with."""
    own = [m['id'] for m in request.all('missions') if m['uav'] == uav]
    actions = [e.get('action') or {} for e in request.all('events')]
    return any(a.get('uav') == uav and [a.get('mission')] != own for a in actions)


def _late(
    request: Request, link: dict[str, Any], event: dict[str, Any], flown: list[dict[str, Any]]
) -> float:
    """Return by how much a message may be later than the end of the last mission, in seconds."""
    trigger = event.get('trigger') or {}
    if trigger.get('on') != 'time' or _sent(request, link['sender']):
        return math.inf
    tolerances, last = request.tolerances, float(request.tolerances['event_delay_s'])
    for number in (trigger['at_s'], event.get('delay_s')):
        if number is not None:
            last += left_open(number, request.slack('duration_s', number))[1]
    tries, gap = link['retransmissions'], link['retransmission_interval_s']
    again = float(tries['high']) * float(gap['high']) if stated(tries) or stated(gap) else 0.0
    last += max(float(tolerances['delivery_s']), again)
    height = flown[0]['altitude_m']
    over = left_open(height, request.slack('altitude_m', height))[0]
    over /= request.limit('uav_climb_max_mps')
    for number in (m.get('duration_s') for m in flown):
        if stated(number):
            over += left_open(number, request.slack('duration_s', number))[0]
        elif number is not None:
            over += float(number['low'])
    return last - over
