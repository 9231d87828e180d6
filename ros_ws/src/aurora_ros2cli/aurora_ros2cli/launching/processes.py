# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the processes of a launch file until they end or somebody ends them."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.launching.description import Command
from aurora_ros2cli.output import emit

# As `ros2 launch` waits after one signal before it sends the next.
_PATIENCE_S = 5.0
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
_LOOK_S = 0.1


class _Running:
    """A process, and the thread that passes its lines on."""

    def __init__(self, command: Command, number: int) -> None:
        self.command = command
        self.name = f'{command.name}-{number}'
        self.told = False
        try:
            # In a session of its own: Ctrl-C of the terminal reaches it through us alone.
            self.process = subprocess.Popen(
                command.words,
                cwd=command.folder,
                env={**os.environ, **command.environment},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError as err:
            raise CliError(f'{command.words[0]}: {err.strerror}') from err
        emit(f'[INFO] [{self.name}]: process started with pid [{self.process.pid}]')
        self._reader = threading.Thread(target=self._pass_on, daemon=True)
        self._reader.start()

    def _pass_on(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            emit(f'[{self.name}] {line.decode(errors="replace").rstrip()}')

    def send(self, number: signal.Signals) -> None:
        """Signal it and whatever it started."""
        with suppress(ProcessLookupError):
            os.killpg(self.process.pid, number)

    def ended(self, *, asked: bool) -> bool:
        """Tell whether it has ended; the first time say how."""
        code = self.process.poll()
        if code is None:
            return False
        if not self.told:
            self.told = True
            # Its last lines come before the word about its end, unless a child holds the pipe.
            self._reader.join(_LOOK_S * 5)
            self._say_end(code, asked=asked)
        return True

    def _say_end(self, code: int, *, asked: bool) -> None:
        pid = self.process.pid
        if code == 0 or (asked and code in (-signal.SIGINT, -signal.SIGTERM)):
            emit(f'[INFO] [{self.name}]: process has finished cleanly [pid {pid}]')
            return
        words = shlex.join(self.command.words)
        emit(
            f'[ERROR] [{self.name}]: process has died '
            f"[pid {pid}, exit code {code}, cmd '{words}']."
        )


def run_all(commands: Sequence[Command]) -> None:
    """Start processes and return when all have ended; Ctrl-C or SIGTERM ends them.

    Raises:
        CliError: One cannot be started; those before it are ended.
    """
    running: list[_Running] = []
    with _asked_to_stop() as stop:
        try:
            for number, command in enumerate(commands, start=1):
                running.append(_Running(command, number))
            while not stop.is_set():
                ended = [one.ended(asked=False) for one in running]
                if all(ended):
                    return
                if any(e and one.command.ends_all for e, one in zip(ended, running, strict=True)):
                    break
                stop.wait(_LOOK_S)
            else:
                emit('[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)')
        finally:
            _end(running)


def _end(running: Sequence[_Running]) -> None:
    """End what still runs, the last one started first; harder each time that patience is over."""
    for k, number in enumerate(_SIGNALS):
        left = [one for one in reversed(running) if not one.ended(asked=True)]
        for one in left:
            if k:
                emit(
                    f'[ERROR] [{one.name}]: process[{one.name}] failed to terminate '
                    f"'{_PATIENCE_S:g}' seconds after receiving '{_SIGNALS[k - 1].name}', "
                    f"escalating to '{number.name}'"
                )
            one.send(number)
        end_s = time.monotonic() + _PATIENCE_S
        while left and time.monotonic() < end_s:
            left = [one for one in left if not one.ended(asked=True)]
            time.sleep(0.0 if not left else _LOOK_S / 5)


@contextmanager
def _asked_to_stop() -> Iterator[threading.Event]:
    """Yield what Ctrl-C and SIGTERM set."""
    stop = threading.Event()

    def note(_number: int, _frame: FrameType | None) -> None:
        stop.set()

    before = {number: signal.signal(number, note) for number in _SIGNALS[:2]}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
