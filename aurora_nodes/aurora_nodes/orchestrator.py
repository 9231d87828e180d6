# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `orchestrator` node: prompt in, report out, by service or action; runs wait in line.

Services and goals that wait for a run block a thread of the executor each, so this node has many;
the runs themselves are worked off by one thread.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rclpy.action.server import ActionServer, CancelResponse, ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup

from aurora_core.errors import AuroraError, PromptError
from aurora_core.pipeline.functions import knowledge
from aurora_core.report.process import process_lives
from aurora_core.report.unfinished import close_unfinished
from aurora_msgs.action import RunScenario
from aurora_msgs.srv import GetRun, ListRuns, RunPrompt
from aurora_nodes.finished_runs import FinishedRun, list_finished, read_finished
from aurora_nodes.jobs import FINISHED, Job, JobQueue
from aurora_nodes.prompts import received_prompt
from aurora_nodes.ros_stages import CALLS, RosStages, StageLimits
from aurora_nodes.run_work import new_job, worker
from aurora_ros import interfaces as on
from aurora_ros.call import Caller
from aurora_ros.conversions.options import run_request, runs_directory
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.main import Spinning, run_node
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare, require_positive

_LOOK_S = 0.1


@dataclass(frozen=True, kw_only=True)
class OrchestratorSettings(StageLimits):
    """See `config/orchestrator.param.yaml`."""

    runs_directory: str
    preload_map: str
    most_waiting: int
    feedback_period_s: float

    def __post_init__(self) -> None:
        super().__post_init__()
        require_positive(self, 'most_waiting', 'feedback_period_s')


class OrchestratorNode(AuroraNode):
    """Knows every run of this graph."""

    def __init__(self) -> None:
        super().__init__('orchestrator')
        self._settings = declare(self, 'orchestrator', OrchestratorSettings)
        knowledge().map(self._settings.preload_map)
        self._root = Path(self._settings.runs_directory).absolute()
        if self._root.is_dir():
            for run_id in close_unfinished(self._root, process_lives):
                self.get_logger().warning(f'run {run_id} was left unfinished: closed as error')
        self._stopping = threading.Event()
        self._gone = False
        caller = Caller(self, HeartbeatWatch(self))
        caller.prepare(*CALLS)
        self._queue = JobQueue(
            worker(
                lambda run_id: RosStages(caller, self._settings, run_id),
                self._stopping.is_set,
            ),
            most_waiting=self._settings.most_waiting,
        )
        group = ReentrantCallbackGroup()
        self.serve(on.RUN_PROMPT, self._run_prompt, group=group)
        self.serve(on.GET_RUN, self._get_run, group=group)
        self.serve(on.LIST_RUNS, self._list_runs, group=group)
        self._server = ActionServer(
            self,
            on.RUN.type,
            on.RUN.name,
            execute_callback=self._run,
            cancel_callback=lambda _goal: CancelResponse.ACCEPT,
            callback_group=group,
        )

    def request_stop(self) -> None:
        """Cancel what is running; its report is still written."""
        self._stopping.set()
        self._queue.close()

    @property
    def is_idle(self) -> bool:
        """Whether no run is going on."""
        return self._queue.is_over

    def destroy_node(self) -> None:
        """Let go of those who wait for a run that does not end."""
        self._gone = True
        super().destroy_node()

    def _submit(self, request: Any) -> Job:
        prompt = received_prompt(request.prompt, request.prompt_bytes)
        asked = runs_directory(request.options_json)
        job = new_job(run_request(prompt, request.options_json), asked or self._root)
        self._queue.submit(job)
        return job

    def _run_prompt(
        self, request: RunPrompt.Request, response: RunPrompt.Response
    ) -> RunPrompt.Response:
        try:
            job = self._submit(request)
        except AuroraError as err:
            response.status = _refusal(err)
            write_error(response, err)
            return response
        while request.wait and not job.done.wait(_LOOK_S) and not self._gone:
            pass
        _fill(response, job)
        return response

    def _run(self, goal: ServerGoalHandle) -> RunScenario.Result:
        result = RunScenario.Result()
        try:
            job = self._submit(goal.request)
        except AuroraError as err:
            result.status = _refusal(err)
            write_error(result, err)
            goal.abort()
            return result
        while not job.done.wait(self._settings.feedback_period_s) and not self._gone:
            if goal.is_cancel_requested:
                job.cancel.set()
            goal.publish_feedback(
                RunScenario.Feedback(
                    run_id=job.run_id,
                    stage=job.stage,
                    fraction=job.fraction,
                    sim_time_s=job.sim_time_s,
                    worst_margin=float('nan'),
                )
            )
        _fill(result, job)
        if goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.succeed()
        return result

    def _get_run(self, request: GetRun.Request, response: GetRun.Response) -> GetRun.Response:
        job = self._queue.get(request.run_id)
        run = job or read_finished(self._root, request.run_id)
        response.found = run is not None
        if run is not None:
            response.state, response.status = run.state, run.status
            response.run_dir, response.report_json = str(run.run_dir), run.report_json
        return response

    def _list_runs(
        self, request: ListRuns.Request, response: ListRuns.Response
    ) -> ListRuns.Response:
        jobs = self._queue.newest()
        known = {job.run_id for job in jobs}
        runs: list[Job | FinishedRun] = [*jobs]
        runs += (run for run in list_finished(self._root) if run.run_id not in known)
        for run in runs[: request.limit or None]:
            response.run_id.append(run.run_id)
            response.state.append(run.state)
            response.status.append(run.status)
            response.prompt.append(run.request.prompt if isinstance(run, Job) else run.prompt)
        return response


def _refusal(err: AuroraError) -> str:
    """Return the status of a prompt that was not taken."""
    return 'not_understood' if isinstance(err, PromptError) else 'error'


def _fill(message: Any, job: Job) -> None:
    """Write what is known of a job into a response or result."""
    message.status = job.status if job.state == FINISHED else job.state
    message.run_id = job.run_id
    message.run_dir = str(job.run_dir)
    message.report_json = job.report_json
    if job.error is not None:
        write_error(message, job.error)


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(OrchestratorNode, spinning=Spinning.MANY_THREADS)
