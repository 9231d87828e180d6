# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of earlier processes, as their folders tell."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_nodes.finished_runs import list_finished, read_finished

OLD, NEW = '20260101T000000Z-0a1b2c', '20260102T000000Z-0a1b2c'


def write(root: Path, run_id: str, text: str) -> None:
    (root / run_id).mkdir()
    (root / run_id / 'report.json').write_text(text, encoding='utf-8')


def test_finished_runs_newest_first(tmp_path: Path) -> None:
    for run_id in (OLD, NEW):
        report = {'run_id': run_id, 'status': 'verified', 'prompt': run_id}
        write(tmp_path, run_id, json.dumps(report))
    (tmp_path / 'notes').mkdir()
    runs = list(list_finished(tmp_path))
    assert [run.run_id for run in runs] == [NEW, OLD]
    assert runs[0].prompt == NEW
    assert runs[0].run_dir == tmp_path / NEW
    assert read_finished(tmp_path, OLD) == runs[1]


def test_the_report_of_another_run_is_none_of_this(tmp_path: Path) -> None:
    report = {'run_id': NEW, 'status': 'verified', 'prompt': 'A drone hovers.'}
    write(tmp_path, OLD, json.dumps(report))
    assert read_finished(tmp_path, OLD) is None
    assert list(list_finished(tmp_path)) == []


@pytest.mark.parametrize('text', ['', '[]', '{"status": "verified"}', '"x"', '[' * 100_000])
def test_a_report_that_cannot_be_read_is_no_finished_run(tmp_path: Path, text: str) -> None:
    write(tmp_path, OLD, text)
    assert read_finished(tmp_path, OLD) is None
    assert list(list_finished(tmp_path)) == []


@pytest.mark.parametrize('run_id', ['', '..', '../x', '/etc', 'x'])
def test_a_run_id_never_leaves_the_folder(tmp_path: Path, run_id: str) -> None:
    assert read_finished(tmp_path, run_id) is None


def test_no_folder_has_no_runs(tmp_path: Path) -> None:
    assert list(list_finished(tmp_path / 'gone')) == []
