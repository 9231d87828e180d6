# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R14, R16, R21, R22: promises that the tests and tools of the checkout count."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as Xml
from collections.abc import Sequence
from functools import cache
from importlib import import_module
from pathlib import Path

from aurora_bench.trust.part import NOTHING, Counter, Found
from aurora_core.errors import AuroraError

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


# R22: of the whole core, in percent.
LEAST_LINES, LEAST_BRANCHES = 95.0, 90.0
_TESTS_LIMIT_S = 5400.0


@cache
def _tested(folder: Path) -> Path:
    """Run the tests with coverage once; return the folder of what they gave."""
    found = folder / 'coverage'
    subprocess.run(
        ['tools/coverage.sh', str(found)],
        cwd=ROOT, capture_output=True, timeout=_TESTS_LIMIT_S, check=False,
    )  # fmt: skip
    return found


def coverage(first: int, count: int, folder: Path) -> Found:
    """Lines and branches of the core that the tests run; a case each."""
    path = _tested(folder) / 'coverage.json'
    if not path.exists():
        return NOTHING
    totals = json.loads(path.read_text())['totals']
    lines = 100.0 * totals['covered_lines'] / totals['num_statements']
    branches = 100.0 * totals['covered_branches'] / totals['num_branches']
    counter = Counter()
    for what, share, least in (
        ('lines', lines, LEAST_LINES),
        ('branches', branches, LEAST_BRANCHES),
    ):
        counter.figure(f'{what} [%]', round(share, 1))
        counter.add('' if share >= least else f'{share:.1f} % of the {what}, expected {least:g}')
    return counter.found()


def provoked(first: int, count: int, folder: Path) -> Found:
    """Every error code that there is, is provoked by a test; a case each."""
    noted = {
        code
        for path in (_tested(folder) / 'codes').glob('*.json')
        for code in json.loads(path.read_text())
    }
    counter = Counter()
    for code in sorted(codes()):
        counter.add('' if code in noted else f'no test provokes {code}')
    return counter.found()


def codes() -> set[int]:
    """Return the wire codes of all errors that the product may raise."""
    for name in ('aurora_core.errors', 'aurora_uav_bridge.errors'):
        import_module(name)

    def below(kind: type[AuroraError]) -> set[int]:
        found = {kind.default_code}.union(*(below(each) for each in kind.__subclasses__()))
        return found if kind.__module__.partition('.')[0] != 'aurora_bench' else set()

    return below(AuroraError)


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
