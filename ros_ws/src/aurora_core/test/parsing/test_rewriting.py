# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shorthand and second thoughts."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.pieces import MOST_ATOMS
from aurora_core.parsing.rewriting.rewrite import longest_sentence, rewrite
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize
from aurora_core.spec.vocabulary import ClauseStatus


@pytest.mark.parametrize(
    ('prompt', 'altitude_m', 'taken_back'),
    [
        ('A drone hovers over the ego at 40 m, sorry, 50 m for 20 s.', 50.0, '40 m'),
        ('A drone hovers over the ego at 40 m altitude... no, make it 35 m.', 35.0, '40 m'),
        ('A UAV follows a bus at a height of 25 m, or rather 30 m.', 30.0, '25 m'),
    ],
)
def test_a_number_taken_back_does_not_count(
    prompt: str, altitude_m: float, taken_back: str
) -> None:
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    assert [m.altitude_m.value for m in outcome.spec.missions] == [altitude_m]
    silent = [c.text for c in outcome.clauses if c.status is ClauseStatus.NO_REQUIREMENT]
    assert any(text.startswith(taken_back) for text in silent)


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers over the ego at 40 m, sorry, for 50 s.',
        'A drone hovers at 40 m. Sorry, the ego stops at 10 s.',
    ],
)
def test_a_number_that_nothing_replaces_stays(prompt: str) -> None:
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    assert 40.0 in [m.altitude_m.value for m in outcome.spec.missions]


def test_up_to_a_height_is_a_bound_when_something_is_bounded() -> None:
    outcome = parse_offline('A drone hovers over the ego at up to 40 m.', ParseContext())
    assert outcome.spec is not None
    (mission,) = outcome.spec.missions
    assert mission.altitude_m.bound.value == 'at_most'


def test_a_label_of_several_is_a_sentence() -> None:
    prompt = 'Two drones: one follows the bus, the other hovers over the ego at 50 m.'
    outcome = parse_offline(prompt, ParseContext())
    assert outcome.spec is not None
    assert [(m.uav, m.mode.value) for m in outcome.spec.missions] == [
        ('uav1', 'track'),
        ('uav2', 'hover'),
    ]


def test_an_endless_sentence_is_left_alone() -> None:
    # Patterns are looked for from every word on: minutes for what nobody writes.
    endless = 'the drone and the bus and ' * 100
    atoms = tag(tokenize(endless), {}).atoms
    assert len(atoms) > MOST_ATOMS
    assert rewrite(atoms, endless).atoms == atoms
    again = 'A drone tracks a bus. ' * 200
    atoms = tag(tokenize(again), {}).atoms
    assert len(atoms) > MOST_ATOMS > longest_sentence(atoms)
