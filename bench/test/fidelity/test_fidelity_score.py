# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Hand-scored pairs of annotation and specification: exactly the named fields are missed."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import pytest

from aurora_bench.fidelity.answer import Answer
from aurora_bench.fidelity.score import PromptScore, score
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.spec.scenario import ScenarioSpec

Doc = dict[str, Any]
Change = Callable[[Doc], None]

REQUIREMENTS: list[Doc] = [
    {'id': 'r1', 'kind': 'world', 'field': 'weather', 'value': 'rain'},
    {'id': 'r2', 'kind': 'agent', 'ref': 'ego', 'type': 'car', 'role': 'ego'},
    {'id': 'r3', 'kind': 'agent', 'ref': 'van1', 'type': 'van'},
    {'id': 'r4', 'kind': 'agent', 'ref': 'bus1', 'type': 'bus'},
    {'id': 'r5', 'kind': 'uav', 'ref': 'uav1'},
    {'id': 'r6', 'kind': 'placement', 'agent': 'van1', 'relation': 'behind', 'of': 'ego',
     'distance_m': 45},
    {'id': 'r7', 'kind': 'behavior', 'agent': 'van1', 'behavior': 'tailgate', 'target': 'ego'},
    {'id': 'r8', 'kind': 'behavior', 'agent': 'bus1', 'behavior': 'drive', 'speed_mps': 10},
    {'id': 'r9', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover',
     'target': 'City Hall', 'altitude_m': 50, 'duration_s': 20},
    {'id': 'r10', 'kind': 'mission', 'ref': 'm2', 'uav': 'uav1', 'mode': 'track',
     'target': 'van1', 'altitude_m': 40, 'standoff_m': 30},
    {'id': 'r11', 'kind': 'order', 'first': 'm1', 'then': 'm2'},
    {'id': 'r12', 'kind': 'event', 'ref': 'e1',
     'trigger': {'on': 'distance_below', 'a': 'van1', 'b': 'ego', 'value_m': 20},
     'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'ego'}},
    {'id': 'r13', 'kind': 'event', 'ref': 'e2',
     'trigger': {'on': 'message_received', 'by': 'ego', 'from': 'uav1'},
     'action': {'do': 'change_lane', 'agent': 'ego'}},
    {'id': 'r14', 'kind': 'order', 'first': 'e1', 'then': 'e2'},
    {'id': 'r15', 'kind': 'link', 'sender': 'uav1', 'receiver': 'ego', 'loss': 0.1,
     'latency_s': 0.2},
    {'id': 'r16', 'kind': 'condition', 'quantity': 'distance', 'of': ['uav1', 'ego'], 'op': '>=',
     'value': 10},
    {'id': 'r17', 'kind': 'any_of', 'any_of': [
        {'id': 'r18', 'kind': 'world', 'field': 'duration_s', 'value': 120},
        {'id': 'r19', 'kind': 'condition', 'quantity': 'landed', 'of': ['uav1'], 'op': '==',
         'value': True, 'by_s': 120}]},
]  # fmt: skip


def number(value: float, unit: str = 'm') -> Doc:
    """Return an inferred parameter."""
    return {'value': value, 'unit': unit, 'low': value, 'high': value, 'provenance': 'inferred'}


def right_spec() -> Doc:
    """Return a specification that says all of `REQUIREMENTS`, with ids of its own."""
    return {
        'prompt': 'any',
        'world': {'weather': 'rain', 'duration_s': number(120, 's')},
        'agents': [
            {'id': 'bus7', 'type': 'bus', 'behaviors': [
                {'kind': 'drive', 'speed_mps': number(10, 'm/s')}]},
            {'id': 'me', 'type': 'car', 'role': 'ego'},
            {'id': 'van3', 'type': 'van',
             'placements': [{'relation': 'behind', 'of': 'me', 'distance_m': number(45)}],
             'behaviors': [{'kind': 'tailgate', 'target': 'me'}]},
        ],
        'uavs': [{'id': 'drone'}],
        'missions': [
            {'id': 'a', 'uav': 'drone', 'mode': 'hover', 'target': 'landmark:City Hall',
             'altitude_m': number(50), 'duration_s': number(20, 's')},
            {'id': 'b', 'uav': 'drone', 'mode': 'track', 'target': 'van3',
             'altitude_m': number(40), 'standoff_m': number(30), 'duration_s': number(30, 's')},
        ],
        'links': [
            {'id': 'l', 'sender': 'drone', 'receiver': 'me', 'loss': number(0.1, '1'),
             'latency_s': number(0.2, 's'), 'retransmissions': number(3, '1'),
             'retransmission_interval_s': number(0.2, 's')}],
        'events': [
            {'id': 'x1',
             'trigger': {'on': 'distance_below', 'a': 'van3', 'b': 'me', 'value_m': number(20)},
             'action': {'do': 'send_message', 'sender': 'drone', 'receiver': 'me'}},
            {'id': 'x2', 'trigger': {'on': 'message_received', 'by': 'me', 'sender': 'drone'},
             'action': {'do': 'change_lane', 'agent': 'me'}}],
        'conditions': [
            {'id': 'c', 'quantity': 'distance', 'of': ['me', 'drone'], 'op': '>=',
             'value': number(10)}],
    }  # fmt: skip


def put(path: str, value: object) -> Change:
    """Return a change that writes a value, e.g. at `agents.2.type`."""

    def change(spec: Doc) -> None:
        *parents, last = path.split('.')
        place: Any = spec
        for name in parents:
            place = place[int(name) if name.isdigit() else name]
        place[int(last) if last.isdigit() else last] = value

    return change


def cut(path: str) -> Change:
    """Return a change that takes something out of a list."""

    def change(spec: Doc) -> None:
        *parents, last = path.split('.')
        place: Any = spec
        for name in parents:
            place = place[int(name) if name.isdigit() else name]
        del place[int(last)]

    return change


def add(name: str, value: Doc) -> Change:
    """Return a change that appends an element."""
    return lambda spec: spec[name].append(value)


def both(*changes: Change) -> Change:
    """Return several changes as one."""

    def change(spec: Doc) -> None:
        for one in changes:
            one(spec)

    return change


def scored(
    spec: Doc, requirements: list[Doc] | None = None, *, is_fair: bool = True, **fields: Any
) -> PromptScore:
    """Score a specification."""
    prompt = AnnotatedPrompt.model_validate(
        {
            'id': 'track-1', 'category': 'track', 'prompt': 'any', 'feasibility': 'feasible',
            'paraphrase_group': None, 'end_to_end': False,
            'requirements': REQUIREMENTS if requirements is None else requirements, **fields,
        }
    )  # fmt: skip
    return score(prompt, Answer(spec=ScenarioSpec.model_validate(spec)), is_fair=is_fair)


def missed(result: PromptScore) -> dict[str, set[str]]:
    """Return the fields that do not hold, by requirement."""
    return {
        r.id: {name for name, held in r.fields.items() if not held}
        for r in result.requirements
        if not r.is_met
    }


PAIRS: list[tuple[str, Change, dict[str, str]]] = [
    ('all right', lambda _: None, {}),
    ('other order of agents', lambda s: s['agents'].reverse(), {}),
    ('wrong weather', put('world.weather', 'snow'), {'r1': 'value'}),
    ('weather left out', put('world', {'duration_s': number(120, 's')}), {'r1': 'value'}),
    ('wrong distance', put('agents.2.placements.0.distance_m', number(54)), {'r6': 'distance_m'}),
    ('1 % off counts', put('agents.2.placements.0.distance_m', number(45.4)), {}),
    ('2 % off does not', put('agents.2.placements.0.distance_m', number(45.9)),
     {'r6': 'distance_m'}),
    ('wrong relation', put('agents.2.placements.0.relation', 'ahead'), {'r6': 'relation'}),
    ('seen from the other body', both(
        cut('agents.2.placements.0'),
        put('agents.1.placements',
            [{'relation': 'ahead', 'of': 'van3', 'distance_m': number(45)}])), {}),
    ('closing from there', both(
        cut('agents.2.placements.0'),
        put('agents.2.behaviors.0.closing_from_m', number(45))), {}),
    ('no distance', put('agents.2.placements.0.distance_m', None), {'r6': 'distance_m'}),
    ('no placement, but tailgating is behind', cut('agents.2.placements.0'),
     {'r6': 'distance_m'}),
    ('behind another', put('agents.2.placements.0.of', 'bus7'), {'r6': 'of'}),
    ('tailgates another', put('agents.2.behaviors.0.target', 'bus7'), {'r7': 'target'}),
    ('follows instead', put('agents.2.behaviors.0.kind', 'follow'), {'r7': 'behavior'}),
    ('no behaviour', cut('agents.2.behaviors.0'), {'r7': 'behavior target'}),
    ('another one tailgates', both(
        cut('agents.2.behaviors.0'),
        put('agents.0.behaviors', [{'kind': 'tailgate', 'target': 'me'}])),
     {'r7': 'behavior target', 'r8': 'behavior speed_mps'}),
    ('wrong speed', put('agents.0.behaviors.0.speed_mps', number(36, 'm/s')), {'r8': 'speed_mps'}),
    ('no ego', put('agents.1.role', 'other'), {'r2': 'role'}),
    ('truck for a van', put('agents.2.type', 'truck'), {'r3': 'type'}),
    ('a car too many', add('agents', {'id': 'car9', 'type': 'car'}), {}),
    ('a UAV too many', add('uavs', {'id': 'drone2'}), {}),
    ('hover too low', put('missions.0.altitude_m', number(15.24)), {'r9': 'altitude_m'}),
    ('hover elsewhere', put('missions.0.target', 'landmark:Union Station'), {'r9': 'target'}),
    ('hover of default length', put('missions.0.duration_s', number(30, 's')),
     {'r9': 'duration_s'}),
    ('inside the variation', put('missions.1.altitude_m', number(44)), {}),
    ('outside the variation', put('missions.1.altitude_m', number(44.5)), {'r10': 'altitude_m'}),
    ('tracks another', put('missions.1.target', 'me'), {'r10': 'target'}),
    ('missions in the other order', lambda s: s['missions'].reverse(), {'r11': 'then'}),
    ('no hover', cut('missions.0'),
     {'r9': 'uav mode target altitude_m duration_s', 'r11': 'then'}),
    ('trigger names bodies the other way round',
     both(put('events.0.trigger.a', 'me'), put('events.0.trigger.b', 'van3')), {}),
    ('wrong threshold', put('events.0.trigger.value_m', number(6.096)),
     {'r12': 'trigger.value_m'}),
    ('other direction of the trigger', put('events.0.trigger.on', 'distance_above'),
     {'r12': 'trigger.on trigger.a trigger.b trigger.value_m'}),
    ('distance to another', put('events.0.trigger.b', 'bus7'), {'r12': 'trigger.b'}),
    ('message to another', put('events.0.action.receiver', 'van3'),
     {'r12': 'action.receiver', 'r14': 'then'}),
    ('waits for the event, not the message',
     put('events.1.trigger', {'on': 'event_done', 'event': 'x1'}),
     {'r13': 'trigger.on trigger.by trigger.from'}),
    ('another changes lane', put('events.1.action.agent', 'van3'), {'r13': 'action.agent'}),
    ('second event left out', cut('events.1'),
     {'r13': 'trigger.on trigger.by trigger.from action.do action.agent', 'r14': 'then'}),
    ('link the other way', both(put('links.0.sender', 'me'), put('links.0.receiver', 'drone')),
     {'r15': 'sender receiver'}),
    ('percent as share', put('links.0.loss', number(10, '1')), {'r15': 'loss'}),
    ('no link', cut('links.0'), {'r15': 'sender receiver loss latency_s'}),
    ('condition the other way', put('conditions.0.op', '<='), {'r16': 'op'}),
    ('condition of another', put('conditions.0.of', ['drone', 'van3']), {'r16': 'of'}),
    ('condition left out', cut('conditions.0'), {'r16': 'quantity of op value'}),
    ('the other reading', both(
        put('world.duration_s', None),
        add('conditions', {'id': 'd', 'quantity': 'landed', 'of': ['drone'], 'op': '==',
                           'value': number(1, '1'), 'by_s': number(120, 's')})), {}),
    ('neither reading', put('world.duration_s', None), {'r17': 'value'}),
]  # fmt: skip


@pytest.mark.parametrize(
    ('change', 'expected'), [p[1:] for p in PAIRS], ids=[p[0].replace(' ', '-') for p in PAIRS]
)
def test_exactly_what_is_wrong_is_missed(change: Change, expected: dict[str, str]) -> None:
    spec = right_spec()
    change(spec)
    result = scored(spec, variation={'r10.altitude_m': [36, 44]})
    assert missed(result) == {name: set(fields.split()) for name, fields in expected.items()}


def test_what_nothing_asked_for_is_named() -> None:
    spec = right_spec()
    spec['agents'].append({'id': 'car9', 'type': 'car'})
    spec['uavs'].append({'id': 'drone2'})
    assert scored(spec).extra == ('car9', 'drone2')


TWO_VANS: list[Doc] = [
    {'id': 'r1', 'kind': 'agent', 'ref': 'van1', 'type': 'van'},
    {'id': 'r2', 'kind': 'agent', 'ref': 'van2', 'type': 'van'},
    {'id': 'r3', 'kind': 'behavior', 'agent': 'van1', 'behavior': 'stop'},
    {'id': 'r4', 'kind': 'behavior', 'agent': 'van2', 'behavior': 'follow', 'target': 'van1'},
    {'id': 'r5', 'kind': 'uav', 'ref': 'uav1'},
    {'id': 'r6', 'kind': 'uav', 'ref': 'uav2'},
    {'id': 'r7', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'track', 'target': 'van1'},
    {'id': 'r8', 'kind': 'mission', 'ref': 'm2', 'uav': 'uav2', 'mode': 'track', 'target': 'van2',
     'altitude_m': 60},
]  # fmt: skip


def two_vans(stops: str, follows: str, first: str, second: str) -> Doc:
    """Return two vans and two UAVs in given roles."""
    behaviors = {
        stops: {'kind': 'stop'},
        follows: {'kind': 'follow', 'target': stops},
    }
    common = {'mode': 'track', 'standoff_m': number(0), 'duration_s': number(30, 's')}
    return {
        'prompt': 'any',
        'agents': [{'id': v, 'type': 'van', 'behaviors': [behaviors[v]]} for v in ('a', 'b')],
        'uavs': [{'id': 'u'}, {'id': 'v'}],
        'missions': [
            {'id': 'p', 'uav': 'u', 'target': first, 'altitude_m': number(30), **common},
            {'id': 'q', 'uav': 'v', 'target': second, 'altitude_m': number(60), **common},
        ],
    }


@pytest.mark.parametrize(
    ('stops', 'follows', 'first', 'second', 'expected'),
    [
        ('a', 'b', 'a', 'b', {}),
        ('b', 'a', 'b', 'a', {}),  # names are free, roles are not
        ('a', 'b', 'b', 'a', {'r8': {'altitude_m'}}),  # the UAVs change names, one is too low
        ('a', 'b', 'a', 'a', {'r8': {'target'}}),
    ],
)
def test_swapped_references(
    stops: str, follows: str, first: str, second: str, expected: dict[str, set[str]]
) -> None:
    assert missed(scored(two_vans(stops, follows, first, second), TWO_VANS)) == expected


@pytest.mark.parametrize(
    ('number_of_cars', 'expected'),
    [(3, {}), (2, {'r1': {'count'}}), (0, {'r1': {'type', 'count'}})],
)
def test_groups_are_counted(number_of_cars: int, expected: dict[str, set[str]]) -> None:
    spec = {
        'prompt': 'any',
        'agents': [
            {'id': f'car{k}', 'type': 'car', 'behaviors': [{'kind': 'circulate'}]}
            for k in range(number_of_cars)
        ],
    }
    requirements: list[Doc] = [
        {'id': 'r1', 'kind': 'agent', 'ref': 'car1', 'type': 'car', 'count': 3},
        {'id': 'r2', 'kind': 'behavior', 'agent': 'car1', 'behavior': 'circulate'},
        {'id': 'r3', 'kind': 'uav', 'ref': 'uav1', 'count': 0},
    ]
    if number_of_cars == 0:
        expected = {**expected, 'r2': {'behavior'}}
    assert missed(scored(spec, requirements)) == expected


def test_every_member_of_a_group_has_to_do_it() -> None:
    spec = two_vans('a', 'b', 'a', 'b')
    spec['missions'][0]['altitude_m'] = number(60)
    requirements: list[Doc] = [
        {'id': 'r1', 'kind': 'uav', 'ref': 'uav1', 'count': 2},
        {'id': 'r2', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'track',
         'altitude_m': 60},
    ]  # fmt: skip
    vans: list[Doc] = [{'id': 'r3', 'kind': 'agent', 'ref': 'van1', 'type': 'van', 'count': 2}]
    assert missed(scored(spec, [*requirements, *vans])) == {}
    spec['missions'][0]['altitude_m'] = number(30)
    assert missed(scored(spec, [*requirements, *vans])) == {'r2': {'altitude_m'}}


def test_many_bodies_are_bound_in_time() -> None:
    types = ('car', 'van', 'bus', 'truck', 'motorcycle', 'bicycle', 'ambulance')
    spec = {
        'prompt': 'any',
        'agents': [
            {'id': f'{t}_{k}', 'type': t, 'behaviors': [{'kind': kind}]}
            for t in types
            for k, kind in enumerate(('stop', 'park', 'drive'))
        ],
        'uavs': [{'id': f'u{k}'} for k in range(4)],
    }
    requirements: list[Doc] = []
    for t in types:
        for k, kind in enumerate(('drive', 'wait')):
            ref, n = f'{t}{k}', len(requirements)
            requirements.append({'id': f'r{n}', 'kind': 'agent', 'ref': ref, 'type': t})
            requirements.append(
                {'id': f'r{n + 1}', 'kind': 'behavior', 'agent': ref, 'behavior': kind}
            )
    requirements += [{'id': f'u{k}', 'kind': 'uav', 'ref': f'uav{k}'} for k in range(4)]
    lost = missed(scored(spec, requirements))
    assert all(fields == {'behavior'} for fields in lost.values())
    assert len(lost) == len(types)  # every one that drives is found, nobody waits


def test_what_must_not_be_is_met_when_it_is_not() -> None:
    requirement = copy.deepcopy(REQUIREMENTS[0]) | {'negate': True}
    spec = right_spec()
    assert missed(scored(spec, [requirement])) == {'r1': {'absent'}}
    spec['world']['weather'] = 'clear'
    assert missed(scored(spec, [requirement])) == {}


def test_an_event_may_be_implied_by_a_mission_or_a_behaviour() -> None:
    requirements: list[Doc] = [
        *REQUIREMENTS[1:5],
        {'id': 'r30', 'kind': 'event', 'ref': 'e5',
         'trigger': {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': 50}},
        {'id': 'r31', 'kind': 'event', 'ref': 'e6',
         'action': {'do': 'change_lane', 'agent': 'ego'}},
        {'id': 'r32', 'kind': 'behavior', 'agent': 'ego', 'behavior': 'change_lane'},
    ]  # fmt: skip
    assert missed(scored(right_spec(), requirements)) == {}


@pytest.mark.parametrize(
    ('quantity', 'of', 'expected'),
    [
        ('separation', ['me', 'drone'], {}),
        ('separation', ['me', 'drone', 'van3'], {'r16': {'of'}}),  # a distance is of two
        ('altitude', ['me', 'drone'], {'r16': {'quantity', 'of', 'op', 'value'}}),
    ],
)
def test_separation_of_two_is_their_distance(
    quantity: str, of: list[str], expected: dict[str, set[str]]
) -> None:
    spec = right_spec()
    spec['conditions'][0].update(quantity=quantity, of=of)
    assert missed(scored(spec)) == expected


def test_what_keeps_all_apart_keeps_two_apart() -> None:
    wanted = {**REQUIREMENTS[15], 'quantity': 'separation'}
    spec = right_spec()
    spec['conditions'][0].update(quantity='separation', of=['me', 'drone', 'van3'])
    assert missed(scored(spec, [*REQUIREMENTS[1:5], wanted])) == {}


def test_which_side_of_a_rectangle_is_long_does_not_matter() -> None:
    spec = right_spec()
    mission = spec['missions'][0]
    mission.update(
        mode='navigate', pattern='rectangle', size_m=[number(60), number(100)],
        speed_mps=number(8, 'm/s'),
    )  # fmt: skip
    wanted = {
        'id': 'r9', 'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'navigate',
        'pattern': 'rectangle', 'size_m': [100, 60],
    }  # fmt: skip
    assert missed(scored(spec, [*REQUIREMENTS[1:5], wanted])) == {}
    mission['size_m'] = [number(60), number(60)]
    assert missed(scored(spec, [*REQUIREMENTS[1:5], wanted])) == {'r9': {'size_m'}}


@pytest.mark.parametrize(('stays_up', 'expected'), [(False, {}), (True, {'r22': {'then'}})])
def test_the_landing_follows_the_missions(stays_up: bool, expected: dict[str, set[str]]) -> None:
    landing: Doc = {
        'id': 'r20', 'kind': 'event', 'ref': 'e9', 'action': {'do': 'land', 'uav': 'uav1'},
    }  # fmt: skip
    order: Doc = {'id': 'r22', 'kind': 'order', 'first': 'm2', 'then': 'e9'}
    spec = right_spec()
    for mission in spec['missions']:
        mission['ends_in_flight'] = stays_up
    found = missed(scored(spec, [*REQUIREMENTS, landing, order], is_fair=False))
    assert found.get('r22', set()) == expected.get('r22', set())
