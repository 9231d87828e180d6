# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model may not get away with, one lie at a time."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.parsing.llm.check import Judgement, judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.outcome import ParseContext, RefusalKind
from aurora_core.spec.parameter import Bound, Provenance
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('clock_tower',))
PROMPT = (
    'In fog, a drone tracks a bus from 25 m below 40 m altitude near the clock tower. '
    'When a car comes within 20 m of the bus, the drone warns my car. Two vans circulate.'
)
GOOD: dict[str, Any] = {
    'world': {'weather': 'fog'},
    'agents': [
        {
            'id': 'bus1',
            'type': 'bus',
            'quote': 'a bus',
            'placements': [
                {'relation': 'near', 'of': 'landmark:clock_tower', 'quote': 'near the clock tower'}
            ],
        },
        {'id': 'car1', 'type': 'car', 'quote': 'a car'},
        {'id': 'ego', 'type': 'car', 'quote': 'my car'},
        {
            'id': 'van1',
            'type': 'van',
            'quote': 'Two vans',
            'behaviors': [{'kind': 'circulate', 'quote': 'circulate'}],
        },
        {
            'id': 'van2',
            'type': 'van',
            'quote': 'Two vans',
            'behaviors': [{'kind': 'circulate', 'quote': 'circulate'}],
        },
    ],
    'uavs': [{'id': 'uav1', 'quote': 'a drone'}],
    'missions': [
        {
            'id': 'm1',
            'uav': 'uav1',
            'mode': 'track',
            'target': 'bus1',
            'standoff_m': {'value': 25, 'unit': 'm', 'quote': '25 m'},
            'altitude_m': {'value': 40, 'unit': 'm', 'quote': '40 m'},
            'quote': 'a drone tracks a bus',
        }
    ],
    'events': [
        {
            'id': 'e1',
            'trigger': {
                'on': 'distance_below',
                'subject': 'car1',
                'other': 'bus1',
                'value': {'value': 20, 'unit': 'm', 'quote': 'within 20 m'},
            },
            'action': {'do': 'send_message', 'subject': 'uav1', 'receiver': 'ego'},
            'quote': 'the drone warns my car',
        }
    ],
    'clauses': [
        {'quote': 'In fog', 'status': 'encoded', 'ids': ['world']},
        {
            'quote': 'a drone tracks a bus from 25 m below 40 m altitude near the clock tower',
            'status': 'encoded',
            'ids': ['m1', 'bus1'],
        },
        {
            'quote': 'When a car comes within 20 m of the bus, the drone warns my car',
            'status': 'encoded',
            'ids': ['e1', 'car1', 'ego'],
        },
        {'quote': 'Two vans circulate', 'status': 'encoded', 'ids': ['van1', 'van2']},
    ],
}


def judged(reading: dict[str, Any], prompt: str = PROMPT) -> Judgement:
    return judge(json.dumps(reading), PromptFacts(prompt, CONTEXT))


def test_good_answer_is_taken_with_values_and_spans_of_the_prompt() -> None:
    outcome = judged(GOOD).outcome
    assert outcome is not None
    assert outcome.spec is not None
    mission = outcome.spec.missions[0]
    assert mission.altitude_m.provenance is Provenance.EXPLICIT
    assert mission.altitude_m.bound is Bound.AT_MOST
    span = mission.altitude_m.span
    assert span is not None
    assert PROMPT[span.start : span.end] == '40 m'
    assert outcome.spec.links[0].sender == 'uav1'
    assert [a.group for a in outcome.spec.agents][-2:] == ['van_group1', 'van_group1']


def number(value: float, quote: str, unit: str = 'm', **more: Any) -> dict[str, Any]:
    return {'value': value, 'unit': unit, 'quote': quote, **more}


def invented_number(r: dict[str, Any]) -> None:
    r['missions'][0]['duration_s'] = number(60, '60 s', 's')


