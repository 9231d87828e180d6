# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Candidates of repair on several processes: the same run, and nothing is left of them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from aurora_cli.beside.executing import Executing
from aurora_cli.installed import installed
from aurora_core.errors import ConfigError
from aurora_core.knowledge.basis import Basis
from aurora_core.pipeline import functions
from aurora_core.pipeline.beside import Candidate
from aurora_core.pipeline.stages import RunRequest

MAIN = 'from aurora_cli.main import main; main()'
# Nowhere does a car get as fast: other places are tried in vain.
PROMPT = (
    'A scenario of 30 seconds. A drone tracks a car. When the car is faster than 24 m/s, the '
    'drone alerts the ego car.'
)
# There is a second to end it in.
LONG = PROMPT.replace('30', '90')
RUN_ID = '20260131T120000Z-0a1b2c'


def started(folder: Path, *options: str, prompt: str = PROMPT) -> subprocess.Popen[bytes]:
    """Start a run whose processes have a folder of their own for what is temporary."""
    (folder / 'temporary').mkdir(parents=True)
    return subprocess.Popen(
        [sys.executable, '-c', MAIN, 'run', prompt, '--repair', '2', '--json', *options],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, 'TMPDIR': str(folder / 'temporary')},
    )


def told(folder: Path, *options: str) -> dict[str, Any]:
    """Return what a report says of a run, without its name and what it took."""
    printed, _ = started(folder, *options).communicate(timeout=280)
    report = json.loads(printed)
    assert not list((folder / 'temporary').glob('aurora_*'))
    return {k: v for k, v in report.items() if k not in ('run_id', 'timing')}


@pytest.fixture(scope='module')
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """The run without any other process."""
    return told(tmp_path_factory.mktemp('alone'))


@pytest.mark.parametrize('options', [('--jobs', '2'), ('--dask', 'local', '--jobs', '2')])
def test_other_processes_give_the_same_run(
    tmp_path: Path, alone: dict[str, Any], options: tuple[str, ...]
) -> None:
    assert [bag['bag'] for bag in alone['bags']] == ['bag.0', 'bag.1', 'bag.2']
    assert told(tmp_path / 'with', *options) == alone


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGKILL])
def test_what_ends_in_the_middle_leaves_nothing_of_what_was_executed_ahead(
    tmp_path: Path, number: signal.Signals
) -> None:
    process = started(tmp_path, '--jobs', '2', prompt=LONG)
    temporary = tmp_path / 'temporary'
    deadline = time.monotonic() + 240.0
    while not list(temporary.glob(f'aurora_beside_{process.pid}_*/*/bag.*/*.mcap')):
        assert time.monotonic() < deadline
        assert process.poll() is None
        time.sleep(0.005)
    workers = children(process.pid)
    assert workers
    process.send_signal(number)
    process.communicate(timeout=60)
    [run] = (tmp_path / 'runs').glob('*Z-*')
    # Whoever executes for a process that was killed sees it at the next tick.
    while any(alive(pid) for pid in workers) or list(temporary.glob('aurora_*')):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    names = {path.name for path in run.iterdir()}
    assert names >= {'prompt.txt', 'spec.0.json', 'bag.0', 'verdict.0.json'}
    assert not {name for name in names if name.startswith('.') or '.2' in name}
    if number is signal.SIGTERM:
        report = json.loads((run / 'report.json').read_text())
        assert report['status'] == 'cancelled'
        assert [bag['bag'] for bag in report['bags']] == ['bag.0']


def test_a_worker_with_another_configuration_executes_nothing() -> None:
    known = installed()
    parsed = functions.parse_stage(known, PROMPT, 'downtown', 1).agsg
    assert parsed is not None
    graph = functions.ground_stage(known, parsed, 1).agsg
    assert graph is not None
    other = Basis.model_validate({**known.basis.model_dump(), 'version': '0.0.1'})
    candidate = Candidate(
        graph=graph, request=RunRequest(prompt=PROMPT), run_id=RUN_ID, basis=other
    )
    with pytest.raises(ConfigError, match='another version or configuration'):
        Executing()(candidate)


def test_no_message_names_a_scheduler_to_a_graph(tmp_path: Path) -> None:
    """Whoever may start runs there may not make it run code of theirs."""
    process = started(tmp_path, '--dask', 'tcp://127.0.0.1:1', '--engine', 'ros')
    process.communicate(timeout=60)
    assert process.returncode == 64
    assert not (tmp_path / 'runs').exists()


def children(pid: int) -> list[int]:
    """Return the processes that a process has started."""
    text = Path(f'/proc/{pid}/task/{pid}/children').read_text()
    return [int(word) for word in text.split()]


def alive(pid: int) -> bool:
    """Tell whether a process is there and no zombie."""
    try:
        return Path(f'/proc/{pid}/stat').read_text().rsplit(')', 1)[1].split()[0] != 'Z'
    except OSError:
        return False
