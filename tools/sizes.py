# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Modules and lines of the product by package, at one or more commits, as a table.

python tools/sizes.py BEFORE AFTER
"""

from __future__ import annotations

import io
import subprocess
import sys
import tarfile
from collections import Counter
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
# A package of this one is a row of its own.
_CORE = 'aurora_core'
# Packages that measure, build and test the product.
_BESIDE = {'aurora_bench', 'aurora_setup', 'aurora_system_tests'}
_NO_PRODUCT = {'test', 'testing', 'maps', 'launch'}


def row_of(path: PurePosixPath) -> str | None:
    """Return the package that a file counts for, None for tests and what is no Python."""
    folders = path.parts[:-1]
    if path.suffix != '.py' or path.name == 'setup.py' or _NO_PRODUCT & set(folders):
        return None
    inner = [number for number, name in enumerate(folders) if name.startswith('aurora')]
    if not inner or folders[inner[-1]] in _BESIDE:
        return None
    name = folders[inner[-1]]
    rest = folders[inner[-1] + 1 :]
    return f'{name}.{rest[0]}' if name == _CORE and rest else name


def sizes(commit: str) -> tuple[Counter[str], Counter[str]]:
    """Return modules and lines by package at a commit.

    Raises:
        subprocess.CalledProcessError: There is no such commit.
    """
    archive = subprocess.run(
        ['git', 'archive', '--format=tar', commit], cwd=ROOT, capture_output=True, check=True
    ).stdout
    modules: Counter[str] = Counter()
    lines: Counter[str] = Counter()
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        for member in tar:
            row = row_of(PurePosixPath(member.name))
            stream = tar.extractfile(member) if row and member.isfile() else None
            if row and stream is not None:
                modules[row] += 1
                lines[row] += stream.read().count(b'\n')
    return modules, lines


def table(commits: list[str]) -> str:
    """Return the table: modules / lines by package, a column for each commit."""
    found = [sizes(commit) for commit in commits]
    names = sorted({name for modules, _ in found for name in modules})
    head = ['package', *(commit[:10] for commit in commits)]
    rows = [[n, *(f'{m[n]} / {count[n]}' if m[n] else '–' for m, count in found)] for n in names]
    rows.append(['all', *(f'{m.total()} / {count.total()}' for m, count in found)])
    marks = ['---', *('---:' for _ in commits)]
    return '\n'.join(f'| {" | ".join(cells)} |' for cells in (head, marks, *rows))


if __name__ == '__main__':
    sys.stdout.write(f'{table(sys.argv[1:] or ["HEAD"])}\n')
