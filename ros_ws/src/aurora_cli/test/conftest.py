# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One real run of the local engine, made once, for the commands that read runs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from run_folders import copied, made

from aurora_cli.main import run_command_line

# Short, and room for a second one that hovers at 30 m.
PROMPT = 'A scenario of 40 seconds. A drone hovers at 20 meters over the ego car for 5 seconds.'


def aurora(
    *arguments: str | bytes, cwd: Path, stdin: bytes = b''
) -> subprocess.CompletedProcess[bytes]:
    """Call the command in a process of its own, as a shell would."""
    return subprocess.run(
        [sys.executable, '-c', 'from aurora_cli.main import main; main()', *arguments],
        input=stdin,
        cwd=cwd,
        capture_output=True,
        timeout=120,
        check=False,
    )


@pytest.fixture(scope='session', autouse=True)
def _no_maps_of_the_user(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Imported maps of whoever runs the tests are none of theirs; what is imported goes here."""
    before = os.environ.get('AURORA_MAPS')
    folder = tmp_path_factory.mktemp('maps')
    os.environ['AURORA_MAPS'] = str(folder)
    yield folder
    if before is None:
        del os.environ['AURORA_MAPS']
    else:
        os.environ['AURORA_MAPS'] = before


@pytest.fixture(scope='session')
def shell() -> SimpleNamespace:
    """Call the command."""
    return SimpleNamespace(aurora=aurora, prompt=PROMPT)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder that is the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Callable[..., SimpleNamespace]:
    """Call the command in this process (a process of its own costs a second of imports)."""

    def called(*arguments: str) -> SimpleNamespace:
        code = run_command_line(list(arguments))
        captured = capsys.readouterr()
        return SimpleNamespace(code=code, out=captured.out, err=captured.err)

    return called


@pytest.fixture(scope='session')
def finished(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A verified run: its folder and its report as `--json` gave it."""
    home = tmp_path_factory.mktemp('home')
    done = aurora('run', PROMPT, '--json', cwd=home)
    report = json.loads(done.stdout)
    folder = home / 'runs' / report['run_id']
    return SimpleNamespace(home=home, folder=folder, report=report, process=done)


@pytest.fixture(scope='session')
def failed(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A violated run of the same prompt, map and seed."""
    fault = '{"kind": "target_removed", "subject": "ego", "at_s": 3.0}'
    return made(finished, shell.prompt, '--fault', fault, status='violated')


@pytest.fixture(scope='session')
def other_seed(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A verified run of the same prompt with another seed."""
    return made(finished, shell.prompt, '--seed', '2')


@pytest.fixture(scope='session')
def other_prompt(finished: SimpleNamespace, shell: SimpleNamespace) -> Path:
    """A verified run of another prompt."""
    return made(finished, shell.prompt.replace('20 meters', '30 meters'))


@pytest.fixture
def run(here: Path, finished: SimpleNamespace) -> Path:
    """A copy of the verified run."""
    return copied(here, finished.folder)
