# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The requests of this campaign, each with its annotation in the format of the prompt files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Annotated = Mapping[str, Any]


def _annotated(
    name: str, category: str, prompt: str, *requirements: Mapping[str, Any]
) -> Annotated:
    """Return a line of a prompt file; requirements are numbered from r1."""
    return {
        'id': f'contradicted-{name}',
        'category': category,
        'prompt': prompt,
        'feasibility': 'feasible',
        'paraphrase_group': None,
        'end_to_end': True,
        'requirements': [{'id': f'r{k}', **r} for k, r in enumerate(requirements, 1)],
    }


def _body(ref: str, type_: str, **more: Any) -> Mapping[str, Any]:
    if type_ == 'uav':
        return {'kind': 'uav', 'ref': ref, **more}
    return {'kind': 'agent', 'ref': ref, 'type': type_, **more}


def _mission(ref: str, mode: str, **more: Any) -> Mapping[str, Any]:
    return {'kind': 'mission', 'ref': ref, 'uav': 'uav1', 'mode': mode, **more}


def _event(ref: str, trigger: Mapping[str, Any], action: Mapping[str, Any]) -> Mapping[str, Any]:
    return {'kind': 'event', 'ref': ref, 'trigger': trigger, 'action': action}


def _message(receiver: str) -> Mapping[str, Any]:
    return {'do': 'send_message', 'sender': 'uav1', 'receiver': receiver}


_UAV = _body('uav1', 'uav')
_EGO = _body('ego', 'car', role='ego')
_CAR = _body('car1', 'car')

