# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the kernel says of another process of this machine: the surest sign of life."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cache
from pathlib import Path

_ENDED = ('Z', 'X', 'x')
_STOPPED = ('T', 't')


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcessState:
    """A process at one moment.

    Attributes:
        started: Start in ticks since boot; a process id alone is used again.
        stopped: By SIGSTOP or a debugger.
    """

    started: int
    stopped: bool


@cache
def pid_space() -> str:
    """Return what two processes have in common that can look at each other by process id.

    Empty where the system does not tell.
    """
    try:
        boot = Path('/proc/sys/kernel/random/boot_id').read_text(encoding='ascii').strip()
        return f'{boot}/{os.readlink("/proc/self/ns/pid")}'
    except OSError:
        return ''


def process_state(pid: int) -> ProcessState | None:
    """Return the state of a process, None when it has ended (also if nobody has waited for it)."""
    try:
        stat = Path(f'/proc/{pid}/stat').read_bytes()
    except OSError:
        return None
    # The name in parentheses may hold anything; the state follows it, then 18 fields, the start.
    fields = stat.rpartition(b')')[2].split()
    state = fields[0].decode('ascii')
    if state in _ENDED:
        return None
    return ProcessState(started=int(fields[19]), stopped=state in _STOPPED)


def is_dumping_core(pid: int) -> bool:
    """Return whether a process has crashed and the kernel is still writing its memory to a file.

    That takes seconds for a large process, in which it still looks alive otherwise.
    """
    try:
        return b'\nCoreDumping:\t1' in Path(f'/proc/{pid}/status').read_bytes()
    except OSError:
        return False