def number_with_somebody_elses_words(r: dict[str, Any]) -> None:
    r['missions'][0]['duration_s'] = number(60, 'a bus', 's')


def changed_number(r: dict[str, Any]) -> None:
    r['missions'][0]['altitude_m'] = number(45, '40 m')


def wrong_dimension(r: dict[str, Any]) -> None:
    r['missions'][0]['duration_s'] = number(40, '40 m', 's')


def feet_for_metres(r: dict[str, Any]) -> None:
    r['missions'][0]['altitude_m'] = number(12.19, '40 m')


def wrong_unit(r: dict[str, Any]) -> None:
    r['missions'][0]['altitude_m'] = number(40, '40 m', 's')


def lost_number(r: dict[str, Any]) -> None:
    del r['missions'][0]['standoff_m']


def stated_number_as_inferred(r: dict[str, Any]) -> None:
    r['missions'][0]['standoff_m'] = number(25, '', provenance='inferred')


def inferred_out_of_domain(r: dict[str, Any]) -> None:
    r['missions'][0]['speed_mps'] = number(400, '', 'm/s', provenance='inferred')


def invented_agent(r: dict[str, Any]) -> None:
    r['agents'].append({'id': 'truck1', 'type': 'truck', 'quote': 'a truck'})
    r['clauses'][0]['ids'].append('truck1')


def agent_with_somebody_elses_words(r: dict[str, Any]) -> None:
    r['agents'].append({'id': 'truck1', 'type': 'truck', 'quote': 'the bus'})
    r['clauses'][0]['ids'].append('truck1')


def second_bus(r: dict[str, Any]) -> None:
    r['agents'].append({'id': 'bus2', 'type': 'bus', 'quote': 'the bus'})
    r['clauses'][0]['ids'].append('bus2')


def third_van(r: dict[str, Any]) -> None:
    r['agents'].append({'id': 'van3', 'type': 'van', 'quote': 'Two vans'})
    r['clauses'][3]['ids'].append('van3')


def lost_van(r: dict[str, Any]) -> None:
    del r['agents'][4]
    r['clauses'][3]['ids'] = ['van1']


def lost_agent(r: dict[str, Any]) -> None:
    del r['agents'][3:]
    r['clauses'][3]['ids'] = ['bus1']


def invented_uav(r: dict[str, Any]) -> None:
    r['uavs'].append({'id': 'uav2', 'quote': 'the drone'})


def invented_place(r: dict[str, Any]) -> None:
    r['missions'][0]['target'] = 'crosswalk'


def lost_place(r: dict[str, Any]) -> None:
    del r['agents'][0]['placements']


def invented_weather(r: dict[str, Any]) -> None:
    r['world']['weather'] = 'snow'


def lost_weather(r: dict[str, Any]) -> None:
    r['world'] = {}


def invented_time(r: dict[str, Any]) -> None:
    r['world']['time_of_day'] = 'night'


def lost_clause(r: dict[str, Any]) -> None:
    del r['clauses'][2]


def clause_that_is_not_there(r: dict[str, Any]) -> None:
    r['clauses'][0]['quote'] = 'In dense fog'


def clause_of_an_unknown_id(r: dict[str, Any]) -> None:
    r['clauses'][0]['ids'] = ['w1']


def encoded_into_nothing(r: dict[str, Any]) -> None:
    r['clauses'][0]['ids'] = []


def demand_called_politeness(r: dict[str, Any]) -> None:
    r['clauses'][3] |= {'status': 'no_requirement', 'ids': []}


def unknown_wish_called_politeness(r: dict[str, Any]) -> None:
    r['clauses'].append({'quote': 'near', 'status': 'no_requirement'})


def one_number_with_two_meanings(r: dict[str, Any]) -> None:
    r['missions'][0]['length_m'] = number(25, '25 m')


def reference_to_itself(r: dict[str, Any]) -> None:
    r['agents'][0]['behaviors'] = [{'kind': 'follow', 'target': 'bus1', 'quote': 'a bus'}]


