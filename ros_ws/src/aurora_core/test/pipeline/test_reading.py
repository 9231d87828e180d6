# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A request and its prompt say the same, or it is told where they part."""

from __future__ import annotations

from typing import Any

import pytest

from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.functions import parse_context, parse_stage, understood
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.reading import doubts_of_reading, parser_digest
from aurora_core.spec.scenario import ScenarioSpec

KNOWN = installed_knowledge()
PROMPT = 'A drone hovers over City Hall at 40 m for 20 seconds.'
HONEST = [
    PROMPT,
    'Two drones hover at 25 and 50 m, and a van follows a bus at 30 km/h.',
    'A drone orbits City Hall with a diameter of 60 feet at 200 ft for 1 min 30 s.',
    'A drone hovers 30 m north of City Hall at 40 m for 20 seconds.',
    'Our drone stays still over Meadow Park at between 30 and 40 m for two minutes.',
    'A drone patrols a line of 200 m at 45 m altitude, then lands; one message in twenty is lost.',
    'The UAV juggles at 40 m; a bus stops.',
]


def read(prompt: str) -> ScenarioSpec:
    graph = parse_stage(KNOWN, prompt, 'downtown', 1).agsg
    assert graph is not None
    return graph.spec


def doubts(spec: ScenarioSpec, *, installed: bool = True) -> list[str]:
    context = parse_context(KNOWN, 'downtown', 1) if installed else None
    return list(doubts_of_reading(spec, KNOWN.limits, context))


def altered(spec: ScenarioSpec, **fields: Any) -> ScenarioSpec:
    """A request that was written anew, as into a bag."""
    return ScenarioSpec.model_validate_json(
        spec.model_copy(update=fields).model_dump_json(warnings=False)
    )


@pytest.mark.parametrize('prompt', HONEST)
@pytest.mark.parametrize('reader', [parser_digest(), 'another version', ''])
def test_what_was_read_is_what_the_prompt_says(prompt: str, reader: str) -> None:
    spec = altered(read(prompt), reader=reader)
    assert doubts(spec) == []
    assert doubts(spec, installed=False) == []


def with_number(spec: ScenarioSpec) -> ScenarioSpec:
    """C1 of the attack: the number in the prompt and its clause is another."""
    clauses = [
        clause.model_copy(update={'text': clause.text.replace('40 m', '90 m')})
        for clause in spec.clauses
    ]
    return altered(spec, prompt=spec.prompt.replace('40 m', '90 m'), clauses=clauses)


def with_sentence(spec: ScenarioSpec) -> ScenarioSpec:
    """C2: a sentence more, and no clause for it."""
    return altered(spec, prompt=f'{spec.prompt} A car crashes into a bus.')


def with_empty_clause(spec: ScenarioSpec) -> ScenarioSpec:
    """C3: the same, with a clause that asks for nothing."""
    begin = len(spec.prompt)
    text = 'A car crashes into a bus'
    clause = {'text': text, 'span': {'start': begin + 1, 'end': begin + 1 + len(text)}}
    found = {**clause, 'status': 'no_requirement', 'ids': [], 'note': ''}
    document = spec.model_dump(mode='json')
    document['prompt'] += f' {text}.'
    document['clauses'].append(found)
    return ScenarioSpec.model_validate(document)


@pytest.mark.parametrize('alter', [with_number, with_sentence, with_empty_clause])
def test_a_prompt_that_was_altered_is_found(alter: Any) -> None:
    (found,) = doubts(alter(read(PROMPT)))
    assert 'the prompt gives' in found


@pytest.mark.parametrize(
    ('alter', 'told'),
    [
        (with_number, "missions/m1/altitude_m is recorded as 40, the prompt states '90 m' there"),
        (with_sentence, 'no clause holds'),
    ],
)
def test_what_somebody_else_has_read_is_held_against_the_words(alter: Any, told: str) -> None:
    outcome = parse_stage(KNOWN, PROMPT, 'downtown', 1)
    graph = understood(KNOWN, ParseOutcome(spec=outcome.spec)).agsg
    assert graph is not None
    assert graph.spec.reader == ''
    found = doubts(alter(graph.spec))
    assert any(told in text for text in found), found


def test_a_clause_stands_where_it_says() -> None:
    spec = altered(read(PROMPT), prompt=PROMPT.replace('City Hall', 'Town Hall'), reader='')
    assert any('there stands' in text for text in doubts(spec))


def test_a_prompt_that_gives_no_request_is_found() -> None:
    for prompt, told in (
        (PROMPT.replace('A drone', 'Unicorn'), 'makes no request'),
        (' ' * len(PROMPT), 'cannot be read'),
    ):
        spec = altered(read(PROMPT), prompt=prompt, clauses=())
        assert any(told in text for text in doubts(spec)), prompt
