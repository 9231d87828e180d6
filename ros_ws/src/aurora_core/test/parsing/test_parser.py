# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Outcomes: refusals with the closed list, spans, order, speed."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from yaml_rows import rows_of

from aurora_core.errors import PromptError
from aurora_core.outcomes.parse import ParseContext, RefusalKind
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.vocabulary import AgentType, ClauseStatus

CONTEXT = ParseContext(map_name='downtown', landmark_names=('clock_tower', 'east tower'))


def test_unsupported_agent_names_the_vocabulary() -> None:
    prompt = 'A drone tracks a helicopter.'
    outcome = parse_offline(prompt, CONTEXT)
    assert outcome.spec is None
    (refusal,) = outcome.refusals
    assert refusal.kind is RefusalKind.UNSUPPORTED
    assert refusal.closed_list == tuple(t.value for t in AgentType)
    assert prompt[refusal.span.start : refusal.span.end] == 'a helicopter'
    assert 'helicopter' in refusal.sentence()


def test_missing_landmark_names_those_of_the_map() -> None:
    outcome = parse_offline('A drone hovers over the airport.', CONTEXT)
    (refusal,) = outcome.refusals
    assert refusal.kind is RefusalKind.MISSING_ELEMENT
    assert refusal.list_name == 'landmarks of downtown'
    assert refusal.closed_list == ('clock_tower', 'east tower')


def test_landmark_by_its_last_word_only_when_one_has_it() -> None:
    alone = ParseContext(landmark_names=('clock_tower', 'old_hospital'))
    spec = parse_offline('A drone hovers over the hospital.', alone).spec
    assert spec is not None
    assert spec.missions[0].target == 'landmark:old_hospital'
    assert 'east tower' in str(parse_offline('A drone hovers over the tower.', CONTEXT).question)


def test_spans_point_at_the_number() -> None:
    prompt = 'A drone tracks a bus from about 25 meters at 120 ft.'
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    standoff = spec.missions[0].standoff_m
    assert standoff is not None
    assert standoff.provenance is Provenance.EXPLICIT
    assert standoff.span is not None
    assert prompt[standoff.span.start : standoff.span.end] == '25 meters'


@pytest.mark.parametrize('prompt', ['', '   ', 'x' * 9000, 'a\x00b'])
def test_text_that_is_no_prompt(prompt: str) -> None:
    with pytest.raises(PromptError):
        parse_offline(prompt, CONTEXT)


def test_mended_spelling_is_told() -> None:
    outcome = parse_offline('A drone follows a motercycle.', CONTEXT)
    assert outcome.clauses[0].note == "read 'motercycle' as 'motorcycle'"


def test_effect_of_an_unread_cause_does_not_hold_without_it() -> None:
    outcome = parse_offline('If the moon rises, the bus follows the ego car.', CONTEXT)
    assert outcome.spec is not None
    assert [c.status for c in outcome.clauses] == [ClauseStatus.NOT_ENCODED] * 2
    assert all(not agent.behaviors for agent in outcome.spec.agents)


def test_spec_carries_prompt_map_and_clauses() -> None:
    outcome = parse_offline('A bus stops.', CONTEXT)
    assert outcome.spec is not None
    assert outcome.spec.prompt == 'A bus stops.'
    assert outcome.spec.world.map_name == 'downtown'
    assert outcome.spec.clauses == outcome.clauses


def test_typical_prompt_takes_few_steps(steps_of: Callable[[Callable[[], object]], int]) -> None:
    rows = rows_of(Path(__file__).with_name('prompts.yaml'))
    prompts = [row['prompt'] for row in rows[::8]]
    for prompt in prompts:  # what is read of the lexicon is kept
        parse_offline(prompt, CONTEXT)
    steps = [steps_of(partial(parse_offline, prompt, CONTEXT)) for prompt in prompts]
    assert statistics.median(steps) < 300_000  # 50,000 are usual, and a few milliseconds


def test_whoever_an_unread_clause_names_takes_part() -> None:
    outcome = parse_offline('When a van hums at a bus, a truck brakes.', CONTEXT)
    assert outcome.spec is not None
    assert {agent.type.value for agent in outcome.spec.agents} == {'van', 'bus', 'truck'}
    unread = [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]
    assert unread[0] == 'When a van hums at a bus'


def test_words_that_are_taken_for_others_are_admitted_where_those_stand() -> None:
    prompt = "Two roadside units get the drone's report 1 second after it has reached 60 m."
    clauses = parse_offline(prompt, CONTEXT).clauses
    unread = [c.text for c in clauses if c.status is ClauseStatus.NOT_ENCODED]
    assert 'the drone' in unread
