# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Candidates as tasks of Dask: on a local cluster, or past one machine."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

from aurora_cli.beside.executing import Executing
from aurora_cli.dask_client import dask_client, do_task, prepare
from aurora_cli.pool import PoolError
from aurora_core.pipeline.beside import Candidate, Recorded

_WORK = Executing()


class DaskWorkers:
    """`Beside` on the workers of a scheduler.

    An execution that nobody needs any more is not begun; one that is going on ends by itself.

    Args:
        address: Of a scheduler; `local` starts one here.
        jobs: Workers where it is started here.
        limit_s: Wall seconds that an execution may take.

    Raises:
        PoolError: Nobody answers at the address, a worker has several threads, or there is none.
    """

    def __init__(self, address: str, jobs: int, limit_s: float) -> None:
        self._stack = ExitStack()
        self._client = self._stack.enter_context(dask_client(address, jobs))
        self._limit_s = limit_s
        # Tasks that may still be in work: those that were dropped are, too.
        self._futures: list[Any] = []
        self._ready: list[Any] = []
        self.places = len(self._client.nthreads())
        if not self.places:
            self.close()
            raise PoolError(
                f'the scheduler at {address} has no worker',
                hint='start some with dask worker ADDRESS --nthreads 1',
            )

    def prepare(self) -> None:
        """Let every worker load what an execution needs."""
        self._ready = [
            self._client.submit(prepare, _WORK, workers=[worker], pure=False)
            for worker in self._client.nthreads()
        ]

    def begin(self, candidate: Candidate) -> _Given | None:
        """Give a candidate away when a worker has nothing to do."""
        self._futures = [future for future in self._futures if not future.done()]
        if len(self._futures) >= len(self._client.nthreads()):
            return None
        future = self._client.submit(do_task, _WORK, candidate, self._limit_s, pure=False)
        self._futures.append(future)
        return _Given(future)

    def close(self) -> None:
        """Leave the scheduler; one that was started here ends."""
        for future in (*self._ready, *self._futures):
            future.cancel()
        self._stack.close()


@dataclass(frozen=True, slots=True)
class _Given:
    """A candidate in hand of a worker."""

    future: Any

    def wait(self, seconds: float) -> Recorded | None:
        """Return what was recorded; None when it is not there after so long."""
        try:
            found = self.future.result(timeout=seconds)
        except TimeoutError:
            return None
        except Exception as err:  # whatever a task raised is a task that is lost
            raise PoolError(f'{type(err).__name__}: {err}') from err
        assert isinstance(found, Recorded)
        return found

    def drop(self) -> None:
        """Take it back."""
        self.future.cancel()
