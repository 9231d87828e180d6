# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process in the ROS domain that writes into a run ends it and is named; the next one goes."""

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

from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph
from aurora_system_tests.intruder import NAME, TOPICS

pytestmark = pytest.mark.ros

PROMPT = (
    'A drone hovers at 30 meters for 10 seconds while a motorcycle drives through the streets.'
)
LIMIT_S = 120.0
TWIN_LIMIT_S = 4.0


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    arguments = {'executor': ['--ros-args', '-p', f'twin_limit_s:={TWIN_LIMIT_S}']}
    folder = tmp_path_factory.mktemp('graph')
    with running_graph(folder, more_arguments=lambda _domain: arguments) as running:
        yield running


@contextmanager
def intruder(graph: RunningGraph, *arguments: str) -> Iterator[None]:
    """Have an intruder in the domain of a graph; it ends properly and leaves no lease."""
    domain = graph.play.node.context.get_domain_id()
    process = subprocess.Popen(
        [sys.executable, '-m', 'aurora_system_tests.intruder', *arguments],
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == 'ready\n'
        yield
    finally:
        process.terminate()
        process.communicate(timeout=20.0)


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


@pytest.mark.parametrize('kind', sorted(TOPICS))
def test_who_comes_writes_and_goes_is_noticed(graph: RunningGraph, kind: str) -> None:
    with intruder(graph, kind, '--passing'):
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
