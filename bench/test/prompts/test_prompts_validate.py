# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The validator finds every planted error, and none in the shipped prompts."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.validate import validate

Doc = dict[str, Any]
Plant = Callable[[Doc], None]


def good() -> Doc:
    """Return a prompt without any error."""
    return {
        'id': 'track-901',
        'category': 'track',
        'prompt': 'A van tailgates my car, 45 m behind it; a drone tracks the van at 30 to 40 m '
        'altitude for half a minute and warns my car below 20 m at City Hall.',
        'feasibility': 'feasible',
        'paraphrase_group': None,
        'end_to_end': True,
        'requirements': [
            {'id': 'r1', 'kind': 'agent', 'ref': 'ego', 'type': 'car', 'role': 'ego'},
            {'id': 'r2', 'kind': 'agent', 'ref': 'van1', 'type': 'van'},
            {'id': 'r3', 'kind': 'uav', 'ref': 'uav1'},
            {
                'id': 'r4', 'kind': 'placement', 'agent': 'van1', 'relation': 'behind',
                'of': 'ego', 'distance_m': 45,
            },
            {
                'id': 'r5', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'track',
                'target': 'van1', 'altitude_m': 35, 'duration_s': 30,
            },
            {
                'id': 'r6', 'kind': 'event', 'ref': 'e1',
                'trigger': {'on': 'distance_below', 'a': 'van1', 'b': 'ego', 'value_m': 20},
                'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'ego'},
            },
            {'id': 'r7', 'kind': 'order', 'first': 'm1', 'then': 'e1'},
            {'id': 'r8', 'kind': 'any_of', 'any_of': [
                {
                    'id': 'r9', 'kind': 'placement', 'agent': 'van1', 'relation': 'at',
                    'of': 'City Hall',
                },
                {
                    'id': 'r10', 'kind': 'behavior', 'agent': 'van1', 'behavior': 'tailgate',
                    'target': 'ego',
                },
            ]},
        ],
        'variation': {'r5.altitude_m': [30, 40]},
    }  # fmt: skip


def found(*documents: Doc) -> tuple[Finding, ...]:
    """Return what the validator finds in documents, one a line."""
    return validate(['\n'.join(json.dumps(d) for d in documents)])[1]


def put(path: str, value: object) -> Plant:
    """Return a plant that writes a value at a path such as `r5.altitude_m` or `prompt`."""

    def plant(document: Doc) -> None:
        *parents, last = path.split('.')
        place: Any = document
        for name in parents:
            place = (
                next(r for r in place['requirements'] if r['id'] == name)
                if name[0] == 'r' and (name[1:].isdigit())
                else place[name]
            )
        place[last] = value

    return plant


def drop(path: str) -> Plant:
    """Return a plant that leaves out a field."""

    def plant(document: Doc) -> None:
        *parents, last = path.split('.')
        place: Any = document
        for name in parents:
            place = next(r for r in place['requirements'] if r['id'] == name)
        del place[last]

    return plant


def more(**fields: object) -> Plant:
    """Return a plant that adds a requirement."""

    def plant(document: Doc) -> None:
        document['requirements'].append({'id': 'r20', **fields})

    return plant


def condition(quantity: str, of: list[str], value: object, **more_fields: object) -> Plant:
    """Return a plant that adds a condition."""
    return more(kind='condition', quantity=quantity, of=of, op='==', value=value, **more_fields)


