# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process in the ROS domain that writes into a run, or serves its calls, is named: it ends."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ExecutionError
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph
from aurora_system_tests.intruder import NAME, TOPICS
from aurora_system_tests.second_server import CALLS
from aurora_system_tests.second_server import NAME as SERVER

pytestmark = pytest.mark.ros

PROMPT = (
    'A scenario of 40 seconds. A drone hovers at 20 meters for 10 seconds while a motorcycle '
    'drives through the streets.'
)
LIMIT_S = 120.0
TWIN_LIMIT_S = 4.0


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    limit = ['--ros-args', '-p', f'twin_limit_s:={TWIN_LIMIT_S}']
    arguments = {'executor': limit, 'orchestrator': limit}
    folder = tmp_path_factory.mktemp('graph')
    with running_graph(folder, more_arguments=lambda _domain: arguments) as running:
        yield running


@contextmanager
def intruder(
    graph: RunningGraph, *arguments: str, kind: str = 'intruder'
) -> Iterator[subprocess.Popen[str]]:
    """Have an intruder in the domain of a graph; it ends properly and leaves no lease."""
    domain = graph.play.node.context.get_domain_id()
    process = subprocess.Popen(
        [sys.executable, '-m', f'aurora_system_tests.{kind}', *arguments],
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == 'ready\n'
        yield process
    finally:
        process.terminate()
        try:
            process.communicate(timeout=20.0)
        finally:
            process.kill()  # whoever missed the signal would write into the next test's domain


def run(graph: RunningGraph) -> Any:
    return graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=PROMPT),
        LIMIT_S,
        on_feedback=lambda _feedback: None,
        raise_errors=False,
    )


def test_without_a_stranger_the_run_is_verified(graph: RunningGraph) -> None:
    assert run(graph).status == 'verified', graph.logs()


@pytest.mark.parametrize('kind', sorted(TOPICS))
def test_who_writes_during_a_run_is_named(graph: RunningGraph, kind: str) -> None:
    with intruder(graph, kind):
        result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error', graph.logs()
    assert report['error']['component'] == 'network', report['error']
    expected = f'second writer on {TOPICS[kind].full_name}: node /{NAME}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert run(graph).status == 'verified', graph.logs()


# No bridge waits for the clock: who writes on it in the last moments of a run is noticed too late.
@pytest.mark.parametrize('kind', sorted(set(TOPICS) - {'clock'}))
def test_who_comes_writes_and_goes_is_noticed(graph: RunningGraph, kind: str) -> None:
    with intruder(graph, kind, '--passing') as passing:
        result = run(graph)
        for _ in range(4):  # where discovery is slow, a run is over before it could write
            if result.status != 'verified' or passing.poll() is not None:
                break
            result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error', (report, graph.logs())
    assert report['error']['component'] == 'network', (report['error'], graph.logs())
    assert f'second writer on {TOPICS[kind].full_name}' in report['error']['message']
    assert run(graph).status == 'verified', graph.logs()


def test_a_run_does_not_begin_beside_another_writer(graph: RunningGraph) -> None:
    with intruder(graph, 'command', '--early'):
        result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error'
    assert f'node /{NAME}' in report['error']['message'], report['error']
    assert not list(graph.runs.glob(f'{result.run_id}/bag.*')), 'nothing was flown'
    assert run(graph).status == 'verified', graph.logs()


@pytest.mark.parametrize('call', sorted(set(CALLS) - {on.RUN.name}))
def test_a_run_does_not_begin_beside_a_second_server(graph: RunningGraph, call: str) -> None:
    with intruder(graph, call, kind='second_server'):
        result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error'
    assert report['error']['component'] == 'network', (report['error'], graph.logs())
    expected = f'second server of /aurora/{call}: node /{SERVER}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert not list(graph.runs.glob(f'{result.run_id}/bag.*')), 'nothing was flown'


@pytest.mark.parametrize('call', [on.VERIFY.name, on.RECORDER_STOP.name, on.EXECUTE.name])
def test_who_begins_to_serve_during_a_run_is_named(graph: RunningGraph, call: str) -> None:
    with intruder(graph, call, '--late', kind='second_server'):
        result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error', graph.logs()
    expected = f'second server of /aurora/{call}: node /{SERVER}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert run(graph).status == 'verified', graph.logs()


def test_a_second_orchestrator_is_not_believed(graph: RunningGraph) -> None:
    with (
        intruder(graph, on.RUN.name, kind='second_server'),
        pytest.raises(ExecutionError, match=f'second server of /aurora/run: node /{SERVER}'),
    ):
        run(graph)
