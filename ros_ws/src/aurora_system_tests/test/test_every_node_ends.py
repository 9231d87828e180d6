# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every node serves when started alone, and ends with code 0 and no traceback on a signal."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.processes import NodeProcess, nodes
from aurora_system_tests.graph import MODULES, ROS_NODES

pytestmark = pytest.mark.ros


@pytest.mark.parametrize('with_signal', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('name', ROS_NODES)
def test_signal(name: str, with_signal: signal.Signals, tmp_path: Path) -> None:
    with own_domain() as domain:
        process = NodeProcess(MODULES[name], domain, tmp_path)
        with nodes(process):
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
