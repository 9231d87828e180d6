# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import pytest

from aurora_core.knowledge.config_files import config_path
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import MANIFEST, PROMPT, RunFolder

Call = Callable[..., SimpleNamespace]
MAIN = 'from aurora_cli.main import main; main()'


def test_a_run_is_verified_and_answers_with_one_document(finished: SimpleNamespace) -> None:
    assert finished.process.returncode == 0, finished.process.stderr.decode()
    assert finished.report['status'] == 'verified'
    schema = json.loads(config_path('schema', 'report.schema.json').read_text('utf-8'))
    jsonschema.validate(finished.report, schema)
    assert b'aurora: execute' in finished.process.stderr


def test_the_run_folder_holds_every_stage(finished: SimpleNamespace) -> None:
    names = {path.name for path in finished.folder.iterdir()}
    stages = {f'{name}.0.json' for name in ('spec', 'agsg', 'grounding', 'schedule')}
    stages |= {'feasibility.0.json', 'verdict.0.json', 'bag.0'}
    assert names >= stages | {'manifest.json', 'prompt.txt', 'report.json', 'report.html'}
    assert not [name for name in names if name.startswith('.')]
    assert json.loads((finished.folder / 'report.json').read_text()) == finished.report
    # Nobody has looked yet.
    assert 'picture.png' not in names


def test_a_fault_at_run_time_ends_violated_with_the_right_condition(
    tmp_path: Path, shell: SimpleNamespace
) -> None:
    fault = '{"kind": "target_removed", "subject": "ego", "at_s": 3.0}'
    done = shell.aurora('run', shell.prompt, '--json', '--picture', '--fault', fault, cwd=tmp_path)
    report = json.loads(done.stdout)
    assert (done.returncode, report['status']) == (1, 'violated')
    picture = tmp_path / 'runs' / report['run_id'] / 'picture.png'
    assert picture.read_bytes().startswith(b'\x89PNG')
    failed = {row['id']: row for row in report['conditions'] if not row['satisfied']}
    assert 'safety.presence' in failed
    assert failed['safety.presence']['worst_time_s'] == pytest.approx(3.05, abs=0.06)
    assert report['faults'][0]['kind'] == 'target_removed'


@pytest.mark.parametrize(
    ('raw', 'words'),
    [
        (b'A drone \xff hovers.', 'UTF-8'),
        (b'A drone\x00hovers.', 'NUL'),
        (b'   ', 'no text'),
        (b'x' * 9000, '8192'),
    ],
)
def test_bytes_that_are_no_prompt_get_a_question(
    here: Path, call: Call, monkeypatch: pytest.MonkeyPatch, raw: bytes, words: str
) -> None:
    monkeypatch.setattr(sys, 'stdin', SimpleNamespace(buffer=io.BytesIO(raw)))
    done = call('run', '-', '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (3, 'not_understood')
    assert words in report['question']
    folder = here / 'runs' / report['run_id']
    assert (folder / PROMPT).read_bytes() == raw
    assert json.loads((folder / 'report.json').read_text()) == report


def test_an_argument_that_is_not_utf8_is_no_crash(tmp_path: Path, shell: SimpleNamespace) -> None:
    done = shell.aurora('run', b'A drone \xff', cwd=tmp_path)
    assert done.returncode == 3
    assert done.stdout.startswith(b'NOT UNDERSTOOD')
    assert b'Traceback' not in done.stderr


def test_what_cannot_be_is_refused_with_a_proof_that_checks_again(here: Path, call: Call) -> None:
    done = call('run', 'A drone hovers at 500 meters altitude over the ego car.', '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (5, 'infeasible')
    [mend] = report['feasibility']['certificates'][0]['mends']
    assert (mend['requested'], mend['nearest']) == (500.0, 120.0)
    again = call('certificate', 'check', f'runs/{report["run_id"]}')
    assert again.code == 0, again.out


def test_a_folder_that_cannot_be_written_is_told(
    here: Path, call: Call, shell: SimpleNamespace
) -> None:
    (here / 'runs').write_text('a file')
    done = call('run', shell.prompt, '--json')
    assert done.code == 4
    assert json.loads(done.out)['error']['code'] == 800
    assert 'choose another output folder' in done.err


def test_unfinished_runs_are_closed_before_the_next_one(here: Path, call: Call) -> None:
    dead = RunFolder(here / 'runs', '20260131T120000Z-0a1b2c')
    dead.create()
    process = this_process().model_dump() | {'started': 'another boot/1'}
    dead.write_json(MANIFEST, {'process': process})
    done = call('run', '')
    assert 'closed the unfinished run 20260131T120000Z-0a1b2c' in done.err
    assert json.loads(dead.file('report.json').read_text())['status'] == 'error'


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_as_cancelled_with_a_readable_folder(
    tmp_path: Path, shell: SimpleNamespace, number: signal.Signals
) -> None:
    prompt = 'A drone hovers at 20 meters over the ego car for 300 seconds.'
    process = subprocess.Popen(
        [sys.executable, '-c', MAIN, 'run', prompt, '--json'],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ,
    )
    assert process.stderr is not None
    deadline = time.monotonic() + 60.0
    for line in process.stderr:
        assert time.monotonic() < deadline
        if b'execute' in line:
            break
    process.send_signal(number)
    answer, told = process.communicate(timeout=60)
    report = json.loads(answer)
    assert process.returncode == 130, (report['status'], report['error'], told)
    assert report['status'] == 'cancelled'
    folder = tmp_path / 'runs' / report['run_id']
    assert json.loads((folder / 'report.json').read_text()) == report


def test_an_action_that_nobody_carries_out_yet_ends_incomplete(
    here: Path, call: Callable[..., SimpleNamespace]
) -> None:
    prompt = (
        'A drone tracks the bicycle for 5 s. When the bicycle rides faster than 1 m/s it changes '
        'lane.'
    )
    done = call('run', prompt, '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (3, 'incomplete'), (report['error'], done.err)
