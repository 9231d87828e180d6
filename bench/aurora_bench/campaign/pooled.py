# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of a campaign on worker processes of this machine.

Whoever is done first answers first. A run whose worker died or was late is tried once more; one
that is lost twice is quarantined by whoever asked.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from typing import TypeVar

from aurora_cli.pool import Lost, Work, run_tasks

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