def uav_that_brakes(r: dict[str, Any]) -> None:
    r['events'][0]['action'] = {'do': 'brake', 'subject': 'uav1'}


def message_to_a_place(r: dict[str, Any]) -> None:
    r['events'][0]['action']['receiver'] = 'crosswalk'


def change_to_an_unknown_mission(r: dict[str, Any]) -> None:
    r['events'][0]['action'] = {'do': 'change_mission', 'subject': 'uav1', 'mission': 'm9'}


def verb_of_another_behaviour(r: dict[str, Any]) -> None:
    r['agents'][3]['behaviors'][0]['kind'] = 'overtake'


def behaviour_left_out(r: dict[str, Any]) -> None:
    del r['agents'][3]['behaviors'], r['agents'][4]['behaviors']


def mission_of_another_mode(r: dict[str, Any]) -> None:
    r['missions'][0]['mode'] = 'hover'


def streets_that_nobody_named(r: dict[str, Any]) -> None:
    r['missions'][0]['over_streets'] = True


def no_landing_that_nobody_asked_for(r: dict[str, Any]) -> None:
    r['missions'][0]['ends_in_flight'] = True


def another_relation(r: dict[str, Any]) -> None:
    r['agents'][0]['placements'][0]['relation'] = 'behind'


def generic_vehicle_of_some_type(r: dict[str, Any]) -> None:
    r['agents'][2] |= {'type': 'van', 'quote': 'my car'}


def message_to_oneself(r: dict[str, Any]) -> None:
    r['events'][0]['action']['receiver'] = 'uav1'


def tracked_place(r: dict[str, Any]) -> None:
    r['missions'][0]['target'] = 'landmark:clock_tower'


def event_from_nowhere(r: dict[str, Any]) -> None:
    r['clauses'][2]['ids'] = ['ego', 'car1']


def unheard_warning(r: dict[str, Any]) -> None:
    del r['events']
    r['clauses'][2]['ids'] = ['ego', 'car1']
    r['missions'][0]['length_m'] = number(20, '20 m')


def dangling_reference(r: dict[str, Any]) -> None:
    r['missions'][0]['target'] = 'bus7'


def same_id_twice(r: dict[str, Any]) -> None:
    r['uavs'][0]['id'] = 'm1'
    r['missions'][0]['uav'] = 'm1'
    r['events'][0]['action']['subject'] = 'm1'


def field_outside_the_schema(r: dict[str, Any]) -> None:
    r['missions'][0]['explode'] = True


def number_as_text(r: dict[str, Any]) -> None:
    r['missions'][0]['altitude_m']['value'] = '40'


def type_outside_the_list(r: dict[str, Any]) -> None:
    r['agents'][0]['type'] = 'tank'


def trigger_without_its_field(r: dict[str, Any]) -> None:
    del r['events'][0]['trigger']['other']


def known_type_called_missing(r: dict[str, Any]) -> None:
    r['missing'] = [{'quote': 'a bus', 'kind': 'agent_type'}]


