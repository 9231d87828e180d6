# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A command that is cancelled or killed while it repairs leaves request, best run and its bag."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

MAIN = 'from aurora_cli.main import main; main()'
# Nowhere does a car get as fast: other places are tried in vain, each for a second or more.
PROMPT = (
    'A scenario of 90 seconds. A drone tracks a car. When the car is faster than 24 m/s, the '
    'drone alerts the ego car.'
)


def _signalled(folder: Path, number: signal.Signals) -> tuple[int, Path]:
    """Send a signal to a run that executes its third realisation."""
    process = subprocess.Popen(
        [sys.executable, '-c', MAIN, 'run', PROMPT, '--repair', '5', '--json'],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=os.environ,
    )
    deadline = time.monotonic() + 120.0
    while not list(folder.glob('runs/*/bag.2/*.mcap')):
        assert time.monotonic() < deadline
        assert process.poll() is None
        time.sleep(0.005)
    process.send_signal(number)
    process.wait(timeout=60)
    [run] = (folder / 'runs').glob('*Z-*')
    return process.returncode, run


def _rank(verdict: dict[str, Any]) -> tuple[int, float]:
    margins = [row['normalised'] for row in verdict['results'] if row['normalised'] is not None]
    return -sum(not row['satisfied'] for row in verdict['results']), min(margins)


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGKILL])
def test_what_ends_in_the_middle_of_a_repair_leaves_the_best_run_and_nothing_else(
    tmp_path: Path,
    shell: SimpleNamespace,
    call: Callable[..., SimpleNamespace],
    number: signal.Signals,
) -> None:
    code, run = _signalled(tmp_path, number)
    if number is signal.SIGKILL:
        # Nobody was left to tidy up: the next command does.
        assert code == -signal.SIGKILL
        assert 'closed the unfinished run' in shell.aurora('run', '', cwd=tmp_path).stderr.decode()
    names = {path.name for path in run.iterdir()}
    assert not {name for name in names if '.2' in name or name.startswith('.')}
    assert names >= {'prompt.txt', 'spec.0.json', 'bag.0', 'bag.1', 'verdict.1.json'}
    report = json.loads((run / 'report.json').read_text())
    assert report['status'] == ('error' if number is signal.SIGKILL else 'cancelled')
    assert [bag['bag'] for bag in report['bags']] == ['bag.0', 'bag.1']
    assert [repair['bag'] for repair in report['repairs']] == ['bag.1']
    ranks = [_rank(json.loads((run / f'verdict.{k}.json').read_text())) for k in (0, 1)]
    assert report['trace']['bag'] == f'bag.{ranks.index(max(ranks))}'
    for iteration in ('0', '1'):
        told = json.loads(call('verify', str(run), '--iteration', iteration, '--json').out)
        assert told['run']['doubts'] == [], iteration
        assert told['verdict']['status'] == 'violated'
