# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Somebody calls a node of the graph in the middle of a run: it holds, or says what happened."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip('rclpy')

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rclpy.client import Client
from rclpy.task import Future

from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph

pytestmark = pytest.mark.ros

# Long enough for a call to arrive before its end.
PROMPT = 'A drone hovers at 10 meters for 20 seconds.'
LIMIT_S = 120.0
CALL_LIMIT_S = 10.0
# Of the simulated run in which the visitor calls.
AT_S = 5.0


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    with running_graph(tmp_path_factory.mktemp('graph')) as running:
        yield running


def run_with_a_visitor(graph: RunningGraph, client: Client, request: Any) -> tuple[Any, Any]:
    """Call once in the middle of a run; return the results of the run and of the call."""
    assert client.wait_for_service(CALL_LIMIT_S)
    calls: list[Future] = []

    def on_feedback(feedback: Any) -> None:
        if not calls and feedback.sim_time_s >= AT_S:
            calls.append(client.call_async(request))

    result = graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=on_feedback,
        raise_errors=False,
    )
    assert calls, f'the run was over before the call: {result.report_json}'
    return result, calls[0].result()


def change_of(transition: int) -> ChangeState.Request:
    request = ChangeState.Request()
    request.transition.id = transition
    return request


def test_a_run_whose_executor_is_deactivated_was_not_cancelled(graph: RunningGraph) -> None:
    client = graph.play.node.create_client(ChangeState, 'executor/change_state')
    deactivate = change_of(Transition.TRANSITION_DEACTIVATE)
    try:
        result, answer = run_with_a_visitor(graph, client, deactivate)
    finally:
        client.call(change_of(Transition.TRANSITION_ACTIVATE), timeout_sec=CALL_LIMIT_S)
    error = json.loads(result.report_json)['error']
    assert answer.success
    assert result.status == 'error', graph.logs()
    assert error['component'] == 'executor', error
    assert 'was deactivated from outside during the run' in error['message'], error


def test_a_recording_that_a_visitor_starts_is_refused(graph: RunningGraph) -> None:
    call = on.RECORDER_START
    client = graph.play.node.create_client(call.type, call.name)
    result, answer = run_with_a_visitor(graph, client, call.type.Request())
    assert 'is being recorded' in answer.error_msg
    assert not answer.ready
    assert result.status == 'verified', (result.report_json, graph.logs())
