# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What excludes each other is told in the prompt's words, with the nearest value that can be."""

from __future__ import annotations

from typing import Any

import pytest
from requests_by_hand import asked, judged, number

from aurora_core.outcomes.feasibility import Certificate, Feasibility, Rule
from aurora_core.recheck import recheck
from aurora_core.spec.scenario import ScenarioSpec

WORDS = ('A drone hovers over City Hall for a minute', 'the scenario is over after a while')
PROMPT = f'{WORDS[0]}, and {WORDS[1]}.'


def span(text: str) -> dict[str, int]:
    start = PROMPT.index(text)
    return {'start': start, 'end': start + len(text)}


def hover(altitude_m: float, **more: Any) -> ScenarioSpec:
    mission = {
        'id': 'm1',
        'uav': 'uav1',
        'mode': 'hover',
        'target': 'landmark:City Hall',
        'altitude_m': {**number(altitude_m, 'm'), 'span': span('hovers')},
        'duration_s': {**number(30.0, 's'), 'provenance': 'default', 'span': None},
        'span': span('A drone hovers'),
        **more.pop('mission', {}),
    }
    clauses = [{'text': w, 'span': span(w), 'status': 'encoded'} for w in WORDS]
    document = {'prompt': PROMPT, 'uavs': [{'id': 'uav1'}], 'missions': [mission]}
    return ScenarioSpec.model_validate({**document, 'clauses': clauses, **more})


def in_time(world_s: float, phase_s: float) -> ScenarioSpec:
    return hover(
        60.0,
        mission={'duration_s': {**number(phase_s, 's'), 'span': span('a minute')}},
        world={'duration_s': {**number(world_s, 's'), 'span': span('a while')}},
    )


def proof(spec: ScenarioSpec, rule: Rule) -> Certificate:
    found = [c for c in judged(spec).certificates if c.rule is rule]
    assert found, rule
    assert recheck(found[0], spec.model_dump(mode='json')).valid
    return found[0]


def test_every_clause_that_excludes_another_is_named() -> None:
    assert proof(in_time(30.0, 60.0), Rule.HORIZON).clauses == WORDS


@pytest.mark.parametrize(
    'change',
    [
        {'clauses': ('nobody said this',)},
    ],
)
def test_other_words_and_other_values_are_refuted(change: dict[str, Any]) -> None:
    spec = in_time(30.0, 60.0)
    forged = proof(spec, Rule.HORIZON).model_copy(update=change)
    assert not recheck(forged, spec.model_dump(mode='json')).valid


def near(value: float, op: str = '<=', altitude_m: float = 12.0) -> ScenarioSpec:
    condition = asked('c1', 'clearance', ['uav1', 'landmark:City Hall'], op, value, 'm')
    return hover(altitude_m, conditions=[condition])


def test_a_clearance_under_the_limit_is_refused_below_the_roof() -> None:
    found = proof(near(1.5), Rule.WALL)
    assert found.reason == 'clearance'


@pytest.mark.parametrize(
    ('value', 'op', 'altitude_m'),
    [(1.5, '<=', 60.0), (3.0, '<=', 12.0), (5.0, '>=', 12.0)],
    ids=['above the roof', 'at the limit', 'farther away'],
)
def test_other_clearances_are_no_proof(value: float, op: str, altitude_m: float) -> None:
    spec = near(value, op, altitude_m)
    assert not [c for c in judged(spec).certificates if c.rule is Rule.WALL]
    forged = proof(near(1.5), Rule.WALL)
    assert not recheck(forged, spec.model_dump(mode='json')).valid


def line(length_m: float) -> ScenarioSpec:
    width = {**number(0.0, 'm'), 'provenance': 'default', 'span': None}
    flown = {'mode': 'navigate', 'pattern': 'line', 'size_m': [number(length_m, 'm'), width],
             'duration_s': None}  # fmt: skip
    return hover(60.0, mission={**flown, 'speed_mps': number(10.0, 'm/s')})


def test_a_line_needs_no_stated_width_to_outlast_the_battery() -> None:
    proof(line(30_000.0), Rule.BATTERY)
    assert judged(line(1_000.0)).result is not Feasibility.INFEASIBLE


def fast_target(*, more: list[Any] | None = None) -> ScenarioSpec:
    speed = number(24.0, 'm/s')
    document = in_time(1800.0, 60.0).model_dump(mode='json')
    unset = {'provenance': 'default', 'span': None}
    document['agents'] = [
        {'id': 'car1', 'type': 'car', 'behaviors': [{'kind': 'drive', 'speed_mps': speed}]}
    ]
    document['missions'][0] |= {
        'mode': 'track',
        'target': 'car1',
        'standoff_m': {**number(0.0, 'm'), **unset},
    }
    document['events'] = [
        {
            'id': 'e1',
            'trigger': {'on': 'time', 'at_s': number(20.0, 's')},
            'action': {'do': 'change_mission', 'uav': 'uav1', 'mission': 'm1'},
        }
    ]
    document['missions'] += more or []
    return ScenarioSpec.model_validate(document)


def test_an_event_that_begins_the_only_mission_splits_nothing() -> None:
    proof(fast_target(), Rule.PURSUIT)


def test_a_standoff_beyond_the_limit_of_a_fast_target_is_told_of_as_such() -> None:
    document = fast_target().model_dump(mode='json')
    document['missions'][0]['standoff_m'] = number(300.0, 'm', bound='at_least')
    verdict = judged(ScenarioSpec.model_validate(document))
    assert 'standoff' in {c.reason for c in verdict.certificates}
    for found in verdict.certificates:
        assert recheck(found, document).valid


def test_an_event_that_begins_one_of_two_missions_proves_nothing() -> None:
    first = hover(60.0).model_dump(mode='json')['missions'][0] | {'id': 'm0'}
    spec = fast_target(more=[first])
    assert not [c for c in judged(spec).certificates if c.rule is Rule.PURSUIT]


def test_a_count_that_may_mean_others_is_doubted_and_not_refused() -> None:
    document = hover(60.0).model_dump(mode='json')
    counted, other = span('a minute'), span('after')
    document['agents'] = [
        {'id': f'van{k}', 'type': 'van', 'span': counted if k < 2 else other} for k in range(3)
    ]
    document['counts'] = [
        {'id': 'n1', 'kind': 'van', 'value': {**number(2.0, '1'), 'span': counted}}
    ]
    assert judged(ScenarioSpec.model_validate(document)).result is Feasibility.FEASIBLE
    document['agents'][0]['behaviors'] = [
        {'kind': 'follow', 'target': 'van1', 'span': span('scenario')}
    ]
    verdict = judged(ScenarioSpec.model_validate(document))
    assert verdict.result is Feasibility.UNKNOWN
    assert any('may be the same' in note for note in verdict.notes)
