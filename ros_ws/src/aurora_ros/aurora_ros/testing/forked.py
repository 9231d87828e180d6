# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Node processes that need not import again what all of them import.

A node of a test is forked off a process that has imported the libraries and has done nothing with
them: no thread, no middleware. What it runs is the same; only the interpreter's own start and end
are not, which `NodeProcess` has (`test_every_node_ends` starts each node that way).
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from importlib import import_module
from multiprocessing.context import ForkServerContext
from multiprocessing.process import BaseProcess
from pathlib import Path

from aurora_ros.testing.processes import NodeProcess, Process


def _context() -> ForkServerContext:
    context = multiprocessing.get_context('forkserver')
    # By name, as it is above this package; without it each node imports its own.
    context.set_forkserver_preload(['aurora_nodes.imported'])
    return context


_CONTEXT = _context()


class ForkedNode(NodeProcess):
    """A `NodeProcess` that starts in a fifth of the time."""

    def _launch(self, arguments: Sequence[str], environment: dict[str, str]) -> Process:
        return _Forked(self.module, arguments, environment, self._log)


class _Forked:
    """A forked process with the words of `subprocess.Popen`."""

    def __init__(
        self, module: str, arguments: Sequence[str], environment: dict[str, str], log: Path
    ) -> None:
        log.touch()
        # A daemon: it ends with the tests, whatever they forget.
        self._process: BaseProcess = _CONTEXT.Process(
            target=_become,
            args=(module, tuple(arguments), environment, log, Path.cwd()),
            daemon=True,
        )
        self._process.start()

    @property
    def pid(self) -> int:
        pid = self._process.pid
        assert pid is not None
        return pid

    def poll(self) -> int | None:
        return self._process.exitcode

    def wait(self, timeout: float | None = None) -> int:
        self._process.join(timeout)
        code = self._process.exitcode
        if code is None:
            raise subprocess.TimeoutExpired(str(self._process), timeout or 0.0)
        return code

    def send_signal(self, sig: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, sig)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)


def _become(
    module: str,
    arguments: tuple[str, ...],
    environment: dict[str, str],
    log: Path,
    folder: Path,
) -> None:
    """Be the node: what `python -c` with its `main` would do, in a session of its own."""
    os.setsid()
    # To itself it is none: a node may have children of its own.
    multiprocessing.current_process().daemon = False
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    with log.open('wb') as stream:
        os.dup2(stream.fileno(), sys.stdout.fileno())
        os.dup2(stream.fileno(), sys.stderr.fileno())
    sys.argv = ['-c', *arguments]
    sys.exit(import_module(module).main())
