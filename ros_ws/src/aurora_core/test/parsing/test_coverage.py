# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What nothing accounts for is quoted, however it slipped through."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        ('A drone tracks a bus in 3 streets.', '3 streets'),
        ('A drone tracks a bus with 7.', '7'),
        ('A bus stops, 40 % of it.', '40 %'),
        ('A drone hovers over the ego car at 1/2 km.', '1/2 km'),
        ('A drone tracks the bus on a 5G network.', '5G'),
        ('A drone gently tracks a bus.', 'gently'),
        ('A drone tracks a bus and a van.', 'a bus and a van'),
        ('A drone tracks a bus unless a van stops.', 'unless a van stops'),
        ('When the moon rises, which is nice, a drone tracks a bus.', 'When the moon'),
        ('A bus drives. To 100 m within the first 8 s of the scenario.', '100 m'),
        ('A drone hovers over the ego car at .12.3 m.', '.12.3 m'),
    ],
)
def test_quoted(prompt: str, quoted: str) -> None:
    outcome = parse_offline(prompt, ParseContext())
    unread = [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]
    assert any(quoted in text for text in unread), (unread, outcome.question)


def test_politeness_needs_nothing() -> None:
    outcome = parse_offline('Hello! A drone tracks a bus. Thank you very much!', ParseContext())
    assert [c.status.value for c in outcome.clauses] == [
        'no_requirement',
        'encoded',
        'no_requirement',
    ]


def test_number_is_never_politeness() -> None:
    outcome = parse_offline('Thank you 5 times. A drone tracks a bus.', ParseContext())
    assert outcome.clauses[0].status is ClauseStatus.NOT_ENCODED


@pytest.mark.parametrize(
    ('prompt', 'kinds'),
    [
        ('Exactly two cars drive along, a drone hovers at 40 m.', [('car', 2.0)]),
        ('Two cars drive along, a drone hovers at 40 m.', []),
        ('Only one bus and just 2 drones are there; the drones track the bus.', [('bus', 1.0)]),
        ('There are exactly 3 vehicles. A drone hovers at 40 m.', [('vehicle', 3.0)]),
    ],
)
def test_exact_numbers_close_the_scene(prompt: str, kinds: list[tuple[str, float]]) -> None:
    spec = parse_offline(prompt, ParseContext(landmark_names=('City Hall',))).spec
    assert spec is not None
    found = [(count.kind, count.value.value) for count in spec.counts]
    assert found[: len(kinds)] == kinds
    assert all(any(c.id in clause.ids for clause in spec.clauses) for c in spec.counts)


def test_who_is_told_of_behind_a_place_is_not_lost_in_silence() -> None:
    prompt = 'A drone hovers at 40 m over City Hall, where a police car is parked.'
    outcome = parse_offline(prompt, ParseContext(landmark_names=('City Hall',)))
    unread = [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]
    assert unread == ['City Hall, where']


@pytest.mark.parametrize(
    ('prompt', 'kinds'),
    [
        ('There is no truck in the scene. A drone tracks a bus.', [('truck', 0.0)]),
        ('A drone tracks a bus; there are no other vehicles.', [('vehicle', 1.0)]),
    ],
)
def test_what_is_denied_closes_the_scene(prompt: str, kinds: list[tuple[str, float]]) -> None:
    spec = parse_offline(prompt, ParseContext()).spec
    assert spec is not None
    assert [(count.kind, count.value.value) for count in spec.counts] == kinds
