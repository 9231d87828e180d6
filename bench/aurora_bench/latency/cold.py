# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A command in a process of its own: wall and CPU seconds from its start to its end."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.results import ResultsError
from aurora_core.document import Document

# What the simulator and the arrays need by themselves: the yardstick of the cold times.
IMPORTS = (sys.executable, '-c', 'import libsumo, numpy')
_ERROR_CHARACTERS = 400


class Spent(Document):
    """Time that something took.

    Attributes:
        wall_s: Seconds on the clock.
        cpu_s: User and system seconds, of a process with all its threads and children.
    """

    wall_s: float
    cpu_s: float


def aurora(arguments: Sequence[str]) -> tuple[str, ...]:
    """Return the command line of `aurora` in this environment."""
    return (sys.executable, '-c', 'from aurora_cli.main import main; main()', *arguments)


def timed(command: Sequence[str], folder: Path, accepted: Sequence[int] = (0,)) -> Spent:
    """Run a command to its end; what it prints is dropped.

    Args:
        command: Program and arguments.
        folder: Where it runs.
        accepted: Exit codes that are no failure.

    Raises:
        ResultsError: It ended with another exit code.
    """
    with tempfile.TemporaryFile() as printed:
        begin = time.perf_counter()
        # No shell: the prompt arrives as it is.
        process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=printed, stderr=printed
        )
        _, status, usage = os.wait4(process.pid, 0)
        wall_s = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in accepted:
            printed.seek(0)
            said = printed.read().decode(errors='replace')[-_ERROR_CHARACTERS:]
            raise ResultsError(f'{command[-2:]} ended with {process.returncode}: {said}')
    return Spent(wall_s=wall_s, cpu_s=usage.ru_utime + usage.ru_stime)
