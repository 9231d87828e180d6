# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every node serves when started alone, and ends with code 0 and no traceback on a signal."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_nodes.modules import MODULES
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.processes import NodeProcess
from aurora_system_tests.graph import ROS_NODES

pytestmark = pytest.mark.ros


SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


@pytest.fixture(scope='module', params=SIGNALS, ids=lambda s: s.name)
def alone(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[signal.Signals, dict[str, NodeProcess]]]:
    """A signal, and every node in a domain of its own; they start side by side.

    With one of the signals a node has an interpreter of its own, which begins and ends, too; with
    the others it is forked off one that has imported everything.
    """
    with ExitStack() as stack:
        started = {}
        for k, name in enumerate(ROS_NODES):
            whole = SIGNALS[k % len(SIGNALS)] is request.param
            kind: type[NodeProcess] = NodeProcess if whole else ForkedNode
            domain = stack.enter_context(own_domain())
            started[name] = kind(MODULES[name], domain, tmp_path_factory.mktemp(name))
            stack.callback(started[name].kill)
        for node in started.values():
            node.await_ready()
        yield request.param, started


@pytest.mark.parametrize('name', ROS_NODES)
def test_signal(alone: tuple[signal.Signals, dict[str, NodeProcess]], name: str) -> None:
    with_signal, started = alone
    process = started[name]
    assert process.ready_file.read_text().strip() == str(process.pid)
    assert process.end(with_signal) == 0, process.log
    assert 'Traceback' not in process.log
    assert not process.ready_file.exists()


@pytest.mark.parametrize(
    ('name', 'wrong'),
    [
        ('sync', 'credit_ticks:=many'),
        ('recorder', 'ack_ticks:=0'),
        ('orchestrator', 'verify_s:=x'),
    ],
)
def test_a_wrong_parameter_is_one_line_and_exit_code_1(
    name: str, wrong: str, tmp_path: Path
) -> None:
    with own_domain() as domain:
        process = NodeProcess(MODULES[name], domain, tmp_path, ['--ros-args', '-p', wrong])
        try:
            assert process.wait(30.0) == 1
        finally:
            process.kill()
        assert wrong.split(':=')[0] in process.log
        assert 'Traceback' not in process.log


def test_a_parameter_file_wins_over_the_shipped_one(tmp_path: Path) -> None:
    file = tmp_path / 'my.yaml'
    file.write_text('/**:\n  ros__parameters:\n    silence_limit_s: -1.0\n', encoding='utf-8')
    with own_domain() as domain:
        process = NodeProcess(
            MODULES['sync'], domain, tmp_path, ['--ros-args', '--params-file', str(file)]
        )
        try:
            assert process.wait(30.0) == 1
        finally:
            process.kill()
        assert 'silence_limit_s must be above 0, found -1.0' in process.log
