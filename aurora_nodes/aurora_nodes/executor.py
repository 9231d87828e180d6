# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `executor` node: action `/aurora/execute` on the pure `ScenarioExecutor`.

Ticks are answered in the node's own thread; a worker thread drives the run, so cancel and
lifecycle are served while it goes on.
"""

from __future__ import annotations

import hashlib
import threading
import time
import traceback
from pathlib import Path

from rclpy.action.server import (
    ActionServer,
    CancelResponse,
    GoalEvent,
    GoalResponse,
    ServerGoalHandle,
)
from rclpy.subscription import Subscription

from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.pipeline.functions import execution_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.hashing import trace_hashes
from aurora_core.trace.trace import Integrity, Trace
from aurora_msgs.action import ExecuteScenario
from aurora_nodes.run_driver import Done, ExecutorSettings, Order, RunDriver
from aurora_nodes.tick_path import AIR, GROUND, TickPath
from aurora_ros import interfaces as on
from aurora_ros.account import tampered
from aurora_ros.conversions.messages import agsg
from aurora_ros.conversions.options import run_request
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.main import run_node
from aurora_ros.node import defect
from aurora_ros.parameters import declare

_CLIENT = 'orchestrator'


class ExecutorNode(ManagedNode):
    """One scenario at a time."""

    def __init__(self) -> None:
        super().__init__('executor')
        self._settings = declare(self, 'executor', ExecutorSettings)
        self.wants_autostart = self._settings.autostart
        self._path: TickPath | None = None
        self._worker: threading.Thread | None = None
        self._giving_up = threading.Event()
        self._deactivated = threading.Event()

    def configure(self) -> None:
        """Create the endpoints."""
        self._path = TickPath(self)
        self._watch = HeartbeatWatch(self)
        self._known = installed_knowledge()
        self._driver = RunDriver(self, self._path, self._watch, self._settings)
        self._server = ActionServer(
            self,
            on.EXECUTE.type,
            on.EXECUTE.name,
            execute_callback=lambda _goal: ExecuteScenario.Result(),
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=lambda _goal: CancelResponse.ACCEPT,
        )

    def cleanup(self) -> None:
        """Let go of the subscriptions, so that they end with the other endpoints."""
        if self._path is not None:
            self._path = None
            self._driver.close()

    def deactivate(self) -> None:
        """Give up a run that is going on (its clean-up goes on in the worker)."""
        if not self._giving_up.is_set():  # else this is the end of the node
            self._deactivated.set()
        self._giving_up.set()

    def request_stop(self) -> None:
        """Cancel a run that is going on."""
        self._giving_up.set()

    @property
    def awaited(self) -> Subscription | None:
        """The state that the next step of a run lacks."""
        return self._path.awaited if self._path is not None else None

    @property
    def is_idle(self) -> bool:
        """Whether no run is going on."""
        return self._worker is None or not self._worker.is_alive()

    def _on_goal(self, _goal: ExecuteScenario.Goal) -> GoalResponse:
        serves = self.is_idle and self.is_active
        return GoalResponse.ACCEPT if serves else GoalResponse.REJECT

    def _on_accepted(self, handle: ServerGoalHandle) -> None:
        self._giving_up.clear()
        self._deactivated.clear()
        # The goal is executed from now on; its end comes from the worker.
        handle._update_state(GoalEvent.EXECUTE)
        self._worker = threading.Thread(target=self._work, args=(handle,), name='run', daemon=True)
        self._worker.start()

    def _work(self, handle: ServerGoalHandle) -> None:
        """Execute a goal and hand its end over to the node's thread."""
        result = ExecuteScenario.Result()
        try:
            done = self._execute(handle)
            self._check_active(done, handle)
            self._fill(result, done)
        except AuroraError as err:
            self.get_logger().error(f'{err.component}: {err}')
            write_error(result, err)
        except Exception as err:  # noqa: BLE001 - a defect: logged, and the client is told
            self.get_logger().error(traceback.format_exc())
            write_error(result, defect(err, self.get_name()))
        self._server.notify_execute(handle, lambda goal: _end(goal, result))

    def _execute(self, handle: ServerGoalHandle) -> Done:
        goal = handle.request
        graph = agsg(goal.agsg)
        request = run_request('', goal.options_json)
        execution = execution_stage(self._known, graph, request.seed, request.faults)
        feedback = _Feedback(handle, execution.roster.dt_s, self._settings.feedback_period_s)
        orphaned = _Orphaned(self._watch)
        return self._driver.run(
            Order(
                run_id=goal.agsg.run_id,
                agsg=graph,
                execution=execution,
                bag_directory=Path(goal.bag_directory),
            ),
            on_tick=feedback,
            cancelled=lambda: handle.is_cancel_requested or self._giving_up.is_set() or orphaned(),
        )

    def _check_active(self, done: Done, handle: ServerGoalHandle) -> None:
        """Tell a run that its user cancelled from one that was taken away from its user.

        Raises:
            ExecutionError: The node was deactivated, and that is what ended the run.
        """
        asked = handle.is_cancel_requested
        if done.outcome == 'cancelled' and self._deactivated.is_set() and not asked:
            name = self.get_name()
            raise ExecutionError(
                f'{name} was deactivated from outside during the run',
                component=name,
                hint=f'see who calls {self.get_fully_qualified_name()}/change_state; then: '
                f'ros2 lifecycle set {self.get_fully_qualified_name()} activate',
            )

    def _fill(self, result: ExecuteScenario.Result, done: Done) -> None:
        result.bag_uri = str(done.bag)
        result.ticks = done.ticks
        result.outcome = done.outcome
        if done.outcome != 'cancelled':
            content = read_bag(done.bag, message_definitions())
            _check_states(content.trace, done)
            hashes = trace_hashes(content.trace, content.world)
            result.trace_sha256 = hashes.trace_sha256
            result.motion_sha256 = hashes.motion_sha256


