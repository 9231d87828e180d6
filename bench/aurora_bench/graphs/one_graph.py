# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One graph of the campaign: started by `up`, looked at through the kernel, stopped by `down`."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from aurora_cli.doctor.leftovers import used_paths
from aurora_cli.doctor.processes import NODES, descendants, look, node_files
from aurora_cli.doctor.sockets import Socket, listening, sockets_of
from aurora_core.errors import ExecutionError
from aurora_uav_sim.protocol import mavlink_port

PROC = Path('/proc')
SHM = Path('/dev/shm')
UP_LIMIT_S = 240
DOWN_LIMIT_S = 120.0
LOOPBACK = '127.0.0.1'


@dataclass(kw_only=True)
class OneGraph:
    """A graph in a domain and a folder of its own.

    Attributes:
        domain: ROS_DOMAIN_ID.
        folder: Current folder of its nodes; holds its runs and its logs.
        pids: Process ids while it was looked at last, by node.
    """

    domain: int
    folder: Path
    pids: dict[str, list[int]] = field(default_factory=dict)

    @property
    def environment(self) -> dict[str, str]:
        """Environment of everything in this domain."""
        own = {'ROS_DOMAIN_ID': str(self.domain), 'AURORA_RUN_DIR': str(self.folder / 'nodes')}
        return {**os.environ, **own}

    @property
    def run_dir(self) -> Path:
        """Where `up` keeps pid files and ready files."""
        return self.folder / 'nodes' / f'domain-{self.domain}'

    @property
    def runs(self) -> Path:
        """Folder of all runs."""
        return self.folder / 'runs'

    def up(self) -> None:
        """Start every node and wait until all serve.

        Raises:
            ExecutionError: They do not.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        self._call('up', '--detach', '--timeout', str(UP_LIMIT_S), limit_s=UP_LIMIT_S + 30.0)

    def down(self) -> None:
        """Stop every node.

        Raises:
            ExecutionError: Some cannot be stopped.
        """
        self._call('down', limit_s=DOWN_LIMIT_S)

    def look(self) -> dict[str, list[Socket]]:
        """Return the sockets of every node that take something in, and remember the processes."""
        table = listening(PROC)
        found: dict[str, list[Socket]] = {}
        self.pids = {}
        for node in node_files(self.run_dir, PROC):
            if node.pid is None or not node.state:
                continue
            # A real `ros2 run` is the parent of its node; `up` is the parent of all.
            below = [] if node.name == 'up' else descendants(node.pid, PROC)
            pids = [node.pid, *below]
            self.pids[node.name] = pids
            found[node.name] = sorted(s for pid in pids for s in sockets_of(pid, PROC, table))
        return found

    def problems_while_up(self, sockets: dict[str, list[Socket]]) -> list[str]:
        """Say what is not as it should be, from what `look` gave."""
        problems = [f'{name} does not run' for name in NODES if name not in sockets]
        for name, taken in sorted(sockets.items()):
            problems += [
                f'{name} listens on {s.kind} {s.address}:{s.port}'
                for s in taken
                if not s.is_loopback
            ]
        simulator = {s.port for s in sockets.get('uav_sim', []) if s.kind == 'udp'}
        if simulator != {mavlink_port(self.domain)}:
            problems.append(
                f'uav_sim: expected UDP port {mavlink_port(self.domain)}, found {simulator}'
            )
        ours = {pid for pids in self.pids.values() for pid in pids}
        shared = used_paths(PROC, SHM, ours)
        problems += [f'shared memory in use: {path}' for path in sorted(shared) if 'fast' in path]
        return [f'domain {self.domain}: {problem}' for problem in problems]

    def problems_after_down(self) -> list[str]:
        """Say what `down` has left of what was looked at."""
        problems = [
            f'{name} (process {pid}) still lives'
            for name, pids in self.pids.items()
            for pid in pids
            if look(pid, PROC)[0]
        ]
        left = [path.name for kind in ('pid', 'ready') for path in self.run_dir.glob(f'*.{kind}')]
        problems += [f'{name} is left in the run folder' for name in sorted(left)]
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind((LOOPBACK, mavlink_port(self.domain)))
            except OSError as err:
                problems.append(f'MAVLink port: {err.strerror}')
        return [f'domain {self.domain} after down: {problem}' for problem in problems]

    def log_of(self, name: str) -> str:
        """Return the last lines of a node's log."""
        path = self.run_dir / 'log' / f'{name}.log'
        if not path.is_file():
            return ''
        return '\n'.join(path.read_text(encoding='utf-8', errors='replace').splitlines()[-12:])

    def _call(self, *arguments: str, limit_s: float) -> None:
        command = [shutil.which('ros2') or 'ros2', 'run', 'aurora_bringup', *arguments]
        try:
            done = subprocess.run(
                command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit_s, check=False,
            )  # fmt: skip
        except (OSError, subprocess.TimeoutExpired) as err:
            raise ExecutionError(f'{arguments[0]} in domain {self.domain}: {err}') from err
        if done.returncode != 0:
            raise ExecutionError(
                f'{arguments[0]} in domain {self.domain} ended with {done.returncode}: '
                f'{done.stdout.decode(errors="replace")[-1000:]}'
            )
