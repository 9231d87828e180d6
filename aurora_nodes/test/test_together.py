# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`together`: nodes as forks of one process, each as `up` would have started it alone."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_ros.matching import wait_until
from aurora_ros.processes import process_state
from aurora_ros.testing.domains import own_domain

CODE = 'import sys\nfrom aurora_nodes.together import main\nsys.exit(main())'
LIMIT_S = 30.0


def together(folder: Path, domain: int, lines: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, '-c', CODE, str(folder), str(folder)],
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain), 'ROS_LOG_DIR': str(folder / 'ros_log')},
        input=lines,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )


def _has_ended(pid: int) -> bool:
    return process_state(pid) is None


def test_a_node_that_is_unknown_starts_none(tmp_path: Path) -> None:
    done = together(tmp_path, 1, 'sync -\nnobody -\n')
    assert (done.returncode, done.stderr) == (1, 'there is no node nobody\n')
    assert list(tmp_path.iterdir()) == []


@pytest.mark.ros
def test_each_node_has_its_group_its_core_its_files_and_its_end(tmp_path: Path) -> None:
    core = min(os.sched_getaffinity(0))
    with own_domain() as domain:
        done = together(tmp_path, domain, f'sync {core}\nrecorder -\n')
        assert done.returncode == 0, done.stderr
        pids = {}
        try:
            for name in ('sync', 'recorder'):
                words = (tmp_path / f'{name}.pid').read_text().split()
                pids[name] = int(words[0])
                state = process_state(pids[name])
                assert state is not None
                assert words[1] == str(state.started)
                assert wait_until((tmp_path / f'{name}.ready').exists, LIMIT_S)
                assert (tmp_path / f'{name}.ready').read_text().split() == [words[0]]
                assert os.getpgid(pids[name]) == pids[name]
                assert Path(f'/proc/{pids[name]}/comm').read_text() == f'{name}\n'
            assert os.sched_getaffinity(pids['sync']) == {core}
            assert os.sched_getaffinity(pids['recorder']) == os.sched_getaffinity(0)
        finally:
            for pid in pids.values():
                os.killpg(pid, signal.SIGINT)
        for name, pid in pids.items():
            assert wait_until(partial(_has_ended, pid), LIMIT_S), name
            assert not (tmp_path / f'{name}.ready').exists()
            assert 'Traceback' not in (tmp_path / f'{name}.log').read_text()


@pytest.mark.ros
def test_a_node_does_not_wait_for_what_others_import(tmp_path: Path) -> None:
    with own_domain() as domain:
        done = together(tmp_path, domain, 'sumo_bridge -\nsync -\n')
        assert done.returncode == 0, done.stderr
        pids = [
            int((tmp_path / f'{n}.pid').read_text().split()[0]) for n in ('sync', 'sumo_bridge')
        ]
        try:
            maps = [Path(f'/proc/{pid}/maps').read_text() for pid in pids]
            assert ['libsumo' in text for text in maps] == [False, True]
        finally:
            for pid in pids:
                os.killpg(pid, signal.SIGKILL)
