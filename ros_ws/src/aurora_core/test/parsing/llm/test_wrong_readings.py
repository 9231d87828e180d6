# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a right reading may say is no way out for a wrong one: objected to, or admitted."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from yaml_rows import rows_of

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.spec.vocabulary import ClauseStatus

_FILE = Path(__file__).with_name('right_readings.yaml')
_ROWS = {row['about']: row for row in rows_of(_FILE)}
CONTEXT = ParseContext(landmark_names=('City Hall', 'Meadow Park', 'Harbor Market'))
Answer = dict[str, Any]


def _purpose_of_a_demand(a: Answer) -> None:
    a['clauses'][2] |= {'status': 'no_requirement', 'ids': []}


def _thanks_with_a_place(a: Answer) -> None:
    a['missions'], a['uavs'] = [], []
    a['clauses'][0] |= {'status': 'no_requirement', 'ids': []}


def _half_for_a_quarter(a: Answer) -> None:
    a['conditions'][0]['value']['value'] = 0.25


def _loss_for_none(a: Answer) -> None:
    a['links'][0]['loss']['value'] = 0.2


def _third_van(a: Answer) -> None:
    a['agents'].append({'id': 'van3', 'type': 'van', 'quote': 'a black van'})


def _second_vehicle(a: Answer) -> None:
    a['agents'].append({'id': 'car2', 'type': 'car', 'quote': 'The vehicle'})
    a['agents'].append({'id': 'car3', 'type': 'car', 'quote': 'The vehicle'})


def _order_of_nothing(a: Answer) -> None:
    a['orders'][0]['then'] = 'bus1'


def _empty_event(a: Answer) -> None:
    del a['events'][0]['trigger']


def _forbidden_twice(a: Answer) -> None:
    a['forbidden'][1]['agent'] = 'van1'


def _height_for_a_distance(a: Answer) -> None:
    a['missions'][0]['altitude_m'] = a['missions'][0].pop('standoff_m')


def _denied_and_done(a: Answer) -> None:
    a['forbidden'] = [a['forbidden'][1]]
    a['clauses'][0]['ids'] = ['van1']


def _landed_place(a: Answer) -> None:
    a['conditions'][1]['of'] = ['intersection']


def _separation_of_one(a: Answer) -> None:
    a['conditions'][0]['of'] = ['uav1']


def _unit_of_another_quantity(a: Answer) -> None:
    a['conditions'][0]['quantity'] = 'speed'


def _missing_value(a: Answer) -> None:
    del a['conditions'][0]['value']


def _demand_in_a_range(a: Answer) -> None:
    a['missions'][0].pop('altitude_m')
    said = {'value': 35, 'unit': 'm', 'quote': 'between 30 and 40 m'}
    a['conditions'] = [
        {'id': 'c1', 'quantity': 'altitude', 'of': ['uav1'], 'op': '>=', 'value': said}
        | {'quote': 'at between 30 and 40 m'}
    ]
    a['clauses'][0]['ids'].append('c1')


def _sum_of_nothing(a: Answer) -> None:
    a['links'][0]['outage_to_s']['value'] = 47


def _other_height_of_two(a: Answer) -> None:
    a['missions'][0]['altitude_m']['value'] = 45


def _within_as_beyond(a: Answer) -> None:
    a['events'][0]['trigger']['on'] = 'distance_above'


def _act_of_another_verb(a: Answer) -> None:
    a['events'][0]['action']['do'] = 'accelerate'


def _turned_bound(a: Answer) -> None:
    a['conditions'][0]['op'] = '<='


def _turned_sight(a: Answer) -> None:
    a['events'][0]['trigger']['on'] = 'occluded'


def _turned_message(a: Answer) -> None:
    a['events'][0]['action'] |= {'subject': 'ego', 'receiver': 'uav1'}
    a['events'][0]['quote'] = 'the drone warns the car'


