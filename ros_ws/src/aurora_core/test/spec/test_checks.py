# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every rule between and inside the parts of a specification, broken once."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.spec.scenario import ScenarioSpec

Scene = dict[str, Any]


def _number(unit: str = 'm', **changes: Any) -> Scene:
    whole = {'value': 1.0, 'unit': unit, 'low': 0.0, 'high': 9.0, 'provenance': 'default'}
    return whole | changes


_HOVER = {
    'id': 'm1',
    'uav': 'uav1',
    'mode': 'hover',
    'altitude_m': _number(),
    'duration_s': _number('s'),
}
_ROUTE = _HOVER | {
    'mode': 'navigate',
    'pattern': 'rectangle',
    'size_m': [_number(), _number()],
    'speed_mps': _number('m/s'),
}
_WAY = _ROUTE | {'pattern': 'waypoints'}
_LINK = {
    'id': 'l1',
    'sender': 'uav1',
    'receiver': 'car1',
    'loss': _number('1'),
    'latency_s': _number('s'),
    'retransmissions': _number('1'),
    'retransmission_interval_s': _number('s'),
}
_STATED = {'id': 'c1', 'quantity': 'speed', 'of': ['car1'], 'op': '<', 'value': _number('m/s')}
_SENDS = {'do': 'send_message', 'sender': 'uav1', 'receiver': 'car1'}
_TO_M1 = {'do': 'change_mission', 'uav': 'uav1', 'mission': 'm1'}


def _scene(**changes: Any) -> Scene:
    whole: Scene = {
        'prompt': 'Two drones.',
        'agents': [{'id': 'car1', 'type': 'car', 'group': 'cars'}],
        'uavs': [{'id': 'uav1', 'group': 'swarm'}, {'id': 'uav2', 'group': 'swarm'}],
        'missions': [_HOVER],
        'links': [_LINK],
        'events': [{'id': 'e1', 'action': _SENDS}, {'id': 'e2', 'action': _TO_M1}],
        'conditions': [_STATED],
        'orders': [{'id': 'o1', 'first': 'e1', 'then': 'm1', 'within_s': _number('s')}],
    }
    return whole | changes


def _event(**parts: Any) -> Scene:
    return {'events': [{'id': 'e1', **parts}, {'id': 'e2'}]}


def _forbids(what: str, **parts: Any) -> Scene:
    return {'prohibitions': [{'id': 'p1', 'forbids': what, **parts}]}


def test_the_scene_itself_is_valid() -> None:
    spec = ScenarioSpec.model_validate(_scene())
    assert ScenarioSpec.model_validate_json(spec.canonical_json()) == spec


