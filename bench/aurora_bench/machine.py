# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Facts about the machine, quoted beside every measurement."""

from __future__ import annotations

import os
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from pydantic import FiniteFloat

from aurora_core.report.versions import product_versions
from aurora_core.spec.parameter import Document

# Packages beside the product's own list that decide how fast something runs.
_PACKAGES = ('ros-jazzy-rclpy', 'ros-jazzy-rmw-fastrtps-cpp', 'pymavlink', 'mcap', 'numba')
_CPU_NAMES = ('model name', 'Model', 'Hardware')
UNKNOWN = 'unknown'


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
