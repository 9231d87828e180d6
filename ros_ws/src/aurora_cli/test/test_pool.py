# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Workers stay warm, and one that is lost takes one task with it."""

from __future__ import annotations

import multiprocessing
from collections.abc import Sequence
from contextlib import closing
from typing import Any

import pytest
from pool_work import Squares

from aurora_cli.pool import Lost, Pool, PoolError, run_tasks

LIMIT_S = 60.0


def done(
    work: Any, tasks: Sequence[tuple[str, int]], jobs: int, limit_s: float = LIMIT_S
) -> tuple[dict[int, int | str], set[int]]:
    """Return by task the square or why there is none, and who answered."""
    found: dict[int, int | str] = {}
    workers = set()
    for index, answer in run_tasks(work, tasks, jobs=jobs, limit_s=limit_s):
        assert index not in found
        if isinstance(answer, Lost):
            found[index] = answer.why
        else:
            found[index] = answer[0]
            workers.add(answer[1])
    assert not multiprocessing.active_children()
    return found, workers


def test_any_number_of_workers_gives_the_same_and_each_does_many_tasks() -> None:
    tasks = [('', k) for k in range(12)]
    alone, one = done(Squares(), tasks, jobs=1)
    together, several = done(Squares(), tasks, jobs=3)
    assert alone == together == {k: k * k for k in range(12)}
    assert len(one) == 1
    assert 1 <= len(several) <= 3


@pytest.mark.parametrize(
    ('word', 'why'),
    [('exit', 'died with exit code 7'), ('crash', 'died of SIGKILL'), ('raise', 'cannot square')],
)
@pytest.mark.parametrize('jobs', [1, 2])
def test_a_lost_task_is_named_and_the_others_are_done(word: str, why: str, jobs: int) -> None:
    found, _ = done(Squares(), [('', 0), ('', 1), (word, 2), ('', 3), (word, 4)], jobs=jobs)
    assert why in str(found.pop(2))
    assert why in str(found.pop(4))
    assert found == {0: 0, 1: 1, 3: 9}


def test_a_worker_that_hangs_is_ended_and_replaced() -> None:
    found, workers = done(Squares(), [('', 3), ('hang', 0), ('', 5)], jobs=1, limit_s=3.0)
    assert 'no answer within 3 s' in str(found.pop(1))
    assert found == {0: 9, 2: 25}
    assert len(workers) == 2


def test_ctrl_c_of_the_terminal_does_not_reach_a_worker() -> None:
    assert done(Squares(), [('interrupt', 4)], jobs=1)[0] == {0: 16}


def test_workers_that_cannot_begin_end_the_campaign() -> None:
    with pytest.raises(PoolError, match='worker 1 cannot begin: RuntimeError: no simulator'):
        done(Squares('no simulator'), [('', 1), ('', 2)], jobs=1)
    assert not multiprocessing.active_children()


def test_what_a_worker_prints_is_no_answer(capfd: pytest.CaptureFixture[str]) -> None:
    done(Squares(), [('', 1)], jobs=1)
    printed = capfd.readouterr()
    assert (printed.out, 'loading' in printed.err) == ('', True)


def test_who_stops_listening_ends_the_workers() -> None:
    answers = run_tasks(Squares(), [('', 1), ('', 2), ('', 3)], jobs=2, limit_s=LIMIT_S)
    next(answers)
    assert multiprocessing.active_children()
    answers.close()
    assert not multiprocessing.active_children()


def test_a_task_that_is_dropped_makes_room_for_the_next() -> None:
    with closing(Pool(Squares(), jobs=1, limit_s=LIMIT_S)) as pool:
        pool.warm()
        # Who prepares itself takes a task as well.
        assert pool.room == 1
        assert pool.look(LIMIT_S) == []
        assert pool.room == 1
        hanging, waiting, wanted = (pool.give(task) for task in (('hang', 1), ('', 2), ('', 3)))
        assert pool.room == 0
        pool.drop(waiting)
        pool.drop(hanging)
        found: list[Any] = []
        while not pool.is_idle:
            found += pool.look(LIMIT_S)
        assert [(number, answer[0]) for number, answer in found] == [(wanted, 9)]
        assert pool.room == 1
    assert not multiprocessing.active_children()
