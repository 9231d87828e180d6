# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of a campaign on the workers of a Dask scheduler, here or on other machines."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import Any, TypeVar

from distributed import Client, as_completed

from aurora_bench.campaign.pooled import Answers, Note
from aurora_cli.dask_client import dask_client, do_task
from aurora_cli.pool import Lost, Work

T = TypeVar('T')
R = TypeVar('R')


def on_dask(
    work: Work[T, R], tasks: Sequence[T], *, address: str, jobs: int, limit_s: float, note: Note
) -> Answers[R]:
    """Do tasks on Dask's workers; yield index and result.

    A worker does one task at a time in a process of its own, since a simulator allows one
    simulation in a process: start them with `--nthreads 1`. No more tasks are given away than
    there are workers: with a worker that dies, Dask loses all that it was given and all that it
    still holds. Tasks that are lost are tried again one by one, so that none pays for another.

    Args:
        work: What is done.
        tasks: With what.
        address: Of a scheduler; `local` starts one here, for this campaign alone.
        jobs: Workers where it is started here.
        limit_s: Wall seconds of one task; its worker is ended by itself when they are over.
        note: Told of a task that is tried again.

    Raises:
        PoolError: Nobody answers at the address, or a worker has several threads.
    """
    with dask_client(address, jobs) as client:
        again: list[int] = []
        for index, answer in _given_away(client, work, tasks, range(len(tasks)), limit_s):
            if isinstance(answer, Lost):
                note(f'run {index + 1} is tried again: {answer.why}')
                again.append(index)
            else:
                yield index, answer
        for index in again:
            yield from _given_away(client, work, tasks, [index], limit_s)


def _given_away(
    client: Client, work: Work[T, R], tasks: Sequence[T], wanted: Sequence[int], limit_s: float
) -> Answers[R]:
    """Do some of the tasks, as many at a time as there are workers."""
    waiting = deque(wanted)
    running: dict[Any, int] = {}
    finished = as_completed()

    def give() -> None:
        while waiting and len(running) < max(1, len(client.nthreads())):
            index = waiting.popleft()
            future = client.submit(do_task, work, tasks[index], limit_s, pure=False)
            running[future] = index
            finished.add(future)

    give()
    for future in finished:
        index = running.pop(future)
        try:
            yield index, future.result()
        except Exception as err:  # noqa: BLE001  (whatever a task raised is a task that is lost)
            yield index, Lost(why=f'{type(err).__name__}: {err}')
        future.release()
        give()
