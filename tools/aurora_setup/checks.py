# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What must be on the machine before anything is installed; each failure is one clear line."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import sysconfig
from pathlib import Path

from console import SetupError
from layout import SYSTEM, SYSTEM_PREFIX, WHEELS, Layout

# The virtual environment takes 1.6 GB, the build 0.2 GB, pip's cache and unpacking the rest.
DISK_NEEDED_BYTES = 4 * 1000**3
# What SUMO's wheels are linked with and do not bring along, and the Debian package of each.
LIBRARIES = {
    'libX11.so.6': 'libx11-6',
    'libXext.so.6': 'libxext6',
    'libXrender.so.1': 'libxrender1',
    'libGL.so.1': 'libgl1',
}


def check_machine(layout: Layout, *, fresh: bool) -> None:
    """Refuse a machine on which the set-up would fail later.

    Args:
        layout: Paths of the checkout.
        fresh: Whether the virtual environment has to be made, so that room is needed for it.

    Raises:
        SetupError: With what is missing and what to install.
    """
    check_compiler()
    check_libraries()
    check_python_parts(layout)
    if fresh:
        check_disk(layout.root)


def check_ros_choice(layout: Layout) -> None:
    """Refuse an unknown ``AURORA_ROS``, and ``system`` where no ROS 2 Jazzy is installed."""
    if layout.ros not in (WHEELS, SYSTEM):
        raise SetupError(f'AURORA_ROS={layout.ros} is neither wheels (the default) nor system')
    if layout.ros == SYSTEM and not (SYSTEM_PREFIX / 'setup.bash').is_file():
        raise SetupError(
            f'AURORA_ROS=system, but {SYSTEM_PREFIX} has no ROS 2 Jazzy; install '
            'ros-jazzy-ros-base and python3-colcon-common-extensions, or unset AURORA_ROS '
            'to use the wheels'
        )
    if layout.ros == SYSTEM and layout.python_tag != '3.12':
        raise SetupError(
            f'AURORA_ROS=system needs the Python 3.12 of ROS 2 Jazzy, this is '
            f'{layout.python_tag}; unset PYTHON or set it to /usr/bin/python3'
        )


def check_compiler() -> None:
    """Refuse a machine without C and C++ compilers or make: aurora_msgs is compiled."""
    missing = [
        ' or '.join(names)
        for names in (
            (os.environ.get('CXX', 'g++'), 'c++'),
            (os.environ.get('CC', 'gcc'), 'cc'),
            ('make', 'gmake'),
        )
        if not any(shutil.which(name.split()[0]) for name in names)
    ]
    if missing:
        raise SetupError(
            f'no {" and no ".join(missing)} on PATH; install a C++ compiler and make '
            '(Debian, Ubuntu: apt install g++ make)'
        )


def check_libraries() -> None:
    """Refuse a machine without the libraries that SUMO loads, though it draws nothing here."""
    missing = [name for name in LIBRARIES if not _loads(name)]
    if missing:
        raise SetupError(
            f'SUMO needs {", ".join(missing)}, which this machine lacks; install them '
            f'(Debian, Ubuntu: apt install {" ".join(LIBRARIES[name] for name in missing)})'
        )


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def check_python_parts(layout: Layout) -> None:
    """Refuse a Python without ensurepip or headers (Debian ships both separately)."""
    tag = layout.python_tag
    if importlib.util.find_spec('ensurepip') is None or importlib.util.find_spec('venv') is None:
        raise SetupError(
            f'this Python {tag} cannot make virtual environments; install them '
            f'(Debian, Ubuntu: apt install python{tag}-venv)'
        )
    header = Path(sysconfig.get_paths()['include']) / 'Python.h'
    if not header.is_file():
        raise SetupError(
            f'the headers of Python {tag} are missing ({header}); install them '
            f'(Debian, Ubuntu: apt install python{tag}-dev)'
        )


def check_disk(folder: Path, needed_bytes: int = DISK_NEEDED_BYTES) -> None:
    """Refuse a disk with too little room left.

    Args:
        folder: Any folder on the disk.
        needed_bytes: Room that must be free.
    """
    free_bytes = shutil.disk_usage(folder).free
    if free_bytes < needed_bytes:
        raise SetupError(
            f'{free_bytes / 1000**3:.1f} GB free on the disk of {folder}, '
            f'{needed_bytes / 1000**3:.0f} GB needed; make room and call again'
        )
