# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from datetime import UTC, datetime
from pathlib import Path

import pytest

from aurora_core.report.manifest import Manifest, manifest_facts
from aurora_core.report.process import ProcessIdentity, this_process
from aurora_core.report.run_folder import MANIFEST, PROMPT, RunFolder
from aurora_core.report.run_report import RunReport
from aurora_core.report.status import Status
from aurora_core.report.unfinished import close_unfinished

GONE = '20260131T120000Z-000001'
ALIVE = '20260131T120000Z-000002'
FINISHED = '20260131T120000Z-000003'
UNREADABLE = '20260131T120000Z-000004'


def _lives(identity: ProcessIdentity) -> bool:
    return identity.pid == 2


@pytest.fixture
def root(tmp_path: Path) -> Path:
    for run_id, pid in ((GONE, 1), (ALIVE, 2), (FINISHED, 1)):
        folder = RunFolder(tmp_path, run_id)
        folder.create()
        process = ProcessIdentity(host='here', pid=pid)
        facts = manifest_facts(datetime(2026, 1, 31, tzinfo=UTC), process, {'aurora': '0.1.0'})
        request = {'prompt': 'ignored', 'map_name': 'junction', 'seed': 7, 'engine': 'ros'}
        folder.write_json(MANIFEST, {**facts, 'request': request})
        folder.write_text(PROMPT, 'A drone hovers.')
    (tmp_path / FINISHED / 'report.json').write_text('{}')
    (tmp_path / UNREADABLE).mkdir()
    (tmp_path / UNREADABLE / MANIFEST).write_text('{"process":')
    (tmp_path / 'notes').mkdir()
    (tmp_path / 'notes' / MANIFEST).write_text('{}')
    return tmp_path


def test_only_runs_of_dead_processes_are_closed(root: Path) -> None:
    assert close_unfinished(root, _lives) == (GONE,)
    report = RunReport.model_validate_json((root / GONE / 'report.json').read_bytes())
    assert report.status is Status.ERROR
    assert (report.prompt, report.map, report.seed) == ('A drone hovers.', 'junction', 7)
    assert report.error is not None
    assert 'the process 1' in report.error.message
    assert not (root / ALIVE / 'report.json').exists()
    assert (root / FINISHED / 'report.json').read_text() == '{}'
    assert not (root / UNREADABLE / 'report.json').exists()


def test_closing_twice_does_nothing(root: Path) -> None:
    close_unfinished(root, _lives)
    assert close_unfinished(root, _lives) == ()


def test_a_run_that_died_before_its_prompt_was_written_is_closed_too(root: Path) -> None:
    (root / GONE / PROMPT).unlink()
    assert close_unfinished(root, _lives) == (GONE,)


def test_there_need_not_be_any_runs(tmp_path: Path) -> None:
    assert close_unfinished(tmp_path / 'none') == ()


def test_the_manifest_reads_what_it_wrote_and_later_fields_do_not_harm() -> None:
    facts = manifest_facts(datetime(2026, 1, 31, tzinfo=UTC), this_process(), {'b': '2', 'a': '1'})
    manifest = Manifest.model_validate_json(json.dumps({**facts, 'new_field': 1}))
    assert manifest.process == this_process()
    assert manifest.started_utc == '2026-01-31T00:00:00+00:00'
    assert list(manifest.versions) == ['a', 'b']
