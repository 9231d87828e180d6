# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sentences as long as a prompt may be: the work grows with the words, not with their square."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.atoms import Atom
from aurora_core.parsing.criteria import causes
from aurora_core.parsing.criteria.told import Told, told
from aurora_core.parsing.doubts import bodies, times
from aurora_core.parsing.doubts.clauses import stretch
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(map_name='downtown')


def counted(monkeypatch: pytest.MonkeyPatch, prompt: str) -> int:
    """Return how many atoms are looked through for causes and for verbs behind a word."""
    work = 0

    def told_counted(atoms: Sequence[Atom]) -> Told:
        nonlocal work
        work += len(atoms)
        return told(atoms)

    def stretch_counted(sentence: Sequence[Atom], start: int) -> list[Atom]:
        nonlocal work
        found = stretch(sentence, start)
        work += len(found)
        return found

    with monkeypatch.context() as patched:
        patched.setattr(causes, 'told', told_counted)
        for module in (times, bodies):
            patched.setattr(module, 'stretch', stretch_counted)
        parse_offline(prompt, CONTEXT)
    return work


@pytest.mark.parametrize(
    ('start', 'more', 'end'),
    [
        ('The car stops', ' when it stops', '.'),
        ('The car stops', ' and', '.'),
        ('', '(', 'The car stops.'),
        ('', '"', 'The car stops.'),
    ],
)
def test_work_grows_with_the_words(
    monkeypatch: pytest.MonkeyPatch, start: str, more: str, end: str
) -> None:
    once, twice = (counted(monkeypatch, start + more * n + end) for n in (250, 500))
    assert twice <= 2.2 * once + 100


def test_what_is_beyond_a_cause_is_admitted_as_unread() -> None:
    outcome = parse_offline('The car stops' + ' when it stops' * 200 + '.', CONTEXT)
    assert any(c.status is ClauseStatus.NOT_ENCODED for c in outcome.clauses)
