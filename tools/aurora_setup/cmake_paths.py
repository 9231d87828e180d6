# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Adapts the CMake files that the ROS wheels export to the machine they are installed on."""

from __future__ import annotations

import re
import sysconfig
from pathlib import Path

from console import SetupError

# The wheels were built in a container whose interpreters lie here; CMake's generate step
# refuses include folders that do not exist.
_PREFIX = r'/opt/python/cp\d+-cp\d+t?'
_NUMPY_INCLUDE = re.compile(_PREFIX + r'/lib/python3\.\d+t?/site-packages/numpy/_core/include')
_PYTHON_INCLUDE = re.compile(_PREFIX + r'/include/python3\.\d+t?')


def rewrite_builder_paths(prefix: Path, site_packages: Path) -> int:
    """Replace the wheel builder's include folders in every exported CMake file.

    Args:
        prefix: Root of the virtual environment, which the wheels use as install prefix.
        site_packages: Where numpy is installed.

    Returns:
        The number of files changed. Zero when called a second time.

    Raises:
        SetupError: If numpy's headers are not where they belong, or a path of the builder
            that is not known stays behind.
    """
    numpy_include = site_packages / 'numpy' / '_core' / 'include'
    if not numpy_include.is_dir():
        raise SetupError(f'numpy has no headers in {numpy_include}; the run lock needs numpy 2')
    python_include = sysconfig.get_paths()['include']
    changed = 0
    for file in sorted((prefix / 'share').rglob('*.cmake')):
        text = file.read_text()
        new = _NUMPY_INCLUDE.sub(lambda _: str(numpy_include), text)
        new = _PYTHON_INCLUDE.sub(lambda _: python_include, new)
        if new != text:
            file.write_text(new)
            changed += 1
    return changed
