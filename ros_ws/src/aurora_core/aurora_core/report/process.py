# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which process writes a run, and whether it still lives."""

from __future__ import annotations

import os
from pathlib import Path

from aurora_core.document import Document


class ProcessIdentity(Document):
    """A process of one machine.

    Attributes:
        host: Name of the machine.
        pid: Process id.
        started: Start of the process in ticks since boot with the boot id ('' where the system
            does not tell): a process id alone is used again.
    """

    host: str
    pid: int
    started: str = ''


def this_process() -> ProcessIdentity:
    """Return the identity of the calling process."""
    pid = os.getpid()
    return ProcessIdentity(host=os.uname().nodename, pid=pid, started=_started(pid))


def process_lives(identity: ProcessIdentity) -> bool:
    """Tell whether a process may still live; one of another machine always may."""
    if identity.host != os.uname().nodename:
        return True
    try:
        os.kill(identity.pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return not identity.started or _started(identity.pid) == identity.started


def _started(pid: int) -> str:
    try:
        stat = Path(f'/proc/{pid}/stat').read_text(encoding='utf-8', errors='replace')
        boot = Path('/proc/sys/kernel/random/boot_id').read_text(encoding='ascii').strip()
    except OSError:
        return ''
    # The name in parentheses may hold blanks; the start time is the 20th field after it.
    fields = stat.rpartition(')')[2].split()
    return f'{boot}/{fields[19]}' if len(fields) > 19 else ''
