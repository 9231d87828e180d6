# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_core.errors import ReportError
from aurora_core.report.run_folder import RunFolder, StageFile, is_run_id, new_run_id


@pytest.fixture
def folder(tmp_path: Path, make: SimpleNamespace) -> RunFolder:
    made = RunFolder(tmp_path / 'runs', make.run_id)
    made.create()
    return made


def test_a_run_id_is_utc_time_and_six_hex_digits() -> None:
    in_tokyo = datetime(2026, 2, 1, 8, 5, 9, tzinfo=timezone(timedelta(hours=9)))
    assert new_run_id(in_tokyo, b'\x01\xab\xcd\xff') == '20260131T230509Z-01abcd'
    assert is_run_id('20260131T230509Z-01abcd')
    assert not is_run_id('20260131T230509Z-01ABCD')


def test_a_run_id_needs_a_zone_and_entropy() -> None:
    with pytest.raises(ReportError, match='zone'):
        new_run_id(datetime(2026, 2, 1), b'abc')
    with pytest.raises(ReportError, match='entropy'):
        new_run_id(datetime(2026, 2, 1, tzinfo=UTC), b'ab')


def test_a_folder_takes_only_run_ids(tmp_path: Path) -> None:
    with pytest.raises(ReportError, match='run id'):
        RunFolder(tmp_path, '../elsewhere')


def test_two_runs_never_share_a_folder(folder: RunFolder) -> None:
    with pytest.raises(ReportError, match='exists already'):
        RunFolder(folder.root, folder.run_id).create()


def test_a_folder_that_cannot_be_made_says_where(tmp_path: Path, make: SimpleNamespace) -> None:
    (tmp_path / 'file').write_text('x')
    with pytest.raises(ReportError, match='file'):
        RunFolder(tmp_path / 'file' / 'runs', make.run_id).create()


def test_text_is_kept_byte_for_byte(folder: RunFolder) -> None:
    text = 'Käse\r\n\ttab and no end of line'
    assert folder.write_text('prompt.txt', text).read_bytes() == text.encode('utf-8')


def test_stage_files_carry_the_iteration(folder: RunFolder, make: SimpleNamespace) -> None:
    path = folder.write_stage(StageFile.SPEC, 2, make.spec())
    assert path.name == 'spec.2.json'
    assert json.loads(path.read_text())['prompt'] == make.prompt
    assert folder.write_stage(StageFile.GROUNDING, 0, '{"a":1}').read_text() == '{"a":1}'
    assert folder.bag_path(2).name == 'bag.2'


def test_a_failed_write_leaves_the_old_file_and_no_temporary_one(
    folder: RunFolder, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder.write_text('report.json', 'old')

    def full(_descriptor: int) -> None:
        raise OSError(28, 'No space left on device')

    monkeypatch.setattr(os, 'fsync', full)
    with pytest.raises(ReportError, match='No space left') as caught:
        folder.write_text('report.json', 'new')
    assert '--out' in caught.value.hint
    assert caught.value.code == 800
    assert (folder.path / 'report.json').read_text() == 'old'
    assert [path.name for path in folder.path.iterdir()] == ['report.json']


def test_a_folder_without_permission_is_named(folder: RunFolder) -> None:
    missing = RunFolder(folder.root / 'gone', folder.run_id)
    with pytest.raises(ReportError, match='gone'):
        missing.write_text('prompt.txt', 'x')


@pytest.mark.parametrize('name', ['../x', 'a/b', '', '..', '/etc/x'])
def test_names_cannot_leave_the_folder(folder: RunFolder, name: str) -> None:
    with pytest.raises(ReportError, match='name of a file'):
        folder.write_text(name, 'x')


def test_numbers_that_are_not_finite_are_refused(folder: RunFolder) -> None:
    with pytest.raises(ReportError, match='JSON'):
        folder.write_json('x.json', {'margin': float('nan')})
    with pytest.raises(ReportError, match='Unicode'):
        folder.write_text('prompt.txt', '\udcff')
    assert list(folder.path.iterdir()) == []


def test_no_mark_of_a_prompt_turns_the_writing_of_a_document(tmp_path: Path) -> None:
    folder = RunFolder(tmp_path, '20260131T120000Z-0a1b2c')
    folder.create()
    document = {'prompt': 'hover \u202eDEIFIREV\u202c \x1b[2J \x9b1A é 木'}
    path = folder.write_json('report.json', document)
    text = path.read_text(encoding='utf-8')
    assert json.loads(text) == document
    assert not any(mark in text for mark in '\u202e\u202c\x1b\x9b')
    assert 'é 木' in text
