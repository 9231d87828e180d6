# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the kernel says of real processes."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator

import pytest

from aurora_ros.processes import pid_space, process_state


@pytest.fixture
def child() -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    yield process
    process.kill()
    process.wait()


def test_a_living_process_is_told_from_a_stopped_and_an_ended_one(
    child: subprocess.Popen[bytes],
) -> None:
    living = process_state(child.pid)
    assert living is not None
    assert living.started > 0
    assert not living.stopped

    child.send_signal(signal.SIGSTOP)
    os.waitpid(child.pid, os.WUNTRACED)
    stopped = process_state(child.pid)
    assert stopped is not None
    assert stopped.stopped
    assert stopped.started == living.started

    child.kill()
    os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
    assert process_state(child.pid) is None, 'a zombie has ended'
    child.wait()
    assert process_state(child.pid) is None


def test_processes_of_one_machine_share_their_ids() -> None:
    code = 'from aurora_ros.processes import pid_space; print(pid_space())'
    other = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True
    )
    assert other.stdout.strip() == pid_space() != ''