class _Orphaned:
    """Tells that the orchestrator whose run this is has died; nobody waits for its end then.

    A goal that somebody else has sent has nothing to do with the orchestrator, which is idle.
    """

    def __init__(self, watch: HeartbeatWatch) -> None:
        self._watch = watch
        self._owner: tuple[int, int] | None = None

    def __call__(self) -> bool:
        watch = self._watch
        if self._owner is None:
            if watch.is_busy(_CLIENT) and not watch.is_dead(_CLIENT):
                self._owner = watch.process(_CLIENT)
            return False
        return watch.is_dead(_CLIENT) or watch.process(_CLIENT) != self._owner


class _Feedback:
    """Publishes the simulated time, not more often than the period of wall-clock time."""

    def __init__(self, handle: ServerGoalHandle, dt_s: float, period_s: float) -> None:
        self._handle = handle
        self._dt_s = dt_s
        self._period_s = period_s
        self._next_s = 0.0

    def __call__(self, tick: int) -> None:
        now_s = time.monotonic()
        if now_s < self._next_s:
            return
        self._next_s = now_s + self._period_s
        self._handle.publish_feedback(
            ExecuteScenario.Feedback(sim_time_s=tick * self._dt_s, tick=tick)
        )


def _check_states(trace: Trace, done: Done) -> None:
    """Hold the states of a recording against those that were answered; damage is the verifier's.

    Raises:
        ExecutionError: They differ: somebody wrote to one of the two in a bridge's name.
    """
    if trace.integrity is not Integrity.INTACT:
        return
    recorded = {GROUND: trace.ground, AIR: trace.uav}
    for source, heard_sha256 in done.states_sha256.items():
        if hashlib.sha256(recorded[source].tobytes()).hexdigest() != heard_sha256:
            raise tampered(f'the recorder holds other {source} states than the executor heard')


def _end(goal: ServerGoalHandle, result: ExecuteScenario.Result) -> ExecuteScenario.Result:
    """Bring a goal into its final state; runs in the node's thread."""
    if goal.is_cancel_requested:
        goal.canceled()
    elif result.error_code:
        goal.abort()
    else:
        goal.succeed()
    return result


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(ExecutorNode)