@pytest.mark.parametrize(
    ('changes', 'says'),
    [
        # ids
        ({'agents': [{'id': 'world', 'type': 'car'}]}, 'belongs to the environment'),
        ({'orders': [{'id': 'e1', 'first': 'e1', 'then': 'm1'}]}, 'unique'),
        (_forbids('agent', type='bus') | {'uavs': [{'id': 'uav1'}, {'id': 'p1'}]}, 'unique'),
        # units, and numbers inside their domain
        ({'missions': [_HOVER | {'altitude_m': _number('s')}]}, 'altitude_m is in m'),
        ({'missions': [_HOVER | {'bearing_deg': _number()}]}, 'bearing_deg is in deg'),
        ({'missions': [_HOVER | {'waypoint_count': _number()}]}, 'waypoint_count is in 1'),
        ({'missions': [_ROUTE | {'speed_mps': _number()}]}, 'speed_mps is in m/s'),
        ({'missions': [_ROUTE | {'size_m': [_number(), _number('s')]}]}, 'size_m is in m'),
        ({'links': [_LINK | {'loss': _number()}]}, 'loss is in 1'),
        ({'conditions': [_STATED | {'value': _number()}]}, 'value is in m/s'),
        ({'conditions': [_STATED | {'fraction': _number('s')}]}, 'fraction is in 1'),
        ({'missions': [_HOVER | {'altitude_m': _number(low=8.0, high=7.0)}]}, 'low <= high'),
        # fields of a mode
        ({'missions': [_HOVER | {'dwell_s': _number('s')}]}, 'only a route'),
        ({'missions': [_HOVER | {'side': 'left'}]}, 'only who tracks'),
        ({'missions': [_ROUTE | {'turns': _number('1')}]}, 'only an orbit'),
        ({'missions': [_ROUTE | {'start': 'crosswalk'}]}, 'has to lead elsewhere'),
        (
            {'missions': [_WAY | {'start': 'crosswalk', 'target': 'crosswalk'}]},
            'has to lead elsewhere',
        ),
        # references
        ({'missions': [_HOVER | {'target': 'uav1'}]}, 'its own target'),
        ({'links': [_LINK | {'receiver': 'uav1'}]}, 'cannot send to itself'),
        (_event(action=_SENDS | {'receiver': 'uav1'}), 'cannot send to itself'),
        (_event(action=_TO_M1 | {'mission': 'm9'}), 'no mission of its UAV'),
        (_event(action=_TO_M1 | {'uav': 'uav2'}), 'no mission of its UAV'),
        (_event(action={'do': 'change_mission', 'uav': 'uav1'}), 'change_mission alone'),
        (_event(action={'do': 'land', 'uav': 'uav1', 'mission': 'm1'}), 'change_mission alone'),
        (_event(action={'do': 'ascend', 'uav': 'uav1'}), 'ascend needs'),
        (_event(action={'do': 'land', 'uav': 'car1'}), 'unknown UAV'),
        (_event(trigger={'on': 'mission_done', 'uav': 'uav9'}), 'unknown UAV'),
        (
            _event(trigger={'on': 'visible', 'observer': 'crosswalk', 'target': 'uav1'}),
            'is a place and sees nothing',
        ),
        (_event(trigger={'on': 'event_done', 'event': 'e9'}), 'unknown event'),
        (_event(trigger={'on': 'event_done', 'event': 'e1'}), 'unknown event'),
        (_event(trigger={'on': 'message_received', 'by': 'bus1'}), 'bus1'),
        ({'conditions': [_STATED | {'of': ['bus1']}]}, 'bus1'),
        ({'conditions': [_STATED | {'of': []}]}, 'of nothing'),
        ({'conditions': [_STATED | {'quantity': 'jump'}]}, 'quantity is one of'),
        ({'orders': [{'id': 'o1', 'first': 'e1', 'then': 'e1'}]}, 'before itself'),
        ({'orders': [{'id': 'o1', 'first': 'e1', 'then': 'car1'}]}, 'no event or mission'),
        # prohibitions
        (_forbids('world'), 'exactly one'),
        (_forbids('world', weather='rain', time_of_day='night'), 'exactly one'),
        (_forbids('agent', type='tram'), 'tram'),
        (_forbids('placement', agent='uav1', relation='near'), 'no ground agent'),
        (_forbids('behavior', agent='bus1', kind='stop'), 'bus1'),
        (_forbids('mission', uav='uav9', mode='hover'), 'uav9'),
        (_forbids('mission', uav='uav1', mode='track', target='uav1'), 'its own target'),
        (_forbids('link', sender='uav1', receiver='bus1'), 'bus1'),
        (_forbids('event', action={'do': 'land', 'uav': 'uav9'}), 'unknown UAV'),
        (_forbids('event', trigger={'on': 'event_done', 'event': 'e9'}), 'unknown event'),
        (_forbids('order', first='e1', then='e9'), 'no event or mission'),
        (_forbids('condition', **(_STATED | {'id': 'p1', 'of': ['x1']})), 'x1'),
        (_forbids('everything'), 'forbids'),
        # spans
        ({'agents': [{'id': 'car1', 'type': 'car', 'span': {'start': 3, 'end': 12}}]}, 'outside'),
        (
            {'missions': [_HOVER | {'altitude_m': _number(span={'start': 0, 'end': 99})}]},
            'outside',
        ),
        ({'world': {'seed': -1}}, 'seed'),
    ],
)
def test_refused(changes: Scene, says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        ScenarioSpec.model_validate(_scene(**changes))


@pytest.mark.parametrize('of', ['car1', 'cars', 'swarm', 'e1', 'm1', 'l1', 'landmark:City Hall'])
def test_what_a_condition_can_be_about(of: str) -> None:
    ScenarioSpec.model_validate(_scene(conditions=[_STATED | {'of': [of]}]))


@pytest.mark.parametrize(
    ('part', 'field'),
    [
        (lambda s: s, 'orders'),
        (lambda s: s, 'prohibitions'),
        (lambda s: s['world'], 'seed'),
        (lambda s: s['missions'][0], 'dwell_s'),
        (lambda s: s['uavs'][0], 'group'),
        (lambda s: s['links'][0], 'occlusion'),
    ],
)
def test_documents_from_before_a_field_keep_their_text(part: Any, field: str) -> None:
    """Digests of requests that do not use a later field must not change."""
    without = _scene(orders=[], uavs=[{'id': 'uav1'}, {'id': 'uav2'}])
    document = ScenarioSpec.model_validate(without).model_dump(mode='json')
    assert field not in part(document)
    used = _scene(
        **_forbids('world', weather='rain'),
        world={'seed': 7},
        missions=[_ROUTE | {'dwell_s': _number('s')}],
        links=[_LINK | {'occlusion': 'blocks'}],
    )
    assert field in part(ScenarioSpec.model_validate(used).model_dump(mode='json'))
