# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""No file that a user names, and none that lies in a run folder, stops a command for ever."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

pytestmark = pytest.mark.timeout(60)

Call = Callable[..., SimpleNamespace]
HOVER = 'A drone hovers at 30 meters over the ego car.'


def pipe(path: Path) -> None:
    os.mkfifo(path)


def endless(path: Path) -> None:
    path.symlink_to('/dev/zero')


def huge(path: Path) -> None:
    with path.open('wb') as stream:
        stream.truncate(1 << 40)


KINDS = (pipe, endless, huge)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize('make', KINDS)
@pytest.mark.parametrize(
    ('command', 'code'),
    [
        (['verify', 'file.mcap'], 4),
        (['diff', 'file.mcap', 'file.mcap'], 4),
        (['picture', 'file.mcap', '-o', 'a.png'], 4),
        (['bag', 'recover', 'file.mcap'], 4),
        (['graph', 'file.json', '-o', 'a.json'], 4),
        (['certificate', 'check', 'file.json'], 4),
        (['check', '--prompt-file', 'file.json'], 64),
        (['run', '--prompt-file', 'file.json'], 64),
        (['check', HOVER, '--model', 'recorded:file.json'], 64),
    ],
    ids=lambda part: ' '.join(part) if isinstance(part, list) else None,
)
def test_a_named_file_without_end_is_refused(
    here: Path, call: Call, make: Callable[[Path], None], command: list[str], code: int
) -> None:
    make(here / 'file.mcap')
    make(here / 'file.json')
    done = call(*command)
    assert done.code == code, done
    assert 'defect' not in done.err + done.out


@pytest.mark.parametrize('make', KINDS)
@pytest.mark.parametrize('name', ['bag.0/metadata.yaml', 'bag.0/*.mcap', 'report.json'])
def test_a_run_with_a_file_without_end_is_never_verified_as_intact(
    here: Path,
    call: Call,
    finished: SimpleNamespace,
    make: Callable[[Path], None],
    name: str,
) -> None:
    run = here / 'run'
    shutil.copytree(finished.folder, run)
    for path in list(run.glob(name)):
        path.unlink()
        make(path)
    done = call('verify', str(run), '--json')
    assert done.code in (0, 4), done
    assert name == 'report.json' or done.code == 4
    assert 'defect' not in done.err + done.out


@pytest.mark.parametrize('make', KINDS)
@pytest.mark.parametrize('name', ['verdict.0.json', 'manifest.json', 'spec.0.json', 'agsg.0.json'])
def test_other_files_of_a_run_do_not_stop_the_commands_that_read_them(
    here: Path,
    call: Call,
    finished: SimpleNamespace,
    make: Callable[[Path], None],
    name: str,
) -> None:
    runs = here / 'runs'
    run = runs / finished.folder.name
    shutil.copytree(finished.folder, run)
    (run / name).unlink()
    make(run / name)
    if name == 'manifest.json':
        (run / 'report.json').unlink()
        assert call('doctor', '--json').code in (0, 1)
        assert call('run', '   ', '--json').code == 3  # looks for unfinished runs first
    for command in (['verify'], ['graph', '-o', 'graph.json'], ['picture', '-o', 'a.png']):
        done = call(command[0], str(run), *command[1:])
        assert done.code in (0, 4), done
        assert 'defect' not in done.err + done.out
