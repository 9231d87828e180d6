# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requests whose times exclude each other, each beside one that is only just possible.

The bounds are worked out by hand beside each pair: 5 m/s up, 3 m/s down, 18 m/s along, 1500 s of
battery; durations to 0.5 s or 2 %, altitudes to 2 m or 3 %, waypoints and the ground to 3 and
0.3 m, an event within 1 s.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from aurora_core.outcomes.feasibility import Rule
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = 'A request.'
SPAN = {'start': 0, 'end': len(PROMPT)}

Part = dict[str, Any]


def number(value: float, unit: str, bound: str = 'exactly') -> Part:
    """Return a stated number."""
    given = {'value': value, 'unit': unit, 'low': -1e6, 'high': 1e6, 'bound': bound}
    return {**given, 'provenance': 'explicit', 'span': SPAN}


def default(value: float, unit: str) -> Part:
    """Return a number that nobody states."""
    return {'value': value, 'unit': unit, 'low': 0.0, 'high': 1e6, 'provenance': 'default'}


def seconds(value: float, bound: str = 'exactly') -> Part:
    return number(value, 's', bound)


def yes(**more: Any) -> Part:
    """Return that something shall be so."""
    value = {'value': 1.0, 'unit': '1', 'low': 0.0, 'high': 1.0, 'provenance': 'inferred'}
    return {'op': '==', 'value': value, **more}


def request(**parts: Any) -> ScenarioSpec:
    """Return a request of these parts, with two cars."""
    agents = [{'id': name, 'type': 'car'} for name in ('car1', 'car2')]
    named = {
        kind: [{'id': f'{kind[0]}{k + 1}', **part} for k, part in enumerate(found)]
        for kind, found in parts.items()
        if kind != 'world'
    }
    uavs = sorted({m['uav'] for m in named.get('missions', ())})
    made = {'agents': agents, 'uavs': [{'id': u} for u in uavs], 'world': parts.get('world', {})}
    return ScenarioSpec.model_validate({'prompt': PROMPT, **made, **named})


def lasting(value: float, bound: str = 'exactly') -> Part:
    return {'duration_s': seconds(value, bound)}


def hover(duration_s: float | None, altitude_m: float | None = None, uav: str = 'uav1') -> Part:
    """Return a hover; what is None is not stated."""
    duration = default(30.0, 's') if duration_s is None else seconds(duration_s)
    altitude = default(30.0, 'm') if altitude_m is None else number(altitude_m, 'm')
    return {'uav': uav, 'mode': 'hover', 'altitude_m': altitude, 'duration_s': duration}


def rectangle(length_m: float, width_m: float) -> Part:
    return {
        'uav': 'uav1',
        'mode': 'navigate',
        'pattern': 'rectangle',
        'altitude_m': number(30.0, 'm'),
        'speed_mps': default(8.0, 'm/s'),
        'size_m': [number(length_m, 'm'), number(width_m, 'm')],
    }


def brakes(car: str = 'car1') -> Part:
    return {'do': 'brake', 'agent': car}


def sends(sender: str = 'uav1', receiver: str = 'car1') -> Part:
    return {'do': 'send_message', 'sender': sender, 'receiver': receiver}


def at(value: float, **more: Any) -> Part:
    return {'trigger': {'on': 'time', 'at_s': seconds(value)}, 'action': brakes(), **more}


def after(event: str, value: float | None = None, **more: Any) -> Part:
    after_s = None if value is None else seconds(value)
    trigger = {'on': 'event_done', 'event': event, 'after_s': after_s}
    return {'trigger': trigger, 'action': brakes('car2'), **more}


def order(first: str, then: str, within_s: float | None = None) -> Part:
    return {
        'first': first,
        'then': then,
        'within_s': None if within_s is None else seconds(within_s),
    }


def event_time(event: str, op: str, value: float) -> Part:
    return {'quantity': 'event_time', 'of': [event], 'op': op, 'value': seconds(value)}


