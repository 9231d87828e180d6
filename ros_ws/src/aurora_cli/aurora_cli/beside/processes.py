# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Candidates on warm processes of this machine, which open no port."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass

from aurora_cli.beside.executing import Executing, leftovers
from aurora_cli.pool import Lost, Pool, PoolError
from aurora_core.pipeline.beside import Candidate, Recorded


class LocalProcesses:
    """`Beside` on this machine.

    Args:
        jobs: Processes.
        limit_s: Wall seconds that an execution may take.
    """

    def __init__(self, jobs: int, limit_s: float) -> None:
        self.places = jobs
        self._pool = Pool(Executing(os.getpid()), jobs=jobs, limit_s=limit_s)
        self._ended: dict[int, Recorded | Lost] = {}

    def prepare(self) -> None:
        """Start the processes."""
        self._pool.warm()

    def begin(self, candidate: Candidate) -> _Given | None:
        """Give a candidate to a process that has none; one that has died gets a successor."""
        self._look(0.0)
        self._pool.warm()
        return _Given(self, self._pool.give(candidate)) if self._pool.room else None

    def wait(self, number: int, seconds: float) -> Recorded | None:
        """Return what came of a task, None when it is not there after so long."""
        if number not in self._ended:
            self._look(seconds)
        found = self._ended.pop(number, None)
        if isinstance(found, Lost):
            raise PoolError(found.why)
        return found

    def drop(self, number: int) -> None:
        """End a task."""
        self._pool.drop(number)
        self._ended.pop(number, None)

    def close(self) -> None:
        """End the processes, and take away what they have left."""
        self._pool.close()
        for folder in leftovers(os.getpid()):
            shutil.rmtree(folder, ignore_errors=True)

    def _look(self, seconds: float) -> None:
        self._ended |= dict(self._pool.look(seconds))


@dataclass(frozen=True, slots=True)
class _Given:
    """A candidate in hand of a process."""

    processes: LocalProcesses
    number: int

    def wait(self, seconds: float) -> Recorded | None:
        """Return what was recorded; None when it is not there after so long."""
        return self.processes.wait(self.number, seconds)

    def drop(self) -> None:
        """End it."""
        self.processes.drop(self.number)
