# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that were not read and ask for nothing."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.asks_nothing import BESIDE, LABEL, reason_of
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus


def _texts(prompt: str, status: ClauseStatus) -> list[str]:
    return [c.text for c in parse_offline(prompt, ParseContext()).clauses if c.status is status]


@pytest.mark.parametrize(
    ('prompt', 'text', 'note'),
    [
        ('A drone hovers at 30 m for 20 s. Cheers, Fiona', 'Cheers, Fiona', 'greets'),
        ('Acceptance criteria: the drone hovers at 30 m.', 'Acceptance', 'title'),
        ('Check the link budget. A drone hovers at 30 m.', 'Check the link budget', 'for'),
        ('A drone hovers at 30 m. If it makes a difference.', 'If it makes', 'remark'),
        ('A drone hovers at 30 m and avoids all no-fly zones.', 'avoids', 'every run'),
        ('A drone hovers at 30 m. No vehicle collides.', 'No vehicle', 'every run'),
    ],
)
def test_what_asks_for_nothing_leaves_a_request_complete(
    prompt: str, text: str, note: str
) -> None:
    outcome = parse_offline(prompt, ParseContext())
    (aside,) = [c for c in outcome.clauses if c.status is ClauseStatus.NO_REQUIREMENT]
    assert aside.text.startswith(text)
    assert note in aside.note
    assert not _texts(prompt, ClauseStatus.NOT_ENCODED)


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers at 30 m for 20 s. Tilt the gimbal.',
        'A drone hovers at 30 m for 20 s. Cheers, and tilt the gimbal.',
        'Check the link budget of 3 dB. A drone hovers at 30 m.',
        'A drone hovers at 30 m and avoids all no-fly zones by 20 m.',
        'A drone hovers at 30 m. If it makes a difference of 2 m.',
    ],
)
def test_one_word_more_leaves_it_unread(prompt: str) -> None:
    assert _texts(prompt, ClauseStatus.NOT_ENCODED)


def test_words_ask_for_nothing_in_their_places_only() -> None:
    assert reason_of('suddenly', [BESIDE])
    assert reason_of('suddenly') is None
    assert reason_of('Expected result', [LABEL])
    assert reason_of('Expected result', ['', BESIDE]) is None
    assert reason_of('') is None


def test_every_row_has_a_reason_and_sorted_phrases() -> None:
    rows = read_data('asks_nothing.yaml')
    assert list(rows) == sorted(rows)
    for row in rows.values():
        assert row['reason']
        assert row.get('where', '') in ('', BESIDE, LABEL)
        assert row['phrases'] == sorted(row['phrases'], key=lambda p: p.replace('(', ''))
