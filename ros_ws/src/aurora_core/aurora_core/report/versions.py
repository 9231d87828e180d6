# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Versions of the product and of what decides results."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

AURORA_VERSION = '0.2.0'

_DECIDING = ('libsumo', 'numpy', 'scipy', 'shapely', 'pydantic', 'rosbags')


def product_versions() -> dict[str, str]:
    """Return the versions that belong into manifest and report."""
    found = {
        'aurora': AURORA_VERSION,
        'python': platform.python_version(),
        'machine': platform.machine(),
    }
    for name in _DECIDING:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = 'unknown'
    return found
