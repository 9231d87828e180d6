# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the orchestrator answers about runs: its own and those that the folder holds."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, islice
from pathlib import Path
from typing import Any

from aurora_core.errors import AuroraError, PromptError
from aurora_msgs.srv import GetRun, ListRuns
from aurora_nodes.finished_runs import FinishedRun, list_finished, read_finished
from aurora_nodes.jobs import FINISHED, Job, JobQueue
from aurora_ros.errors import write_error


def fill_result(message: Any, job: Job) -> None:
    """Write what is known of a job into a response or result."""
    message.status = job.status if job.state == FINISHED else job.state
    message.run_id = job.run_id
    message.run_dir = str(job.run_dir)
    message.report_json = job.report_json
    if job.error is not None:
        write_error(message, job.error)


def fill_refusal(message: Any, err: AuroraError) -> None:
    """Write why a prompt was not taken into a response or result."""
    message.status = 'not_understood' if isinstance(err, PromptError) else 'error'
    write_error(message, err)


class RunRecords:
    """The services that tell of runs.

    Args:
        queue: Runs of this process.
        root: Folder of all runs, also of earlier processes.
    """

    def __init__(self, queue: JobQueue, root: Path) -> None:
        self._queue = queue
        self._root = root

    def get(self, request: GetRun.Request, response: GetRun.Response) -> GetRun.Response:
        """Tell of one run."""
        run = self._queue.get(request.run_id) or read_finished(self._root, request.run_id)
        response.found = run is not None
        if run is not None:
            response.state, response.status = run.state, run.status
            response.run_dir, response.report_json = str(run.run_dir), run.report_json
        return response

    def list(self, request: ListRuns.Request, response: ListRuns.Response) -> ListRuns.Response:
        """List runs, the newest first, at most `limit` unless that is 0."""
        jobs = self._queue.newest()
        known = {job.run_id for job in jobs}
        earlier = (run for run in list_finished(self._root) if run.run_id not in known)
        runs: Iterator[Job | FinishedRun] = chain(jobs, earlier)
        for run in islice(runs, request.limit or None):
            response.run_id.append(run.run_id)
            response.state.append(run.state)
            response.status.append(run.status)
            response.prompt.append(run.request.prompt if isinstance(run, Job) else run.prompt)
        return response
