# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one `main` of every node: start, serve, end with exit code 0 and without a traceback."""

from __future__ import annotations

import faulthandler
import gc
import os
import signal
import socket
import sys
import threading
import time
from collections.abc import Callable, Sequence
from enum import Enum
from pathlib import Path

import rclpy
from rclpy.executors import (
    Executor,
    ExternalShutdownException,
    MultiThreadedExecutor,
    SingleThreadedExecutor,
)
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import get_logger
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import try_shutdown

from aurora_core.errors import AuroraError
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.node import AuroraNode
from aurora_ros.waitset_executor import WaitSetExecutor, is_supported

READY_FILE_VARIABLE = 'AURORA_READY_FILE'

# How long a node may go on serving after a signal to bring a run to a proper end.
STOP_LIMIT_S = 2.5
# After this time a node that was told to end is ended, wherever it hangs.
_END_LIMIT_S = 8.0
_HUNG = 1  # exit code then: it did not end well
# A terminal that is closed sends SIGHUP; `nohup` has it ignored, and it stays so.
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_POLL_S = 0.02


class Spinning(Enum):
    """How a node's callbacks are run."""

    ONE_THREAD = 'one_thread'
    MANY_THREADS = 'many_threads'  # for nodes whose services block on other services


def run_node(
    create: Callable[[], AuroraNode | ManagedNode],
    *,
    spinning: Spinning = Spinning.ONE_THREAD,
    threads: int = 16,
    background: bool = False,
    arguments: Sequence[str] | None = None,
) -> int:
    """Create a node, serve until SIGINT, SIGTERM or SIGHUP, clean up.

    rclpy's own signal handlers end the context at once, and then nothing can be published or
    asked any more. So signals are taken by a thread, and the context ends last.

    While the node serves, the file named by `AURORA_READY_FILE` exists and holds its process id.

    Args:
        create: Makes the node; a `ManagedNode` starts itself unless its `autostart` is false.
        spinning: Kind of executor.
        threads: Threads of `MANY_THREADS`.
        background: For observers: whoever works on the next tick is never interrupted by what
            arrives here. No less computing time is given.
        arguments: Command line; None takes the process's own.

    Returns:
        Exit code: 0 after an ordinary end, 1 when the node could not start.
    """
    if background:
        # Before the middleware's threads are made: they inherit it.
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
    stop = _Stop()
    node: AuroraNode | ManagedNode | None = None
    executor: Executor | None = None
    ready: Path | None = None
    try:
        rclpy.init(
            args=list(arguments) if arguments is not None else sys.argv,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        node = create()
        executor = _executor(spinning, threads, node)
        executor.add_node(node)
        stop.wakes(executor)
        if isinstance(node, ManagedNode) and node.wants_autostart:
            node.autostart()
        # Only now: nobody publishes or asks while this thread still creates endpoints.
        node.serve_roll_call()
        node.heartbeat.start()
        # What start-up made stays: the garbage collector need not look at it again and again.
        gc.collect()
        gc.freeze()
        ready = stop.ready = _announce(node)
        _serve(node, executor, stop)
    except AuroraError as err:
        get_logger('aurora').fatal(f'{err.component}: {err}')
        return 1
    finally:
        if ready is not None:
            ready.unlink(missing_ok=True)
        if node is not None:
            node.destroy_node()
        if executor is not None:
            executor.shutdown(timeout_sec=1.0)
        try_shutdown()
    return 0


class _Stop:
    """Takes the signals of the process: the first asks for an end, the second enforces it.

    So does the time limit, after the log was told where every thread hangs.
    """

    def __init__(self) -> None:
        self.requested = False
        self.ready: Path | None = None
        self._executor: Executor | None = None
        # The main thread may be waiting inside the middleware, where a Python handler is not run.
        # The wake-up file is written by the C handler, at once.
        self._reader, self._writer = socket.socketpair()
        self._writer.setblocking(False)
        for number in _SIGNALS:
            if number == signal.SIGHUP and signal.getsignal(number) is signal.SIG_IGN:
                continue
            signal.signal(number, lambda _number, _frame: None)
        signal.set_wakeup_fd(self._writer.fileno())
        threading.Thread(target=self._wait, name='signals', daemon=True).start()

    def wakes(self, executor: Executor) -> None:
        """Wake this executor when a signal comes."""
        self._executor = executor
        if self.requested:
            self._wake()

    def _wait(self) -> None:
        self._next_signal()
        self.requested = True
        self._wake()
        self._reader.settimeout(_END_LIMIT_S)
        try:
            os._exit(128 + self._next_signal())
        except TimeoutError:
            sys.stderr.write(f'told to end {_END_LIMIT_S:g} s ago, cut off at:\n')
            sys.stderr.flush()
            faulthandler.dump_traceback(all_threads=True)
            if self.ready is not None:
                self.ready.unlink(missing_ok=True)
            os._exit(_HUNG)

    def _next_signal(self) -> int:
        while (number := self._reader.recv(1)[0]) not in _SIGNALS:
            pass
        return number

    def _wake(self) -> None:
        if self._executor is not None:
            # A task, since a bare wake-up does not end the stock executors' wait.
            self._executor.create_task(lambda: None)


def _serve(node: AuroraNode | ManagedNode, executor: Executor, stop: _Stop) -> None:
    """Run callbacks until a signal comes and what is under way has ended."""
    try:
        while executor.context.ok() and not stop.requested:
            executor.spin_once()
        node.request_stop()
        deadline = time.monotonic() + STOP_LIMIT_S
        while executor.context.ok() and not node.is_idle and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=_POLL_S)
    except ExternalShutdownException:
        return
    except rclpy_implementation.RCLError:
        # A callback that was under way when somebody ended the context could not publish.
        if executor.context.ok():
            raise


def _executor(spinning: Spinning, threads: int, node: AuroraNode | ManagedNode) -> Executor:
    if spinning is Spinning.MANY_THREADS:
        return MultiThreadedExecutor(num_threads=threads)
    if not is_supported():
        return SingleThreadedExecutor()
    return WaitSetExecutor(awaited=lambda: node.awaited)


def _announce(node: AuroraNode | ManagedNode) -> Path | None:
    """Write the ready file whole, so that a reader never sees it empty."""
    node.get_logger().info('ready')
    named = os.environ.get(READY_FILE_VARIABLE, '')
    if not named:
        return None
    path = Path(named)
    temporary = path.with_name(f'{path.name}.{os.getpid()}')
    temporary.write_text(f'{os.getpid()}\n', encoding='ascii')
    temporary.replace(path)
    return path