def landed(by_s: float, bound: str = 'exactly') -> Part:
    return yes(quantity='landed', of=['uav1'], by_s=seconds(by_s, bound))


def high(value_m: float, by_s: float) -> Part:
    value = number(value_m, 'm')
    return {
        'quantity': 'altitude',
        'of': ['uav1'],
        'op': '>=',
        'value': value,
        'by_s': seconds(by_s),
    }


@dataclass(frozen=True, kw_only=True)
class Pair:
    """What cannot be, by which rule and because of which element, and what just can."""

    name: str
    rule: Rule
    path: str
    cannot: ScenarioSpec
    can: ScenarioSpec


def _pair(name: str, rule: Rule, path: str, cannot: Part, can: Part) -> Pair:
    return Pair(name=name, rule=rule, path=path, cannot=request(**cannot), can=request(**can))


def _chain(duration_s: float, bound: str = 'exactly') -> Part:
    # 9.5 + 4.5 + 19.5 = 33.5 s
    events = [at(10.0), after('e1', 5.0), after('e2', 20.0)]
    return {'events': events, 'world': lasting(duration_s, bound)}


def _flight(by_s: float) -> Part:
    # 28 m up 5.6 s, 58.8 s, 27.7 m down 9.2333 s: 73.633 s
    return {'missions': [hover(60.0, 30.0)], 'conditions': [landed(by_s)]}


def _lap(by_s: float) -> Part:
    # 28 m up 5.6 s, 2 x (394 + 294) m in 76.444 s: 82.044 s
    done = yes(quantity='mission_completed', of=['uav1'], by_s=seconds(by_s))
    return {'missions': [rectangle(400.0, 300.0)], 'conditions': [done]}


def _seen(by_s: float) -> Part:
    # 97 m up 19.4 s
    trigger = {'on': 'visible', 'observer': 'uav1', 'target': 'car1'}
    return {
        'missions': [hover(None, 100.0)],
        'events': [{'trigger': trigger, 'action': brakes()}],
        'conditions': [event_time('e1', '<=', by_s)],
    }


