# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A word that is in the way is left out, and said to be; nothing is turned round by it."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing import second_look
from aurora_core.parsing.atoms import Atom
from aurora_core.parsing.attempt import Attempt, attempt
from aurora_core.parsing.landmarks import landmark_phrases
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize
from aurora_core.spec.vocabulary import ClauseStatus, Relation

CONTEXT = ParseContext(landmark_names=('City Hall', 'Ridge School'))


def first_reading(prompt: str) -> Attempt:
    tagged = tag(tokenize(prompt), landmark_phrases(CONTEXT.landmark_names))
    return attempt(prompt, CONTEXT, tagged.atoms)


def unread(prompt: str) -> list[str]:
    outcome = parse_offline(prompt, CONTEXT)
    return [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]


def test_a_clause_is_read_without_the_word_in_its_way() -> None:
    prompt = 'Make sure that a bicycle is to the left of the truck and that no bus shows up.'
    assert first_reading(prompt).unread_words > 10
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    placed = [p for agent in spec.agents for p in agent.placements]
    assert [p.relation for p in placed] == [Relation.LEFT]
    assert unread(prompt) == []


def test_a_word_left_out_that_means_something_is_admitted() -> None:
    prompt = (
        'A motorcycle overtakes a truck that trundles along at 6 m/s, around the motorcycle '
        'doing 12 m/s.'
    )
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    speeds = {b.speed_mps.value for a in spec.agents for b in a.behaviors if b.speed_mps}
    assert speeds == {6.0, 12.0}
    assert unread(prompt) == ['around']


@pytest.mark.parametrize(
    'prompt',
    [
        'If the moon rises, the bus follows the ego car.',
        'The bus brakes, mind you, when the moon rises.',
    ],
)
def test_an_effect_never_loses_the_cause_that_was_not_read(prompt: str) -> None:
    spec = parse_offline(prompt, CONTEXT).spec
    assert spec is not None
    assert all(not agent.behaviors for agent in spec.agents)
    assert all(event.trigger is None for event in spec.events)
    assert any('moon' in text for text in unread(prompt))


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone tracks a bus and a van.',
        'A truck passes between the ego and the drone.',
        'A van waits between the bus and the truck.',
    ],
)
def test_a_reading_that_says_less_or_something_else_is_no_better(prompt: str) -> None:
    first = first_reading(prompt)
    assert second_look.second_look(first) is first


def test_what_a_short_request_leaves_open_is_asked_about() -> None:
    outcome = parse_offline('A drone tracks it.', CONTEXT)
    assert outcome.spec is None
    assert outcome.question


def test_words_that_open_nothing_stay_where_they_are() -> None:
    first = first_reading('A bus hums a tune at the intersection.')
    assert first.unread_words
    assert second_look.second_look(first) is first


@pytest.mark.parametrize(('clauses', 'most'), [(3, 20), (20, 4), (60, 0)])
def test_the_number_of_readings_is_bounded(
    monkeypatch: pytest.MonkeyPatch, clauses: int, most: int
) -> None:
    tries = 0

    def counted(prompt: str, context: ParseContext, atoms: Sequence[Atom]) -> Attempt:
        nonlocal tries
        tries += 1
        return attempt(prompt, context, atoms)

    first = first_reading('. '.join(['the bus is to hum it, and by the way'] * clauses))
    monkeypatch.setattr(second_look, 'attempt', counted)
    second_look.second_look(first)
    assert tries <= most
    assert (tries > 0) == (most > 0)
