# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Processes as the kernel tells of them, and the nodes that `up` has started."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

# In the order of starting (aurora_bringup/scripts/common.bash).
NODES = (
    'uav_sim', 'sync', 'sumo_bridge', 'uav_bridge', 'recorder', 'monitor', 'executor', 'grounding',
    'parser', 'repair', 'orchestrator',
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeFiles:
    """What the run folder says of a node, and what the kernel says of its process.

    Attributes:
        name: Of the node.
        pid_file: Path of the pid file.
        pid: Process id, None when the file cannot be read.
        state: Letter of the kernel (`T` = stopped); '' when the process has ended.
        is_ready: Whether its ready file is there.
    """

    name: str
    pid_file: Path
    pid: int | None
    state: str
    is_ready: bool

    @property
    def ready_file(self) -> Path:
        """Path of the ready file."""
        return self.pid_file.with_suffix('.ready')


def node_files(run_dir: Path, proc: Path) -> list[NodeFiles]:
    """Return every node that the run folder knows, sorted by name."""
    found = []
    for path in sorted(run_dir.glob('*.pid')):
        words = _read(path).split()
        pid = int(words[0]) if words and words[0].isdecimal() else None
        state = _state(words, proc) if pid is not None else ''
        name = path.stem
        ready = path.with_suffix('.ready').exists()
        found.append(NodeFiles(name=name, pid_file=path, pid=pid, state=state, is_ready=ready))
    return found


def _state(words: list[str], proc: Path) -> str:
    """The state of the process that a pid file means; '' when it is gone (ids are used again)."""
    boot = _read(proc / 'sys' / 'kernel' / 'random' / 'boot_id').strip()
    if len(words) > 2 and boot and words[2] != boot:
        return ''
    state, started = look(int(words[0]), proc)
    return state if len(words) < 2 or started == words[1] else ''


def look(pid: int, proc: Path) -> tuple[str, str]:
    """Return state and start time of a process; ('', '') when it has ended.

    One that has ended and whose parent has not asked for its exit code (`Z`) has ended.
    """
    # The name in parentheses may hold blanks: state and start time come after it.
    fields = _read(proc / str(pid) / 'stat').rpartition(')')[2].split()
    if len(fields) < 20 or fields[0] in ('Z', 'X'):
        return '', ''
    return fields[0], fields[19]


def command_line(pid: int, proc: Path) -> str:
    """Return the command line of a process, '' when it cannot be read."""
    return _read(proc / str(pid) / 'cmdline').replace('\0', ' ').strip()


def process_ids(proc: Path) -> list[int]:
    """Return the ids of all processes."""
    return sorted(int(path.name) for path in proc.iterdir() if path.name.isdecimal())


def descendants(pid: int, proc: Path) -> list[int]:
    """Return the ids of all processes below a process."""
    found = []
    for path in sorted((proc / str(pid) / 'task').glob('*/children')):
        for child in map(int, _read(path).split()):
            found += [child, *descendants(child, proc)]
    return found


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding='utf-8', errors='replace')
    except OSError:
        return ''
