# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`--engine ros`: hand a prompt to the running graph, or to one that is started for it.

The only module of the command that imports ROS; it is imported for this engine alone.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from aurora_cli.ros_isolated import not_isolated, run_isolated
from aurora_core.errors import ExecutionError
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_report import RunReport

try:
    import rclpy
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
    from rclpy.node import Node
    from rclpy.signals import SignalHandlerOptions

    from aurora_msgs.action import RunScenario
    from aurora_ros import interfaces as on
    from aurora_ros.call import Caller
    from aurora_ros.conversions.options import options_json
    from aurora_ros.errors import raise_error
    from aurora_ros.heartbeat import HeartbeatWatch
except ImportError as err:
    raise ExecutionError(
        f'the engine ros needs ROS 2 and the built workspace: {err}',
        hint='make setup, then source ros_ws/setup.bash; or use --engine local',
        component='aurora_cli',
    ) from err

# Wall-clock limits.
_DISCOVERY_S = 3.0
_DISCOVERY_AFTER_START_S = 20.0
_START_S = 90
_STOP_S = 30.0
_RUN_S = 2 * 3600.0
_CANCEL_S = 30.0
_END_S = 20.0  # for a command that was told to end
_LOOK_S = 0.1

_UP = ('ros2', 'run', 'aurora_bringup', 'up', '--detach', '--timeout', str(_START_S))
_DOWN = ('ros2', 'run', 'aurora_bringup', 'down')


def run_over_ros(
    request: RunRequest,
    root: Path,
    control: RunControl,
    tell: Callable[[str], None],
    jobs: int | None = None,
) -> tuple[RunReport, Path]:
    """Run a prompt on the graph and return its report and run folder.

    Where no graph runs, one is started for it, in a network of its own where the kernel gives one.

    Args:
        request: Prompt and options.
        root: Folder of the run folders (absolute; the graph runs on this machine).
        control: Progress and cancel.
        tell: Takes what the user should know meanwhile.
        jobs: Processes for candidates of repair; None: as the configuration of the graph says.

    Raises:
        ExecutionError: The graph cannot be reached or started, or it gave no report.
        KeyboardInterrupt: Cancelled before the run began.
    """
    with _client_node() as node:
        caller = _caller(node)
        if _is_served(caller, _DISCOVERY_S):
            return _run(caller, request, root, control, jobs)
        why = not_isolated(request)
        if why:
            tell(f'no graph is running, starting one that others on this machine reach: {why}')
            with _own_graph(caller, control.cancelled):
                return _run(caller, request, root, control, jobs)
    tell('no graph is running, starting one in a network of its own')
    return run_isolated(request, root, control, tell, jobs)


def run_on_own_graph(
    request: RunRequest, root: Path, control: RunControl, jobs: int | None = None
) -> tuple[RunReport, Path]:
    """Run a prompt on a graph that is started for it, in the network that this process is in.

    Raises:
        ExecutionError: It cannot be started, or it gave no report.
        KeyboardInterrupt: Cancelled before the run began.
    """
    with _client_node() as node:
        caller = _caller(node)
        with _own_graph(caller, control.cancelled):
            return _run(caller, request, root, control, jobs)


def _caller(node: Node) -> Caller:
    caller = Caller(node, HeartbeatWatch(node))
    caller.prepare(on.RUN)
    return caller


def _run(
    caller: Caller, request: RunRequest, root: Path, control: RunControl, jobs: int | None
) -> tuple[RunReport, Path]:
    result = caller.action(
        on.RUN,
        RunScenario.Goal(
            prompt=request.prompt,
            prompt_bytes=len(request.prompt.encode('utf-8')),
            options_json=_options(request, root, jobs),
        ),
        _RUN_S,
        on_feedback=lambda feedback: control.progress(
            feedback.stage, feedback.fraction, feedback.sim_time_s
        ),
        cancelled=control.cancelled,
        cancel_limit_s=_CANCEL_S,
        raise_errors=False,
    )
    return _report(result), Path(result.run_dir)


def _options(request: RunRequest, root: Path, jobs: int | None) -> str:
    """Return the options with the folder of runs and `--jobs`, which are no part of a request."""
    return json.dumps({**json.loads(options_json(request)), 'out': str(root), 'jobs': jobs})


def _report(result: Any) -> RunReport:
    if not result.report_json:
        raise_error(result, 'orchestrator')
    try:
        return RunReport.model_validate_json(str(result.report_json))
    except ValidationError as err:
        raise ExecutionError(
            f'the orchestrator gave no readable report (status {result.status!r})',
            hint=f'see the run folder {result.run_dir} and the log of the orchestrator',
            component='orchestrator',
        ) from err


@contextmanager
def _client_node() -> Iterator[Node]:
    """A node that is served by a thread of its own meanwhile."""
    # Signals stay with us: rclpy's handlers would end the context before the run is cancelled.
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = Node(f'cli_{os.getpid()}', namespace=on.NAMESPACE)
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            return
        except Exception:
            rclpy.try_shutdown()  # whoever waits for an answer must not wait for ever
            raise

    thread = threading.Thread(target=spin, name='rclpy', daemon=True)
    thread.start()
    try:
        yield node
    finally:
        executor.shutdown(timeout_sec=1.0)
        thread.join(timeout=2.0)
        node.destroy_node()
        rclpy.try_shutdown()


@contextmanager
def _own_graph(caller: Caller, cancelled: Callable[[], bool]) -> Iterator[None]:
    """A graph that is started here and stopped afterwards."""
    try:
        _start(cancelled)
        if not _is_served(caller, _DISCOVERY_AFTER_START_S):
            raise ExecutionError(
                f'the graph was started, but nobody serves {on.RUN.name}',
                hint='is ROS_DOMAIN_ID the same in every shell?',
                component='aurora_cli',
            )
        yield
    finally:
        _call(_DOWN, lambda: False, _STOP_S)


def _is_served(caller: Caller, limit_s: float) -> bool:
    deadline_s = time.monotonic() + limit_s
    while not caller.is_served(on.RUN):
        if time.monotonic() > deadline_s:
            return False
        time.sleep(_LOOK_S)
    return True


def _start(cancelled: Callable[[], bool]) -> None:
    code = _call(_UP, cancelled, _START_S + 10.0)
    if cancelled():
        raise KeyboardInterrupt
    if code != 0:
        raise ExecutionError(
            f'{" ".join(_UP)} ended with {code}',
            hint='its messages are above; make setup builds what it needs',
            component='aurora_cli',
        )


def _call(command: tuple[str, ...], cancelled: Callable[[], bool], limit_s: float) -> int:
    """Run a command out of reach of a Ctrl-C, its output on standard error; return its code."""
    try:
        # A session of its own: a Ctrl-C is for us, and we tell it when to stop.
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=sys.stderr, start_new_session=True
        )
    except OSError as err:
        raise ExecutionError(
            f'{command[0]} cannot be started: {err.strerror or err}',
            hint='source ros_ws/setup.bash puts it on PATH',
            component='aurora_cli',
        ) from err
    deadline_s = time.monotonic() + limit_s
    told = False
    while True:
        try:
            return process.wait(timeout=_LOOK_S)
        except subprocess.TimeoutExpired:
            if told and time.monotonic() > deadline_s:
                process.kill()
            elif not told and (cancelled() or time.monotonic() > deadline_s):
                told = True
                process.terminate()
                deadline_s = time.monotonic() + _END_S
