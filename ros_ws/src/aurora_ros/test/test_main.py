# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A node that hangs when it is told to end is ended all the same, and says where it hung."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_ros.testing.domains import own_domain

pytestmark = pytest.mark.ros

LIMIT_S = 30.0
HANGING = """
import sys, time
from aurora_ros import main
from aurora_ros.node import AuroraNode

class Hanging(AuroraNode):
    def destroy_node(self):
        time.sleep(600.0)

main._END_LIMIT_S = 0.5
sys.exit(main.run_node(lambda: Hanging('hanging')))
"""


def test_a_node_that_hangs_at_its_end_is_cut_off(tmp_path: Path) -> None:
    ready = tmp_path / 'ready'
    with own_domain() as domain:
        process = subprocess.Popen(
            [sys.executable, '-c', HANGING],
            stderr=subprocess.PIPE,
            env={**os.environ, 'ROS_DOMAIN_ID': str(domain), 'AURORA_READY_FILE': str(ready)},
        )
        try:
            deadline = time.monotonic() + LIMIT_S
            while not ready.exists():
                assert process.poll() is None
                assert time.monotonic() < deadline
                time.sleep(0.05)
            process.send_signal(signal.SIGTERM)
            _, said = process.communicate(timeout=LIMIT_S)
        finally:
            process.kill()
    assert process.returncode == 1, 'a hang is no proper end'
    assert b'told to end 0.5 s ago' in said
    assert b'in destroy_node' in said
    assert not ready.exists()
