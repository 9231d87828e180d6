# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph as a user starts it (`ros2 run aurora_bringup up`), and one without a recorder."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.results import ResultsError
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.processes import NodeProcess

# The processes of a tick, in the order of the figure.
TICK_PROCESSES = (
    'sync',
    'sumo_bridge',
    'uav_bridge',
    'uav_sim',
    'executor',
    'recorder',
    'monitor',
)
# These do nothing during a run.
PROCESSES = (*TICK_PROCESSES, 'parser', 'grounding', 'repair', 'orchestrator')
_UP_LIMIT_S = 120
_UP_SLACK_S = 30.0
_DOWN_LIMIT_S = 60.0

# What a run needs but the recorder (the monitor watches every run): node name and the module that
# holds its main.
_MODULES = {
    'uav_sim': 'aurora_uav_sim.udp_main',
    'sync': 'aurora_sync.node',
    'sumo_bridge': 'aurora_sumo_bridge.node',
    'uav_bridge': 'aurora_uav_bridge.node',
    'recorder': 'aurora_bench.lockstep.null_recorder',
    'monitor': 'aurora_nodes.monitor',
    'executor': 'aurora_nodes.executor',
}


@dataclass(frozen=True, kw_only=True)
class Graph:
    """A graph that is ready.

    Attributes:
        domain: ROS_DOMAIN_ID.
        pids: Process ids by node name.
        cold_start_s: From the command to all nodes ready, wall.
    """

    domain: int
    pids: dict[str, int]
    cold_start_s: float


@contextmanager
def running_graph(folder: Path) -> Iterator[Graph]:
    """Start every node with `up`, in a domain of its own; `down` at the end.

    Args:
        folder: For logs and process ids.

    Raises:
        ResultsError: The graph does not come up, or does not go down.
    """
    with own_domain() as domain:
        environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'AURORA_RUN_DIR': str(folder),
            'ROS_LOG_DIR': str(folder / 'log'),
        }
        begin = time.perf_counter()
        _ros2_run(('up', '--detach', '--timeout', str(_UP_LIMIT_S)), environment, folder)
        cold_start_s = time.perf_counter() - begin
        try:
            run_dir = folder / f'domain-{domain}'
            pids = {name: _pid(run_dir, name) for name in PROCESSES}
            yield Graph(domain=domain, pids=pids, cold_start_s=cold_start_s)
        finally:
            _ros2_run(('down',), environment, folder)


@contextmanager
def graph_without_recorder(folder: Path) -> Iterator[Graph]:
    """Start the nodes of a run; in the recorder's place a node that stores nothing.

    Raises:
        AssertionError: A node does not come up; with its log.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        domain = stack.enter_context(own_domain())
        begin = time.perf_counter()
        nodes = {}
        for name, module in _MODULES.items():
            nodes[name] = NodeProcess(module, domain, folder)
            stack.callback(nodes[name].kill)
        for node in nodes.values():
            node.await_ready()
        pids = {name: node.pid for name, node in nodes.items()}
        yield Graph(domain=domain, pids=pids, cold_start_s=time.perf_counter() - begin)


def _ros2_run(verb: tuple[str, ...], environment: dict[str, str], folder: Path) -> None:
    """Run `up` or `down`; its output goes to a file, which a detached node may keep open."""
    ros2 = shutil.which('ros2')
    if ros2 is None:
        raise ResultsError('there is no ros2 on PATH', hint='source ros_ws/setup.bash first')
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / f'{verb[0]}.log'
    with log.open('ab') as stream:
        try:
            done = subprocess.run(
                [ros2, 'run', 'aurora_bringup', *verb],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=stream,
                timeout=_DOWN_LIMIT_S if verb[0] == 'down' else _UP_LIMIT_S + _UP_SLACK_S,
                check=False,
            )
        except subprocess.TimeoutExpired as err:
            raise ResultsError(f'aurora_bringup {verb[0]} did not end: {err}') from err
    if done.returncode != 0:
        text = log.read_text(encoding='utf-8', errors='replace')[-1000:]
        raise ResultsError(f'aurora_bringup {verb[0]} failed ({done.returncode}):\n{text}')


def _pid(run_dir: Path, name: str) -> int:
    file = run_dir / f'{name}.pid'
    try:
        return int(file.read_text(encoding='ascii').split()[0])
    except (OSError, ValueError, IndexError) as err:
        raise ResultsError(f'{file} does not hold the process id of {name}: {err}') from err
