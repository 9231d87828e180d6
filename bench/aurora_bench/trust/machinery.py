# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R14, R16, R21, R22: promises that the tests and tools of the checkout count."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import xml.etree.ElementTree as Xml
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.trust.part import Counter, Found

ROOT = Path(__file__).resolve().parents[3]
_LIMIT_S = 1800.0


def _tests(files: Sequence[str], select: str = '') -> Found:
    """Run tests that start no ROS node and count them; one that was skipped did not hold."""
    counter = Counter()
    with tempfile.TemporaryDirectory() as folder:
        told = Path(folder) / 'told.xml'
        chosen = ['-k', select] if select else []
        subprocess.run(
            [sys.executable, '-m', 'pytest', '-q', '-m', 'not ros', f'--junitxml={told}', *chosen,
             *files],
            cwd=ROOT, capture_output=True, timeout=_LIMIT_S, check=False,
        )  # fmt: skip
        if not told.exists():
            counter.add('the tests could not be run')
            return counter.found()
        for case in Xml.parse(told).getroot().iter('testcase'):
            bad = next((part.tag for part in case if part.tag != 'properties'), '')
            counter.add(f'{case.get("name")}: {bad}' if bad else '')
    return counter.found()


def clients(first: int, count: int, folder: Path) -> Found:
    """Fly by MAVSDK: connect, missions, way home, offboard, parameters, battery, fence."""
    return _tests(('bridges/aurora_uav_sim/test/test_mavsdk.py',))


def clocks(first: int, count: int, folder: Path) -> Found:
    """Pause, jump, repeat and lose time, as far as tests do so."""
    files = (
        'bridges/aurora_sync', 'aurora_nodes', 'ros_ws/src/aurora_ros',
        'bridges/aurora_uav_sim/test',
    )  # fmt: skip
    return _tests(files, 'clock or silence or silent or stall or barrier or real_time')


# Words in the names of tests that plant a fault.
_SUMO_FAULTS = (
    'refuse or finite or cannot_be_placed or outside_the_roster or does_not_exist or bad_order '
    'or numbers_are_checked or do_not_fit or gap_is_an_error or removed_agent or overlapping '
    'or out_elsewhere'
)


def sumo(first: int, count: int, folder: Path) -> Found:
    """Unknown ids, numbers that are none, bad places and orders: refused by name, nothing ends."""
    return _tests(('bridges/aurora_sumo_bridge/test',), _SUMO_FAULTS)


def failsafes(first: int, count: int, folder: Path) -> Found:
    """Link, offboard stream, battery, fence: the documented state within the stated time."""
    files = (
        'bridges/aurora_uav_sim/test/test_pilot.py', 'bridges/aurora_uav_sim/test/test_battery.py',
        'bridges/aurora_uav_sim/test/test_autopilot.py',
    )  # fmt: skip
    return _tests(
        files, 'fence or battery or link or silen or losing or lost or loss or stream or sticks'
    )


def supply_chain(first: int, count: int, folder: Path) -> Found:
    """Every package of every lock has hashes and a licence that may be."""
    sys.path.insert(0, str(ROOT / 'tools'))
    try:
        import supply_chain as tool
    finally:
        sys.path.pop(0)
    counter = Counter()
    for lock in sorted(tool.REQUIREMENTS.glob('*.txt')):
        problems = {problem.split()[1]: problem for problem in tool.lock_problems(lock)}
        for package in tool.read_lock(lock):
            counter.add(problems.get(package.name, ''))
    return counter.found()


def findings(first: int, count: int, folder: Path) -> Found:
    """Ruff, mypy, the import rules and bandit find nothing."""
    counter = Counter()
    for what, command in (
        ('lint', ['tools/lint.sh']),
        ('types', [sys.executable, 'tools/typecheck.py']),
    ):
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, timeout=_LIMIT_S, check=False
        )
        counter.add(f'{what}: {done.stdout[-200:]}' if done.returncode else '')
    return counter.found()