REQUESTS: Mapping[str, Annotated] = {
    'hover': _annotated(
        'hover',
        'hover',
        'A drone hovers over City Hall at 50 m for 20 seconds. The scenario lasts 90 s.',
        _UAV,
        _mission('m1', 'hover', target='City Hall', altitude_m=50, duration_s=20),
        {'kind': 'world', 'field': 'duration_s', 'value': 90},
    ),
    'sequence': _annotated(
        'sequence',
        'sequential',
        'A drone hovers at 30 m for 10 seconds, then tracks the ego car for 20 seconds, then '
        'lands. It must be on the ground by 120 s.',
        _UAV,
        _EGO,
        _mission('m1', 'hover', altitude_m=30, duration_s=10),
        _mission('m2', 'track', target='ego', duration_s=20),
        {'kind': 'order', 'first': 'm1', 'then': 'm2'},
        {
            'kind': 'condition',
            'quantity': 'landed',
            'of': ['uav1'],
            'op': '==',
            'value': True,
            'by_s': 120,
        },
    ),
    'rectangle': _annotated(
        'rectangle',
        'patrol',
        'A drone flies a 120 m by 80 m rectangle around Harbor Market at 40 m and 10 m/s.',
        _UAV,
        _mission(
            'm1',
            'navigate',
            target='Harbor Market',
            altitude_m=40,
            pattern='rectangle',
            size_m=[120, 80],
            speed_mps=10,
        ),
    ),
    'points': _annotated(
        'points',
        'patrol',
        'A drone visits three waypoints around a parked van at 40 m.',
        _UAV,
        _body('van1', 'van'),
        {'kind': 'behavior', 'agent': 'van1', 'behavior': 'park'},
        _mission(
            'm1', 'navigate', target='van1', altitude_m=40, pattern='waypoints', waypoint_count=3
        ),
    ),
    'tailgate': _annotated(
        'tailgate',
        'communication',
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.',
        _body('van1', 'van'),
        _EGO,
        _UAV,
        {'kind': 'behavior', 'agent': 'van1', 'behavior': 'tailgate', 'target': 'ego'},
        {
            'kind': 'placement',
            'agent': 'van1',
            'relation': 'behind',
            'of': 'ego',
            'distance_m': 45,
        },
        _mission('m1', 'track', target='van1'),
        _event(
            'e1',
            {'on': 'distance_below', 'a': 'van1', 'b': 'ego', 'value_m': 20},
            _message('ego'),
        ),
    ),
    'lossy link': _annotated(
        'lossy-link',
        'communication',
        'A drone hovers at 30 m. The link from the drone to the ego car has 60 % loss, 0.2 s '
        'latency and 5 retransmissions. At 15 s the drone sends the ego a message, which must be '
        'delivered.',
        _UAV,
        _EGO,
        _mission('m1', 'hover', altitude_m=30),
        {
            'kind': 'link',
            'sender': 'uav1',
            'receiver': 'ego',
            'loss': 0.6,
            'latency_s': 0.2,
            'retransmissions': 5,
        },
        _event('e1', {'on': 'time', 'at_s': 15}, _message('ego')),
        {
            'kind': 'condition',
            'quantity': 'delivered',
            'of': ['uav1', 'ego'],
            'op': '==',
            'value': True,
        },
    ),
    'setting off': _annotated(
        'setting-off',
        'conditional',
        'When the drone has reached 25 m, a car sets off at 8 m/s; the drone tracks the car at an '
        'altitude of 40 m.',
        _UAV,
        _CAR,
        _event(
            'e1',
            {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': 25},
            {'do': 'start', 'agent': 'car1', 'value_mps': 8},
        ),
        _mission('m1', 'track', target='car1', altitude_m=40),
    ),
    'slow and stop': _annotated(
        'slow-and-stop',
        'sequential',
        'A drone tracks a car; after 40 s the car slows down to 4 m/s; after 60 s the car stops; '
        '3 s after it has stopped the drone alerts the car.',
        _UAV,
        _CAR,
        _mission('m1', 'track', target='car1'),
        _event('e1', {'on': 'time', 'at_s': 40}, {'do': 'slow', 'agent': 'car1', 'value_mps': 4}),
        _event('e2', {'on': 'time', 'at_s': 60}, {'do': 'stop', 'agent': 'car1'}),
        _event('e3', {'on': 'event_done', 'event': 'e2', 'after_s': 3}, _message('car1')),
    ),
    'brake later': _annotated(
        'brake-later',
        'conditional',
        'At 20 s the drone alerts a car; 10 s after that the car brakes; the drone tracks '
        'the car.',
        _UAV,
        _CAR,
        _event('e1', {'on': 'time', 'at_s': 20}, _message('car1')),
        _event(
            'e2',
            {'on': 'event_done', 'event': 'e1', 'after_s': 10},
            {'do': 'brake', 'agent': 'car1'},
        ),
        _mission('m1', 'track', target='car1'),
    ),
    'convoy': _annotated(
        'convoy',
        'environment',
        'At dusk in the rain, a bus drives 30 m ahead of the ego car and an ambulance follows '
        'behind the ego; a drone tracks the bus from 35 meters.',
        _body('bus1', 'bus'),
        _EGO,
        _body('ambulance1', 'ambulance'),
        _UAV,
        {'kind': 'world', 'field': 'weather', 'value': 'rain'},
        {'kind': 'world', 'field': 'time_of_day', 'value': 'dusk'},
        {'kind': 'placement', 'agent': 'bus1', 'relation': 'ahead', 'of': 'ego', 'distance_m': 30},
        {'kind': 'behavior', 'agent': 'bus1', 'behavior': 'drive'},
        {'kind': 'placement', 'agent': 'ambulance1', 'relation': 'behind', 'of': 'ego'},
        {'kind': 'behavior', 'agent': 'ambulance1', 'behavior': 'follow', 'target': 'ego'},
        _mission('m1', 'track', target='bus1', standoff_m=35),
    ),
    'parked': _annotated(
        'parked',
        'perception',
        'A truck is parked 20 m behind a parked van; a drone hovers 30 m from the van at an '
        'altitude of 20 m for 20 s and sees the van for at least 90 % of the time.',
        _body('truck1', 'truck'),
        _body('van1', 'van'),
        _UAV,
        {'kind': 'behavior', 'agent': 'truck1', 'behavior': 'park'},
        {'kind': 'behavior', 'agent': 'van1', 'behavior': 'park'},
        {
            'kind': 'placement',
            'agent': 'truck1',
            'relation': 'behind',
            'of': 'van1',
            'distance_m': 20,
        },
        _mission('m1', 'hover', target='van1', standoff_m=30, altitude_m=20, duration_s=20),
        {
            'kind': 'condition',
            'quantity': 'visible_fraction',
            'of': ['uav1', 'van1'],
            'op': '>=',
            'value': 0.9,
        },
    ),
    'two cars': _annotated(
        'two-cars',
        'multi_agent',
        'Exactly two cars circulate. A drone hovers over the intersection at 40 m.',
        _body('cars', 'car', count=2),
        _UAV,
        {'kind': 'behavior', 'agent': 'cars', 'behavior': 'circulate'},
        _mission('m1', 'hover', target='intersection', altitude_m=40),
        {'kind': 'count', 'type': 'car', 'value': 2, 'scope': 'scene'},
    ),
    'parking': _annotated(
        'parking',
        'sequential',
        'A truck drives to Harbor Market and parks there. The scenario lasts 140 s.',
        _body('truck1', 'truck'),
        {'kind': 'behavior', 'agent': 'truck1', 'behavior': 'park', 'target': 'Harbor Market'},
        {'kind': 'behavior', 'agent': 'truck1', 'behavior': 'drive', 'target': 'Harbor Market'},
        {'kind': 'world', 'field': 'duration_s', 'value': 140},
    ),
    'beside': _annotated(
        'beside',
        'spatial',
        'A truck drives at 7 m/s. A motorcycle drives beside the truck.',
        _body('truck1', 'truck'),
        {'kind': 'behavior', 'agent': 'truck1', 'behavior': 'drive', 'speed_mps': 7},
        _body('motorcycle1', 'motorcycle'),
        {
            'kind': 'placement',
            'agent': 'motorcycle1',
            'relation': 'beside',
            'of': 'truck1',
            'kept': True,
        },
    ),
}
