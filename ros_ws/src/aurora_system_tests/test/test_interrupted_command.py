# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora run --engine ros` is interrupted: the run is cancelled, a graph of its own is ended."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from rclpy.action import ActionClient

from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.trace import Integrity
from aurora_ros import interfaces as on
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner

pytestmark = pytest.mark.ros

COMMAND = 'from aurora_cli.main import main; main()'
PROMPT = 'A drone hovers at 20 meters over the ego car for 300 seconds.'
LIMIT_S = 90.0


def processes_of(mark: str) -> list[str]:
    """Return the commands of the processes that have this in their environment."""
    found = []
    for path in Path('/proc').glob('[0-9]*'):
        try:
            if mark.encode() in (path / 'environ').read_bytes().split(b'\0'):
                found.append((path / 'cmdline').read_bytes().decode(errors='replace'))
        except OSError:
            continue
    return found


def test_an_interrupted_command_leaves_a_readable_run_and_no_process(tmp_path: Path) -> None:
    with own_domain() as domain, partner(domain) as waiting:
        # Somebody else who would like a run is no graph.
        ActionClient(waiting.node, on.RUN.type, on.RUN.name)
        process = subprocess.Popen(
            [sys.executable, '-c', COMMAND, 'run', PROMPT, '--engine', 'ros', '--json'],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={
                **os.environ,
                'ROS_DOMAIN_ID': str(domain),
                'AURORA_RUN_DIR': str(tmp_path / 'graph'),
            },
        )
        try:
            assert process.stderr is not None
            said = b''
            for line in process.stderr:
                said += line
                if b'execute' in line:
                    break
            process.send_signal(signal.SIGTERM)
            answer, rest = process.communicate(timeout=LIMIT_S)
        finally:
            process.kill()
    assert process.returncode == 130, (said + rest).decode()
    report = json.loads(answer)
    assert report['status'] == 'cancelled'
    folder = tmp_path / 'runs' / report['run_id']
    assert json.loads((folder / 'report.json').read_text()) == report
    bag = read_bag(folder / 'bag.0', message_definitions())
    assert bag.trace.integrity is Integrity.INTACT
    assert processes_of(f'AURORA_RUN_DIR={tmp_path / "graph"}') == []
    assert not list((tmp_path / 'graph').glob('*/*.pid'))
