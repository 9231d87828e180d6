# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The specification refuses what contradicts itself and survives JSON unchanged."""

from __future__ import annotations

import json
from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.spec.scenario import ScenarioSpec

_METRES = {'value': 30.0, 'unit': 'm', 'low': 0.0, 'high': 120.0, 'provenance': 'default'}
_SECONDS = _METRES | {'unit': 's'}
_SPEED = _METRES | {'unit': 'm/s', 'value': 8.0}
_ONE = _METRES | {'unit': '1', 'value': 0.0}

_BUS = {'id': 'bus1', 'type': 'bus'}
_EGO = {'id': 'ego', 'type': 'car', 'role': 'ego'}
_TRACK = {
    'id': 'm1',
    'uav': 'uav1',
    'mode': 'track',
    'target': 'bus1',
    'altitude_m': _METRES,
    'standoff_m': _METRES,
    'duration_s': _SECONDS,
}
_SEND = {'do': 'send_message', 'sender': 'uav1', 'receiver': 'ego'}
_NEAR = {'on': 'distance_below', 'a': 'bus1', 'b': 'ego', 'value_m': _METRES}
_LINK = {
    'id': 'link1',
    'sender': 'uav1',
    'receiver': 'ego',
    'loss': _ONE,
    'latency_s': _SECONDS,
    'retransmissions': _ONE,
    'retransmission_interval_s': _SECONDS,
}


def _scene(**changes: Any) -> dict[str, Any]:
    scene: dict[str, Any] = {
        'prompt': 'A drone tracks a bus and alerts the ego.',
        'agents': [_BUS, _EGO],
        'uavs': [{'id': 'uav1'}],
        'missions': [_TRACK],
        'links': [_LINK],
        'events': [{'id': 'e1', 'trigger': _NEAR, 'action': _SEND}],
    }
    return scene | changes


def test_whole_scene_round_trip() -> None:
    spec = ScenarioSpec.model_validate(_scene())
    again = ScenarioSpec.model_validate_json(spec.model_dump_json())
    assert again == spec
    assert again.canonical_json() == spec.canonical_json()
    assert json.loads(spec.canonical_json())['schema_version'] == 1


def test_canonical_json_has_no_blanks_and_sorted_keys() -> None:
    text = ScenarioSpec(prompt='Straße').canonical_json()
    assert 'Straße' in text
    assert ': ' not in text
    keys = list(json.loads(text))
    assert keys == sorted(keys)


@pytest.mark.parametrize(
    ('changes', 'says'),
    [
        ({'agents': [_BUS, _BUS, _EGO]}, 'unique'),
        ({'uavs': [{'id': 'uav1'}, {'id': 'ego'}]}, 'unique'),
        ({'agents': [_EGO, {'id': 'ego2', 'type': 'car', 'role': 'ego'}, _BUS]}, 'one ego'),
        ({'missions': [_TRACK | {'target': 'van1'}]}, 'van1'),
        ({'missions': [_TRACK | {'uav': 'uav2'}]}, 'uav2'),
        ({'links': [_LINK | {'receiver': 'nobody'}]}, 'nobody'),
        ({'events': [{'id': 'e1', 'trigger': _NEAR | {'b': 'nobody'}}]}, 'nobody'),
        ({'events': [{'id': 'e1', 'action': _SEND | {'sender': 'nobody'}}]}, 'nobody'),
        ({'events': [{'id': 'e1', 'action': {'do': 'brake', 'agent': 'nobody'}}]}, 'nobody'),
        ({'agents': [_EGO, _BUS | {'placements': [{'relation': 'ahead', 'of': 'x1'}]}]}, 'x1'),
        ({'agents': [_EGO, _BUS | {'behaviors': [{'kind': 'follow', 'target': 'x1'}]}]}, 'x1'),
        ({'agents': [_EGO, _BUS | {'id': 'Bus 1'}]}, 'pattern'),
        ({'agents': [_EGO, _BUS | {'type': 'tram'}]}, 'type'),
        ({'events': [{'id': 'e1', 'trigger': {'on': 'full_moon'}}]}, 'full_moon'),
        ({'weather': 'clear'}, 'extra'),
        ({'schema_version': 2}, 'schema_version'),
    ],
)
def test_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        ScenarioSpec.model_validate(_scene(**changes))


@pytest.mark.parametrize(
    ('mission', 'says'),
    [
        (_TRACK | {'target': None}, 'track needs'),
        (_TRACK | {'standoff_m': None}, 'track needs'),
        (_TRACK | {'duration_s': None}, 'duration_s'),
        (_TRACK | {'mode': 'hover', 'duration_s': None}, 'duration_s'),
        (_TRACK | {'mode': 'navigate', 'speed_mps': _SPEED}, 'navigate needs'),
        (_TRACK | {'mode': 'navigate', 'pattern': 'orbit'}, 'navigate needs'),
    ],
)
def test_modes_have_their_fields(mission: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        ScenarioSpec.model_validate(_scene(missions=[mission]))


@pytest.mark.parametrize('place', ['intersection', 'main_road', 'landmark:clock_tower'])
def test_places_may_be_targets(place: str) -> None:
    spec = ScenarioSpec.model_validate(_scene(missions=[_TRACK | {'target': place}]))
    assert spec.missions[0].target == place
