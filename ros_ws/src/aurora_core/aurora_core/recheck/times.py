# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds on times, derived again from the specification as plain JSON.

Time points have the names of the certificate (`outcomes.feasibility.TimeBound`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from aurora_core.outcomes.feasibility import BoundKind as Kind
from aurora_core.recheck.request import Request, left_open, stated
from aurora_core.recheck.zones import farthest

_UP = ('>', '>=', '==')
_DOWN = ('<', '<=', '==')


@dataclass(frozen=True, slots=True)
class Derived:
    """`later` comes from `least_s` to `most_s` after `earlier`, because of an element."""

    kind: Kind
    of: str
    earlier: str
    later: str
    least_s: float = -math.inf
    most_s: float = math.inf


def derived(request: Request) -> Iterator[Derived]:
    """Yield every bound that may stand in a proof."""
    for event in request.all('events'):
        yield from _event(request, event)
    for uav in request.all('uavs'):
        yield Derived(Kind.START, f'uavs/{uav["id"]}', 'start', f'uavs/{uav["id"]}/takeoff', 0.0)
        missions = [m for m in request.all('missions') if m['uav'] == uav['id']]
        if missions:
            yield from _flight(request, uav['id'], missions)
    for order in request.all('orders'):
        yield from _order(request, order)
    for condition in request.all('conditions'):
        yield from _condition(request, condition)
    yield from _whole(request)


def _seconds(request: Request, number: Any) -> tuple[float, float]:
    """Return what a wait may last; where there is none it lasts no time."""
    if not number:
        return 0.0, 0.0
    return left_open(number, request.slack('duration_s', number))


def _event(request: Request, event: dict[str, Any]) -> Iterator[Derived]:
    of = f'events/{event["id"]}'
    trigger, action = event.get('trigger') or {}, event.get('action') or {}
    at, delay = f'{of}/trigger', event.get('delay_s') if action else None
    shortest, longest = _seconds(request, delay)
    yield Derived(Kind.START, of, 'start', at, 0.0)
    yield Derived(Kind.DELAY, of, at, of, shortest)
    yield Derived(Kind.END, of, of, f'{of}/done', 0.0, math.inf if action else 0.0)
    if trigger and action.get('do') != 'change_lane':
        deadline = (delay or {}).get('bound') == 'at_most'
        spare = 0.0 if deadline or not action else float(request.tolerances['event_delay_s'])
        yield Derived(Kind.SOON, of, at, of, most_s=longest + spare)
    yield from _trigger(request, event, trigger)
    if action.get('do') == 'send_message':
        sender = action['sender']
        climbs = trigger.get('on') == 'altitude_reached' and trigger.get('uav') == sender
        if not climbs and any(m['uav'] == sender for m in request.all('missions')):
            yield Derived(Kind.ALOFT, of, f'uavs/{sender}/up', of, 0.0)


def _trigger(
    request: Request, event: dict[str, Any], trigger: dict[str, Any]
) -> Iterator[Derived]:
    of = f'events/{event["id"]}'
    at, on = f'{of}/trigger', trigger.get('on')
    if on == 'time':
        first, last = _seconds(request, trigger['at_s'])
        delay = event.get('delay_s')
        yield Derived(Kind.TIME, of, 'start', at, first)
        if stated(trigger['at_s']):
            yield Derived(Kind.TIME, of, 'start', of, most_s=last + _seconds(request, delay)[1])
    elif on == 'event_done':
        first, last = _seconds(request, trigger.get('after_s'))
        yield Derived(Kind.CAUSE, of, f'events/{trigger["event"]}/done', at, first, last)
    elif on == 'event_begun':
        first, _ = _seconds(request, trigger.get('after_s'))
        yield Derived(Kind.CAUSE, of, f'events/{trigger["event"]}', at, first)
    elif on == 'altitude_reached':
        height = left_open(trigger['value_m'], 0.0)[0]
        up_s = height / request.limit('uav_climb_max_mps')
        yield Derived(Kind.CLIMB, of, f'uavs/{trigger["uav"]}/takeoff', at, up_s)
    elif on == 'message_received':
        sent = [
            e['id']
            for e in request.all('events')
            if e['id'] != event['id']
            and (e.get('action') or {}).get('do') == 'send_message'
            and e['action']['receiver'] == trigger['by']
            and trigger.get('sender') in (None, e['action']['sender'])
        ]
        if len(sent) == 1:
            yield Derived(Kind.MESSAGE, of, f'events/{sent[0]}', at, 0.0)
    elif on in ('visible', 'occluded'):
        if any(m['uav'] == trigger['observer'] for m in request.all('missions')):
            yield Derived(Kind.SIGHT, of, f'uavs/{trigger["observer"]}/up', at, 0.0)
    elif on == 'mission_done':
        own = [m['id'] for m in request.all('missions') if m['uav'] == trigger['uav']]
        if own and not _is_sent_elsewhere(request, trigger['uav'], own[0]):
            yield Derived(Kind.DONE, of, f'missions/{own[-1]}/over', at, 0.0)


def _is_sent_elsewhere(request: Request, uav: str, first: str) -> bool:
    """An event may end its phases before their time; one that begins the first cannot."""
    actions = [e.get('action') or {} for e in request.all('events')]
    return any(
        a.get('uav') == uav and not (a['do'] == 'change_mission' and a.get('mission') == first)
        for a in actions
    )


def _lowest_m(request: Request, mission: dict[str, Any]) -> float:
    height = mission['altitude_m']
    return left_open(height, request.slack('altitude_m', height))[0]


def _flight(request: Request, uav: str, missions: list[dict[str, Any]]) -> Iterator[Derived]:
    of, last = f'uavs/{uav}', missions[-1]
    free = _is_sent_elsewhere(request, uav, missions[0]['id'])
    before = f'{of}/up'
    up_m = 0.0 if free else _lowest_m(request, missions[0])
    down_m = 0.0 if free else _lowest_m(request, last)
    down_m = max(0.0, down_m - float(request.tolerances['touchdown_height_m']))
    up_s = up_m / request.limit('uav_climb_max_mps')
    down_s = down_m / request.limit('uav_descent_max_mps')
    yield Derived(Kind.CLIMB, of, f'{of}/takeoff', before, up_s)
    for k, mission in enumerate(missions):
        name = f'missions/{mission["id"]}'
        if k > 0 and not free:
            way_s = _between(request, missions[k - 1], mission)
            yield Derived(Kind.WAY, name, before, f'{name}/captured', way_s)
        begin, end = f'{name}/captured', f'{name}/over'
        yield Derived(Kind.SEQUENCE, name, before, begin, 0.0)
        for event in _beginners(request, mission):
            yield Derived(Kind.BEGUN, name, f'events/{event}', begin, 0.0)
        shortest, longest = left_open(mission.get('duration_s'), _slack(request, mission))
        if free:
            shortest, longest = 0.0, math.inf
        if mission['mode'] == 'navigate':
            longest = math.inf
            way_s = 0.0 if free else _way_s(request, mission)
            yield Derived(Kind.ROUTE, name, begin, end, way_s)
        yield Derived(Kind.PHASE, name, begin, end, shortest, longest)
        before = end
    yield Derived(Kind.SINK, of, before, f'{of}/landed', down_s)
    home = before if last.get('ends_in_flight') else f'{of}/landed'
    endurance = request.limit('uav_endurance_s')
    yield Derived(Kind.BATTERY, of, f'{of}/takeoff', home, most_s=endurance)
    if stated((request.spec.get('world') or {}).get('duration_s')):
        yield Derived(Kind.INSIDE, of, home, 'end', 0.0)


def _slack(request: Request, mission: dict[str, Any]) -> float:
    number = mission.get('duration_s')
    return request.slack('duration_s', number) if number else 0.0


def _beginners(request: Request, mission: dict[str, Any]) -> list[str]:
    """Return the event that a mission waits for, unless it comes next anyway."""
    return [
        e['id']
        for e in request.all('events')
        if (e.get('action') or {}).get('do') == 'change_mission'
        and e['action']['uav'] == mission['uav']
        and e['action'].get('mission') == mission['id']
        and e.get('trigger')
        and (e['trigger']['on'], e['trigger'].get('uav')) != ('mission_done', mission['uav'])
    ][:1]


def _way_s(request: Request, mission: dict[str, Any]) -> float:
    """Return the least time along a pattern whose size is stated, its corners cut."""
    cut = 2.0 * float(request.tolerances['waypoint_horizontal_m'])
    ways = [max(0.0, leg - cut) for leg in _legs(request, mission)]
    top, speed = request.limit('uav_speed_max_mps'), mission.get('speed_mps')
    if not stated(speed):
        return sum(ways) / top
    if speed.get('bound') == 'at_least' or not 0.0 < float(speed['value']) < top:
        return sum(ways) / top
    # A share of what is flown away from the ends of a leg has the stated speed, the rest any.
    fast = min(top, float(speed['value']) + request.slack('route_speed_mps', speed))
    share = float(request.tolerances['route_speed_share'])
    mean = share * fast + (1.0 - share) * top
    ends = float(speed['value']) ** 2 / float(request.tolerances['route_acceleration_mps2'])
    return sum(min(way, ends) / top + max(0.0, way - ends) / mean for way in ways)


def _legs(request: Request, mission: dict[str, Any]) -> tuple[float, ...]:
    if mission.get('pattern') == 'orbit':
        radius, turns = mission.get('radius_m'), mission.get('turns')
        if not (stated(radius) and stated(turns)):
            return ()
        around = 360.0 * left_open(turns, 0.0)[0] - float(request.tolerances['orbit_deg'])
        near = left_open(radius, request.slack('standoff_m', radius))[0]
        return (max(0.0, math.radians(around)) * near,)
    size = mission.get('size_m')
    counted = 1 if mission.get('pattern') == 'line' else 2
    if not size or not all(stated(side) for side in size[:counted]):
        return ()
    length, width = (left_open(side, 0.0)[0] for side in size)
    legs = {
        'rectangle': (length, width, length, width),
        'line': (length,),
        'lawnmower': (max(length, width),),
    }
    return legs.get(mission.get('pattern') or '', ())


def _between(request: Request, before: dict[str, Any], mission: dict[str, Any]) -> float:
    """Return the least time from a hover at one landmark to the next one at another."""
    marks = request.landmarks()
    here, there = (marks.get(m.get('target') or '') for m in (before, mission))
    if here is None or there is None or {before['mode'], mission['mode']} != {'hover'}:
        return 0.0
    aside = farthest(request, before) + farthest(request, mission)
    return max(0.0, math.dist(here, there) - aside) / request.limit('uav_speed_max_mps')


def _order(request: Request, order: dict[str, Any]) -> Iterator[Derived]:
    events = {e['id'] for e in request.all('events')}
    uavs = {m['id']: m['uav'] for m in request.all('missions')}
    first, then = order['first'], order['then']
    # A UAV flies its missions as they are listed; an order against the list proves nothing.
    if first in uavs and uavs[first] == uavs.get(then):
        return
    if not {first, then} <= events | set(uavs):
        return
    earlier = f'events/{first}' if first in events else f'missions/{first}/over'
    later = f'events/{then}' if then in events else f'missions/{then}/captured'
    within = math.inf
    if first in events and then in events:
        within = left_open(order.get('within_s'), 0.0)[1]
    yield Derived(Kind.ORDER, f'orders/{order["id"]}', earlier, later, 0.0, within)


def _condition(request: Request, condition: dict[str, Any]) -> Iterator[Derived]:
    name = f'conditions/{condition["id"]}'
    quantity, of, op = condition['quantity'], list(condition['of']), condition['op']
    value, due = condition['value'], left_open(condition.get('by_s'), 0.0)[1]
    if quantity == 'event_time':
        known = [e['id'] for e in request.all('events')]
        if stated(value) and len(of) == 1 and of[0] in known:
            slack = request.slack('duration_s', value) if op == '==' else 0.0
            first = max(0.0, float(value['value']) - slack) if op in _UP else -math.inf
            last = float(value['value']) + slack if op in _DOWN else math.inf
            yield Derived(Kind.DEADLINE, name, 'start', f'events/{of[0]}', first, last)
        return
    if quantity == 'battery':
        own = [m for m in request.all('missions') if [m['uav']] == of]
        partly = any(condition.get(part) is not None for part in ('fraction', 'hold_s', 'by_s'))
        if own and stated(value) and op in ('>', '>=') and not partly:
            home = f'uavs/{of[0]}/landed'
            if own[-1].get('ends_in_flight'):
                home = f'missions/{own[-1]["id"]}/over'
            left = max(0.0, 1.0 - float(value['value'])) * request.limit('uav_endurance_s')
            yield Derived(Kind.BATTERY, name, f'uavs/{of[0]}/takeoff', home, most_s=left)
        return
    if quantity == 'altitude':
        if stated(value) and op in ('>', '>=') and len(of) == 1:
            up_s = float(value['value']) / request.limit('uav_climb_max_mps')
            yield Derived(Kind.CLIMB, name, f'uavs/{of[0]}/takeoff', name, up_s)
            yield Derived(Kind.DEADLINE, name, 'start', name, most_s=due)
        return
    asked = op in _UP and float(value['value']) > 0.0
    own = [m['id'] for m in request.all('missions') if [m['uav']] == of]
    point = None
    if quantity == 'landed' and asked and own:
        point = f'uavs/{of[0]}/landed'
    elif quantity == 'mission_completed' and asked and own:
        point = f'missions/{own[0]}/over'
    elif quantity == 'delivery_latency' or (quantity == 'delivered' and asked):
        sent = [
            e['id']
            for e in request.all('events')
            if (e.get('action') or {}).get('do') == 'send_message'
            and [e['action']['sender'], e['action']['receiver']] == of
        ]
        point = f'events/{sent[0]}' if len(sent) == 1 else None
    if point is not None:
        yield Derived(Kind.DEADLINE, name, 'start', point, most_s=due)


def _whole(request: Request) -> Iterator[Derived]:
    """Yield the end of a scenario of stated length, and the events that come before it."""
    duration = (request.spec.get('world') or {}).get('duration_s')
    if stated(duration):
        last = left_open(duration, 0.0)[1]
        yield Derived(Kind.HORIZON, 'world/duration_s', 'start', 'end', most_s=last)
        for event in request.all('events'):
            of = f'events/{event["id"]}'
            yield Derived(Kind.INSIDE, of, of, 'end', 0.0)
        for agent in request.all('agents'):
            for number, behavior in enumerate(agent.get('behaviors', ())):
                of = f'agents/{agent["id"]}/behaviors/{number}'
                if stated(behavior.get('duration_s')):
                    shortest, _ = _seconds(request, behavior['duration_s'])
                    yield Derived(Kind.PHASE, of, 'start', of, shortest)
                    yield Derived(Kind.INSIDE, of, of, 'end', 0.0)