@pytest.mark.parametrize(
    ('lie', 'words'),
    [
        (invented_number, 'not in the prompt'),
        (number_with_somebody_elses_words, 'no number'),
        (changed_number, "'40 m'"),
        (wrong_dimension, "'40 m'"),
        (feet_for_metres, "'40 m'"),
        (wrong_unit, "expected the unit 'm'"),
        (lost_number, "states '25 m'"),
        (stated_number_as_inferred, "states '25 m'"),
        (inferred_out_of_domain, 'must be in'),
        (invented_agent, 'truck1'),
        (agent_with_somebody_elses_words, 'truck1'),
        (second_bus, 'already named'),
        (third_van, 'there are more'),
        (lost_van, 'expected 2 actors'),
        (lost_agent, "'Two vans'"),
        (invented_uav, 'already named'),
        (invented_place, 'no crosswalk'),
        (lost_place, 'landmark:clock_tower'),
        (invented_weather, 'expected fog'),
        (lost_weather, 'expected fog'),
        (invented_time, 'time_of_day: expected null'),
        (lost_clause, 'is in no clause'),
        (clause_that_is_not_there, "'In dense fog' is not in the prompt"),
        (clause_of_an_unknown_id, 'cites w1'),
        (encoded_into_nothing, 'cites no id'),
        (demand_called_politeness, 'cannot be no_requirement'),
        (unknown_wish_called_politeness, 'cannot be no_requirement'),
        (one_number_with_two_meanings, 'one stated number has one meaning'),
        (reference_to_itself, 'not its own target'),
        (uav_that_brakes, 'is not a ground agent'),
        (message_to_a_place, 'is not an actor'),
        (change_to_an_unknown_mission, 'no mission of the answer'),
        (tracked_place, 'is not an actor'),
        (verb_of_another_behaviour, "'circulate' says circulate, found overtake"),
        (behaviour_left_out, "'circulate' is said and nothing in the answer does it"),
        (mission_of_another_mode, 'says track, found hover'),
        (streets_that_nobody_named, 'over_streets: the prompt does not say so'),
        (no_landing_that_nobody_asked_for, 'ends_in_flight: the prompt does not say so'),
        (another_relation, "'near the clock tower' says near, found behind"),
        (generic_vehicle_of_some_type, 'does not name a van'),
        (message_to_oneself, 'sender and receiver are the same'),
        (event_from_nowhere, 'e1: no encoded clause cites it'),
        (unheard_warning, 'cites no event'),
        (dangling_reference, "'bus7'"),
        (same_id_twice, 'used twice'),
        (field_outside_the_schema, 'explode'),
        (number_as_text, 'altitude_m.value'),
        (type_outside_the_list, 'agents.0.type'),
        (trigger_without_its_field, 'b: Field required'),
        (known_type_called_missing, "'a bus' does not name something that is missing"),
    ],
    ids=lambda value: getattr(value, '__name__', ''),
)
def test_lie_is_turned_down(lie: Callable[[dict[str, Any]], None], words: str) -> None:
    reading = copy.deepcopy(GOOD)
    lie(reading)
    judgement = judged(reading)
    assert judgement.outcome is None
    assert any(words in complaint for complaint in judgement.complaints), judgement.complaints


def test_what_is_admitted_not_to_be_encoded_is_no_lie() -> None:
    reading = copy.deepcopy(GOOD)
    lost_agent(reading)
    reading['clauses'][3] |= {'status': 'not_encoded', 'ids': [], 'note': 'too many'}
    outcome = judged(reading).outcome
    assert outcome is not None
    assert outcome.clauses[3].status is ClauseStatus.NOT_ENCODED


def test_both_ends_of_a_range_are_wanted() -> None:
    prompt = 'A drone hovers over my car and stays between 20 and 30 m above ground.'
    low = {
        'id': 'c1',
        'quantity': 'altitude',
        'of': ['u'],
        'op': '>=',
        'value': number(20, 'between 20 and 30 m'),
        'quote': 'stays between 20 and 30 m above ground',
    }
    high = {**low, 'id': 'c2', 'op': '<=', 'value': number(30, '20 and 30 m')}
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


def test_the_same_number_twice_is_two_numbers() -> None:
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
                'standoff_m': number(30, '30 m'),
                'quote': 'tracks a bus',
            }
        ],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }
    assert "'30 m'" in judged(reading, prompt).complaints[0]
    reading['missions'][0]['altitude_m'] = number(30, '30 m')
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    mission = outcome.spec.missions[0]
    assert mission.standoff_m is not None
    assert mission.altitude_m.span != mission.standoff_m.span


