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


PLANTED = [
    ('category that is none', put('category', 'flying'), Rule.FORMAT),
    ('id with blanks', put('id', 'track 1'), Rule.FORMAT),
    ('no prompt', put('prompt', ''), Rule.FORMAT),
    ('feasibility that is none', put('feasibility', 'maybe'), Rule.FORMAT),
    ('unknown field', put('difficulty', 3), Rule.FORMAT),
    ('no paraphrase group given', drop('paraphrase_group'), Rule.FORMAT),
    ('unknown field of a requirement', put('r5.height_m', 35), Rule.FORMAT),
    ('unknown kind', put('r7.kind', 'sequence'), Rule.FORMAT),
    ('unknown agent type', put('r2.type', 'lorry'), Rule.FORMAT),
    ('unknown behaviour', more(kind='behavior', agent='ego', behavior='fly'), Rule.FORMAT),
    ('unknown relation', put('r4.relation', 'under'), Rule.FORMAT),
    ('number as text', put('r5.altitude_m', 'high'), Rule.FORMAT),
    ('field of another trigger', put('r6.trigger.at_s', 20), Rule.FORMAT),
    ('field of another action', put('r6.action.agent', 'ego'), Rule.FORMAT),
    ('event without trigger and action', more(kind='event', ref='e5'), Rule.FORMAT),
    ('no requirements', put('requirements', []), Rule.FORMAT),
    ('repeated requirement id', put('r7.id', 'r10'), Rule.REQUIREMENT_ID),
    ('agent that is not declared', put('r4.agent', 'bus1'), Rule.REFERENCE),
    ('landmark that is not on the map', put('r5.target', 'Old Mill'), Rule.REFERENCE),
    ('UAV that is none', put('r5.uav', 'van1'), Rule.REFERENCE),
    ('order of nothing', put('r7.then', 'e9'), Rule.REFERENCE),
    ('agent declared twice', put('r2.ref', 'ego'), Rule.REFERENCE),
    (
        'wait for itself',
        put('r6.trigger', {'on': 'event_done', 'event': 'e1'}),
        Rule.REFERENCE,
    ),
    ('variation of nothing', put('variation', {'r5.radius_m': [1, 2]}), Rule.VARIATION),
    ('variation that excludes its value', put('variation', {'r5.altitude_m': [40, 50]}),
     Rule.VARIATION),
    ('another number than stated', put('r4.distance_m', 54), Rule.NOT_STATED),
    ('feet as metres', put('prompt', good()['prompt'].replace('45 m', '45 ft')), Rule.NOT_STATED),
    ('stated number without annotation', drop('r4.distance_m'), Rule.NOT_ANNOTATED),
    ('duration without annotation', drop('r5.duration_s'), Rule.NOT_ANNOTATED),
    ('feasible above the ceiling', put('r5.altitude_m', 135), Rule.LIMIT),
    ('feasible and faster than a UAV flies', put('r5.speed_mps', 25), Rule.LIMIT),
    ('infeasible without a reason', put('feasibility', 'infeasible'), Rule.FEASIBILITY),
    ('refusal of a feasible prompt', more(kind='reject', because='count'), Rule.FEASIBILITY),
    ('alone in its group', put('paraphrase_group', 'van-track'), Rule.PARAPHRASE),
]  # fmt: skip


def test_the_good_prompt_has_no_finding() -> None:
    assert [str(f) for f in found(good()) if f.is_error] == []


@pytest.mark.parametrize(
    ('plant', 'rule'), [p[1:] for p in PLANTED], ids=[p[0].replace(' ', '-') for p in PLANTED]
)
def test_a_planted_error_is_found(plant: Plant, rule: Rule) -> None:
    document = good()
    plant(document)
    assert rule in {f.rule for f in found(document) if f.is_error}


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
