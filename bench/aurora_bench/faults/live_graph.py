# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A graph started with `up`, and what it leaves behind."""

from __future__ import annotations

import fcntl
import os
import re
import resource
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from aurora_core.errors import AuroraError

NAMES = (
    'uav_sim', 'sync', 'sumo_bridge', 'uav_bridge', 'recorder',
    'monitor', 'executor', 'grounding', 'parser', 'repair', 'orchestrator',
)  # fmt: skip
_START_S = 300
UP = ('ros2', 'run', 'aurora_bringup', 'up', '--timeout', str(_START_S))
DOWN = ('ros2', 'run', 'aurora_bringup', 'down')
CALL_LIMIT_S = 400.0
_SOCKET = re.compile(r'socket:\[(\d+)\]')
_LOOK_S = 0.02


class CampaignError(AuroraError):
    """The campaign itself cannot go on."""

    default_component = 'bench'


@dataclass(frozen=True, slots=True, kw_only=True)
class Footprint:
    """What processes use beside their own memory.

    Attributes:
        shared_memory: Files of Fast DDS that they have mapped.
        sockets: Inodes of their sockets.
    """

    shared_memory: frozenset[str]
    sockets: frozenset[int]


class LiveGraph:
    """Starts and stops a graph of its own and looks at its processes.

    Args:
        folder: For pid files, logs and runs.
        domain: ROS_DOMAIN_ID.
    """

    def __init__(self, folder: Path, domain: int) -> None:
        self._folder = folder
        self._domain = domain
        self._mark = f'AURORA_RUN_DIR={folder / "graph"}'.encode()
        self._environment = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'AURORA_RUN_DIR': str(folder / 'graph'),
        }
        self._environment.pop('ROS_LOG_DIR', None)

    @property
    def run_dir(self) -> Path:
        """Folder of the pid and ready files."""
        return self._folder / 'graph' / f'domain-{self._domain}'

    @property
    def runs(self) -> Path:
        """Folder of the run folders."""
        return self._folder / 'runs'

    def call(self, command: tuple[str, ...]) -> subprocess.CompletedProcess[str]:
        """Run a command of the graph to its end."""
        return subprocess.run(
            command,
            env=self._environment,
            cwd=self._folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=CALL_LIMIT_S,
            check=False,
            preexec_fn=_prepare,
        )

    def up(self) -> None:
        """Start it with `up --detach`.

        Raises:
            CampaignError: It did not start.
        """
        done = self.call((*UP, '--detach'))
        if done.returncode != 0:
            raise CampaignError(f'up ended with {done.returncode}: {done.stderr}')

    def begin(self, command: tuple[str, ...] = UP) -> subprocess.Popen[str]:
        """Begin to start it and return at once."""
        return subprocess.Popen(
            command,
            env=self._environment,
            cwd=self._folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            preexec_fn=_prepare,
        )

    def foreground(self) -> subprocess.Popen[str]:
        """Start it with `up` in the foreground and wait until it is ready.

        Raises:
            CampaignError: It did not start.
        """
        process = self.begin()
        assert process.stdout is not None
        said = ''
        for line in process.stdout:
            said += line
            if line.startswith('all nodes are ready'):
                return process
        raise CampaignError(f'up ended with {process.wait()}: {said}')

    def down(self) -> int:
        """Stop it and return the exit code."""
        return self.call(DOWN).returncode

    def pid(self, name: str) -> int:
        """Return the process id of a node, 0 when none is noted."""
        try:
            return int((self.run_dir / f'{name}.pid').read_text().split()[0])
        except (OSError, ValueError, IndexError):
            return 0

    def is_whole(self) -> bool:
        """Whether every node serves."""
        return all(
            (self.run_dir / f'{name}.ready').exists() and _state(self.pid(name)) in ('R', 'S', 'D')
            for name in NAMES
        )

    def is_busy(self) -> bool:
        """Whether the orchestrator holds the lock of a run."""
        with (self.run_dir / 'busy').open('a') as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
        return False

    def use(self) -> dict[str, tuple[int, int]]:
        """Return resident memory (KiB) and open descriptors of every node."""
        return {name: (_rss_kib(self.pid(name)), _descriptors(self.pid(name))) for name in NAMES}

    def footprint(self) -> Footprint:
        """Return what its processes use now that must be gone when they are."""
        memory: set[str] = set()
        sockets: set[int] = set()
        for pid in self.processes():
            process = Path(f'/proc/{pid}')
            try:
                maps = (process / 'maps').read_text(errors='replace')
                targets = [os.readlink(path) for path in (process / 'fd').iterdir()]
            except OSError:
                continue  # it has just ended
            memory.update(re.findall(r'/dev/shm/\S*fast\S*', maps))
            sockets.update(int(found[1]) for t in targets if (found := _SOCKET.fullmatch(t)))
        return Footprint(shared_memory=frozenset(memory), sockets=frozenset(sockets))

    def processes(self) -> list[int]:
        """Return every process that was started for this graph, whoever its parent is."""
        found = []
        for path in Path('/proc').iterdir():
            if not path.name.isdigit() or int(path.name) == os.getpid():
                continue
            try:
                variables = (path / 'environ').read_bytes().split(b'\0')
            except OSError:
                continue
            if self._mark in variables and _state(int(path.name)) != 'Z':
                found.append(int(path.name))
        return sorted(found)

    def leftovers(self, used: Footprint) -> list[str]:
        """Return what is left of a graph that was stopped.

        Args:
            used: By its processes while it was running.
        """
        lines = Path('/proc/net/udp').read_text().splitlines()[1:]
        bound = {int(line.split()[9]) for line in lines}
        memory = (name for name in sorted(used.shared_memory) if Path(name).exists())
        return [
            *(f'process {pid}' for pid in self.processes()),
            *(f'file {path.name}' for path in self.run_dir.iterdir() if path.suffix),
            *(f'UDP socket {inode}' for inode in sorted(used.sockets & bound)),
            *(f'shared memory {name}' for name in memory),
        ]


def wait_for(what: str, is_true: Callable[[], bool], limit_s: float) -> float:
    """Wait until something is true and return how long it took, s.

    Raises:
        CampaignError: It did not come true within the limit.
    """
    begun_s = time.monotonic()
    while not is_true():
        if time.monotonic() - begun_s > limit_s:
            raise CampaignError(f'{what}: not within {limit_s:g} s')
        time.sleep(_LOOK_S)
    return time.monotonic() - begun_s


def _prepare() -> None:
    # Crashes on purpose leave no core files; a shell's background job hears Ctrl-C all the same.
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _state(pid: int) -> str:
    try:
        stat = Path(f'/proc/{pid}/stat').read_text(errors='replace')
    except OSError:
        return ''
    return stat.rpartition(')')[2].split()[0]


def _rss_kib(pid: int) -> int:
    text = Path(f'/proc/{pid}/status').read_text()
    found = re.search(r'VmRSS:\s+(\d+) kB', text)
    return int(found[1]) if found else 0


def _descriptors(pid: int) -> int:
    return len(list(Path(f'/proc/{pid}/fd').iterdir()))
