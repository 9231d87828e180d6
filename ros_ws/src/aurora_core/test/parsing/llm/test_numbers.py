# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every stated number is in the reading once, with the words and the bound that it has."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.parsing.llm.check import Judgement
from aurora_core.spec.parameter import Provenance


def metres(value: float, quote: str) -> dict[str, Any]:
    return {'value': value, 'unit': 'm', 'quote': quote}


def test_both_ends_of_a_range_are_wanted(judged: Callable[..., Judgement]) -> None:
    prompt = 'A drone hovers over my car and stays between 20 and 30 m above ground.'
    low = {
        'id': 'c1',
        'quantity': 'altitude',
        'of': ['u'],
        'op': '>=',
        'value': metres(20, 'between 20 and 30 m'),
        'quote': 'stays between 20 and 30 m above ground',
    }
    high = {**low, 'id': 'c2', 'op': '<=', 'value': metres(30, '20 and 30 m')}
    reading: dict[str, Any] = {
        'agents': [{'id': 'ego', 'type': 'car', 'quote': 'my car'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {'id': 'm', 'uav': 'u', 'mode': 'hover', 'target': 'ego', 'quote': 'A drone hovers'}
        ],
        'conditions': [low],
        'clauses': [
            {'quote': 'A drone hovers over my car', 'status': 'encoded', 'ids': ['m', 'ego']},
            {
                'quote': 'and stays between 20 and 30 m above ground',
                'status': 'encoded',
                'ids': ['c1'],
            },
        ],
    }
    assert 'both of its numbers' in judged(reading, prompt).complaints[0]
    reading['conditions'].append(high)
    reading['clauses'][1]['ids'].append('c2')
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    assert [c.value.value for c in outcome.spec.conditions] == [20, 30]


def test_the_same_number_twice_is_two_numbers(judged: Callable[..., Judgement]) -> None:
    prompt = 'A drone tracks a bus from 30 m at an altitude of 30 m.'
    reading: dict[str, Any] = {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'track',
                'target': 'b',
                'standoff_m': metres(30, '30 m'),
                'quote': 'tracks a bus',
            }
        ],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }
    assert "'30 m'" in judged(reading, prompt).complaints[0]
    reading['missions'][0]['altitude_m'] = metres(30, '30 m')
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    mission = outcome.spec.missions[0]
    assert mission.standoff_m is not None
    assert mission.altitude_m.span != mission.standoff_m.span


def test_bearing_and_no_retries_are_stated_in_words(judged: Callable[..., Judgement]) -> None:
    prompt = 'A drone follows my car from the north and warns me at 10 s with no retransmissions.'
    reading: dict[str, Any] = {
        'agents': [{'id': 'ego', 'type': 'car', 'quote': 'my car'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'track',
                'target': 'ego',
                'bearing_deg': {'value': 0, 'unit': 'deg', 'quote': 'from the north'},
                'quote': 'A drone follows my car',
            }
        ],
        'links': [
            {
                'id': 'l',
                'sender': 'u',
                'receiver': 'ego',
                'retransmissions': {'value': 0, 'unit': '1', 'quote': 'no retransmissions'},
                'quote': 'no retransmissions',
            }
        ],
        'events': [
            {
                'id': 'e',
                'trigger': {'on': 'time', 'value': {'value': 10, 'unit': 's', 'quote': '10 s'}},
                'action': {'do': 'send_message', 'subject': 'u', 'receiver': 'ego'},
                'quote': 'warns me',
            }
        ],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'ego', 'e', 'l']}],
    }
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    bearing = outcome.spec.missions[0].bearing_deg
    assert bearing is not None
    assert bearing.provenance is Provenance.EXPLICIT
    assert outcome.spec.links[0].retransmissions.provenance is Provenance.EXPLICIT
    reading['missions'][0]['bearing_deg']['value'] = 90
    assert 'no number' in judged(reading, prompt).complaints[0]


def test_number_of_an_unread_clause_is_not_borrowed(judged: Callable[..., Judgement]) -> None:
    prompt = 'Paint it 80 m high. A drone hovers over my car at 80 m.'
    reading: dict[str, Any] = {
        'agents': [{'id': 'ego', 'type': 'car', 'quote': 'my car'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'hover',
                'target': 'ego',
                'altitude_m': metres(80, '80 m'),
                'quote': 'A drone hovers over my car',
            }
        ],
        'clauses': [
            {'quote': 'Paint it 80 m high', 'status': 'not_encoded'},
            {'quote': 'A drone hovers over my car at 80 m', 'status': 'encoded', 'ids': ['m']},
        ],
    }
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    span = outcome.spec.missions[0].altitude_m.span
    assert span is not None
    assert span.start == prompt.rindex('80 m')


@pytest.mark.parametrize(
    ('prompt', 'bound'),
    [
        ('A drone climbs up to 60 m and hovers there.', 'exactly'),
        ('Drone up to 60 m, hover there.', 'exactly'),
        ('A drone hovers there at up to 60 m.', 'at_most'),
    ],
)
def test_a_way_up_is_no_bound(judged: Callable[..., Judgement], prompt: str, bound: str) -> None:
    uav = {'id': 'uav1', 'quote': 'drone' if 'drone' in prompt else 'Drone'}
    mission = {
        'id': 'm1', 'uav': 'uav1', 'mode': 'hover', 'quote': prompt[:-1],
        'altitude_m': metres(60.0, '60 m'),
    }  # fmt: skip
    clauses = [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m1']}]
    reading = {'uavs': [uav], 'missions': [mission], 'clauses': clauses}
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    assert outcome.spec.missions[0].altitude_m.bound.value == bound
