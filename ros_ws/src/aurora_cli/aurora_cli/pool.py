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
import math
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Generator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, Generic, Protocol, TypeVar

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

    default_component = 'workers'


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
    task: int | None = None
    is_ready: bool = False  # False: it prepares itself


class Pool(Generic[T, R]):
    """Workers that are given tasks one by one.

    Nothing happens beside the caller: a worker that is done gets its next task in `look`.

    Args:
        work: What is done.
        jobs: Most workers at a time.
        limit_s: Wall seconds that a task may take.
        clock: Steady seconds.
    """

    def __init__(
        self,
        work: Work[T, R],
        *,
        jobs: int,
        limit_s: float,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._work = work
        self._jobs = jobs
        self._limit_s = limit_s
        self._clock = clock
        self._workers: list[_Worker] = []
        self._waiting: deque[tuple[int, T]] = deque()
        self._started = 0
        self._given = 0

    @property
    def is_idle(self) -> bool:
        """Whether no task is waiting or in work."""
        return not self._waiting and all(w.task is None for w in self._workers)

    @property
    def room(self) -> int:
        """How many tasks would wait for no other one."""
        busy = sum(w.task is not None for w in self._workers)
        return max(0, self._jobs - busy - len(self._waiting))

    def warm(self) -> None:
        """Start all workers, before there are tasks."""
        while len(self._workers) < self._jobs:
            self._start()

    def give(self, task: T) -> int:
        """Take a picklable task and return its number, from 0 on."""
        self._waiting.append((self._given, task))
        self._given += 1
        self._hand_out()
        return self._given - 1

    def look(self, timeout_s: float | None = None) -> list[tuple[int, R | Lost]]:
        """Return number and result of what has ended; wait for it so long at most.

        Raises:
            PoolError: A worker could not prepare itself.
        """
        # Nobody is started for tasks that those who prepare themselves will take.
        preparing = sum(not w.is_ready for w in self._workers)
        while len(self._workers) < self._jobs and preparing < len(self._waiting):
            self._start()
            preparing += 1
        ended: list[tuple[int, R | Lost]] = []
        for worker in _ready(self._workers, timeout_s, self._clock):
            answer = _answer(worker, self._limit_s, self._clock)
            if answer is None:
                continue
            kind, value = answer
            if not worker.is_ready and kind != 'ready':
                raise PoolError(f'worker {worker.number} cannot begin: {value}')
            index, worker.task = worker.task, None
            worker.is_ready, worker.deadline_s = True, math.inf
            if kind == 'lost':
                self._remove(worker)
            if index is not None:
                ended.append((index, value if kind == 'done' else Lost(why=value)))
        self._hand_out()
        return ended

    def drop(self, number: int) -> None:
        """Forget a task; the worker that does it is ended, and another one takes its place."""
        self._waiting = deque(row for row in self._waiting if row[0] != number)
        for worker in [w for w in self._workers if w.task == number]:
            self._remove(worker)
            self._start()

    def rest(self) -> None:
        """End the workers that have nothing to do."""
        if not self._waiting:
            for worker in [w for w in self._workers if w.is_ready and w.task is None]:
                self._remove(worker)

    def close(self) -> None:
        """End the workers at once, whatever they do."""
        for worker in tuple(self._workers):
            self._remove(worker)

    def _start(self) -> None:
        self._started += 1
        deadline_s = self._clock() + _PREPARE_LIMIT_S
        self._workers.append(_start(self._started, self._work, deadline_s))

    def _hand_out(self) -> None:
        for worker in self._workers:
            if not self._waiting:
                return
            if worker.is_ready and worker.task is None:
                worker.task, task = self._waiting.popleft()
                worker.deadline_s = self._clock() + self._limit_s
                _send(worker, task)

    def _remove(self, worker: _Worker) -> None:
        self._workers.remove(worker)
        _end(worker)


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
    with closing(Pool(work, jobs=jobs, limit_s=limit_s, clock=clock)) as pool:
        for task in tasks:
            pool.give(task)
        while not pool.is_idle:
            ended = pool.look()
            pool.rest()
            yield from ended


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


def _ready(
    workers: list[_Worker], timeout_s: float | None, clock: Callable[[], float]
) -> list[_Worker]:
    """Wait until a worker has something to say, has died or is late; return all such."""
    until_s = min((w.deadline_s for w in workers), default=clock())
    if timeout_s is not None:
        until_s = min(until_s, clock() + timeout_s)
    watched: list[Any] = [w.connection for w in workers]
    watched += [w.process.sentinel for w in workers]
    wait(watched, timeout=None if math.isinf(until_s) else max(0.0, until_s - clock()))
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
