# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What this process holds of the machine, and whether it has grown."""

from __future__ import annotations

import gc
import os
from dataclasses import dataclass
from pathlib import Path

from aurora_bench.results import Goal

# Names that belong to ROS graphs of other processes: the local engine loads no DDS.
_FOREIGN = 'fastrtps'

# Memory may grow by this share: allocators do not give back every page.
MEMORY_SHARE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Holdings:
    """Memory, descriptors, threads and shared memory.

    Attributes:
        memory_mib: Resident memory of the process.
        descriptors: Open file descriptors.
        threads: Threads, those of libraries too.
        shared_memory: Names in /dev/shm, of the whole machine but for those of DDS.
    """

    memory_mib: float
    descriptors: int
    threads: int
    shared_memory: frozenset[str]


def holdings() -> Holdings:
    """Return what the process holds now, garbage collected."""
    gc.collect()
    status = dict(
        line.split(':', 1)
        for line in Path('/proc/self/status').read_text(encoding='ascii').splitlines()
    )
    shared = Path('/dev/shm')
    names = [p.name for p in shared.iterdir()] if shared.is_dir() else []
    return Holdings(
        memory_mib=int(status['VmRSS'].split()[0]) / 1024.0,
        descriptors=len(os.listdir('/proc/self/fd')),
        threads=int(status['Threads']),
        shared_memory=frozenset(name for name in names if _FOREIGN not in name),
    )


def growth_goals(early: Holdings, late: Holdings, early_runs: int, runs: int) -> tuple[Goal, ...]:
    """Return what must hold between an early and the last sample.

    Args:
        early: After `early_runs` runs.
        late: After all.
        early_runs: Runs before the early sample: every lazy table exists by then.
        runs: Runs in all.
    """
    since = f'after {runs} runs against {early_runs}'
    share = late.memory_mib / early.memory_mib - 1.0
    left = sorted(late.shared_memory - early.shared_memory)
    return (
        Goal(
            name=f'resident memory {since}',
            target=f'at most {MEMORY_SHARE:.0%} more',
            figure=f'{share:+.1%} ({early.memory_mib:.0f} to {late.memory_mib:.0f} MiB)',
            met=share <= MEMORY_SHARE,
        ),
        Goal(
            name=f'open descriptors {since}',
            target='equal',
            figure=f'{early.descriptors} and {late.descriptors}',
            met=late.descriptors == early.descriptors,
        ),
        Goal(
            name=f'threads {since}',
            target='equal',
            figure=f'{early.threads} and {late.threads}',
            met=late.threads == early.threads,
        ),
        Goal(
            name=f'new names in /dev/shm {since}',
            target='none',
            figure=', '.join(left) or 'none',
            met=not left,
        ),
    )
