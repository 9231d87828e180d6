# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R16: the clock of the machine jumps, stands or races while a run goes on (libfaketime).

The library is Debian's `libfaketime`; AURORA_FAKETIME names it where it lies elsewhere. Steady
time is left alone, as the kernel leaves it alone when somebody sets the clock. Only the local
engine is tried: under libfaketime no run of a graph came to its end within three minutes.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from aurora_bench.trust.documents import PROMPT, quiet_run
from aurora_bench.trust.part import NOTHING, Counter, Found

_COMMAND = 'from aurora_cli.main import main; main()'
_LIMIT_S = 240.0
_LOOK_S = 0.01
_BETWEEN_S = 1.2
# What libfaketime is told, one after the other.
_MOVES: tuple[tuple[str, ...], ...] = (
    ('+1s',), ('-1s',), ('+1h',), ('-1h',), ('+400d',), ('-400d',), ('@2038-01-19 03:14:00',),
    ('@1970-01-02 00:00:00',), ('+0 x50',), ('+0 x0.02',), ('-2h', '+2h', '-5s', '+5s', '-2h'),
)  # fmt: skip
# A file of the run folder that is there from that moment on.
_MOMENTS = {'reading': 'prompt.txt', 'flying': 'agsg.0.json', 'judging': 'bag.0/metadata.yaml'}
_DURATION_S = 3600.0


def library() -> Path | None:
    """Return libfaketime, None where it is not installed."""
    named = os.environ.get('AURORA_FAKETIME', '')
    places = (
        [Path(named)] if named else sorted(Path('/usr/lib').glob('*/faketime/libfaketimeMT.so.1'))
    )
    return next((path for path in places if path.is_file()), None)


def surroundings(clock: Path, preloaded: Path) -> dict[str, str]:
    """Return what makes a process read its time of day from a file.

    Args:
        clock: The file; it is written here, with the right time.
        preloaded: The library.
    """
    _set(clock, '+0')
    return {
        'LD_PRELOAD': str(preloaded),
        'FAKETIME_TIMESTAMP_FILE': str(clock),
        # Without it every look at the time would read the file.
        'FAKETIME_CACHE_DURATION': '1',
        'FAKETIME_DONT_FAKE_MONOTONIC': '1',
        'DONT_FAKE_MONOTONIC': '1',
    }


def _set(clock: Path, told: str) -> None:
    new = clock.with_suffix('.new')
    new.write_text(told + '\n')
    os.replace(new, clock)


def _untried() -> Found:
    sys.stderr.write('trust: no libfaketime (apt-get install libfaketime): clocks not moved\n')
    return NOTHING


def moved(first: int, count: int, folder: Path) -> Found:
    """Move the clock in a run of the local engine.

    A case holds when status and trace are those of an undisturbed run, no duration in the report
    is negative or of another hour, and the run is verified again afterwards.
    """
    preloaded = library()
    if preloaded is None:
        return _untried()
    counter = Counter()
    wanted = _undisturbed(folder)
    for number in range(first, first + count):
        moment = tuple(_MOMENTS)[number % len(_MOMENTS)]
        moves = _MOVES[number // len(_MOMENTS) % len(_MOVES)]
        runs, clock = folder / f'runs{number}', folder / f'clock{number}'
        process = subprocess.Popen(
            [sys.executable, '-c', _COMMAND, 'run', PROMPT, '--json', '--out', str(runs)],
            env={**os.environ, **surroundings(clock, preloaded)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        came = came_about(runs, _MOMENTS[moment], process, _LIMIT_S)
        _move(clock, moves)
        said, complaint = end_of(process, _LIMIT_S)
        problem = '' if came else f'the moment never came: {complaint.decode()[-200:]}'
        problem = problem or _problem(process.returncode, said, wanted)
        counter.add(f'{" ".join(moves)} while {moment}: {problem}' if problem else '')
    return counter.found()


@cache
def _undisturbed(folder: Path) -> tuple[int, str]:
    code, report = quiet_run(folder / 'undisturbed')
    return code, report['trace']['sha256']


def came_about(runs: Path, name: str, process: subprocess.Popen[bytes], limit_s: float) -> bool:
    """Wait for a file of the run folder; return False when the run ended, or hangs, without it."""
    until_s = time.monotonic() + limit_s
    while process.poll() is None and time.monotonic() < until_s:
        if any(runs.glob(f'*/{name}')):
            return True
        time.sleep(_LOOK_S)
    return any(runs.glob(f'*/{name}'))


def end_of(process: subprocess.Popen[bytes], limit_s: float) -> tuple[bytes, bytes]:
    """Return what a run said at its end; one that does not end is killed, and that told."""
    try:
        return process.communicate(timeout=limit_s)
    except subprocess.TimeoutExpired:
        process.kill()
        said, complaint = process.communicate()
        return said, complaint + f' it did not end in {limit_s:g} s'.encode()


def _move(clock: Path, moves: tuple[str, ...]) -> None:
    for k, told in enumerate(moves):
        if k:
            time.sleep(_BETWEEN_S)
        _set(clock, told)


def _problem(code: int, said: bytes, wanted: tuple[int, str]) -> str:
    try:
        report = json.loads(said)
    except ValueError:
        return f'exit code {code} and no report'
    if (code, report['trace']['sha256']) != wanted:
        return f'it ends as {report["status"]} with another code or trace'
    return impossible_duration(report)


def impossible_duration(report: Mapping[str, Any]) -> str:
    """Return which duration of a report cannot be, '' when all can."""
    for name, seconds in report['timing'].items():
        if isinstance(seconds, int | float) and not 0.0 <= seconds <= _DURATION_S:
            return f'{name} took {seconds} s'
    return ''
