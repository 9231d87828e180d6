# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where clauses begin and how they hang together."""

from __future__ import annotations

import pytest

from aurora_core.parsing.segments import segment
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize


def _clauses(text: str) -> list[tuple[str, str]]:
    return [
        (piece.link.value, text[piece.start : piece.end])
        for piece in segment(tag(tokenize(text), {}).atoms)
    ]


@pytest.mark.parametrize(
    ('text', 'clauses'),
    [
        (
            'A drone ascends and then follows a bus as it drives.',
            [('main', 'A drone ascends'), ('main', 'follows a bus'), ('while', 'as it drives')],
        ),
        (
            'A van tailgates the ego car, closing from 45 m.',
            [('main', 'A van tailgates the ego car'), ('participle', 'closing from 45 m')],
        ),
        (
            'A drone that tracks the van alerts the ego when the van stops',
            [
                ('relative', 'A drone that tracks the van'),
                ('main', 'alerts the ego'),
                ('when', 'when the van stops'),
            ],
        ),
        ('At 30 m, a drone hovers.', [('main', 'At 30 m, a drone hovers')]),
        ('The bus and the van stop.', [('main', 'The bus and the van stop')]),
        (
            'A bus stops with two cars driving around',
            [('main', 'A bus stops'), ('main', 'two cars driving around')],
        ),
        (
            'The drone lands 5 s after the bus stops',
            [('main', 'The drone lands'), ('after', '5 s after the bus stops')],
        ),
        ('After 10 s the bus stops', [('main', 'After 10 s the bus stops')]),
        (
            'It hovers over the ego before landing',
            [('main', 'It hovers over the ego'), ('main', 'before landing')],
        ),
        (
            'a drone over the ego, a bus behind it',
            [('main', 'a drone over the ego'), ('main', 'a bus behind it')],
        ),
        (
            'link with 20 % loss, 0.3 s latency and 200 m range',
            [('main', 'link with 20 % loss, 0.3 s latency and 200 m range')],
        ),
    ],
)
def test_clauses(text: str, clauses: list[tuple[str, str]]) -> None:
    assert _clauses(text) == clauses


def test_landing_after_before_is_a_sequence() -> None:
    text = 'A drone hovers over the ego before landing'
    pieces = segment(tag(tokenize(text), {}).atoms)
    assert [piece.then for piece in pieces] == [False, True]