def test_bearing_and_no_retries_are_stated_in_words() -> None:
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
                'bearing_deg': number(0, 'from the north', 'deg'),
                'quote': 'A drone follows my car',
            }
        ],
        'links': [
            {
                'id': 'l',
                'sender': 'u',
                'receiver': 'ego',
                'retransmissions': number(0, 'no retransmissions', '1'),
                'quote': 'no retransmissions',
            }
        ],
        'events': [
            {
                'id': 'e',
                'trigger': {'on': 'time', 'value': number(10, '10 s', 's')},
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


@pytest.mark.parametrize(
    ('prompt', 'quote', 'kind', 'expected'),
    [
        ('A drone tracks a unicorn.', 'a unicorn', 'agent_type', RefusalKind.UNSUPPORTED),
        ('A drone follows a helicopter.', 'helicopter', 'agent_type', RefusalKind.UNSUPPORTED),
        ('A drone hovers over the castle.', 'castle', 'landmark', RefusalKind.MISSING_ELEMENT),
    ],
)
def test_what_does_not_exist_is_refused_with_the_closed_list(
    prompt: str, quote: str, kind: str, expected: RefusalKind
) -> None:
    outcome = judged({'missing': [{'quote': quote, 'kind': kind}]}, prompt).outcome
    assert outcome is not None
    assert [r.kind for r in outcome.refusals] == [expected]
    assert outcome.refusals[0].closed_list


def test_unicorn_does_not_become_a_car() -> None:
    prompt = 'A drone tracks a unicorn.'
    reading = {
        'agents': [{'id': 'c', 'type': 'car', 'quote': 'a unicorn'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [{'id': 'm', 'uav': 'u', 'mode': 'track', 'target': 'c', 'quote': 'tracks'}],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'c']}],
    }
    assert 'does not name a car' in judged(reading, prompt).complaints[0]


def test_missing_that_only_the_model_claims_is_a_question_and_no_proof() -> None:
    prompt = 'A drone gently zorbles a bus.'
    outcome = judged({'missing': [{'quote': 'zorbles', 'kind': 'agent_type'}]}, prompt).outcome
    assert outcome is not None
    assert (outcome.spec, outcome.refusals) == (None, ())
    assert outcome.question is not None
    assert "'zorbles' is not one of the agent types" in outcome.question


def test_words_that_only_the_model_understood_are_named_in_the_clause() -> None:
    prompt = 'A drone shadows a bus zealously.'
    reading = {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'a bus'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [{'id': 'm', 'uav': 'u', 'mode': 'track', 'target': 'b', 'quote': 'shadows'}],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.clauses[0].note == "understood by the model alone: 'zealously'"


def test_denial_is_no_request_for_the_thing_denied() -> None:
    prompt = 'A drone must not follow the bus.'
    reading = {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'the bus'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [{'id': 'm', 'uav': 'u', 'mode': 'track', 'target': 'b', 'quote': 'follow'}],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }
    assert 'denies something' in judged(reading, prompt).complaints[0]


def test_naming_what_is_not_wanted_asks_for_nothing() -> None:
    prompt = 'A bus and no drone.'
    reading: dict[str, Any] = {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'A bus'}],
        'clauses': [
            {'quote': 'A bus', 'status': 'encoded', 'ids': ['b']},
            {'quote': 'no drone', 'status': 'no_requirement'},
        ],
    }
    outcome = judged(reading, prompt).outcome
    assert outcome is not None
    assert outcome.spec is not None
    assert outcome.spec.uavs == ()
    reading['uavs'] = [{'id': 'u', 'quote': 'drone'}]
    assert judged(reading, prompt).complaints


def test_number_of_an_unread_clause_is_not_borrowed() -> None:
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
                'altitude_m': number(80, '80 m'),
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


def test_question_of_the_model_is_asked() -> None:
    outcome = judged({'question': 'Which bus?'}).outcome
    assert outcome is not None
    assert (outcome.spec, outcome.question) == (None, 'Which bus?')
