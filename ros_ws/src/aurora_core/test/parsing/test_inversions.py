# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Statements are put in order; what only looks like one is left alone."""

from __future__ import annotations

import pytest

from aurora_core.parsing.rewriting.inversions import straighten
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize


def _words(prompt: str) -> list[str]:
    atoms = straighten(tag(tokenize(prompt), {}).atoms, prompt)
    return [f'{a.kind.value} {a.key}' for a in atoms]


@pytest.mark.parametrize(
    ('prompt', 'told'),
    [
        ('there comes a bus', ['fill there', 'noun bus', 'verb drive']),
        ('only then does the bus brake', ['then only then', 'noun bus', 'verb brake']),
        ('the hover phase lasts 20 s', ['fill the', 'preposition for', 'measure time']),
    ],
)
def test_statement_is_put_in_order(prompt: str, told: list[str]) -> None:
    assert _words(prompt) == told


def test_a_cause_stays_a_cause() -> None:
    assert 'subordinator when' in _words('the drone lands if the bus stops')