@pytest.mark.parametrize(
    ('about', 'lie', 'words'),
    [
        ('a title and a purpose', _purpose_of_a_demand, 'cannot be no_requirement'),
        ('thanks with a name, and a remark', _thanks_with_a_place, 'cannot be no_requirement'),
        ('a share in words', _half_for_a_quarter, 'is not what'),
        ('zero in words', _loss_for_none, 'is not what'),
        ('a negation that only tells who is meant', _third_van, 'there are more'),
        ('two nouns for one actor', _second_vehicle, 'there are more'),
        ('an order without an event of its own', _order_of_nothing, 'no event or mission'),
        ('a milestone that others wait for', _empty_event, 'a trigger, an action or both'),
        ('prohibitions of several kinds', _forbidden_twice, 'expected agent with kind, type'),
        ('prohibitions of several kinds', _denied_and_done, 'denies something'),
        ('landed and completed with deadlines', _landed_place, 'landed is of [UAV]'),
        ('count words and ordinals', _separation_of_one, 'separation is of [body, body'),
        ('count words and ordinals', _unit_of_another_quantity, "speed is in 'm/s', found 'm'"),
        ('count words and ordinals', _missing_value, 'needs op and a value'),
        ('zero in words', _within_as_beyond, 'says the opposite'),
        ('two nouns for one actor', _act_of_another_verb, 'says brake, found accelerate'),
        ('count words and ordinals', _turned_bound, 'at_least'),
        ('a milestone that others wait for', _turned_sight, 'that somebody is seen'),
        ('a message over a link', _height_for_a_distance, 'say standoff_m'),
        ('a message over a link', _turned_message, 'the other way round'),
        ('a height out of a range', _demand_in_a_range, 'is not what'),
        ('a height out of a range', _other_height_of_two, 'is not what'),
        ('the end of an outage is the sum of two numbers', _sum_of_nothing, "states '8 s'"),
    ],
    ids=lambda value: getattr(value, '__name__', ''),
)
def test_wrong_reading_goes_back(about: str, lie: Callable[[Answer], None], words: str) -> None:
    row = copy.deepcopy(_ROWS[about])
    lie(row['answer'])
    judgement = judge(json.dumps(row['answer']), PromptFacts(row['prompt'], CONTEXT))
    assert judgement.outcome is None
    assert any(words in complaint for complaint in judgement.complaints), judgement.complaints


def test_words_that_nothing_carries_are_admitted_and_not_forced() -> None:
    """The model drops `all vehicles` and the speed below which one slows down."""
    prompt = (
        'A drone tracks a bus and warns all vehicles near it. '
        'At 20 s the bus slows to below 5 m/s.'
    )
    reading: Answer = {
        'agents': [{'id': 'bus1', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'uav1', 'quote': 'A drone'}],
        'missions': [
            {'id': 'm1', 'uav': 'uav1', 'mode': 'track', 'target': 'bus1', 'quote': 'tracks a bus'}
        ],
        'events': [
            {
                'id': 'e1',
                'action': {'do': 'send_message', 'subject': 'uav1', 'receiver': 'bus1'},
                'quote': 'warns all vehicles near it',
            },
            {
                'id': 'e2',
                'trigger': {'on': 'time', 'value': {'value': 20, 'unit': 's', 'quote': '20 s'}},
                'action': {
                    'do': 'slow',
                    'subject': 'bus1',
                    'value': {'value': 5, 'unit': 'm/s', 'quote': '5 m/s'},
                },
                'quote': 'the bus slows',
            },
        ],
        'clauses': [
            {
                'quote': 'A drone tracks a bus and warns all vehicles near it',
                'status': 'encoded',
                'ids': ['bus1', 'm1', 'e1'],
            },
            {
                'quote': 'At 20 s the bus slows to below 5 m/s',
                'status': 'encoded',
                'ids': ['e2'],
            },
        ],
    }
    judgement = judge(json.dumps(reading), PromptFacts(prompt, CONTEXT))
    assert judgement.complaints == ()
    assert judgement.outcome is not None
    open_words = {
        c.text for c in judgement.outcome.clauses if c.status is ClauseStatus.NOT_ENCODED
    }
    assert {'all vehicles', 'below 5 m/s'} <= open_words


@pytest.mark.parametrize(
    ('words', 'field', 'value', 'unit'),
    [
        ('at 30 m and then at 20 m', 'altitude_m', 50.0, 'm'),
        ('for 20 s and then for 40 s', 'duration_s', 60.0, 's'),
    ],
)
def test_two_stated_values_do_not_become_their_sum(
    words: str, field: str, value: float, unit: str
) -> None:
    prompt = f'A drone tracks a bus {words}.'
    number = {'value': value, 'unit': unit, 'provenance': 'inferred'}
    mission = {'id': 'm1', 'uav': 'uav1', 'mode': 'track', 'target': 'bus1', field: number}
    answer: Answer = {
        'agents': [{'id': 'bus1', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'uav1', 'quote': 'A drone'}],
        'missions': [{**mission, 'quote': 'tracks a bus'}],
        'clauses': [{'quote': prompt, 'status': 'encoded', 'ids': ['m1', 'bus1']}],
    }
    judgement = judge(json.dumps(answer), PromptFacts(prompt, CONTEXT))
    assert judgement.outcome is None
    assert len([c for c in judgement.complaints if 'the prompt states' in c]) == 2
