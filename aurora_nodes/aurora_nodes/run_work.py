# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the orchestrator does with one job: the pipeline over the stages of the graph."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from datetime import UTC, datetime
from pathlib import Path
from typing import Protocol

from aurora_core.errors import AuroraError
from aurora_core.pipeline.beside import Beside
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest, Stages
from aurora_core.report.manifest import manifest_facts
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import RunFolder, json_text, new_run_id
from aurora_core.report.run_report import ErrorReport
from aurora_core.report.versions import product_versions
from aurora_nodes.jobs import Job


class WallClock:
    """Steady time of this process."""

    def seconds(self) -> float:
        """Return steady seconds."""
        return time.monotonic()


def new_job(request: RunRequest, root: Path, processes: int | None = None) -> Job:
    """Return a job with an id of its own."""
    run_id = new_run_id(datetime.now(UTC), os.urandom(3))
    return Job(
        run_id=run_id,
        request=request.model_copy(update={'engine': 'ros'}),
        root=root.absolute(),
        processes=processes,
    )


class GraphStages(Stages, Protocol):
    """Stages that hold something of the graph until they are closed."""

    def close(self) -> None:
        """Let go of it; safe to call when nothing is held."""


def worker(
    stages_of: Callable[[str, Callable[[], bool]], GraphStages],
    known: Knowledge,
    stopping: Callable[[], bool],
    broke: Callable[[AuroraError], None],
    beside: Callable[[int | None], AbstractContextManager[Beside | None]],
) -> Callable[[Job], None]:
    """Return the function that works off jobs.

    Args:
        stages_of: Gives the stages of a run id; the second argument tells of a cancel.
        known: What is installed here.
        stopping: Whether the node is being shut down.
        broke: Told the error of a run that ended with one.
        beside: Gives who executes candidates of repair, in so many processes.
    """

    versions = product_versions()

    def work(job: Job) -> None:
        def progress(stage: str, fraction: float, sim_time_s: float) -> None:
            is_new = stage != job.stage
            job.stage, job.fraction = stage, fraction
            job.sim_time_s = max(job.sim_time_s, sim_time_s)
            if is_new:
                job.news.set()

        def cancelled() -> bool:
            return job.cancel.is_set() or stopping()

        stages = stages_of(job.run_id, cancelled)
        try:
            with beside(job.processes) as others:
                report = run(
                    job.request,
                    stages,
                    known,
                    RunFolder(job.root, job.run_id),
                    RunControl(progress=progress, cancelled=cancelled),
                    WallClock(),
                    versions=versions,
                    manifest=manifest_facts(datetime.now(UTC), this_process(), versions),
                    beside=others,
                )
            job.status = report.status.value
            job.report_json = json_text(report)
            if report.error is not None:
                job.error = _error(report.error)
                broke(job.error)
        finally:
            stages.close()

    return work


def _error(told: ErrorReport) -> AuroraError:
    return AuroraError(told.message, hint=told.hint, component=told.component, code=told.code)
