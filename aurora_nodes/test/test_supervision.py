# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The agreement with `up`: locks and notes."""

from __future__ import annotations

import fcntl
import time
from pathlib import Path

import pytest

from aurora_core.errors import BagError, ExecutionError, ParticipantSilentError, SimulatorError
from aurora_nodes.supervision import BUSY, Supervision, supervision_folder


def never() -> bool:
    return False


def made(folder: Path | None) -> Supervision:
    return Supervision(folder, supervised_s=30.0, alone_s=5.0)


def may_restart(folder: Path) -> bool:
    """Whether `up` would get its lock now."""
    with (folder / BUSY).open('a') as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True


def test_nothing_is_restarted_from_begin_to_end_of_a_run(tmp_path: Path) -> None:
    supervision = made(tmp_path)
    assert supervision.begin_run(time.monotonic() + 1.0, never)
    assert not may_restart(tmp_path)
    assert supervision.begin_run(time.monotonic() + 1.0, never), 'again: the lock is renewed'
    supervision.end_run()
    assert may_restart(tmp_path)
    supervision.end_run()


def test_no_run_begins_while_something_is_restarted(tmp_path: Path) -> None:
    supervision = made(tmp_path)
    with (tmp_path / BUSY).open('a') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert not supervision.begin_run(time.monotonic() - 1.0, never)
        assert not supervision.begin_run(time.monotonic() + 60.0, lambda: True)
    assert supervision.begin_run(time.monotonic() - 1.0, never)
    supervision.end_run()


@pytest.mark.parametrize(
    ('error', 'noted'),
    [
        (ParticipantSilentError('x', component='sync'), ['sync.silent']),
        (SimulatorError('x', component='uav_sim', code=421), ['uav_sim.silent']),
        (BagError('the disk is full', component='recorder'), []),
        (ParticipantSilentError('x', component='../sync'), []),
        (ParticipantSilentError('x', component='unknown'), []),
    ],
)
def test_only_silent_nodes_of_this_graph_are_noted(
    tmp_path: Path, error: ExecutionError, noted: list[str]
) -> None:
    for name in ('sync', 'uav_sim', 'recorder'):
        (tmp_path / f'{name}.pid').touch()
    made(tmp_path).note(error)
    assert [path.name for path in tmp_path.glob('*.silent')] == noted


def test_who_was_given_up_is_known(tmp_path: Path) -> None:
    (tmp_path / 'sync.failed').touch()
    assert made(tmp_path).has_given_up('sync')
    assert not made(tmp_path).has_given_up('recorder')


def test_without_a_supervisor_a_run_begins_and_nobody_is_waited_for_long() -> None:
    supervision = made(None)
    assert supervision.restart_s == 5.0
    assert supervision.begin_run(time.monotonic() - 1.0, never)
    supervision.note(ParticipantSilentError('x', component='sync'))
    assert not supervision.has_given_up('sync')
    supervision.end_run()


def test_a_folder_that_is_gone_is_told(tmp_path: Path) -> None:
    with pytest.raises(ExecutionError, match='cannot be opened') as caught:
        made(tmp_path / 'gone').begin_run(time.monotonic() + 1.0, never)
    assert 'start it again' in caught.value.hint


def test_the_folder_comes_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('AURORA_SUPERVISION_DIR', '/somewhere')
    assert supervision_folder() == Path('/somewhere')
    monkeypatch.setenv('AURORA_SUPERVISION_DIR', '')
    assert supervision_folder() is None
