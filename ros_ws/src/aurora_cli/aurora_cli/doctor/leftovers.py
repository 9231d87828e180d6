# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What dead processes have left: shared memory of the middleware, runs without a report."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from aurora_cli.doctor.machine import Finding, Machine
from aurora_cli.doctor.processes import process_ids

# Fast DDS names its files so; `_el` and `sem.` belong to them.
_PATTERNS = ('fastrtps_*', 'sem.fastrtps_*', 'fastdds_*', 'sem.fastdds_*')
# A file this young may have been made for somebody who is about to open it.
_YOUNG_S = 10.0
_NAMED_AT_MOST = 3


def shared_memory(machine: Machine) -> list[Finding]:
    """No shared memory of the middleware is left without a process that uses it.

    Dead is a file of this user's that no process has mapped or open; those of other users are not
    ours to judge.
    """
    files = [
        path
        for pattern in _PATTERNS
        for path in sorted(machine.shm.glob(pattern))
        if _is_ours_and_old(path, machine)
    ]
    if not files:
        return []
    used = used_paths(machine.proc, machine.shm, process_ids(machine.proc))
    dead = tuple(path for path in files if str(path) not in used)
    if not dead:
        return []
    size = sum(_size(path) for path in dead)
    more = f' and {len(dead) - _NAMED_AT_MOST} more' if len(dead) > _NAMED_AT_MOST else ''
    return [
        Finding(
            expected=f'no files of the middleware in {machine.shm} without a process',
            found=f'{len(dead)} ({size / 1e6:.1f} MB): '
            f'{", ".join(path.name for path in dead[:_NAMED_AT_MOST])}{more}',
            fix='aurora doctor --fix',
            dead=dead,
        )
    ]


def unfinished_runs(machine: Machine) -> list[Finding]:
    """No run is left without a report by a process that has ended."""
    from aurora_core.files import MANIFEST_BYTES, read_bytes
    from aurora_core.report.manifest import Manifest
    from aurora_core.report.run_folder import MANIFEST, REPORT, is_run_id

    findings = []
    for path in sorted(machine.runs.glob(f'*/{MANIFEST}')):
        folder = path.parent
        if not is_run_id(folder.name) or (folder / REPORT).exists():
            continue
        try:
            manifest = Manifest.model_validate_json(read_bytes(path, MANIFEST_BYTES))
        except (OSError, ValueError):
            findings.append(
                Finding(
                    expected=f'a readable {path}',
                    found='it is no manifest, and the run has no report',
                    fix=f'rm -r {folder}',
                )
            )
            continue
        if not machine.lives(manifest.process):
            findings.append(
                Finding(
                    expected=f'a report of run {folder.name}',
                    found=f'process {manifest.process.pid}, which ran it, has ended without one',
                    fix=f'aurora doctor --fix --runs {machine.runs} (closes it as error)',
                )
            )
    return findings


def remove(finding: Finding) -> bool:
    """Remove what is dead of a finding; tell whether all of it is gone."""
    for path in finding.dead:
        path.unlink(missing_ok=True)
    return bool(finding.dead)


def _is_ours_and_old(path: Path, machine: Machine) -> bool:
    try:
        facts = path.stat(follow_symlinks=False)
    except OSError:
        return False
    return facts.st_uid == machine.uid and machine.wall_s() - facts.st_mtime > _YOUNG_S


def used_paths(proc: Path, shm: Path, pids: Iterable[int]) -> set[str]:
    """Return every path below `shm` that one of some processes has mapped or open."""
    used: set[str] = set()
    wanted = f'{shm}/'
    for pid in pids:
        folder = proc / str(pid)
        try:
            for line in (
                (folder / 'maps').read_text(encoding='utf-8', errors='replace').split('\n')
            ):
                start = line.find(wanted)
                if start >= 0:
                    used.add(line[start:])
            for descriptor in (folder / 'fd').iterdir():
                target = os.readlink(descriptor)
                if target.startswith(wanted):
                    used.add(target)
        except OSError:
            continue  # it has ended meanwhile, or belongs to somebody else
    return used


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
