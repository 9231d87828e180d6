# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator and the script of docs/autopilot.md, in real time, as a reader would run them."""

from __future__ import annotations

import re
import socket
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parents[3] / 'docs' / 'autopilot.md'
LIMIT_S = 200.0


def _free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(('127.0.0.1', 0))
        return int(probe.getsockname()[1])


def test_the_script_flies_and_comes_home() -> None:
    text = PAGE.read_text(encoding='utf-8')
    (script,) = re.findall(r'```python\n(.*?)```', text, re.DOTALL)
    started = re.search(r'^ros2 run aurora_uav_sim uav_sim (.*)$', text, re.MULTILINE)
    assert started is not None
    ports = {'14540': str(_free_port()), '14550': str(_free_port())}
    options = started[1]
    for named, free in ports.items():
        options, script = options.replace(named, free), script.replace(named, free)
    command = 'import sys; from aurora_uav_sim.udp_main import main; sys.exit(main())'
    simulator = subprocess.Popen([sys.executable, '-c', command, *options.split()])
    try:
        done = subprocess.run(
            [sys.executable, '-c', script],
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
            check=False,
        )
    finally:
        simulator.terminate()
        simulator.wait(timeout=30.0)
    assert done.returncode == 0, done.stdout + done.stderr
    assert 'home again, battery' in done.stdout
