# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The queue of runs: order, bound, cancel, errors."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.pipeline.stages import RunRequest
from aurora_nodes.jobs import FINISHED, QUEUED, RUNNING, Job, JobQueue

LIMIT_S = 5.0


def wait_until(is_true: Callable[[], bool], limit_s: float) -> bool:
    deadline = time.monotonic() + limit_s
    while not is_true() and time.monotonic() < deadline:
        time.sleep(0.005)
    return is_true()


class Work:
    """Holds each job until it is let go."""

    def __init__(self) -> None:
        self.begun = threading.Semaphore(0)
        self.may_end = threading.Semaphore(0)
        self.order: list[str] = []
        self.error: Exception | None = None

    def __call__(self, job: Job) -> None:
        self.order.append(job.run_id)
        self.begun.release()
        if job.cancel.is_set():  # as the pipeline does: it ends before the first stage
            job.status = 'cancelled'
            return
        assert self.may_end.acquire(timeout=LIMIT_S)
        if self.error is not None:
            raise self.error
        job.status = 'cancelled' if job.cancel.is_set() else 'verified'


def job(run_id: str) -> Job:
    return Job(run_id=run_id, request=RunRequest(prompt=run_id), root=Path('/runs'))


@pytest.fixture
def work() -> Work:
    return Work()


@pytest.fixture
def queue(work: Work) -> Iterator[JobQueue]:
    made = JobQueue(work, most_waiting=2)
    yield made
    for _ in range(10):
        work.may_end.release()
    made.close()
    assert wait_until(lambda: made.is_over, LIMIT_S)


def test_jobs_run_one_after_another_in_order(queue: JobQueue, work: Work) -> None:
    jobs = [job(name) for name in 'abc']
    queue.submit(jobs[0])
    assert work.begun.acquire(timeout=LIMIT_S)
    queue.submit(jobs[1])
    queue.submit(jobs[2])
    assert [j.state for j in jobs] == [RUNNING, QUEUED, QUEUED]
    for _ in jobs:
        work.may_end.release()
    assert all(j.done.wait(LIMIT_S) for j in jobs)
    assert work.order == ['a', 'b', 'c']
    assert [j.state for j in jobs] == [FINISHED] * 3
    assert [j.run_id for j in queue.newest()] == ['c', 'b', 'a']
    assert [j.run_id for j in queue.newest(1)] == ['c']
    assert queue.get('b') is jobs[1]
    assert queue.get('x') is None
    assert jobs[0].run_dir == Path('/runs/a')


def test_the_line_is_bounded(queue: JobQueue, work: Work) -> None:
    queue.submit(job('a'))
    assert work.begun.acquire(timeout=LIMIT_S)
    queue.submit(job('b'))
    queue.submit(job('c'))
    with pytest.raises(ExecutionError, match='2 runs are waiting'):
        queue.submit(job('d'))
    assert queue.get('d') is None


@pytest.mark.parametrize('error', [ExecutionError('sumo died'), ValueError('a defect')])
def test_an_error_ends_the_job_and_not_the_queue(
    queue: JobQueue, work: Work, error: Exception
) -> None:
    work.error = error
    first, second = job('a'), job('b')
    queue.submit(first)
    work.may_end.release()
    assert first.done.wait(LIMIT_S)
    assert first.status == 'error'
    assert isinstance(first.error, AuroraError)
    assert str(error) in str(first.error)
    work.error = None
    queue.submit(second)
    work.may_end.release()
    assert second.done.wait(LIMIT_S)
    assert second.status == 'verified'


def test_close_cancels_what_runs_and_what_waits(work: Work) -> None:
    queue = JobQueue(work, most_waiting=5)
    jobs = [job(name) for name in 'ab']
    for each in jobs:
        queue.submit(each)
    assert work.begun.acquire(timeout=LIMIT_S)
    work.may_end.release()
    work.may_end.release()
    queue.close()
    assert wait_until(lambda: queue.is_over, LIMIT_S)
    with pytest.raises(ExecutionError, match='shutting down'):
        queue.submit(job('c'))
    assert all(each.done.is_set() for each in jobs)
    assert jobs[1].status == 'cancelled'


def test_old_finished_jobs_are_forgotten_and_waiting_ones_never() -> None:
    done = threading.Event()
    queue = JobQueue(lambda _job: done.set(), most_waiting=50, most_kept=3)
    for name in 'abcdefg':
        each = job(name)
        queue.submit(each)
        assert each.done.wait(LIMIT_S)
    assert len(queue.newest()) <= 4
    assert queue.newest()[0].run_id == 'g'
    queue.close()


def test_a_cancelled_job_in_line_ends_at_once_and_the_running_one_goes_on(
    queue: JobQueue, work: Work
) -> None:
    first, second, third = job('a'), job('b'), job('c')
    queue.submit(first)
    assert work.begun.acquire(timeout=LIMIT_S)
    queue.submit(second)
    queue.submit(third)
    queue.cancel(second)
    assert second.done.is_set()
    assert (second.state, second.status) == (FINISHED, 'cancelled')
    assert (first.state, third.state) == (RUNNING, QUEUED)
    work.may_end.release()
    work.may_end.release()
    assert third.done.wait(LIMIT_S)
    assert (first.status, third.status) == ('verified', 'verified')
    assert work.order == ['a', 'b', 'c']


def test_cancelling_the_running_job_only_asks_for_its_end(queue: JobQueue, work: Work) -> None:
    one = job('a')
    queue.submit(one)
    assert work.begun.acquire(timeout=LIMIT_S)
    queue.cancel(one)
    assert one.cancel.is_set()
    assert not one.done.is_set()
    work.may_end.release()
    assert one.done.wait(LIMIT_S)
    assert work.order == ['a']


def test_the_end_of_a_job_is_news(queue: JobQueue, work: Work) -> None:
    one = job('a')
    work.may_end.release()
    queue.submit(one)
    assert one.news.wait(LIMIT_S)
    assert one.done.is_set()
