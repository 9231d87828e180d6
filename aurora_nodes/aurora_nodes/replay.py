# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run aurora_nodes replay BAG`: publish a recorded run again, under its own clock.

A monitor that listens judges it as if it happened now; its margins must be those of the bag to the
last bit.
"""

from __future__ import annotations

import argparse
import json
import math
import signal
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

import rclpy
from pydantic import ValidationError
from rclpy.exceptions import InvalidHandle
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args, try_shutdown
from rich.console import Console

from aurora_core.errors import AuroraError, BagError, VerificationError
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.verification import graph_of
from aurora_core.pipeline.verify_run import report_beside
from aurora_core.report.comparison import Comparison, Difference, compare
from aurora_core.report.find_bag import FoundBag, find_bag
from aurora_core.report.status import ExitCode
from aurora_core.report.terminal import print_verify
from aurora_core.trace.bag_reader import content_of, read_stored
from aurora_core.trace.definitions import message_definitions
from aurora_msgs.msg import Verdict as VerdictMessage
from aurora_nodes.judgement import Judgement, judge
from aurora_nodes.replay_node import ReplayNode
from aurora_nodes.replay_plan import ReplayPlan, plan_replay

_HEARD_LIVE = 'live monitor'
_JOIN_LIMIT_S = 2.0


class _Parser(argparse.ArgumentParser):
    """Ends with the exit code that all commands of AURORA have for a usage error."""

    def error(self, message: str) -> NoReturn:
        self.print_usage(sys.stderr)
        self.exit(int(ExitCode.USAGE), f'{self.prog}: {message}\n')


def main() -> int:
    """Replay the bag that the command line names and return the exit code."""
    options = _options(remove_ros_args(sys.argv)[1:])
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        return int(_replay(options))
    except AuroraError as err:
        _say(f'{err.component}: {err.message}')
        if err.hint:
            _say(f'        {err.hint}')
        return int(ExitCode.BROKEN)
    except KeyboardInterrupt:
        _say('interrupted')
        return int(ExitCode.CANCELLED)


def _options(arguments: Sequence[str]) -> argparse.Namespace:
    parser = _Parser(prog='replay', description='Publish a recorded run under its own clock.')
    parser.add_argument('bag', metavar='BAG', help='run folder, run id, bag folder or .mcap file')
    parser.add_argument('--iteration', type=int, help='of a run folder; the last one by default')
    parser.add_argument(
        '--rate', type=float, help='times real time (default: as fast as the monitor follows)'
    )
    parser.add_argument(
        '--no-monitor',
        action='store_true',
        help='only publish, in real time unless --rate says otherwise',
    )
    parser.add_argument('--json', action='store_true', help='one JSON document on standard output')
    options = parser.parse_args(arguments)
    if options.rate is not None and not 0.0 < options.rate < math.inf:
        parser.error(f'--rate must be above 0, found {options.rate}')
    if options.rate is None and options.no_monitor:
        options.rate = 1.0
    try:
        options.found = find_bag(options.bag, options.iteration)
    except BagError as err:
        parser.error(err.message)
    return options


def _replay(options: argparse.Namespace) -> ExitCode:
    """Read, publish, compare.

    Raises:
        AuroraError: The bag holds nothing to replay, or the replay could not be brought to an end.
    """
    found: FoundBag = options.found
    bag = read_stored(found.bag, message_definitions())
    content = content_of(bag.messages, bag.damage, where=str(bag.folder))
    plan = plan_replay(bag, content)
    # Beforehand: nothing is published of a bag with which no verdict could be compared.
    known = installed_knowledge()
    judged = None if options.no_monitor else judge(known, content, str(bag.folder))
    for _, note in plan.damage:
        _say(f'the recording is damaged and is replayed as far as it goes: {note}')
    with _spinning(plan) as node:
        node.await_quiet()
        if judged is None:
            node.await_listeners()
        else:
            node.await_monitor()
        began_s = time.monotonic()
        node.play(rate=options.rate, monitored=judged is not None)
        took_s = time.monotonic() - began_s
        heard = None if judged is None else node.await_verdict()
    _say(
        f'replayed run {plan.run_id}: {plan.last_tick + 1} ticks, '
        f'{plan.last_tick * plan.dt_s:.2f} s of simulated time in {took_s:.2f} s'
    )
    if judged is None or heard is None:
        return ExitCode.BROKEN if plan.damage else ExitCode.OK
    compared = _compared(judged, heard)
    agsg = graph_of(content, str(bag.folder))
    report = report_beside(known, found, content, agsg, judged.verdict, compared)
    if options.json:
        text = json.dumps(report.model_dump(mode='json'), indent=2, ensure_ascii=False)
        sys.stdout.write(f'{text}\n')
    else:
        print_verify(report, Console(file=sys.stdout))
    return report.outcome.exit_code


def _compared(judged: Judgement, heard: VerdictMessage) -> Comparison:
    """Hold the monitor's verdict against the bag's.

    Raises:
        VerificationError: What the monitor published is no verdict.
    """
    try:
        live = Verdict.model_validate_json(heard.verdict_json)
    except ValidationError as err:
        raise VerificationError(
            f'the monitor published a verdict that is not valid: {err}'
        ) from err
    recorded = compare(live, judged.verdict, _HEARD_LIVE)
    if heard.trace_sha256 == judged.trace_sha256:
        return recorded
    differs = Difference(
        condition='trace',
        recorded=None,
        recomputed=None,
        what=f'trace hash {heard.trace_sha256} instead of {judged.trace_sha256}',
    )
    return Comparison(
        file=recorded.file, equal=False, differences=(*recorded.differences, differs)
    )


@contextmanager
def _spinning(plan: ReplayPlan) -> Iterator[ReplayNode]:
    """Yield the node while a thread serves it."""
    rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
    node: ReplayNode | None = None
    thread: threading.Thread | None = None
    try:
        node = ReplayNode(plan)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        thread = threading.Thread(target=_spin, args=(executor,), name='spin', daemon=True)
        thread.start()
        try:
            yield node
        finally:
            node.leave()
    finally:
        try_shutdown()
        if thread is not None:
            thread.join(_JOIN_LIMIT_S)
        if node is not None:
            node.destroy_node()


def _spin(executor: SingleThreadedExecutor) -> None:
    try:
        executor.spin()
    except ExternalShutdownException:
        return
    except (InvalidHandle, rclpy_implementation.RCLError):
        if rclpy.ok():
            raise  # else it was shut down while it waited


def _interrupt(_number: int, _frame: FrameType | None) -> NoReturn:
    raise KeyboardInterrupt


def _say(text: str) -> None:
    """Write a line to standard error; standard output carries the answer alone."""
    sys.stderr.write(f'replay: {text}\n')
    sys.stderr.flush()
