# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where the runs of a campaign are done: workers of this machine, or those of a Dask scheduler.

Whoever is done first answers first. A run whose worker died or was late is tried once more; one
that is lost twice is quarantined by whoever asked.
"""

from __future__ import annotations

import faulthandler
from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from typing import Any, TypeVar

from aurora_bench.campaign.pool import Lost, PoolError, Work, run_tasks

LOCAL = 'local'
T = TypeVar('T')
R = TypeVar('R')
Answers = Generator[tuple[int, R | Lost], None, None]
Note = Callable[[str], None]


def on_pool(
    work: Work[T, R], tasks: Sequence[T], *, jobs: int, limit_s: float, note: Note
) -> Answers[R]:
    """Do tasks on processes of this machine, which open no port; yield index and result.

    Args:
        work: What is done.
        tasks: With what.
        jobs: Processes.
        limit_s: Wall seconds of one task.
        note: Told of a task that is tried again.
    """
    again: list[int] = []
    with closing(run_tasks(work, tasks, jobs=jobs, limit_s=limit_s)) as answers:
        for index, answer in answers:
            if isinstance(answer, Lost):
                note(f'run {index + 1} is tried again: {answer.why}')
                again.append(index)
            else:
                yield index, answer
    left = [tasks[index] for index in again]
    with closing(run_tasks(work, left, jobs=jobs, limit_s=limit_s)) as answers:
        for index, answer in answers:
            yield again[index], answer


def on_dask(
    work: Work[T, R], tasks: Sequence[T], *, address: str, jobs: int, limit_s: float
) -> Answers[R]:
    """Do tasks on Dask's workers; yield index and result.

    Dask gives the task of a worker that died to another one. A worker does one task at a time in a
    process of its own, since a simulator allows one simulation in a process: start them with
    `--nthreads 1`.

    Args:
        work: What is done.
        tasks: With what.
        address: Of a scheduler; `local` starts one here, for this campaign alone.
        jobs: Workers where it is started here.
        limit_s: Wall seconds of one task; its worker is ended by itself when they are over.

    Raises:
        PoolError: Nobody answers at the address, or a worker has several threads.
    """
    import dask
    from distributed import Client, LocalCluster, as_completed

    # As often as on the pool: it is tried once more.
    settings = {'distributed.scheduler.allowed-failures': 1}
    with dask.config.set(settings):
        cluster = None
        if address == LOCAL:
            cluster = LocalCluster(
                n_workers=jobs,
                threads_per_worker=1,
                host='127.0.0.1',
                dashboard_address=None,
            )
        try:
            client = Client(address if cluster is None else cluster)
        except (OSError, ValueError, TimeoutError) as err:
            raise PoolError(
                f'no scheduler answers at {address}: {err}', hint='start one with dask scheduler'
            ) from err
        try:
            threads = client.nthreads()
            if any(number != 1 for number in threads.values()):
                raise PoolError(
                    'a worker has several threads, and a simulator needs a process of its own',
                    hint='start them with dask worker ADDRESS --nthreads 1',
                )
            futures = {
                client.submit(_done, work, task, limit_s, pure=False): index
                for index, task in enumerate(tasks)
            }
            for future in as_completed(list(futures)):
                index = futures[future]
                if future.status == 'finished':
                    yield index, future.result()
                else:
                    err = future.exception()
                    yield index, Lost(why=f'{type(err).__name__}: {err}')
                future.release()
        finally:
            client.close()
            if cluster is not None:
                cluster.close()


def _done(work: Work[Any, Any], task: Any, limit_s: float) -> Any:
    """Do one task in a worker's process."""
    _prepare(work)
    faulthandler.dump_traceback_later(limit_s, exit=True)
    try:
        return work(task)
    finally:
        faulthandler.cancel_dump_traceback_later()


_prepared: list[str] = []


def _prepare(work: Work[Any, Any]) -> None:
    """Load what tasks need, once in each process."""
    if repr(work) not in _prepared:
        work.prepare()
        _prepared.append(repr(work))
