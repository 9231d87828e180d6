# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R16, R18: time zones and languages change no trace; what there is too little of is told."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from aurora_bench.trust.documents import PROMPT, quiet_run
from aurora_bench.trust.part import Counter, Found

_COMMAND = 'from aurora_cli.main import main; main()'
_LIMIT_S = 300.0
_PLACES: tuple[dict[str, str], ...] = (
    {'TZ': 'Asia/Kathmandu'}, {'TZ': 'America/St_Johns'}, {'TZ': 'Pacific/Kiritimati'},
    {'TZ': 'nowhere/at_all'}, {'TZ': 'AAA+99:99'}, {'TZ': ''},
    {'LC_ALL': 'C'}, {'LC_ALL': 'de_DE.UTF-8'}, {'LC_ALL': 'tr_TR.UTF-8'}, {'LC_ALL': 'none.XX'},
    {'LC_ALL': 'C', 'PYTHONUTF8': '0', 'PYTHONCOERCECLOCALE': '0'}, {'PYTHONHASHSEED': '7'},
)  # fmt: skip
# Descriptors, and MiB of address space, which numpy alone takes 200 of; enough of both comes last.
_LIMITS: tuple[tuple[int, int], ...] = (
    *((resource.RLIMIT_NOFILE, most) for most in (5, 8, 12, 16, 20, 24, 32, 64)),
    *((resource.RLIMIT_AS, most << 20) for most in (300, 400, 500, 600, 800, 1000, 1500, 4000)),
)


def places(first: int, count: int, folder: Path) -> Found:
    """Run with other time zones and languages; status and trace are as ever."""
    counter = Counter()
    code, report = quiet_run(folder / f'as_ever{first}')
    wanted = (code, report['trace']['sha256'])
    for number in range(first, first + count):
        changes = _PLACES[number % len(_PLACES)]
        done = _run(folder / f'place{number}', changes)
        try:
            found = (done.returncode, json.loads(done.stdout)['trace']['sha256'])
            problem = '' if found == wanted else f'it ends with {found[0]} and another trace'
        except (ValueError, KeyError, TypeError):
            problem = f'exit code {done.returncode}: {done.stderr[-200:].decode(errors="replace")}'
        counter.add(f'{changes}: {problem}' if problem else '')
    return counter.found()


def limits(first: int, count: int, folder: Path) -> Found:
    """Run with few descriptors and little memory.

    A case holds when the run is verified, or the exit code is 4 and a sentence says what there is
    too little of; no signal ends it, and no traceback is shown.
    """
    counter = Counter()
    for number in range(first, first + count):
        which, most = _LIMITS[number % len(_LIMITS)]

        def limit(which: int = which, most: int = most) -> None:
            resource.setrlimit(which, (most, most))

        done = _run(folder / f'limit{number}', {}, limit)
        what = 'descriptors' if which == resource.RLIMIT_NOFILE else 'bytes'
        problem = told_badly(done)
        counter.add(f'{most} {what}: {problem}' if problem else '')
    return counter.found()


def _run(
    folder: Path, changes: Mapping[str, str], limit: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, '-c', _COMMAND, 'run', PROMPT, '--json', '--out', str(folder)],
        env={**os.environ, **changes},
        capture_output=True,
        timeout=_LIMIT_S,
        check=False,
        preexec_fn=limit,
    )


def told_badly(done: subprocess.CompletedProcess[bytes]) -> str:
    """Return what is wrong with how a run ended that had too little of something."""
    said = (done.stderr + done.stdout).decode(errors='replace')
    if done.returncode == 0:
        return ''
    if done.returncode != 4:
        return f'exit code {done.returncode}: {said[-200:]}'
    if 'Traceback' in said:
        return f'a traceback is shown: {said[-200:]}'
    told = 'ulimit' in said or 'Too many open files' in said
    return '' if told else f'what there is too little of is not said: {said[-200:]}'
