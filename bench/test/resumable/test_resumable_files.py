# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The lines that programs read, and files that would be counted twice."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any

import pytest

from aurora_bench.results import ResultsError
from aurora_bench.resumable.code import code_digest, files_digest
from aurora_bench.resumable.files import file_line, read_files, verdict_line
from aurora_core.report.share import Share


def line(**changes: Any) -> str:
    """Return a line of a prompt file."""
    document = {
        'id': 'hover-901', 'category': 'hover', 'prompt': 'A drone hovers, with music.',
        'feasibility': 'feasible', 'paraphrase_group': None, 'end_to_end': False,
        'requirements': [
            {'id': 'r1', 'kind': 'uav', 'ref': 'uav1'},
            {'id': 'r2', 'kind': 'beyond', 'text': 'with music'},
        ], **changes,
    }  # fmt: skip
    return json.dumps(document) + '\n'


def written(path: Path, text: str) -> Path:
    """Write a file and its folder."""
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    return path


def test_a_file_is_told_by_digest_and_number_of_beyond(tmp_path: Path) -> None:
    text = line() + line(id='hover-902')
    (file,) = read_files([written(tmp_path / 'mine' / 'own.jsonl', text)])
    digest = hashlib.sha256(text.encode()).hexdigest()
    assert file_line(file) == f'mine/own.jsonl  sha256 {digest}  beyond 2'


def test_what_would_count_twice_is_refused(tmp_path: Path) -> None:
    path = written(tmp_path / 'mine' / 'own.jsonl', line())
    with pytest.raises(ResultsError, match='given twice'):
        read_files([path, path])
    twice = written(tmp_path / 'mine' / 'twice.jsonl', line() + line())
    with pytest.raises(ResultsError, match='two prompts of the id hover-901'):
        read_files([twice])


@pytest.mark.parametrize(
    ('what', 'of', 'found'),
    [
        (
            'realised',
            ' feasible',
            'realised 42 of 93 feasible  0.452 [0.354, 0.553]  silent failures 3  '
            'unchecked 7 of 210',
        ),
        (
            'right outcome',
            '',
            'right outcome 42 of 93  0.452 [0.354, 0.553]  silent failures 3  unchecked 7 of 210',
        ),
    ],
)
def test_the_last_line_is_the_contracts(what: str, of: str, found: str) -> None:
    share, unchecked = Share(met=42, total=93), Share(met=7, total=210)
    assert verdict_line(what, share, of, 3, unchecked) == found


def test_any_edit_of_the_code_or_the_configuration_is_another_product(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, two = written(tmp_path / 'a' / 'one.py', 'x = 1'), written(tmp_path / 'a' / 'two.py', '')
    before = files_digest([('one', one), ('two', two)])
    assert files_digest([('two', two), ('one', one)]) == before
    assert files_digest([('one', two), ('two', one)]) != before
    one.write_text('x = 2')
    assert files_digest([('one', one), ('two', two)]) != before
    here = code_digest()
    (tmp_path / 'config').mkdir()
    monkeypatch.setenv('AURORA_CONFIG_DIR', str(tmp_path / 'config'))
    assert code_digest() != here


def test_a_pipe_or_a_device_is_refused_before_it_is_read(tmp_path: Path) -> None:
    # Nobody writes into the pipe, and the device never ends: reading either would not come back.
    os.mkfifo(tmp_path / 'pipe.jsonl')
    for path in (tmp_path / 'pipe.jsonl', Path('/dev/zero')):
        with pytest.raises(ResultsError, match='expected a regular file'):
            read_files([path])