# What is planted, how, the rule that must find it, and words that its finding must have.
PLANTED = [
    ('category that is none', put('category', 'flying'), Rule.FORMAT, 'category: Input'),
    ('id with blanks', put('id', 'track 1'), Rule.FORMAT, 'id: String should match'),
    ('no prompt', put('prompt', ''), Rule.FORMAT, 'prompt: String should have'),
    ('feasibility that is none', put('feasibility', 'maybe'), Rule.FORMAT, 'feasibility: Input'),
    ('unknown field', put('difficulty', 3), Rule.FORMAT, 'difficulty: Extra'),
    ('no paraphrase group given', drop('paraphrase_group'), Rule.FORMAT, 'paraphrase_group'),
    ('unknown field of a requirement', put('r5.height_m', 35), Rule.FORMAT, 'height_m: Extra'),
    ('unknown kind', put('r7.kind', 'sequence'), Rule.FORMAT, "'sequence'"),
    ('unknown agent type', put('r2.type', 'lorry'), Rule.FORMAT, 'agent.type: Input'),
    ('unknown behaviour', more(kind='behavior', agent='ego', behavior='fly'), Rule.FORMAT,
     'behavior.behavior: Input'),
    ('unknown relation', put('r4.relation', 'under'), Rule.FORMAT, 'placement.relation: Input'),
    ('unknown quantity', condition('height', ['uav1'], 20), Rule.FORMAT, 'quantity: Input'),
    ('unknown reason', more(kind='reject', because='bad'), Rule.FORMAT, 'reject.because: Input'),
    ('number as text', put('r5.altitude_m', 'high'), Rule.FORMAT, 'altitude_m.float: Input'),
    ('one reading only', more(kind='any_of', any_of=[{'id': 'r30', 'kind': 'uav', 'ref': 'u'}]),
     Rule.FORMAT, 'any_of: Tuple should have at least 2'),
    ('field of another trigger', put('r6.trigger.at_s', 20), Rule.FORMAT,
     "distance_below has no 'at_s'"),
    ('field of another action', put('r6.action.agent', 'ego'), Rule.FORMAT,
     "send_message has no 'agent'"),
    ('event without trigger and action', more(kind='event', ref='e5'), Rule.FORMAT,
     'r20 has neither'),
    ('no requirements', put('requirements', []), Rule.FORMAT, 'requirements: Tuple'),
    ('repeated requirement id', put('r7.id', 'r10'), Rule.REQUIREMENT_ID, "'r10' is there twice"),
    ('agent that is not declared', put('r4.agent', 'bus1'), Rule.REFERENCE, "r4 names 'bus1'"),
    ('landmark that is not on the map', put('r5.target', 'Old Mill'), Rule.REFERENCE,
     "r5 names 'Old Mill'"),
    ('UAV that is none', put('r5.uav', 'van1'), Rule.REFERENCE, "r5: 'van1' is no UAV"),
    ('order of nothing', put('r7.then', 'e9'), Rule.REFERENCE, "r7: 'e9' is no event"),
    ('time of a body', condition('event_time', ['ego'], 30), Rule.REFERENCE,
     "r20: 'ego' is no event"),
    ('agent declared twice', put('r2.ref', 'ego'), Rule.REFERENCE, "'ego' is declared twice"),
    ('wait for itself', put('r6.trigger', {'on': 'event_done', 'event': 'e1'}), Rule.REFERENCE,
     "r6 waits for unknown 'e1'"),
    ('weather that is none', more(kind='world', field='weather', value='sunny'), Rule.MEANING,
     "weather is one of clear, cloudy, fog, heavy_rain, rain, snow, not 'sunny'"),
    ('duration in words', more(kind='world', field='duration_s', value='long'), Rule.MEANING,
     "duration_s cannot be 'long'"),
    ('distance below zero', put('r4.distance_m', -45), Rule.MEANING, 'r4.distance_m = -45 is'),
    ('tolerance below zero', put('r4.tol', -1), Rule.MEANING, 'r4.tol = -1 is below zero'),
    ('tolerance of nothing', put('r4.tol', {'height_m': 1}), Rule.MEANING, "to 'height_m'"),
    ('percent as a share', more(kind='link', sender='uav1', receiver='ego', loss=20),
     Rule.MEANING, 'r20.loss = 20 is no share'),
    ('behind itself', put('r4.of', 'van1'), Rule.MEANING, "'van1' cannot stand in relation"),
    ('link to itself', more(kind='link', sender='uav1', receiver='uav1'), Rule.MEANING,
     "'uav1' cannot stand in relation"),
    ('distance of one', condition('distance', ['uav1'], 20), Rule.MEANING, 'distance is of 2'),
    ('altitude that is yes', condition('altitude', ['uav1'], True), Rule.MEANING,
     'altitude cannot be True'),
    ('landed that is a number', condition('landed', ['uav1'], 20), Rule.MEANING,
     'landed cannot be 20'),
    ('two egos', put('r2.role', 'ego'), Rule.MEANING, 'one ego only'),
    ('two missions of one name', more(kind='mission', ref='m1', uav='uav1', mode='hover'),
     Rule.MEANING, "'m1' names two moments"),
    ('orbit flown by track', put('r5.pattern', 'orbit'), Rule.MEANING, 'flown by navigate'),
    ('UAV that tracks itself', put('r5.target', 'uav1'), Rule.MEANING, 'its own target'),
    ('nothing to execute', put('requirements', [
        {'id': 'r1', 'kind': 'world', 'field': 'weather', 'value': 'rain'}]),
     Rule.MEANING, 'marked end_to_end'),
    ('reference of a UAV that is not there', put('reference', {
        'prompt': good()['prompt'], 'missions': [{'id': 'm1', 'uav': 'u', 'mode': 'hover'}]}),
     Rule.MEANING, 'its reference is no specification'),
    ('reference of another prompt', put('reference', {'prompt': 'any'}), Rule.MEANING,
     'its reference is that of another prompt'),
    ('variation of nothing', put('variation', {'r5.radius_m': [1, 2]}), Rule.VARIATION,
     'r5.radius_m is no number'),
    ('variation that excludes its value', put('variation', {'r5.altitude_m': [40, 50]}),
     Rule.VARIATION, 'r5.altitude_m = 35.0 is outside [40.0, 50.0]'),
    ('variation upside down', put('variation', {'r5.altitude_m': [40, 30]}), Rule.VARIATION,
     'is outside [40.0, 30.0]'),
    ('another number than stated', put('r4.distance_m', 54), Rule.NOT_STATED,
     'r4.distance_m = 54 m'),
    ('feet as metres', put('prompt', good()['prompt'].replace('45 m', '45 ft')), Rule.NOT_STATED,
     'r4.distance_m = 45 m'),
    ('half a minute as half a second', put('r5.duration_s', 0.5), Rule.NOT_STATED,
     'r5.duration_s = 0.5 s'),
    ('a number that is nowhere', put('r5.standoff_m', 17), Rule.NOT_STATED, 'r5.standoff_m = 17'),
    ('stated number without annotation', drop('r4.distance_m'), Rule.NOT_ANNOTATED, "'45 m'"),
    ('duration without annotation', drop('r5.duration_s'), Rule.NOT_ANNOTATED, "'half a minute'"),
    ('feasible above the ceiling', put('r5.altitude_m', 135), Rule.LIMIT,
     'r5.altitude_m = 135 is outside altitude_m [3.0, 120.0]'),
    ('feasible and faster than a UAV flies', put('r5.speed_mps', 25), Rule.LIMIT,
     'r5.speed_mps = 25 is outside'),
    ('feasible and out of sight', put('r5.standoff_m', 900), Rule.LIMIT, 'sensing range'),
    ('more UAVs than there may be', put('r3.count', 40), Rule.LIMIT, 'UAVs = 40 is outside'),
    ('infeasible without a reason', put('feasibility', 'infeasible'), Rule.FEASIBILITY,
     'no requirement of kind reject'),
    ('refusal of a feasible prompt', more(kind='reject', because='count'), Rule.FEASIBILITY,
     'is feasible and asks for a refusal'),
    ('feasible among the infeasible', put('category', 'infeasible'), Rule.FEASIBILITY,
     'is feasible in category infeasible'),
    ('alone in its group', put('paraphrase_group', 'van-track'), Rule.PARAPHRASE,
     'is alone in paraphrase group van-track'),
]  # fmt: skip


