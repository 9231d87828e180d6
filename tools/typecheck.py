# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""mypy over the sources and tests of every package (options in pyproject.toml).

Test folders are no packages, so mypy knows their files by their bare names, and two files of one
name (every conftest.py, to begin with) cannot be checked in one go. They go into rounds; what one
round has analysed, the next takes from mypy's cache.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def package_folders() -> list[Path]:
    """Return the folders that tools/packages.sh names."""
    output = subprocess.run(
        [ROOT / 'tools' / 'packages.sh'], capture_output=True, text=True, check=True
    ).stdout
    return [ROOT / line for line in output.splitlines()]


def rounds_of(files: list[Path]) -> list[list[Path]]:
    """Spread files over as few rounds as their names allow.

    Args:
        files: Python files; one inside a package (beside an `__init__.py`) never clashes.
    """
    rounds: list[list[Path]] = [[]]
    seen: dict[str, int] = {}
    for file in files:
        if (file.parent / '__init__.py').is_file():
            rounds[0].append(file)
            continue
        turn = seen.get(file.stem, 0)
        seen[file.stem] = turn + 1
        if turn == len(rounds):
            rounds.append([])
        rounds[turn].append(file)
    return rounds


def main() -> int:
    """Check everything; return the exit code."""
    folders = package_folders()
    files = sorted(
        file.relative_to(ROOT)
        for folder in folders
        for file in folder.rglob('*.py')
        if file.name != 'setup.py' and '__pycache__' not in file.parts
    )
    folders += [folder / 'test' / 'helpers' for folder in folders]
    folders += [ROOT / 'tools' / 'aurora_setup', ROOT / 'config' / 'maps']
    environment = {**os.environ, 'MYPYPATH': os.pathsep.join(map(str, folders))}
    failed = False
    os.chdir(ROOT)
    for batch in rounds_of(files):
        command = [sys.executable, '-m', 'mypy', *map(str, batch)]
        failed |= subprocess.run(command, env=environment, check=False).returncode != 0
    return int(failed)


if __name__ == '__main__':
    sys.exit(main())
