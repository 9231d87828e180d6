# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the format can say beyond the shipped files, and what a reference makes of it."""

from __future__ import annotations

import json
from typing import Any

import pytest

from aurora_bench.prompts.format import AnnotatedPrompt, beyond
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_bench.prompts.validate import validate

Doc = dict[str, Any]

TEXT = (
    'In a 6 m/s crosswind from the west exactly two vehicles drive; a drone scans City Hall from '
    '10 to 40 m, flies 2 turns, stays left of the van and 25 m off Signal Tower, reports at 2 Hz '
    'from 15 s to 25 s, goes home below 30 % battery and keeps 12 m clear of all within 8 cameras.'
)
BODIES: list[Doc] = [
    {'id': 'r1', 'kind': 'agent', 'ref': 'van1', 'type': 'van'},
    {'id': 'r2', 'kind': 'uav', 'ref': 'uav1'},
    {'id': 'r3', 'kind': 'uav', 'ref': 'uav2'},
]
MISSION: Doc = {'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'navigate'}
EVENT: Doc = {'kind': 'event', 'ref': 'e1', 'trigger': {'on': 'time', 'at_s': 15}}
LINK: Doc = {'kind': 'link', 'sender': 'uav1', 'receiver': 'uav2'}
CONDITION: Doc = {'kind': 'condition', 'op': '>='}
# A requirement that is valid, and a change that makes it none, with the words of the finding.
EXTENSIONS: list[tuple[str, Doc, Doc, str]] = [
    ('wind-speed', {'kind': 'world', 'field': 'wind_mps', 'value': 6}, {'value': 'six'}, 'cannot'),
    (
        'wind-from',
        {'kind': 'world', 'field': 'wind_from_deg', 'value': 270},
        {'value': 'west'},
        'cannot',
    ),
    (
        'wind',
        {'kind': 'world', 'field': 'wind', 'value': 'crosswind'},
        {'value': 'sidewind'},
        'one of crosswind, headwind, tailwind',
    ),
    (
        'count-of-type',
        {'kind': 'count', 'type': 'vehicle', 'value': 2, 'scope': 'scene'},
        {'of': 'van1'},
        'one of the two',
    ),
    ('count-of-names', {'kind': 'count', 'of': ['van1'], 'value': 1}, {'of': 'bus1'}, "'bus1'"),
    ('side', {**MISSION, 'mode': 'track', 'side': 'left'}, {'side': 'above'}, 'side'),
    ('ends', {**MISSION, 'start': 'City Hall', 'end': 'crosswalk'}, {'end': 'Nowhere'}, 'Nowhere'),
    ('turns', {**MISSION, 'pattern': 'orbit', 'turns': 2}, {'turns': -2}, 'below zero'),
    (
        'facade',
        {**MISSION, 'pattern': 'facade', 'altitude_m': [10, 40]},
        {'altitude_m': [40, 10]},
        'lower one',
    ),
    (
        'street',
        {**MISSION, 'pattern': 'street', 'target': 'Market Street'},
        {'target': 'No Such Street'},
        'No Such Street',
    ),
    (
        'avoid',
        {**MISSION, 'avoid': ['Signal Tower'], 'avoid_m': 25},
        {'avoid': ['Nowhere']},
        'Nowhere',
    ),
    ('outage', {**LINK, 'outage_s': [15, 25]}, {'outage_s': [25, 15]}, 'ends after it begins'),
    ('rate', {**LINK, 'rate_hz': 2}, {'rate_hz': 3}, 'not in the prompt'),
    (
        'battery',
        {
            **EVENT,
            'trigger': {'on': 'battery_below', 'uav': 'uav1', 'value': 0.3},
            'action': {'do': 'return_home', 'uav': 'uav1'},
        },
        {'trigger': {'on': 'battery_below', 'uav': 'uav1', 'value_m': 30}},
        "no 'value_m'",
    ),
    (
        'hand-over',
        {**EVENT, 'action': {'do': 'hand_over', 'uav': 'uav1', 'to': 'uav2'}, 'once': False},
        {'action': {'do': 'hand_over', 'uav': 'uav1', 'to': 'uav3'}},
        "'uav3'",
    ),
    (
        'clearance',
        {**CONDITION, 'quantity': 'clearance', 'of': ['uav1', 'Signal Tower'], 'value': 12},
        {'of': ['uav1']},
        'is of 2',
    ),
    (
        'battery-left',
        {**CONDITION, 'quantity': 'battery', 'of': ['uav1'], 'value': 0.3},
        {'of': []},
        'is of 1',
    ),
    ('wind-held', {**CONDITION, 'quantity': 'wind', 'value': 6}, {'value': True}, 'cannot'),
    (
        'beyond',
        {'kind': 'beyond', 'text': 'within 8 cameras'},
        {'text': ''},
        'at least 1 character',
    ),
]
IDS = [name for name, *_ in EXTENSIONS]


def document(*requirements: Doc) -> Doc:
    """Return a prompt with two drones, a van and these requirements."""
    numbered = [{'id': f'r{k}', **r} for k, r in enumerate(requirements, start=9)]
    return {
        'id': 'track-901', 'category': 'track', 'prompt': TEXT, 'feasibility': 'feasible',
        'paraphrase_group': None, 'end_to_end': False, 'requirements': [*BODIES, *numbered],
    }  # fmt: skip


def errors(*requirements: Doc) -> list[str]:
    """Return what the validator says against these requirements, numbers left out apart."""
    _, findings = validate([json.dumps(document(*requirements))])
    return [f.text for f in findings if f.is_error and f.rule != 'number-not-annotated']


@pytest.mark.parametrize(('good', 'change', 'words'), [e[1:] for e in EXTENSIONS], ids=IDS)
def test_an_extension_is_valid_and_a_wrong_one_is_named(
    good: Doc, change: Doc, words: str
) -> None:
    assert errors(good) == []
    assert any(words in text for text in errors({**good, **change}))
    assert any('sort_of' in text for text in errors({**good, 'sort_of': 1}))


# What the specification has learnt to say since.
SAYABLE = frozenset(
    {
        'count-of-type',
        'beyond',
        'ends',
        'side',
        'turns',
        'wind',
        'wind-from',
        'wind-speed',
        'outage',
        'rate',
        'battery-left',
        'clearance',
        'battery',
        'avoid',
    }
)
UNSAYABLE = [(name, good) for name, good, *_ in EXTENSIONS if name not in SAYABLE]


def test_a_reference_closes_the_scene() -> None:
    closed = {'kind': 'count', 'type': 'vehicle', 'value': 1, 'scope': 'scene'}
    spec = reference_spec(AnnotatedPrompt.model_validate(document(closed)), judged=True)
    assert [(count.kind, count.value.value) for count in spec.counts] == [('vehicle', 1.0)]


def test_a_reference_goes_from_start_to_end() -> None:
    ends = {'start': 'City Hall', 'end': 'crosswalk'}
    flight = {**MISSION, 'mode': 'navigate', **ends}
    (made,) = reference_spec(
        AnnotatedPrompt.model_validate(document(flight)), judged=True
    ).missions
    assert (made.start, made.target) == ('landmark:City Hall', 'crosswalk')
    around = AnnotatedPrompt.model_validate(document({**flight, 'pattern': 'rectangle'}))
    with pytest.raises(NotExpressibleError, match='start of a pattern'):
        reference_spec(around, judged=True)


@pytest.mark.parametrize('good', [e[1] for e in UNSAYABLE], ids=[e[0] for e in UNSAYABLE])
def test_a_reference_never_leaves_an_extension_out(good: Doc) -> None:
    asked = AnnotatedPrompt.model_validate(document(good))
    with pytest.raises(NotExpressibleError, match='no specification can say'):
        reference_spec(asked, judged=True)


def test_beyond_is_listed_and_asks_nothing_of_the_reference() -> None:
    hover = {'kind': 'mission', 'ref': 'm1', 'uav': 'uav1', 'mode': 'hover'}
    more = {'kind': 'beyond', 'text': 'within 8 cameras'}
    with_it, without = (
        AnnotatedPrompt.model_validate(document(*requirements))
        for requirements in ((hover, more), (hover,))
    )
    assert [r.text for r in beyond(with_it)] == ['within 8 cameras']
    assert reference_spec(with_it) == reference_spec(without)


def test_a_number_of_beyond_is_annotated() -> None:
    def missing(*requirements: Doc) -> list[str]:
        _, findings = validate([json.dumps(document(*requirements))])
        return [f.text for f in findings if f.rule == 'number-not-annotated' and f.is_error]

    assert any("'8" in text for text in missing())
    assert not any("'8" in text for text in missing({'kind': 'beyond', 'text': '8 cameras'}))
