# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The fuzzer itself: installed beside the product, from a lock of its own, into `.venv-fuzz`.

It has wheels for x86-64 alone, so it is no package that working on AURORA needs.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from aurora_core.errors import AuroraError

_FOLDER = '.venv-fuzz'


class FuzzerError(AuroraError):
    """The fuzzer cannot be installed or does not start."""

    default_component = 'bench'


def fuzzer_folder(root: Path) -> Path:
    """Return the folder to import the fuzzer from; install it where it is not.

    Args:
        root: Of the checkout.

    Raises:
        FuzzerError: It does not install.
    """
    lock = root / 'requirements' / f'fuzz-py{sys.version_info[0]}.{sys.version_info[1]}.txt'
    folder = root / _FOLDER
    stamp = folder / 'lock.sha256'
    digest = hashlib.sha256(lock.read_bytes()).hexdigest()
    if stamp.is_file() and stamp.read_text(encoding='ascii') == digest:
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    done = subprocess.run(
        [
            sys.executable, '-m', 'pip', '--disable-pip-version-check', '--no-input', 'install',
            '--quiet', '--no-deps', '--require-hashes', '--only-binary', ':all:',
            '--target', str(folder), '-r', str(lock),
        ],
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    if done.returncode != 0:
        raise FuzzerError(
            f'{lock.name} does not install: {done.stderr.strip()[-500:]}',
            hint='it needs a package index and an x86-64 machine',
        )
    stamp.write_text(digest, encoding='ascii')
    return folder


def environment(root: Path) -> dict[str, str]:
    """Return the environment of a worker: with the fuzzer, and all code as Python.

    Raises:
        FuzzerError: The fuzzer does not install.
    """
    paths = (str(fuzzer_folder(root)), os.environ.get('PYTHONPATH', ''))
    return {
        **os.environ,
        'PYTHONPATH': os.pathsep.join(path for path in paths if path),
        'AURORA_PLAIN_FLIGHT': '1',
    }
