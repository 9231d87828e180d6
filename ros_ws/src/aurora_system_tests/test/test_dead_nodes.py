# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A node that dies during a run: the run ends as an error that names it, and nothing goes on.

A selection of the cells of `aurora_bench.faults`. Whoever died is started again by the test, and
the next cell's run shows that the graph works.
"""

from __future__ import annotations

import json
import resource
import signal
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ParticipantSilentError
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.matching import wait_until
from aurora_system_tests.graph import ROS_NODES, RunningGraph, running_graph

pytestmark = pytest.mark.ros

PROMPT = (
    'A scenario of 28 seconds. A drone ascends to 10 meters and then follows a motorcycle for '
    '5 seconds as it drives through the streets.'
)
LIMIT_S = 120.0
# 5 s (and 3 s more for a node that was stopped) on a quiet machine; it would never end otherwise.
NOTICED_WITHIN_S = 60.0
IDLE_WITHIN_S = 60.0

Moment = Callable[[RunScenario.Feedback], bool]


def loading(feedback: RunScenario.Feedback) -> bool:
    return bool(feedback.stage == 'execute')


def flying(feedback: RunScenario.Feedback) -> bool:
    return bool(feedback.sim_time_s >= 5.0)


def verifying(feedback: RunScenario.Feedback) -> bool:
    return bool(feedback.stage == 'verify')


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    with running_graph(tmp_path_factory.mktemp('graph')) as running:
        yield running


@pytest.fixture(scope='module')
def watch(graph: RunningGraph) -> HeartbeatWatch:
    return graph.play.watch


def run_and(graph: RunningGraph, moment: Moment, act: Callable[[], None]) -> tuple[Any, float]:
    """Run the prompt, act once at a moment, return result and seconds from act to report.

    What comes after (drawing the picture of what was flown) takes its time on a busy machine.
    """
    acted: list[float] = []
    reported: list[float] = []

    def on_feedback(feedback: RunScenario.Feedback) -> None:
        if moment(feedback) and not acted:
            acted.append(time.monotonic())
            act()
        if feedback.stage in ('report', 'done') and not reported:
            reported.append(time.monotonic())

    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=on_feedback,
        raise_errors=False,
    )
    assert acted, (result.status, result.error_msg, 'the moment never came', graph.logs())
    return result, (reported or [time.monotonic()])[0] - acted[0]


@pytest.mark.parametrize(
    ('name', 'blow', 'moment'),
    [
        ('recorder', signal.SIGKILL, flying),
        ('executor', signal.SIGKILL, flying),
        # Its successor finds the session of the dead one, which still has an owner.
        ('uav_bridge', signal.SIGKILL, flying),
        ('sync', signal.SIGSTOP, loading),
        ('sync', signal.SIGKILL, flying),
        ('uav_sim', signal.SIGSTOP, flying),
        ('sumo_bridge', signal.SIGSEGV, verifying),
        ('uav_sim', signal.SIGKILL, verifying),
    ],
)
def test_a_dead_node_is_named_and_the_run_is_over(
    graph: RunningGraph, watch: HeartbeatWatch, name: str, blow: signal.Signals, moment: Moment
) -> None:
    resource.prlimit(graph.nodes[name].pid, resource.RLIMIT_CORE, (0, 0))  # no files of a crash
    try:
        result, seconds = run_and(graph, moment, lambda: graph.nodes[name].send(blow))
        assert result.status == 'error', graph.logs()
        report = json.loads(result.report_json)
        assert report['error']['component'] == name, (report['error'], graph.logs())
        assert result.error_code == report['error']['code'] != 0
        assert result.error_msg.startswith(f'{name}: ')
        assert seconds < NOTICED_WITHIN_S
        others = [other for other in ROS_NODES if other != name]
        assert wait_until(lambda: not any(map(watch.is_busy, others)), IDLE_WITHIN_S), graph.logs()
    finally:
        graph.restart(name)


def test_after_all_of_it_the_next_prompt_is_verified(graph: RunningGraph) -> None:
    response = graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
    assert response.status == 'verified', (response.report_json[-2000:], graph.logs())


def test_the_executor_gives_up_the_run_of_an_orchestrator_that_died(
    graph: RunningGraph, watch: HeartbeatWatch
) -> None:
    with pytest.raises(ParticipantSilentError):
        run_and(graph, flying, lambda: graph.nodes['orchestrator'].send(signal.SIGKILL))
    others = [name for name in ROS_NODES if name != 'orchestrator']
    assert wait_until(lambda: not any(map(watch.is_busy, others)), IDLE_WITHIN_S), graph.logs()
    graph.restart('orchestrator')
    listed = graph.play.call(on.LIST_RUNS, LIMIT_S, limit=2)
    assert list(listed.status) == ['error', 'verified'], 'closed by the new orchestrator'
    found = graph.play.call(on.GET_RUN, LIMIT_S, run_id=listed.run_id[0])
    assert json.loads(found.report_json)['run_id'] == listed.run_id[0]
