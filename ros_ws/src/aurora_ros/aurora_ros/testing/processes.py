# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Node processes: started, awaited by their ready file, ended by a signal."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from aurora_ros.main import READY_FILE_VARIABLE

READY_LIMIT_S = 30.0
END_LIMIT_S = 10.0


class Process(Protocol):
    """What is asked of a process here; `subprocess.Popen` is one."""

    @property
    def pid(self) -> int:
        """Process id."""

    def poll(self) -> int | None:
        """Return the exit code, None while it runs."""

    def wait(self, timeout: float | None = None) -> int:
        """Wait for the end and return the exit code; subprocess.TimeoutExpired: it goes on."""

    def send_signal(self, sig: int) -> None:
        """Send a signal to a process that runs."""

    def kill(self) -> None:
        """End it."""


class NodeProcess:
    """A process that runs the `main` of a module.

    Args:
        module: e.g. `aurora_sync.node`.
        domain: ROS_DOMAIN_ID.
        folder: For the ready file and the log.
        arguments: Command line, e.g. `--ros-args -p silence_limit_s:=0.5`.
        environment: Added to this process's own.
    """

    def __init__(
        self,
        module: str,
        domain: int,
        folder: Path,
        arguments: Sequence[str] = (),
        environment: dict[str, str] | None = None,
    ) -> None:
        self.module = module
        self.ready_file = folder / f'{module}.ready'
        self._log = folder / f'{module}.log'
        own = {
            'ROS_DOMAIN_ID': str(domain),
            'ROS_LOG_DIR': str(folder / 'ros_log'),
            READY_FILE_VARIABLE: str(self.ready_file),
        }
        self._process = self._launch(arguments, {**os.environ, **own, **(environment or {})})

    def _launch(self, arguments: Sequence[str], environment: dict[str, str]) -> Process:
        """Start the process, its output going to the log."""
        code = f'import sys\nfrom {self.module} import main\nsys.exit(main())'
        with self._log.open('wb') as log:
            return subprocess.Popen(
                [sys.executable, '-c', code, *arguments],
                env=environment,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    @property
    def log(self) -> str:
        """What the process has printed."""
        return self._log.read_text(encoding='utf-8', errors='replace')

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    @property
    def has_ended(self) -> bool:
        """Whether it is over."""
        return self._process.poll() is not None

    def await_ready(self, limit_s: float = READY_LIMIT_S) -> None:
        """Wait for the ready file.

        Raises:
            AssertionError: The process ended or was not ready in time; with its log.
        """
        deadline = time.monotonic() + limit_s
        while not self.ready_file.exists():
            code = self._process.poll()
            if code is not None or time.monotonic() > deadline:
                raise AssertionError(f'{self.module} not ready (exit code {code}):\n{self.log}')
            time.sleep(0.02)

    def wait(self, limit_s: float = END_LIMIT_S) -> int:
        """Wait for the end and return the exit code.

        Raises:
            subprocess.TimeoutExpired: It goes on.
        """
        return self._process.wait(limit_s)

    def end(self, with_signal: int = signal.SIGTERM) -> int:
        """Send a signal and return the exit code."""
        self.send(with_signal)
        return self.wait()

    def send(self, with_signal: int) -> None:
        """Send a signal."""
        if self._process.poll() is None:
            self._process.send_signal(with_signal)

    def kill(self) -> None:
        """End it whatever it does."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()


@contextmanager
def nodes(*processes: NodeProcess) -> Iterator[None]:
    """Wait until all are ready; kill what is left of them at the end."""
    try:
        for process in processes:
            process.await_ready()
        yield
    finally:
        for process in processes:
            process.kill()
