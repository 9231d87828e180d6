# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which processes execute candidates of repair, as it was asked for."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass

from aurora_cli.installed import installed
from aurora_core.pipeline.beside import Beside


@dataclass(frozen=True, slots=True, kw_only=True)
class Elsewhere:
    """What was asked for.

    Attributes:
        jobs: Processes; None: as `config/repair.yaml` says. 1: that of the run.
        dask: Address of a scheduler whose workers execute instead; `local` starts one.
    """

    jobs: int | None = None
    dask: str | None = None


HERE = Elsewhere()


@contextmanager
def chosen(asked: Elsewhere, *, here: bool = True) -> Iterator[Beside | None]:
    """Give who executes candidates beside the runs of the context; None: nobody.

    Args:
        asked: Processes or a scheduler.
        here: Whether this process executes candidates itself where there is no other one.

    Raises:
        AuroraError: The scheduler cannot be used, or the configuration cannot be read.
    """
    settings = installed().repair
    jobs = settings.jobs if asked.jobs is None else asked.jobs
    if asked.dask is not None:
        from aurora_cli.beside.dask_workers import DaskWorkers

        with closing(DaskWorkers(asked.dask, jobs, settings.limit_s)) as workers:
            yield workers
    elif jobs > 1 or not here:
        from aurora_cli.beside.processes import LocalProcesses

        with closing(LocalProcesses(jobs, settings.limit_s)) as processes:
            yield processes
    else:
        yield None
