# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Progress lines, the one kind of failure, and running a long command with its log in a file."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

HEARTBEAT_S = 15.0
_START_S = time.monotonic()


class SetupError(Exception):
    """The set-up cannot go on; the message is one line that says what to do."""


def say(text: str) -> None:
    """Print one progress line with the seconds since the start."""
    sys.stdout.write(f'setup: [{time.monotonic() - _START_S:4.0f} s] {text}\n')
    sys.stdout.flush()


def run_logged(
    command: Sequence[str], log: Path, *, label: str, environment: Mapping[str, str] | None = None
) -> int:
    """Run a command with its output in a log file, and say every so often that it still runs.

    Args:
        command: Program and arguments.
        log: File that takes standard output and standard error; overwritten.
        label: What the heartbeat line says is going on.
        environment: Environment of the command; this process's own when absent.

    Returns:
        The exit code of the command.

    Raises:
        SetupError: If the program does not exist.
    """
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open('wb') as output:
        try:
            process = subprocess.Popen(
                list(command),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                env=dict(os.environ if environment is None else environment),
            )
        except FileNotFoundError as err:
            raise SetupError(f'{command[0]} is missing; install it and call again') from err
        try:
            while True:
                try:
                    return process.wait(timeout=HEARTBEAT_S)
                except subprocess.TimeoutExpired:
                    say(f'… {label}')
        except BaseException:
            # Ctrl-C reaches the child too (same process group); wait so that no half-written
            # file appears after this process has said that it stopped.
            process.terminate()
            process.wait()
            raise


def last_lines(log: Path, count: int = 6) -> str:
    """Return the last non-empty lines of a log, indented for a message."""
    lines = [line for line in log.read_text(errors='replace').splitlines() if line.strip()]
    return '\n'.join(f'    {line[:300]}' for line in lines[-count:])
