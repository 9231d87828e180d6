# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Disk, memory, cores, clocks."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from datetime import UTC, datetime
from pathlib import Path

from aurora_cli.doctor.machine import Finding, Machine

# A run of a minute leaves a few MB; a campaign of a hundred, some hundred.
DISK_FREE_BYTES = 1_000_000_000
INODES_FREE = 10_000
# The graph needs 1.3 GB, the local engine 0.3 GB.
MEMORY_FREE_BYTES = 2_000_000_000
CORES = 2
DESCRIPTORS = 256
_MOST_RESOLUTION_S = 1e-3
_SETBACK_S = 60.0


def disk(machine: Machine) -> list[Finding]:
    """Runs and temporary files have room and may be written."""
    findings = []
    for what, folder in (('runs', machine.runs), ('temporary files', machine.temp)):
        place = _existing(folder.absolute())
        usage = shutil.disk_usage(place)
        if usage.free < DISK_FREE_BYTES:
            findings.append(
                Finding(
                    expected=f'{DISK_FREE_BYTES / 1e9:.0f} GB free for {what} ({place})',
                    found=f'{usage.free / 1e9:.2f} GB',
                    fix=f'make room: du -sh {folder}/* | sort -h | tail',
                )
            )
        inodes = os.statvfs(place)
        if inodes.f_files and inodes.f_favail < INODES_FREE:
            findings.append(
                Finding(
                    expected=f'room for {INODES_FREE} more files for {what} ({place})',
                    found=f'room for {inodes.f_favail}',
                    fix=f'make room: du --inodes -d1 {place} | sort -n | tail',
                )
            )
        problem = _write_problem(place)
        if problem:
            findings.append(
                Finding(
                    expected=f'{what} can be written to {place}',
                    found=problem,
                    fix='choose another folder: aurora run --out DIR'
                    if what == 'runs'
                    else 'export TMPDIR=DIR',
                )
            )
    return findings


def memory(machine: Machine) -> list[Finding]:
    """The graph has memory, cores and file descriptors."""
    findings = []
    free = _available_bytes(machine.proc)
    if free is not None and free < MEMORY_FREE_BYTES:
        findings.append(
            Finding(
                expected=f'{MEMORY_FREE_BYTES / 1e9:.0f} GB of memory to be had',
                found=f'{free / 1e9:.2f} GB',
                fix='end what takes it: ps aux --sort=-rss | head',
            )
        )
    cores = len(os.sched_getaffinity(0))
    if cores < CORES:
        findings.append(
            Finding(
                expected=f'{CORES} cores',
                found=f'{cores}: runs are right, but several times slower than they could be',
                fix='give the container or machine more cores (docker run --cpus 2)',
            )
        )
    most = _soft_limit(machine.proc, 'Max open files')
    if most is not None and most < DESCRIPTORS:
        findings.append(
            Finding(
                expected=f'{DESCRIPTORS} open files per process',
                found=str(most),
                fix='ulimit -n 1024',
            )
        )
    return findings


def clocks(machine: Machine) -> list[Finding]:
    """The wall clock is not behind what it has written, and steady time is fine enough."""
    findings = []
    now_s = machine.wall_s()
    newest_s = max((_run_time_s(name) for name in _names(machine.runs)), default=0.0)
    if machine.checkout is not None:
        newest_s = max(newest_s, (machine.checkout / 'ros_ws' / 'setup.bash').stat().st_mtime)
    if now_s < newest_s - _SETBACK_S:
        findings.append(
            Finding(
                expected=f'a wall clock after {_utc(newest_s)} (files and runs are of then)',
                found=_utc(now_s),
                fix='sudo timedatectl set-ntp true (run ids are made of the time)',
            )
        )
    resolution_s = time.get_clock_info('monotonic').resolution
    if resolution_s > _MOST_RESOLUTION_S:
        findings.append(
            Finding(
                expected=f'steady time in steps of {_MOST_RESOLUTION_S:g} s or less',
                found=f'{resolution_s:g} s',
                fix='choose another clock source: /sys/devices/system/clocksource',
            )
        )
    return findings


def _existing(folder: Path) -> Path:
    """The folder, or the nearest one above it that exists."""
    while not folder.is_dir() and folder != folder.parent:
        folder = folder.parent
    return folder


def _write_problem(folder: Path) -> str:
    try:
        with tempfile.NamedTemporaryFile(dir=folder, prefix='.aurora-doctor-') as file:
            file.write(b'x' * 4096)
            file.flush()
    except OSError as err:
        return err.strerror or str(err)
    return ''


def _available_bytes(proc: Path) -> int | None:
    try:
        text = (proc / 'meminfo').read_text(encoding='ascii')
    except OSError:
        return None
    for line in text.splitlines():
        name, _, rest = line.partition(':')
        if name == 'MemAvailable':
            return int(rest.split()[0]) * 1024
    return None


def _soft_limit(proc: Path, name: str) -> int | None:
    try:
        text = (proc / 'self' / 'limits').read_text(encoding='ascii')
    except OSError:
        return None
    for line in text.splitlines():
        if line.startswith(name):
            soft = line[len(name) :].split()[0]
            return int(soft) if soft.isdecimal() else None
    return None


def _names(runs: Path) -> list[str]:
    return [path.name for path in runs.iterdir()] if runs.is_dir() else []


def _run_time_s(name: str) -> float:
    """When a run began, from its id; 0 for anything else."""
    try:
        begun = datetime.strptime(name.partition('-')[0], '%Y%m%dT%H%M%SZ')
    except ValueError:
        return 0.0
    return begun.replace(tzinfo=UTC).timestamp()


def _utc(time_s: float) -> str:
    return datetime.fromtimestamp(time_s, UTC).strftime('%Y-%m-%d %H:%M:%S UTC')
