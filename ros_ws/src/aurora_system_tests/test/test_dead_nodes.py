# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A node that dies in the middle of a run: the run ends as an error that names it.

After that the dead node is started again and the next prompt works.
"""

from __future__ import annotations

import json
import signal
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph

pytestmark = pytest.mark.ros

PROMPT = (
    'A drone ascends to 40 meters and then follows a motorcycle as it drives through the streets.'
)
LIMIT_S = 60.0
# Liveliness lease, or what the watchdog of sync allows, and some load on the machine.
NOTICED_WITHIN_S = 8.0


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    with running_graph(tmp_path_factory.mktemp('graph')) as running:
        yield running


def run_and(graph: RunningGraph, act_at_s: float, act: Any) -> tuple[Any, float]:
    """Run the prompt, act once at a simulated time, return result and seconds since the act."""
    acted: list[float] = []
    lock = threading.Lock()

    def on_feedback(feedback: RunScenario.Feedback) -> None:
        with lock:
            if feedback.sim_time_s >= act_at_s and not acted:
                acted.append(time.monotonic())
                act()

    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=on_feedback,
        raise_errors=False,
    )
    assert acted, 'the run ended before the node was killed'
    return result, time.monotonic() - acted[0]


@pytest.mark.parametrize(
    ('name', 'with_signal'),
    [
        ('sumo_bridge', signal.SIGKILL),
        ('recorder', signal.SIGKILL),
        ('executor', signal.SIGKILL),
        ('uav_sim', signal.SIGSTOP),
    ],
)
def test_a_dead_node_is_named_and_the_next_prompt_works(
    graph: RunningGraph, name: str, with_signal: signal.Signals
) -> None:
    result, seconds = run_and(graph, 5.0, lambda: graph.nodes[name].send(with_signal))
    assert result.status == 'error', graph.logs()
    report = json.loads(result.report_json)
    assert report['error']['component'] == name, (report['error'], graph.logs())
    assert seconds < NOTICED_WITHIN_S
    graph.restart(name)
    response = graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
    assert response.status == 'verified', (response.report_json[-2000:], graph.logs())
