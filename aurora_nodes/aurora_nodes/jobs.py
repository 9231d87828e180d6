# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`JobQueue`: runs wait in line and are worked off one by one. No ROS."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.pipeline.stages import RunRequest

COMPONENT = 'orchestrator'
QUEUED, RUNNING, FINISHED = 'queued', 'running', 'finished'


@dataclass(kw_only=True, eq=False)
class Job:
    """One run from submission to report.

    Attributes:
        root: Folder of all runs.
        cancel: Set to ask for the end; see `JobQueue.cancel`.
        done: Set once `status` and `report_json` (or `error`) are final.
        news: Set when the stage changes and at the end; whoever waits for it clears it.
        stage: Stage that is going on, for feedback.
        fraction: Of the whole run, 0 to 1.
        sim_time_s: Simulated time.
        processes: That execute candidates of repair; None: as the configuration says.
    """

    run_id: str
    request: RunRequest
    root: Path
    cancel: threading.Event = field(default_factory=threading.Event)
    done: threading.Event = field(default_factory=threading.Event)
    news: threading.Event = field(default_factory=threading.Event)
    state: str = QUEUED
    status: str = ''
    report_json: str = ''
    error: AuroraError | None = None
    stage: str = ''
    fraction: float = 0.0
    sim_time_s: float = 0.0
    processes: int | None = None

    @property
    def run_dir(self) -> Path:
        """Folder of this run."""
        return self.root / self.run_id


class JobQueue:
    """A bounded queue with one worker.

    Args:
        work: Fills `status` and `report_json` of a job; an `AuroraError` becomes its error.
        most_waiting: Jobs that may wait behind the one that is running.
        most_kept: Finished jobs that are remembered.
    """

    def __init__(
        self, work: Callable[[Job], None], *, most_waiting: int, most_kept: int = 1000
    ) -> None:
        self._work = work
        self._most_waiting = most_waiting
        self._most_kept = most_kept
        self._waiting: deque[Job] = deque()
        self._running: Job | None = None
        self._jobs: dict[str, Job] = {}
        self._changed = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._run, name='runs', daemon=True)
        self._thread.start()

    def submit(self, job: Job) -> None:
        """Put a job in line.

        Raises:
            ExecutionError: Too many are waiting already.
        """
        with self._changed:
            if self._closed:
                raise ExecutionError(
                    'no run is taken any more: shutting down', component=COMPONENT
                )
            if len(self._waiting) >= self._most_waiting:
                raise ExecutionError(
                    f'{len(self._waiting)} runs are waiting already',
                    component=COMPONENT,
                    hint='wait for one of them to end, or cancel it',
                )
            self._jobs[job.run_id] = job
            self._forget_oldest()
            self._waiting.append(job)
            self._changed.notify()

    def cancel(self, job: Job) -> None:
        """Ask for the end of a job; one that still waits in line ends at once.

        Its folder and report are written in the calling thread: with `cancel` set, the work does
        nothing else.
        """
        with self._changed:
            job.cancel.set()
            if job not in self._waiting:
                return
            self._waiting.remove(job)
        self._finish(job)

    def get(self, run_id: str) -> Job | None:
        """Return a job by its run id."""
        with self._changed:
            return self._jobs.get(run_id)

    def newest(self, limit: int = 0) -> list[Job]:
        """Return jobs, the newest first; 0 = all."""
        with self._changed:
            jobs = list(reversed(self._jobs.values()))
        return jobs[:limit] if limit else jobs

    @property
    def is_over(self) -> bool:
        """Whether the queue is closed and its worker has ended."""
        return not self._thread.is_alive()

    def close(self) -> None:
        """Cancel everything and take nothing more; see `is_over`."""
        with self._changed:
            self._closed = True
            for job in (*self._waiting, *([self._running] if self._running else [])):
                job.cancel.set()
            self._changed.notify()

    def _forget_oldest(self) -> None:
        finished = [run_id for run_id, job in self._jobs.items() if job.done.is_set()]
        for run_id in finished[: max(0, len(self._jobs) - self._most_kept)]:
            del self._jobs[run_id]

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: bool(self._waiting) or self._closed)
                if not self._waiting:
                    return
                job = self._waiting.popleft()
                self._running = job
                job.state = RUNNING
            self._finish(job)

    def _finish(self, job: Job) -> None:
        """Work a job off; whatever happens, it is done afterwards."""
        try:
            self._work(job)
        except AuroraError as err:
            job.error = err
            job.status = 'error'
        except Exception as err:  # noqa: BLE001 - told to the client; the next job must run
            job.error = AuroraError(f'{type(err).__name__}: {err}', component=COMPONENT)
            job.status = 'error'
        with self._changed:
            if self._running is job:
                self._running = None
            job.state = FINISHED
            job.done.set()
            job.news.set()
