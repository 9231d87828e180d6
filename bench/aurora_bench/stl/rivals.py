# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The virtual environment of the rivals: made when it is not there or its lock has changed.

Some of them need versions that the product must not have (antlr4 4.7, attrs below 23), so they
never go into the product's environment.
"""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
import venv
from pathlib import Path

from aurora_core.errors import AuroraError

# Looked for and left out: distribution and why.
LEFT_OUT = (
    ('stlrom 0.4.0', 'no wheel; its C++ does not build from the source distribution'),
    ('tltk-mtl 0.0.27', 'no wheel; its C does not build from the source distribution'),
    ('moonlight 0.3.1', 'needs a Java runtime'),
    ('signal-temporal-logic 0.1.3', 'no distribution for Python 3.11 or later (fork: pystlogic)'),
    ('metric-temporal-fuzzy-logic 0.0.6', 'needs other versions of what metric-temporal-logic '
     'needs; an extension of it by fuzzy connectives'),
    ('past-mtl-monitors 0.1.0', 'truth values only'),
    ('commonroad-stl-monitor 2025.1.1', 'needs torch; rules of traffic, no formulas of the user; '
     'no distribution for Python 3.12'),
    ('stlcg', 'not on the package index'),
)  # fmt: skip

_BUILD_TOOLS = ('setuptools', 'wheel')


class RivalsError(AuroraError):
    """The environment of the rivals cannot be made."""

    default_component = 'bench'


def rivals_python(root: Path) -> Path:
    """Return the interpreter of the rivals' environment, installing it when necessary.

    Args:
        root: Of the checkout.

    Raises:
        RivalsError: A package does not install.
    """
    lock = root / 'requirements' / f'rivals-py{sys.version_info[0]}.{sys.version_info[1]}.txt'
    folder = root / '.venv-rivals'
    stamp, python = folder / 'lock.sha256', folder / 'bin' / 'python'
    digest = hashlib.sha256(lock.read_bytes()).hexdigest()
    if stamp.is_file() and stamp.read_text(encoding='ascii') == digest:
        return python
    venv.create(folder, clear=True, with_pip=True, symlinks=True)
    tools = folder / 'build-tools.txt'
    tools.write_text(_entries(lock.read_text(encoding='utf-8'), _BUILD_TOOLS), encoding='utf-8')
    for requirements in (tools, lock):
        _install(python, requirements)
    stamp.write_text(digest, encoding='ascii')
    return python


def _entries(lock: str, names: tuple[str, ...]) -> str:
    """Return the entries of some packages; the hashes of an entry are indented."""
    entries = re.split(r'^(?=\S)', lock, flags=re.MULTILINE)
    return ''.join(entry for entry in entries if entry.partition('==')[0] in names)


def _install(python: Path, requirements: Path) -> None:
    """Install with hashes; what comes as source only is built with the locked setuptools."""
    # What the ROS wheels put into the environment of this process must not reach the rivals.
    clean = {name: value for name, value in os.environ.items() if name != 'PYTHONPATH'}
    done = subprocess.run(
        [
            str(python), '-m', 'pip', '--disable-pip-version-check', '--no-input', 'install',
            '--quiet', '--no-deps', '--require-hashes', '--no-build-isolation',
            '-r', str(requirements),
        ],
        env=clean,
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    if done.returncode != 0:
        raise RivalsError(
            f'{requirements.name} does not install: {done.stderr.strip()[-500:]}',
            hint='is the package index reachable?',
        )
