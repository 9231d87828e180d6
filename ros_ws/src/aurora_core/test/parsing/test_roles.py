# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A second, shallow reading of who does what to whom, held against the specification."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.doubts import roles
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize
from aurora_core.spec.events import AgentAction
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus


def _spec(prompt: str) -> ScenarioSpec:
    spec = parse_offline(prompt, ParseContext()).spec
    assert spec is not None
    return spec


def _told(prompt: str) -> list[tuple[str, str, str]]:
    atoms = tag(tokenize(prompt), {}).atoms

    def words(noun: object) -> str:
        return getattr(noun, 'key', '') if noun is not None else ''

    return [
        (words(d.doer), d.verb.key, words(d.done_to))
        for sentence in roles._clauses(atoms)
        for d in roles.deeds(sentence)
    ]


@pytest.mark.parametrize(
    ('prompt', 'told'),
    [
        ('A truck followed by a bus stops', [('bus', 'follow', 'truck'), ('truck', 'stop', '')]),
        ('A truck a bus follows stops', [('bus', 'follow', 'truck'), ('truck', 'stop', '')]),
        (
            'A bus, stopped by a van, turns left',
            [('van', 'stop', 'bus'), ('bus', 'turn_left', '')],
        ),
        ('A bus tracks a van and the ego stops', [('bus', 'track', 'van'), ('ego', 'stop', '')]),
        ('A truck with a bus behind it stops', [('truck', 'stop', '')]),
        (
            'A truck behind which a van drives brakes',
            [('van', 'drive', ''), ('truck', 'brake', '')],
        ),
        (
            'A car following a truck following a bus brakes',
            [('car', 'follow', 'truck'), ('truck', 'follow', ''), ('car', 'brake', '')],
        ),
    ],
)
def test_who_does_what_to_whom(prompt: str, told: list[tuple[str, str, str]]) -> None:
    assert _told(prompt) == told


@pytest.mark.parametrize(
    'prompt',
    [
        'A truck followed by a bus stops at the crosswalk.',
        'Behind, a truck tailgates the ego; ahead, a bus stops.',
        'A bus has a motorcycle on its left and a bicycle on its right.',
    ],
)
def test_a_part_that_the_elements_give_to_another_is_admitted(prompt: str) -> None:
    clauses = parse_offline(prompt, ParseContext()).clauses
    assert any(c.status is ClauseStatus.NOT_ENCODED for c in clauses)


def test_elements_that_swap_two_bodies_are_found_and_the_right_ones_are_not() -> None:
    prompt = 'When the car comes within 20 m of the bus, the bus stops.'
    spec = _spec(prompt)
    atoms = tag(tokenize(prompt), {}).atoms
    assert not list(roles.misplaced(spec, atoms))
    (event,) = spec.events
    assert isinstance(event.action, AgentAction)
    other = next(a.id for a in spec.agents if a.id != event.action.agent)
    action = event.action.model_copy(update={'agent': other})
    wrong = spec.model_copy(update={'events': (event.model_copy(update={'action': action}),)})
    assert list(roles.misplaced(wrong, atoms))
