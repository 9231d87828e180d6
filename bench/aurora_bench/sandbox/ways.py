# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How a program is contained on this machine: bubblewrap, else namespaces of our own, else not.

Both end in `inside/guard.py`, which adds limits and a filter of system calls. A way counts only
after a program that looks around in it has found nothing (`probe`).
"""

from __future__ import annotations

import json
import shutil
import sys
import sysconfig
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from aurora_core.errors import AuroraError

INSIDE = Path(__file__).resolve().parent / 'inside'
_LIBRARIES = ('/lib', '/lib64', '/usr/lib', '/usr/lib64', '/usr/local/lib')


class SandboxError(AuroraError):
    """Nothing on this machine contains a program."""

    default_component = 'sandbox'


class WayName(StrEnum):
    """The ways, the preferred one first."""

    BUBBLEWRAP = 'bubblewrap'
    NAMESPACES = 'namespaces'


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramLimits:
    """What a program may use.

    Attributes:
        cpu_s: Processor seconds of the program itself, without the simulators.
        wall_s: Seconds that are spent waiting for it, all together.
        memory_bytes: Its address space.
        output_bytes: What it may print.
        requests: Requests to the scene.
    """

    cpu_s: int = 60
    wall_s: float = 180.0
    memory_bytes: int = 1 << 29
    output_bytes: int = 1 << 16
    requests: int = 200_000


def command(way: WayName, limits: ProgramLimits, root: Path) -> tuple[str, ...]:
    """Return the command that runs a program; the program comes on its standard input.

    Args:
        way: How it is contained.
        limits: What it may use.
        root: An empty folder, its new root.
    """
    python = str(Path(sys.executable).resolve())
    guard = (
        python, '-I', '-S', '-B', '/scene/guard.py',
        str(limits.cpu_s), str(limits.memory_bytes), str(limits.output_bytes),
    )  # fmt: skip
    binds, links = _kept(python)
    if way is WayName.NAMESPACES:
        config = {
            'root': str(root), 'binds': binds, 'links': links, 'scene': str(INSIDE), 'argv': guard,
        }  # fmt: skip
        return (python, '-I', '-S', '-B', str(INSIDE / 'enter.py'), json.dumps(config))
    options = [
        'bwrap', '--unshare-all', '--die-with-parent', '--new-session', '--cap-drop', 'ALL',
        '--clearenv', '--setenv', 'LANG', 'C.UTF-8',
    ]  # fmt: skip
    for path in binds:
        options += ['--ro-bind', path, path]
    options += ['--ro-bind', str(INSIDE), '/scene']
    for name, target in links.items():
        options += ['--symlink', target, name]
    return (*options, '--remount-ro', '/', '--chdir', '/', '--', *guard)


def _kept(python: str) -> tuple[tuple[str, ...], dict[str, str]]:
    """Return the paths that an interpreter needs, none inside another, and links at the top."""
    paths = {Path(python), Path(sysconfig.get_path('stdlib')).resolve()}
    base = Path(sys.base_prefix).resolve()
    paths.update(p for p in (base / 'lib').glob('libpython*.so*') if p.is_file())
    links: dict[str, str] = {}
    for name in _LIBRARIES:
        path = Path(name)
        if path.is_symlink():
            links[name] = str(path.readlink())
            continue
        if path.is_dir():
            paths.add(path)
    cache = Path('/etc/ld.so.cache')
    if cache.is_file():
        paths.add(cache)
    kept = sorted(str(p) for p in paths if not any(q in p.parents for q in paths))
    return tuple(kept), links


def ways() -> tuple[WayName, ...]:
    """Return the ways that might do here, without a probe."""
    bubblewrap = (WayName.BUBBLEWRAP,) if shutil.which('bwrap') else ()
    return (*bubblewrap, WayName.NAMESPACES)
