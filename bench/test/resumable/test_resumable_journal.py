# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A journal keeps what is finished, and is never that of two campaigns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aurora_bench.resumable.journal import Journal, JournalError, JournalHead, journal_path


def head(**changes: Any) -> JournalHead:
    """Return what a campaign measures."""
    values: dict[str, Any] = {
        'campaign': 'realise', 'files': {'tune/own.jsonl': 'ab12'}, 'options': {'map': 'downtown'},
    }  # fmt: skip
    return JournalHead(**{**values, **changes})


def cut_short(path: Path) -> None:
    """Write a journal of two trials that no `end` follows."""
    with Journal(path, head(), resume=False) as journal:
        journal.add('a', {'right': True})
        journal.add('b', {'right': False})


def test_what_was_finished_is_there_again_and_goes_on(tmp_path: Path) -> None:
    path = journal_path(tmp_path / 'new', 'realise')
    cut_short(path)
    with Journal(path, head(), resume=True) as journal:
        assert journal.finished == {'a': {'right': True}, 'b': {'right': False}}
        journal.add('c', {'right': True})
    with Journal(path, head(), resume=True) as journal:
        assert list(journal.finished) == ['a', 'b', 'c']


@pytest.mark.parametrize('left', [b'{"key": "c", "resu', b'{"key": "c"', b'\xff\xfe'])
def test_a_line_that_a_crash_cut_is_as_if_it_had_not_been(tmp_path: Path, left: bytes) -> None:
    path = tmp_path / 'own.jsonl'
    cut_short(path)
    whole = path.read_bytes()
    path.write_bytes(whole + left)
    with Journal(path, head(), resume=True) as journal:
        assert list(journal.finished) == ['a', 'b']
    assert path.read_bytes() == whole


@pytest.mark.parametrize(
    ('changes', 'words'),
    [
        ({'campaign': 'outcome'}, 'campaign is realise, not outcome'),
        ({'files': {'tune/own.jsonl': 'cd34'}}, 'files is tune/own.jsonl ab12, not tune/own.'),
        ({'options': {'map': 'harbour'}}, 'options is map downtown, not map harbour'),
    ],
)
def test_a_journal_of_something_else_is_refused(
    tmp_path: Path, changes: dict[str, Any], words: str
) -> None:
    path = tmp_path / 'own.jsonl'
    cut_short(path)
    before = path.read_bytes()
    with pytest.raises(JournalError, match=words):
        Journal(path, head(**changes), resume=True)
    assert path.read_bytes() == before


def test_hours_of_work_are_not_written_over(tmp_path: Path) -> None:
    path = tmp_path / 'own.jsonl'
    cut_short(path)
    with pytest.raises(JournalError, match='holds 2 trials of a campaign that was not ended'):
        Journal(path, head(), resume=False)
    with Journal(path, head(), resume=True) as journal:
        journal.end()
    with Journal(path, head(), resume=False) as journal:
        assert journal.finished == {}


def test_what_is_no_journal_is_refused_and_stays(tmp_path: Path) -> None:
    path = tmp_path / 'prompts.jsonl'
    path.write_text('{"id": "hover-001"}\n')
    with pytest.raises(JournalError, match='is no journal'):
        Journal(path, head(), resume=True)
    assert path.read_text() == '{"id": "hover-001"}\n'
