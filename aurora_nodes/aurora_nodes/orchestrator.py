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

from aurora_core.errors import AuroraError
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.report.process import process_lives
from aurora_core.report.unfinished import close_unfinished
from aurora_msgs.action import RunScenario
from aurora_msgs.srv import RunPrompt
from aurora_nodes.answers import PublishedVerdicts
from aurora_nodes.attendance import EVERYBODY, Attendance, AttendanceLimits
from aurora_nodes.candidates import candidates
from aurora_nodes.jobs import Job, JobQueue
from aurora_nodes.prompts import received_prompt
from aurora_nodes.ros_stages import CALLS, RosStages, StageLimits
from aurora_nodes.run_records import RunRecords, fill_refusal, fill_result
from aurora_nodes.run_work import new_job, worker
from aurora_nodes.supervision import Supervision, supervision_folder
from aurora_ros import interfaces as on
from aurora_ros.call import Caller
from aurora_ros.conversions.options import repair_processes, run_request, runs_directory
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.main import Spinning, run_node
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare, require_positive
from aurora_ros.roll_call import RollCall

_LOOK_S = 0.1
_SERVED = (on.RUN_PROMPT, on.GET_RUN, on.LIST_RUNS, on.RUN)


@dataclass(frozen=True, kw_only=True)
class OrchestratorSettings(StageLimits, AttendanceLimits):
    """See `config/orchestrator.param.yaml`."""

    runs_directory: str
    preload_map: str
    most_waiting: int
    feedback_period_s: float
    assemble_s: float
    restart_s: float
    dask: str

    def __post_init__(self) -> None:
        StageLimits.__post_init__(self)
        AttendanceLimits.__post_init__(self)
        require_positive(self, 'most_waiting', 'feedback_period_s', 'assemble_s', 'restart_s')


class OrchestratorNode(AuroraNode):
    """Knows every run of this graph."""

    def __init__(self) -> None:
        super().__init__('orchestrator')
        self._settings = declare(self, 'orchestrator', OrchestratorSettings)
        self._known = installed_knowledge()
        self._known.map(self._settings.preload_map)
        self._root = Path(self._settings.runs_directory).absolute()
        if self._root.is_dir():
            for run_id in close_unfinished(self._root, process_lives):
                self.get_logger().warning(f'run {run_id} was left unfinished: closed as error')
        self._stopping = threading.Event()
        self._gone = False
        group = ReentrantCallbackGroup()
        self._queue = self._make_queue(group)
        records = RunRecords(self._queue, self._root)
        self.serve(on.RUN_PROMPT, self._run_prompt, group=group)
        self.serve(on.GET_RUN, records.get, group=group)
        self.serve(on.LIST_RUNS, records.list, group=group)
        self._server = ActionServer(
            self,
            on.RUN.type,
            on.RUN.name,
            execute_callback=self._run,
            cancel_callback=lambda _goal: CancelResponse.ACCEPT,
            callback_group=group,
        )

    def _make_queue(self, group: ReentrantCallbackGroup) -> JobQueue:
        """Connect the runs with the graph."""
        settings = self._settings
        # In a group of its own: signs of life are taken while other callbacks are at work.
        watch = HeartbeatWatch(self, group=group)
        supervision = Supervision(
            supervision_folder(), supervised_s=settings.restart_s, alone_s=settings.assemble_s
        )
        roll_call = RollCall(self, watch, EVERYBODY)
        attendance = Attendance(roll_call, watch, supervision, settings)
        caller = Caller(self, watch, guard=attendance.check, others=_SERVED)
        caller.prepare(*CALLS)
        published = PublishedVerdicts(self)
        work = worker(
            lambda run_id, cancelled: RosStages(
                caller, attendance, published, settings, run_id, cancelled
            ),
            self._known,
            self._stopping.is_set,
            supervision.note,
            lambda processes: candidates(processes, settings.dask),
        )

        def busy_work(job: Job) -> None:
            self.heartbeat.busy(0)
            try:
                work(job)
            finally:
                self.heartbeat.idle()

        return JobQueue(busy_work, most_waiting=settings.most_waiting)

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
        options = request.options_json
        root = runs_directory(options) or self._root
        job = new_job(run_request(prompt, options), root, repair_processes(options))
        self._queue.submit(job)
        return job

    def _run_prompt(
        self, request: RunPrompt.Request, response: RunPrompt.Response
    ) -> RunPrompt.Response:
        try:
            job = self._submit(request)
        except AuroraError as err:
            fill_refusal(response, err)
            return response
        while request.wait and not job.done.wait(_LOOK_S) and not self._gone:
            pass
        fill_result(response, job)
        return response

    def _run(self, goal: ServerGoalHandle) -> RunScenario.Result:
        result = RunScenario.Result()
        try:
            job = self._submit(goal.request)
        except AuroraError as err:
            fill_refusal(result, err)
            goal.abort()
            return result
        while not job.done.is_set() and not self._gone:
            job.news.wait(self._settings.feedback_period_s)
            job.news.clear()
            if goal.is_cancel_requested and not job.cancel.is_set():
                self._queue.cancel(job)
            goal.publish_feedback(
                RunScenario.Feedback(
                    run_id=job.run_id,
                    stage=job.stage,
                    fraction=job.fraction,
                    sim_time_s=job.sim_time_s,
                    worst_margin=float('nan'),
                )
            )
        fill_result(result, job)
        if goal.is_cancel_requested:
            goal.canceled()
        else:
            goal.succeed()
        return result


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(OrchestratorNode, spinning=Spinning.MANY_THREADS)
