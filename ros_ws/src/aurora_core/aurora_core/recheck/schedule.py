# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by time: battery, deadlines, the stated duration, and orders."""

from __future__ import annotations

from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, stated


def _soonest(request: Request, number: Any) -> float:
    return left_open(number, request.slack('duration_s', number))[0] if number else 0.0


def _of_uav(request: Request, uav: str) -> list[dict[str, Any]]:
    return [m for m in request.all('missions') if m['uav'] == uav]


def _in_flight(request: Request, uav: str) -> float:
    return sum(_soonest(request, m.get('duration_s')) for m in _of_uav(request, uav))


def _height(request: Request, mission: dict[str, Any]) -> float:
    stated_m = mission['altitude_m']
    return left_open(stated_m, request.slack('altitude_m', stated_m))[0]


def _is_sent_elsewhere(request: Request, uav: str) -> bool:
    """An event may end its phases before their time."""
    actions = [e.get('action') or {} for e in request.all('events')]
    return any(a.get('uav') == uav for a in actions)


def _until_done(request: Request, uav: str, last: str | None = None) -> float:
    """Climb to the first phase, and all phases up to the last one."""
    flown = _of_uav(request, uav)
    if not flown or _is_sent_elsewhere(request, uav):
        return 0.0
    total = _height(request, flown[0]) / request.limit('uav_climb_max_mps')
    for mission in flown:
        total += _soonest(request, mission.get('duration_s'))
        if mission['id'] == last:
            break
    return total


def _until_landed(request: Request, uav: str) -> float:
    """Climb to the first phase, all phases, descent from the last one."""
    flown = _of_uav(request, uav)
    if not flown:
        return 0.0
    down = _height(request, flown[-1]) / request.limit('uav_descent_max_mps')
    return _until_done(request, uav) + down


def event_times(request: Request) -> dict[str, float]:
    """Return a time before which each event cannot happen.

    All start at zero and are raised as often as there are events: each value on the way is a
    lower bound, and a chain without a circle is followed to its end.
    """
    events = request.all('events')
    times = {e['id']: 0.0 for e in events}
    for _ in events:
        times = {
            e['id']: max(_caused(request, e, times), _put_behind(request, e, times))
            for e in events
        }
    return times


def _caused(request: Request, event: dict[str, Any], times: dict[str, float]) -> float:
    cause = _cause(request, event.get('trigger') or {}, times)
    return cause + _soonest(request, event.get('delay_s'))


def _put_behind(request: Request, event: dict[str, Any], times: dict[str, float]) -> float:
    """What an order puts in front of an event is over before it."""
    uavs = {m['id']: m['uav'] for m in request.all('missions')}
    ahead = [o['first'] for o in request.all('orders') if o['then'] == event['id']]
    ends = [
        _until_done(request, uavs[one], one) if one in uavs else times.get(one, 0.0)
        for one in ahead
    ]
    return max(ends, default=0.0)


def _cause(request: Request, trigger: dict[str, Any], times: dict[str, float]) -> float:
    on = trigger.get('on')
    if on == 'time':
        return _soonest(request, trigger['at_s'])
    if on == 'event_done':
        return times.get(trigger['event'], 0.0) + _soonest(request, trigger.get('after_s'))
    if on == 'altitude_reached':
        return left_open(trigger['value_m'], 0.0)[0] / request.limit('uav_climb_max_mps')
    if on == 'mission_done':
        return _until_done(request, trigger['uav'])
    if on == 'message_received':
        return _first_message(request, times, None, trigger['by'])
    return 0.0


def _first_message(
    request: Request, times: dict[str, float], sender: str | None, receiver: str
) -> float:
    sent = [
        times[e['id']]
        for e in request.all('events')
        if (e.get('action') or {}).get('do') == 'send_message'
        and e['action']['receiver'] == receiver
        and sender in (None, e['action']['sender'])
    ]
    return min(sent, default=0.0)


