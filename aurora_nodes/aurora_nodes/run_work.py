# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the orchestrator does with one job: the pipeline over the stages of the graph."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest, Stages
from aurora_core.report.manifest import manifest_facts
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import RunFolder, json_text, new_run_id
from aurora_core.report.versions import product_versions
from aurora_nodes.jobs import Job


class WallClock:
    """Steady time of this process."""

    def seconds(self) -> float:
        """Return steady seconds."""
        return time.monotonic()


def new_job(request: RunRequest, root: Path) -> Job:
    """Return a job with an id of its own."""
    run_id = new_run_id(datetime.now(UTC), os.urandom(3))
    return Job(
        run_id=run_id, request=request.model_copy(update={'engine': 'ros'}), root=root.absolute()
    )


def worker(
    stages_of: Callable[[str], Stages], stopping: Callable[[], bool]
) -> Callable[[Job], None]:
    """Return the function that works off jobs.

    Args:
        stages_of: Gives the stages of a run id.
        stopping: Whether the node is being shut down.
    """

    versions = product_versions()

    def work(job: Job) -> None:
        def progress(stage: str, fraction: float, sim_time_s: float) -> None:
            job.stage, job.fraction = stage, fraction
            job.sim_time_s = max(job.sim_time_s, sim_time_s)

        report = run(
            job.request,
            stages_of(job.run_id),
            RunFolder(job.root, job.run_id),
            RunControl(progress=progress, cancelled=lambda: job.cancel.is_set() or stopping()),
            WallClock(),
            versions=versions,
            manifest=manifest_facts(datetime.now(UTC), this_process(), versions),
        )
        job.status = report.status.value
        job.report_json = json_text(report)

    return work
