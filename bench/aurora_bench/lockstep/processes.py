# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""CPU time of processes, from /proc."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from aurora_bench.results import ResultsError

_TICKS_PER_S = os.sysconf('SC_CLK_TCK')
# Fields of /proc/PID/stat after the name, which may hold blanks and ends with a bracket.
_UTIME, _STIME = 11, 12


def cpu_s(pid: int, proc: Path = Path('/proc')) -> float:
    """Return user and system time of a process with all its threads, seconds.

    Raises:
        ResultsError: There is no such process.
    """
    try:
        text = (proc / str(pid) / 'stat').read_text(encoding='ascii', errors='replace')
    except OSError as err:
        raise ResultsError(f'process {pid} has ended while it was measured') from err
    fields = text.rpartition(')')[2].split()
    return (int(fields[_UTIME]) + int(fields[_STIME])) / _TICKS_PER_S


def cpu_by_name(pids: Mapping[str, int]) -> dict[str, float]:
    """Return the CPU time of each named process, seconds."""
    return {name: cpu_s(pid) for name, pid in pids.items()}