def test_the_good_prompt_has_no_finding() -> None:
    assert [str(f) for f in found(good()) if f.is_error] == []


def test_there_are_more_than_thirty_errors_and_no_two_are_one() -> None:
    assert len({name for name, *_ in PLANTED}) == len(PLANTED) >= 30
    assert len({(rule, words) for *_, rule, words in PLANTED}) == len(PLANTED)


@pytest.mark.parametrize(
    ('plant', 'rule', 'words'),
    [p[1:] for p in PLANTED],
    ids=[p[0].replace(' ', '-') for p in PLANTED],
)
def test_a_planted_error_is_found_by_its_own_finding(plant: Plant, rule: Rule, words: str) -> None:
    document = good()
    plant(document)
    errors = [f for f in found(document) if f.is_error and f.rule is rule]
    assert any(words in f.text for f in errors), [str(f) for f in errors]
    assert {f.where for f in errors} == {document['id']}


def test_a_driver_may_observe_as_a_drone_does() -> None:
    told = []
    for observer in ('ego', 'uav1'):
        document = good()
        put('r6.trigger', {'on': 'visible', 'observer': observer, 'target': 'van1'})(document)
        told.append([str(f) for f in found(document)])
    assert told[0] == told[1]


def test_a_line_that_is_no_json_is_named_and_the_others_are_read() -> None:
    prompts, findings = validate(['{"id": \n' + json.dumps(good()) + '\n'])
    assert [p.id for p in prompts] == ['track-901']
    assert [(f.where, f.rule) for f in findings if f.is_error] == [('line 1', Rule.JSON)]


def test_a_repeated_key_is_an_error() -> None:
    text = json.dumps(good())[:-1] + ', "id": "track-902"}'
    assert [f.rule for f in validate([text])[1]] == [Rule.JSON]


def test_errors_between_prompts_are_found() -> None:
    same, number, group, other = (good() for _ in range(4))
    number['id'], group['id'], other['id'] = 'track-902', 'track-903', 'track-904'
    number['prompt'] = number['prompt'].replace('45 m', '55 m')
    put('r4.distance_m', 55)(number)
    for document, text in ((group, 'Once more: '), (other, 'And again: ')):
        document['paraphrase_group'] = 'van-track'
        document['prompt'] = text + document['prompt']
    put('r5.target', 'ego')(other)
    rules = [f.rule for f in found(good(), same, number, group, other) if f.is_error]
    assert rules == [
        Rule.DUPLICATE_ID,
        Rule.DUPLICATE_PROMPT,
        Rule.PARAPHRASE,
        Rule.DUPLICATE_PROMPT,
    ]


def test_a_boundary_pair_may_differ_in_a_number_only() -> None:
    inside, outside = good(), good()
    inside.update(category='boundary', feasibility='boundary')
    put('prompt', inside['prompt'].replace('30 to 40', '120'))(inside)
    put('r5.altitude_m', 120)(inside)
    del inside['variation']
    outside.update(
        id='infeasible-901',
        category='infeasible',
        feasibility='infeasible',
        end_to_end=False,
        prompt=inside['prompt'].replace('120', '121'),
        requirements=[{'id': 'r1', 'kind': 'reject', 'because': 'altitude_limit'}],
    )
    del outside['variation']
    assert [str(f) for f in found(inside, outside) if f.is_error] == []