def battery(proof: Certificate, request: Request) -> list[Step]:
    """The stated phases of a UAV last longer together than its battery."""
    kind, _, uav = proof.path.partition('/')
    phases = [m['duration_s'] for m in _of_uav(request, uav) if stated(m.get('duration_s'))]
    # "at most 700 s" may be nothing at all.
    total = sum(float(p['value']) for p in phases if p.get('bound') != 'at_most')
    most = request.limit('uav_endurance_s')
    return [
        (kind == 'uavs' and bool(phases), f'{proof.path} has stated phases'),
        (proof.limit == most, f'{proof.limit_name} is {most:g}'),
        (proof.requested in [p['value'] for p in phases], f'{proof.requested} is a phase of it'),
        (total > most, f'they last {total:g} s together, {most:g} s are possible'),
    ]


def deadline(proof: Certificate, request: Request) -> list[Step]:
    """What a condition asks for cannot be done by its deadline."""
    condition = request.one(proof.path)
    if condition is None or condition.get('quantity') is None:
        return [(False, f'{proof.path} is a condition')]
    quantity, of, op = condition['quantity'], condition['of'], condition['op']
    value, due = float(condition['value']['value']), condition.get('by_s')
    needed = 0.0
    if quantity == 'event_time' and op in ('<', '<='):
        due, needed = condition['value'], event_times(request).get(of[0], 0.0)
    elif quantity == 'altitude' and op in ('>', '>='):
        needed = value / request.limit('uav_climb_max_mps')
    elif quantity in ('landed', 'mission_completed') and value > 0.0:
        needed = _until_landed(request, of[0])
    elif quantity in ('delivered', 'delivery_latency') and len(of) == 2:
        needed = _first_message(request, event_times(request), *of)
    if not stated(due):
        return [(False, f'{proof.path} has a stated deadline')]
    last = float(due['value'])
    return [(needed > last, f'it needs {needed:.1f} s at least, and is due at {last:g} s')]


def horizon(proof: Certificate, request: Request) -> list[Step]:
    """Something needs longer than the scenario is to last."""
    last = (request.spec.get('world') or {}).get('duration_s')
    if not stated(last):
        return [(False, 'the duration of the scenario is stated')]
    kind, _, name = proof.path.partition('/')
    needed = 0.0
    if kind == 'events':
        needed = event_times(request).get(name, 0.0)
    elif kind == 'uavs':
        needed = _in_flight(request, name)
    end = float(last['value'])
    return [(needed > end, f'{proof.path} needs {needed:.1f} s at least, there are {end:g} s')]


def _circle(event: str, request: Request) -> Step:
    """Follow the causes back: whoever waits for itself never happens."""
    waits = {
        e['id']: e['trigger']['event']
        for e in request.all('events')
        if (e.get('trigger') or {}).get('on') == 'event_done'
    }
    at: str | None = event
    for _ in waits:
        at = waits.get(at or '')
        if at == event:
            return True, f'{event} waits for itself'
    return False, f'{event} waits for itself'


def order(proof: Certificate, request: Request) -> list[Step]:
    """What is to come first comes second by other orders, or by the stated times."""
    one = request.one(proof.path)
    if one is not None and proof.path.startswith('events/'):
        return [_circle(proof.path.split('/')[1], request)]
    if one is None or 'then' not in one:
        return [(False, f'{proof.path} is an order')]
    first, then = one['first'], one['then']
    behind = {then}
    for _ in request.all('orders'):
        behind |= {o['then'] for o in request.all('orders') if o['first'] in behind}
    event = request.one(f'events/{then}') or {}
    at = (event.get('trigger') or {}).get('at_s')
    late = False
    if at is not None:
        # An event at a stated time happens inside the tolerance of that time.
        delay = event.get('delay_s')
        latest = left_open(at, request.slack('duration_s', at))[1]
        latest += left_open(delay, request.slack('duration_s', delay))[1] if delay else 0.0
        late = event_times(request).get(first, 0.0) > latest
    circle = first in behind
    text = 'the orders run in a circle' if circle else 'the stated times put it behind'
    return [(circle or late, f'{first} before {then}: {text}')]
