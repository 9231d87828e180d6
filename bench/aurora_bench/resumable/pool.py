# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Worker processes that stay warm: each imports and loads once, then does task after task.

The workers are spawned, not forked: a simulator allows one simulation per process, and threads of
libraries do not survive a fork. What a task gives must depend on nothing but the task, so the
number of workers and the order in which they answer change no result.

A worker that dies or does not answer in time is named, its task is `Lost`, and another one takes
its place.
"""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Generator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, Protocol, TypeVar

from aurora_core.document import Document
from aurora_core.errors import AuroraError

# Loading takes seconds; a machine with much other work gets time.
_PREPARE_LIMIT_S = 300.0
T = TypeVar('T')
R = TypeVar('R')
_Task = TypeVar('_Task', contravariant=True)
_Result = TypeVar('_Result', covariant=True)
_SPAWN = multiprocessing.get_context('spawn')


class PoolError(AuroraError):
    """The workers cannot begin."""

    default_component = 'bench'


class Lost(Document):
    """A task without a result.

    Attributes:
        why: That its worker died, took too long, or what it raised.
    """

    why: str


class Work(Protocol[_Task, _Result]):
    """What is done with every task. It is sent to each worker, so it has to be picklable."""

    def prepare(self) -> None:
        """Import and load what all tasks need; called once in each worker."""

    def __call__(self, task: _Task, /) -> _Result:
        """Do one task."""


@dataclass(slots=True)
class _Worker:
    number: int
    process: BaseProcess
    connection: Connection
    deadline_s: float
    task: int | None = None  # None: it prepares itself


def run_tasks(
    work: Work[T, R],
    tasks: Sequence[T],
    *,
    jobs: int,
    limit_s: float,
    clock: Callable[[], float] = time.monotonic,
) -> Generator[tuple[int, R | Lost], None, None]:
    """Do all tasks; yield the index and the result of each as it ends, in any order.

    Closing the generator ends the workers at once. Who may be interrupted while it looks at a
    result does so with `contextlib.closing`: else they work on until the generator is collected.

    Args:
        work: What is done.
        tasks: Picklable.
        jobs: Most workers at a time.
        limit_s: Wall seconds that a task may take.
        clock: Steady seconds.

    Raises:
        PoolError: A worker could not prepare itself.
    """
    waiting = deque(range(len(tasks)))
    workers: list[_Worker] = []
    started = 0
    try:
        while waiting or any(w.task is not None for w in workers):
            # Nobody is started for tasks that those who prepare themselves will take.
            preparing = sum(w.task is None for w in workers)
            while len(workers) < jobs and preparing < len(waiting):
                started += 1
                preparing += 1
                workers.append(_start(started, work, clock() + _PREPARE_LIMIT_S))
            for worker in _ready(workers, clock):
                answer = _answer(worker, limit_s, clock)
                if answer is None:
                    continue
                kind, value = answer
                index, worker.task = worker.task, None
                if index is None and kind != 'ready':
                    raise PoolError(f'worker {worker.number} cannot begin: {value}')
                if kind != 'lost' and waiting:
                    worker.task = waiting.popleft()
                    worker.deadline_s = clock() + limit_s
                    _send(worker, tasks[worker.task])
                else:
                    workers.remove(worker)
                    _end(worker)
                if index is not None:
                    yield index, value if kind == 'done' else Lost(why=value)
    finally:
        for worker in workers:
            _end(worker)


def _start(number: int, work: Work[Any, Any], deadline_s: float) -> _Worker:
    ours, theirs = _SPAWN.Pipe()
    process = _SPAWN.Process(target=_serve, args=(theirs, work), name=f'worker {number}')
    # Ctrl-C goes to the whole group of processes; it is ours alone to act on. A blocked signal
    # stays blocked in the child, and one that comes meanwhile is delivered to us afterwards.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        process.start()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    theirs.close()
    return _Worker(number, process, ours, deadline_s)


def _send(worker: _Worker, task: object) -> None:
    # Who has died meanwhile is found by its sentinel.
    with suppress(BrokenPipeError, ConnectionResetError):
        worker.connection.send(task)


def _ready(workers: list[_Worker], clock: Callable[[], float]) -> list[_Worker]:
    """Wait until a worker has something to say, has died or is late; return all such."""
    until_s = min((w.deadline_s for w in workers), default=clock())
    watched: list[Any] = [w.connection for w in workers]
    watched += [w.process.sentinel for w in workers]
    wait(watched, timeout=max(0.0, until_s - clock()))
    now_s = clock()
    return [
        w
        for w in workers
        if w.connection.poll() or not w.process.is_alive() or now_s >= w.deadline_s
    ]


def _answer(worker: _Worker, limit_s: float, clock: Callable[[], float]) -> tuple[str, Any] | None:
    """Return what a worker says: ready, done, raised or lost, with a value."""
    try:
        if worker.connection.poll():
            kind, value = worker.connection.recv()
            return str(kind), value
    except (EOFError, ConnectionResetError):
        pass
    else:
        if worker.process.is_alive() and clock() >= worker.deadline_s:
            return 'lost', f'worker {worker.number}: no answer within {limit_s:g} s'
        if worker.process.is_alive():
            return None
    worker.process.join(timeout=5.0)
    return 'lost', f'worker {worker.number} died{_how(worker.process.exitcode)}'


def _how(code: int | None) -> str:
    if code is None:
        return ''
    if code >= 0:
        return f' with exit code {code}'
    try:
        return f' of {signal.Signals(-code).name}'
    except ValueError:
        return f' of signal {-code}'


def _end(worker: _Worker) -> None:
    worker.connection.close()
    # What it has is in our hands or lost; it owns nothing that it would have to put in order.
    worker.process.kill()
    worker.process.join()


def _serve(connection: Connection, work: Work[Any, Any]) -> None:
    """Do tasks until nobody sends any (in the worker's process)."""
    faulthandler.enable()
    sys.stdout.flush()
    os.dup2(sys.stderr.fileno(), 1)  # what libraries print is no result
    try:
        work.prepare()
    except Exception as err:  # noqa: BLE001  (told to the parent, which ends the campaign)
        connection.send(('raised', _told(err)))
        return
    connection.send(('ready', None))
    while True:
        try:
            task = connection.recv()
        except (EOFError, ConnectionResetError):
            return
        try:
            answer = ('done', work(task))
        except Exception as err:  # noqa: BLE001  (one task that breaks must not end the others)
            answer = ('raised', _told(err))
        with suppress(BrokenPipeError):
            connection.send(answer)


def _told(err: Exception) -> str:
    return f'{type(err).__name__}: {err}'
