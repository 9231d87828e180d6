# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the judge takes, refuses or asks when a model tells what it read."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.outcomes.parse import RefusalKind
from aurora_core.parsing.llm.check import Judgement
from aurora_core.spec.parameter import Bound, Provenance
from aurora_core.spec.vocabulary import ClauseStatus


def test_good_answer_is_taken_with_values_and_spans_of_the_prompt(
    good: dict[str, Any], judged: Callable[..., Judgement]
) -> None:
    outcome = judged(good).outcome
    assert outcome is not None
    assert outcome.spec is not None
    mission = outcome.spec.missions[0]
    assert mission.altitude_m.provenance is Provenance.EXPLICIT
    assert mission.altitude_m.bound is Bound.AT_MOST
    span = mission.altitude_m.span
    assert span is not None
    assert outcome.spec.prompt[span.start : span.end] == '40 m'
    assert outcome.spec.links[0].sender == 'uav1'
    assert [a.group for a in outcome.spec.agents][-2:] == ['van_group1', 'van_group1']


def test_what_is_admitted_not_to_be_encoded_is_no_lie(
    good: dict[str, Any], judged: Callable[..., Judgement]
) -> None:
    del good['agents'][3:]
    good['clauses'][3] |= {'status': 'not_encoded', 'ids': [], 'note': 'too many'}
    outcome = judged(good).outcome
    assert outcome is not None
    assert outcome.clauses[3].status is ClauseStatus.NOT_ENCODED


@pytest.mark.parametrize(
    ('prompt', 'quote', 'kind', 'expected'),
    [
        ('A drone tracks a unicorn.', 'a unicorn', 'agent_type', RefusalKind.UNSUPPORTED),
        ('A drone follows a helicopter.', 'helicopter', 'agent_type', RefusalKind.UNSUPPORTED),
        ('A drone hovers over the castle.', 'castle', 'landmark', RefusalKind.MISSING_ELEMENT),
    ],
)
def test_what_does_not_exist_is_refused_with_the_closed_list(
    prompt: str, quote: str, kind: str, expected: RefusalKind, judged: Callable[..., Judgement]
) -> None:
    outcome = judged({'missing': [{'quote': quote, 'kind': kind}]}, prompt).outcome
    assert outcome is not None
    assert [r.kind for r in outcome.refusals] == [expected]
    assert outcome.refusals[0].closed_list


def test_unicorn_does_not_become_a_car(judged: Callable[..., Judgement]) -> None:
    prompt = 'A drone tracks a unicorn.'
    reading = {
        'agents': [{'id': 'c', 'type': 'car', 'quote': 'a unicorn'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [{'id': 'm', 'uav': 'u', 'mode': 'track', 'target': 'c', 'quote': 'tracks'}],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'c']}],
    }
    assert 'does not name a car' in judged(reading, prompt).complaints[0]


def test_missing_that_only_the_model_claims_is_a_question_and_no_proof(
    judged: Callable[..., Judgement],
) -> None:
    prompt = 'A drone gently zorbles a bus.'
    outcome = judged({'missing': [{'quote': 'zorbles', 'kind': 'agent_type'}]}, prompt).outcome
    assert outcome is not None
    assert (outcome.spec, outcome.refusals) == (None, ())
    assert outcome.question is not None
    assert "'zorbles' is not one of the agent types" in outcome.question


def test_words_that_only_the_model_understood_are_named_in_the_clause(
    judged: Callable[..., Judgement],
) -> None:
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


def test_denial_is_no_request_for_the_thing_denied(judged: Callable[..., Judgement]) -> None:
    prompt = 'A drone must not follow the bus.'
    reading = {
        'agents': [{'id': 'b', 'type': 'bus', 'quote': 'the bus'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [{'id': 'm', 'uav': 'u', 'mode': 'track', 'target': 'b', 'quote': 'follow'}],
        'clauses': [{'quote': prompt[:-1], 'status': 'encoded', 'ids': ['m', 'b']}],
    }
    assert 'denies something' in judged(reading, prompt).complaints[0]


def test_naming_what_is_not_wanted_asks_for_nothing(judged: Callable[..., Judgement]) -> None:
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


def test_question_of_the_model_is_asked(judged: Callable[..., Judgement]) -> None:
    outcome = judged({'question': 'Which bus?'}).outcome
    assert outcome is not None
    assert (outcome.spec, outcome.question) == (None, 'Which bus?')
