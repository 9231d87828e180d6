# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a model may not get away with, one lie at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.parsing.llm.check import Judgement


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
def test_lie_is_turned_down(
    lie: Callable[[dict[str, Any]], None],
    words: str,
    good: dict[str, Any],
    judged: Callable[..., Judgement],
) -> None:
    lie(good)
    judgement = judged(good)
    assert judgement.outcome is None
    assert any(words in complaint for complaint in judgement.complaints), judgement.complaints
