# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every command of docs/replay.md does what the page says."""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.processes import nodes

pytestmark = pytest.mark.ros

ROOT = Path(__file__).resolve().parents[4]
PAGE = (ROOT / 'docs' / 'replay.md').read_text(encoding='utf-8')
SEEN = 'until ros2 node list | grep -qx /aurora/viewer; do sleep 0.1; done'
LINES = [
    line
    for block in re.findall(r'```bash\n(.*?)```', PAGE, re.DOTALL)
    for line in block.splitlines()
]


def shell(line: str, folder: Path, domain: int) -> tuple[int, str]:
    script = f'source {shlex.quote(str(ROOT / "ros_ws" / "setup.bash"))} && {line}'
    done = subprocess.run(
        ['bash', '-c', script],
        cwd=folder,
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120.0,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


@contextmanager
def viewing(line: str, domain: int) -> Iterator[None]:
    """Run a node until the block ends, and hold it to a proper end."""
    process = subprocess.Popen(
        [
            'bash',
            '-c',
            f'source {shlex.quote(str(ROOT / "ros_ws" / "setup.bash"))} && exec {line}',
        ],
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdin=subprocess.DEVNULL,
    )
    try:
        # It has to be there when the run is announced.
        code, output = shell(SEEN, ROOT, domain)
        assert code == 0, output
        yield
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=60.0) == 0


def test_every_command_of_the_page(tmp_path: Path) -> None:
    margins, make, monitor, *replays, viewer, alone = LINES
    assert monitor == 'ros2 run aurora_nodes monitor'
    assert viewer == 'ros2 run aurora_nodes viewer'
    assert len(replays) == 3
    with own_domain() as domain:
        code, output = shell(make, tmp_path, domain)
        assert code == 0, output
        (run,) = (tmp_path / 'runs').iterdir()
        with nodes(ForkedNode('aurora_nodes.monitor', domain, tmp_path)):
            for line in replays:
                code, output = shell(line.replace('<run_id>', run.name), tmp_path, domain)
                assert code == 0, f'{line}\n{output}'
                assert 'to the last bit' in output or '"equal": true' in output
            code, output = shell(f'{margins} --once', tmp_path, domain)
            assert code == 0, output
            assert 'verdict: ' in output
        with viewing(viewer, domain):
            code, output = shell(alone.replace('<run_id>', run.name), tmp_path, domain)
            assert code == 0, output
            assert f'replayed run {run.name}' in output
            code, output = shell('ros2 topic echo /markers --once', tmp_path, domain)
            assert code == 0, output
            assert 'ns: buildings' in output
