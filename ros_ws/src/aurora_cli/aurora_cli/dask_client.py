# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Work on the workers of a Dask scheduler, here or on other machines.

A worker does one task at a time in a process of its own, since a simulator allows one simulation
in a process: start them with `--nthreads 1`.
"""

from __future__ import annotations

import faulthandler
import logging
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import dask
from distributed import Client, LocalCluster

from aurora_cli.pool import PoolError, Work

LOCAL = 'local'


@contextmanager
def dask_client(address: str, jobs: int) -> Iterator[Client]:
    """Give a connection to a scheduler with fitting workers.

    Args:
        address: Of a scheduler; `local` starts one here, which ends with the context.
        jobs: Workers where it is started here.

    Raises:
        PoolError: Nobody answers at the address, or a worker has several threads.
    """
    with ExitStack() as stack:
        # A scheduler of somebody else has a setting of its own.
        stack.enter_context(dask.config.set({'distributed.scheduler.allowed-failures': 0}))
        place: Any = address
        try:
            if address == LOCAL:
                place = stack.enter_context(
                    LocalCluster(
                        n_workers=jobs,
                        threads_per_worker=1,
                        host='127.0.0.1',
                        dashboard_address=None,
                        silence_logs=logging.CRITICAL,
                    )
                )
            client = stack.enter_context(Client(place))
        except (OSError, ValueError) as err:
            raise PoolError(
                f'no scheduler answers at {address}: {err}', hint='start one with dask scheduler'
            ) from err
        if any(number != 1 for number in client.nthreads().values()):
            raise PoolError(
                'a worker has several threads, and a simulator needs a process of its own',
                hint='start them with dask worker ADDRESS --nthreads 1',
            )
        yield client


def do_task(work: Work[Any, Any], task: Any, limit_s: float) -> Any:
    """Do one task in a worker's process, which is ended when its wall seconds are over."""
    prepare(work)
    faulthandler.dump_traceback_later(limit_s, exit=True)
    try:
        return work(task)
    finally:
        faulthandler.cancel_dump_traceback_later()


def prepare(work: Work[Any, Any]) -> None:
    """Load in a worker's process what tasks need, once."""
    if repr(work) not in _prepared:
        work.prepare()
        _prepared.append(repr(work))


_prepared: list[str] = []
