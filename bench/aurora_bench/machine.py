# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Facts about the machine, quoted beside every measurement."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from pydantic import FiniteFloat

from aurora_core.document import Document
from aurora_core.report.versions import product_versions

# Packages beside the product's own list that decide how fast something runs.
_PACKAGES = ('ros-jazzy-rclpy', 'ros-jazzy-rmw-fastrtps-cpp', 'pymavlink', 'mcap', 'numba')
_CPU_NAMES = ('model name', 'Model', 'Hardware')
UNKNOWN = 'unknown'
_IDLE = (3, 4)  # columns idle and iowait of /proc/stat


class Machine(Document):
    """Where and when something was measured.

    Attributes:
        date_utc: ISO 8601, to the second.
        cores: Cores that this process may use.
        memory_mib: All of it, 0 when unknown.
        load_average: Over 1, 5 and 15 minutes, when the facts were taken.
        versions: Of the product, Python and the packages that matter; absent packages are left
            out.
    """

    date_utc: str
    cores: int
    cpu: str
    memory_mib: int
    system: str
    python: str
    load_average: tuple[FiniteFloat, FiniteFloat, FiniteFloat]
    versions: Mapping[str, str]


def machine_facts() -> Machine:
    """Return the facts of this machine now."""
    memory = os.sysconf('SC_PAGE_SIZE') * os.sysconf('SC_PHYS_PAGES')
    return Machine(
        date_utc=datetime.now(UTC).strftime('%Y-%m-%dT%H:%M:%SZ'),
        cores=len(os.sched_getaffinity(0)),
        cpu=cpu_model(Path('/proc/cpuinfo')),
        memory_mib=memory // 2**20,
        system=f'{platform.system()} {platform.machine()}',
        python=platform.python_version(),
        load_average=os.getloadavg(),
        versions=dict(sorted({**product_versions(), **_package_versions()}.items())),
    )


def busy_share(
    seconds: float = 1.0,
    stat: Path = Path('/proc/stat'),
    pause: Callable[[float], None] = time.sleep,
) -> float:
    """Return the share of all cores that somebody used for a while, from 0 to 1.

    Call it while the campaign itself does nothing: what is found is other people's work, beside
    which wall times mean little.

    Args:
        seconds: Wall time to look at.
        stat: The kernel's counters.
        pause: Lets the time pass.
    """
    before = _core_times(stat)
    pause(seconds)
    after = _core_times(stat)
    spent = [b - a for a, b in zip(before, after, strict=True)]
    total = sum(spent)
    return 1.0 - sum(spent[k] for k in _IDLE) / total if total > 0 else 0.0


def _core_times(stat: Path) -> list[int]:
    fields = stat.read_text(encoding='ascii').split('\n', 1)[0].split()
    # user, nice, system, idle, iowait, irq, softirq, steal; guests are part of user.
    return [int(field) for field in fields[1:9]]


def cpu_model(cpuinfo: Path) -> str:
    """Return the name of the processor, or "unknown" where the kernel does not tell."""
    try:
        lines = cpuinfo.read_text(encoding='utf-8', errors='replace').splitlines()
    except OSError:
        return UNKNOWN
    for name in _CPU_NAMES:
        for line in lines:
            key, _, value = line.partition(':')
            if key.strip() == name and value.strip():
                return value.strip()
    return UNKNOWN


def _package_versions() -> dict[str, str]:
    found = {}
    for name in _PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found