def _up(by_s: float) -> Part:
    # 100 m up 20 s
    trigger = {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': number(100.0, 'm')}
    return {
        'missions': [hover(None)],
        'events': [{'trigger': trigger, 'action': brakes()}],
        'conditions': [event_time('e1', '<=', by_s)],
    }


def _told(by_s: float) -> Part:
    # 29.4 s; nobody states how high
    done = {'on': 'mission_done', 'uav': 'uav1'}
    received = yes(quantity='delivered', of=['uav1', 'car1'], by_s=seconds(by_s))
    return {
        'missions': [hover(30.0)],
        'events': [{'trigger': done, 'action': sends()}],
        'conditions': [received],
    }


def _sent(at_s: float, altitude_m: float) -> Part:
    return {'missions': [hover(None, altitude_m)], 'events': [at(at_s, action=sends())]}


def _waits(by_s: float) -> Part:
    # 29.4 s on the ground, 29.4 s up there, 27.7 m down 9.2333 s: 68.033 s
    begin = {'do': 'change_mission', 'uav': 'uav1', 'mission': 'm1'}
    return {
        'missions': [hover(30.0, 30.0)],
        'events': [at(30.0, action=begin)],
        'conditions': [landed(by_s)],
    }


def _answers(first: Part) -> Part:
    answer = {'trigger': first, 'action': brakes()}
    return {'missions': [hover(None)], 'events': [after('e2', action=sends()), answer]}


def _between(delay_s: float) -> Part:
    # 10.5 s at the latest and 5 s more
    return {
        'events': [at(10.0), {'action': brakes('car2')}],
        'orders': [order('e1', 'e2', 5.0)],
        'conditions': [event_time('e2', '>=', delay_s)],
    }


def _drives(duration_s: float) -> Part:
    return {'type': 'car', 'behaviors': [{'kind': 'drive', 'duration_s': seconds(duration_s)}]}


_TWO = [at(10.0), at(30.0, action=brakes('car2'))]
_HEARD = {'on': 'message_received', 'by': 'car1'}

PAIRS = (
    _pair('landing', Rule.DEADLINE, 'conditions/c1', _flight(73.6), _flight(73.7)),
    _pair('chain in a short scenario', Rule.HORIZON, 'events/e3', _chain(33.4), _chain(33.6)),
    _pair(
        'at least so long a scenario',
        Rule.HORIZON,
        'events/e3',
        _chain(20.0, 'at_most'),
        _chain(20.0, 'at_least'),
    ),
    _pair(
        'event after the scenario',
        Rule.HORIZON,
        'events/e1',
        {'events': [at(30.0)], 'world': lasting(29.3)},
        {'events': [at(30.0)], 'world': lasting(29.5)},
    ),
    _pair(
        # 20 s may be 19.5 s
        'a drive in a short scenario',
        Rule.HORIZON,
        'agents/a1/behaviors/0',
        {'agents': [_drives(20.0)], 'world': lasting(19.4)},
        {'agents': [_drives(20.0)], 'world': lasting(19.6)},
    ),
    _pair(
        # 38 m up 7.6 s, 37.7 m down 12.567 s, and 49 s or 39.2 s
        'flight in a short scenario',
        Rule.HORIZON,
        'uavs/uav1',
        {'missions': [hover(50.0, 40.0)], 'world': lasting(60.0)},
        {'missions': [hover(40.0, 40.0)], 'world': lasting(60.0)},
    ),
    _pair(
        'climb within 5 s',
        Rule.DEADLINE,
        'conditions/c1',
        {'missions': [hover(None, 100.0)], 'conditions': [high(100.0, 5.0)]},
        {'missions': [hover(None, 100.0)], 'conditions': [high(25.0, 5.0)]},
    ),
    _pair(
        'climb within 20 s',
        Rule.DEADLINE,
        'conditions/c1',
        {'missions': [hover(None, 100.0)], 'conditions': [high(100.0, 19.9)]},
        {'missions': [hover(None, 100.0)], 'conditions': [high(100.0, 20.0)]},
    ),
    _pair('height that triggers', Rule.DEADLINE, 'conditions/c1', _up(19.9), _up(20.0)),
    _pair('sight', Rule.DEADLINE, 'conditions/c1', _seen(19.3), _seen(19.5)),
    _pair('message after a mission', Rule.DEADLINE, 'conditions/c1', _told(29.3), _told(29.5)),
    # 58 m up 11.6 s, and half a second of tolerance
    _pair(
        'message in the ascent', Rule.DEADLINE, 'events/e1', _sent(11.0, 60.0), _sent(11.2, 60.0)
    ),
    _pair('lap', Rule.DEADLINE, 'conditions/c1', _lap(82.0), _lap(82.1)),
    _pair('late take-off', Rule.DEADLINE, 'conditions/c1', _waits(68.0), _waits(68.1)),
    _pair(
        'deadline that is only a least one',
        Rule.DEADLINE,
        'conditions/c1',
        _flight(40.0),
        {'missions': [hover(60.0, 30.0)], 'conditions': [landed(40.0, 'at_least')]},
    ),
    _pair(
        'time of an event, too early',
        Rule.DEADLINE,
        'conditions/c1',
        {'events': [at(30.0)], 'conditions': [event_time('e1', '<=', 29.3)]},
        {'events': [at(30.0)], 'conditions': [event_time('e1', '<=', 29.4)]},
    ),
    _pair(
        'time of an event, too late',
        Rule.DEADLINE,
        'conditions/c1',
        {'events': [at(30.0)], 'conditions': [event_time('e1', '>=', 30.7)]},
        {'events': [at(30.0)], 'conditions': [event_time('e1', '>=', 30.6)]},
    ),
    _pair(
        'order against stated times',
        Rule.ORDER,
        'orders/o1',
        {'events': _TWO, 'orders': [order('e2', 'e1')]},
        {'events': _TWO, 'orders': [order('e1', 'e2')]},
    ),
    _pair(
        # 10.6 s at the earliest, 10.5 s at the latest; 10.4 s and 10.5 s
        'order against times that nearly meet',
        Rule.ORDER,
        'orders/o1',
        {'events': [at(10.0), at(11.1)], 'orders': [order('e2', 'e1')]},
        {'events': [at(10.0), at(10.9)], 'orders': [order('e2', 'e1')]},
    ),
    _pair(
        # from 10.5 s to 19.5 s
        'too far apart for an order',
        Rule.ORDER,
        'orders/o1',
        {'events': [at(10.0), at(20.0)], 'orders': [order('e1', 'e2', 8.9)]},
        {'events': [at(10.0), at(20.0)], 'orders': [order('e1', 'e2', 9.0)]},
    ),
    _pair(
        'circle of orders',
        Rule.ORDER,
        'orders/o1',
        {'events': _TWO, 'orders': [order('e1', 'e2'), order('e2', 'e1')]},
        {'events': _TWO, 'orders': [order('e1', 'e2'), order('e1', 'e2')]},
    ),
    _pair(
        'order against a cause',
        Rule.ORDER,
        'orders/o1',
        {'events': [{'action': brakes()}, after('e1')], 'orders': [order('e2', 'e1')]},
        {'events': [{'action': brakes()}, after('e1')], 'orders': [order('e1', 'e2')]},
    ),
    _pair(
        'circle of causes',
        Rule.ORDER,
        'events/e1',
        {'events': [after('e2'), after('e1')]},
        {'events': [after('e2'), at(5.0)]},
    ),
    _pair(
        'circle of messages',
        Rule.ORDER,
        'events/e1',
        _answers(_HEARD),
        _answers({'on': 'time', 'at_s': seconds(5.0)}),
    ),
    _pair('order and deadline together', Rule.ORDER, 'orders/o1', _between(15.6), _between(15.5)),
    _pair(
        # 98 or 18 m up, 1465.1 s, 97 - 0.3 or 18 - 0.3 m down
        'battery, climb and way counted',
        Rule.BATTERY,
        'uavs/uav1',
        {'missions': [hover(740.0, 100.0), hover(755.0, 100.0)]},
        {'missions': [hover(740.0, 20.0), hover(755.0, 20.0)]},
    ),
)
# Each has a reason why the times that it states are no proof.
OPEN = {
    'an event may end a phase early': request(
        missions=[hover(60.0, 30.0)],
        events=[at(10.0, action={'do': 'land', 'uav': 'uav1'})],
        conditions=[landed(30.0)],
    ),
    'nobody says how long the flight is': request(
        missions=[hover(None, 60.0)], world=lasting(15.0)
    ),
    'an order against the list of missions': request(
        missions=[hover(30.0), hover(30.0)], orders=[order('m2', 'm1')]
    ),
    'its own message is not the one that it waits for': request(
        missions=[hover(None)], events=[{'trigger': _HEARD, 'action': sends()}]
    ),
    'another message may be the one': request(
        missions=[hover(None)],
        events=[
            {'trigger': _HEARD, 'action': brakes()},
            after('e1', action=sends()),
            after('e1', action=sends()),
        ],
    ),
    'who changes lane may wait for a lane': request(
        events=[
            at(10.0),
            after('e1', action={'do': 'change_lane', 'agent': 'car2'}),
        ],
        conditions=[event_time('e2', '>=', 60.0)],
    ),
    'it is asked not to be so': request(
        missions=[hover(60.0, 30.0)],
        conditions=[{**landed(40.0), 'op': '<='}],
    ),
    'a delay that is a deadline': request(
        events=[at(10.0), after('e1', delay_s=seconds(6.0, 'at_most'))],
        conditions=[event_time('e2', '<=', 9.5)],
    ),
    'in the air at the end': request(
        missions=[{**hover(50.0, 40.0), 'ends_in_flight': True}], world=lasting(60.0)
    ),
}
