# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tokens: places in the text, notations of numbers, hyphens."""

from __future__ import annotations

from fractions import Fraction

import pytest

from aurora_core.parsing.tokens import TokenKind, tokenize


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        ('30', Fraction(30)),
        ('0.3', Fraction(3, 10)),
        ('.5', Fraction(1, 2)),
        ('1,200', Fraction(1200)),
        ('1e3', Fraction(1000)),
        ('-5', Fraction(-5)),
        ('3,5', Fraction(7, 2)),
        ('1,25', Fraction(5, 4)),
        ('30,45', None),
        ('1/2', None),
        ('10:30', None),
        ('.12.3', None),
        ('2^3', None),
        ('1.2.3', None),
        ('9' * 30, None),
    ],
)
def test_only_plain_numbers_have_a_value(text: str, value: Fraction | None) -> None:
    (token,) = tokenize(text)
    assert token.kind is TokenKind.NUMBER
    assert token.value == value
    assert (token.start, token.end) == (0, len(text))


def test_words_keep_their_place() -> None:
    text = 'The ego’s 35-meter stand-off, 100x60m'
    tokens = tokenize(text)
    assert [t.norm for t in tokens] == [
        'the', 'ego', "'s", '35', 'meter', 'stand', 'off', ',', '100', 'x', '60', 'm',
    ]  # fmt: skip
    for token in tokens:
        assert text[token.start : token.end].lower().replace('’', "'") == token.norm


@pytest.mark.parametrize(
    ('text', 'norms'),
    [
        ('20-30 m', ['20', '-', '30', 'm']),
        ('a drone - fast', ['a', 'drone', ';', 'fast']),
        ('v2x link', ['v2x', 'link']),
        ('van -> stop', ['van', '→', 'stop']),
        ('a) van b) stop', [';', 'van', ';', 'stop']),
        ('a van (number 2) stops', ['a', 'van', '(', 'number', '2', ')', 'stops']),
        ('one\ntwo', ['one', '\n', 'two']),
    ],
)
def test_marks(text: str, norms: list[str]) -> None:
    assert [t.norm for t in tokenize(text)] == norms


def test_single_capital_is_noted() -> None:
    assert [t.capital for t in tokenize('drone B tracks a bus')] == [
        False,
        True,
        False,
        False,
        False,
    ]


@pytest.mark.parametrize(
    ('text', 'breaks'),
    [
        ('A drone hovers over City Hall\nat 50 m\r\nfor 10 seconds.', 0),
        ('A drone hovers. It tracks a van\n45 m away.', 0),
        ('A drone hovers.\nit tracks a van.', 1),
        ('Steps:\n- a drone hovers\n- it lands.', 2),
        ('a drone hovers\nit lands', 1),
        ('A drone hovers.\n\nA van stops.', 1),
    ],
)
def test_a_line_that_is_wrapped_goes_on(text: str, breaks: int) -> None:
    assert sum(token.norm == '\n' for token in tokenize(text)) == breaks
