# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Turns, sides and winds that a model reads reach the specification, and only where they fit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.parsing.llm.check import Judgement
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavAction
from aurora_core.spec.vocabulary import RelativeWind, Side

Judge = Callable[..., Judgement]
ORBIT = 'A drone flies two turns round a bus on an orbit.'
WAY = 'A drone flies from the crosswalk to the intersection.'
TRACK = 'In a crosswind of 6 m/s a drone tracks a bus on its left.'


def _orbit(**mission: Any) -> dict[str, Any]:
    turns = {'value': 2, 'unit': '1', 'quote': 'two turns'}
    return {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'navigate',
                'pattern': 'orbit',
                'target': 'b',
                'turns': turns,
                'quote': 'flies two turns round a bus on an orbit',
                **mission,
            }
        ],
        'clauses': [{'quote': ORBIT[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }


def _track(**mission: Any) -> dict[str, Any]:
    return {
        'world': {
            'wind': 'crosswind',
            'wind_mps': {'value': 6, 'unit': 'm/s', 'quote': '6 m/s'},
        },
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'u', 'quote': 'a drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'track',
                'target': 'b',
                'side': 'left',
                'quote': 'tracks a bus on its left',
                **mission,
            }
        ],
        'clauses': [
            {'quote': 'In a crosswind of 6 m/s', 'status': 'encoded', 'ids': ['world']},
            {
                'quote': 'a drone tracks a bus on its left',
                'status': 'encoded',
                'ids': ['m', 'b'],
            },
        ],
    }


def _way(**mission: Any) -> dict[str, Any]:
    return {
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'navigate',
                'pattern': 'waypoints',
                'start': 'crosswalk',
                'target': 'intersection',
                'quote': WAY[2:-1],
                **mission,
            }
        ],
        'clauses': [{'quote': WAY[:-1], 'status': 'encoded', 'ids': ['m', 'u']}],
    }


def _spec(judgement: Judgement) -> ScenarioSpec:
    assert judgement.outcome is not None, judgement.complaints
    assert judgement.outcome.spec is not None
    return judgement.outcome.spec


def test_turns_are_read_from_their_words(judged: Judge) -> None:
    turns = _spec(judged(_orbit(), ORBIT)).missions[0].turns
    assert turns is not None
    assert (turns.value, turns.provenance) == (2.0, Provenance.EXPLICIT)


def test_a_way_between_two_places_is_read(judged: Judge) -> None:
    (mission,) = _spec(judged(_way(), WAY)).missions
    assert (mission.start, mission.target) == ('crosswalk', 'intersection')
    assert (mission.waypoint_count, mission.size_m) == (None, None)


def test_a_side_and_a_wind_are_read(judged: Judge) -> None:
    spec = _spec(judged(_track(), TRACK))
    assert spec.missions[0].side is Side.LEFT
    assert spec.world.wind is RelativeWind.CROSSWIND
    assert spec.world.wind_mps is not None
    assert (spec.world.wind_mps.value, spec.world.wind_from_deg) == (6.0, None)


def test_a_return_is_read(judged: Judge) -> None:
    prompt = 'A drone flies two turns round a bus on an orbit. After 60 s it returns to its start.'
    reading = _orbit()
    reading['events'] = [
        {
            'id': 'e',
            'trigger': {'on': 'time', 'value': {'value': 60, 'unit': 's', 'quote': '60 s'}},
            'action': {'do': 'return_home', 'subject': 'u'},
            'quote': 'it returns to its start',
        }
    ]
    said = {'quote': 'After 60 s it returns to its start', 'status': 'encoded', 'ids': ['e']}
    reading['clauses'].append(said)
    action = _spec(judged(reading, prompt)).events[0].action
    assert isinstance(action, UavAction)
    assert (action.do, action.uav, action.lands) == ('return_home', 'uav1', True)


@pytest.mark.parametrize(
    ('reading', 'prompt', 'words'),
    [
        (_orbit(pattern='rectangle'), ORBIT, 'only an orbit has turns'),
        (_way(pattern='orbit'), WAY, 'a way by waypoints leads'),
        (_track(mode='hover'), TRACK, 'only who tracks keeps to a side'),
    ],
)
def test_what_does_not_fit_is_objected_to(
    judged: Judge, reading: dict[str, Any], prompt: str, words: str
) -> None:
    assert any(words in text for text in judged(reading, prompt).complaints)
