# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The way of a file to a verdict: import, measure, check, run, verify, each as a command."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from aurora_bench.maps.calls import Called, call
from aurora_bench.maps.hostile import CLASSES, NAMES

STEPS = ('import', 'measure', 'check', 'run', 'verify')
# A line that ends a command in words is no longer than that, and says nothing of Python.
_MOST_LINES = 3
_WIDE = 600
_OURS = 'aurora: '


@dataclass(kw_only=True)
class Journey:
    """What became of a file.

    Attributes:
        file: As it was named.
        seconds: Wall time by step.
        facts: What the import said of the map.
        stands: Vehicles that stood where they were tried, and how many were tried.
        status: Of the run; empty where there was none.
        trace: Its hash.
        same: Verification found every recorded margin again.
        problem: What a step said that did not end well.
        peak_mib: Memory of the greatest step.
    """

    file: str
    seconds: dict[str, float] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)
    stands: tuple[int, int] = (0, 0)
    status: str = ''
    trace: str = ''
    same: bool = False
    problem: str = ''
    peak_mib: float = 0.0

    @property
    def is_whole(self) -> bool:
        """Whether every step ended well, with a verified run."""
        return not self.problem and self.same and self.status == 'verified'


def journey(file: Path, number: int, prompt: str, folder: Path) -> Journey:
    """Take a file all the way.

    Args:
        file: Of a map.
        number: Of the file; its map is called after it.
        prompt: What is to happen there.
        folder: For the map and the run.
    """
    done, name = Journey(file=file.name), f'map{number}'
    maps = {'AURORA_MAPS': str(folder / 'maps')}
    runs = folder / f'runs{number}'

    def step(which: str, *arguments: str) -> Called:
        called = call(arguments, folder, maps)
        done.seconds[which] = round(called.seconds, 2)
        done.peak_mib = max(done.peak_mib, called.peak_mib)
        if called.code != 0 and not done.problem:
            done.problem = f'{which}: {_last(called)}'
        return called

    here = ('map', 'import', str(file.absolute()), '--name', name, '--no-measure', '--json')
    imported = step('import', *here)
    if imported.code != 0:
        return done
    done.facts = json.loads(imported.out)
    measured = step('measure', 'map', 'measure', name, '--json')
    if measured.code != 0:
        return done
    rows = json.loads(measured.out)['records']['spawns']
    done.stands = (sum(r['stands'] for r in rows), sum(r['tried'] for r in rows))
    step('check', 'check', '--map', name, prompt)
    step('run', 'run', '--map', name, '--out', str(runs), prompt)
    found = sorted(runs.glob('*/report.json'))
    if len(found) != 1:
        done.problem = done.problem or 'run: it left no report'
        return done
    report = json.loads(found[0].read_text(encoding='utf-8'))
    done.status = str(report['status'])
    verified = step('verify', 'verify', str(found[0].parent), '--json')
    if verified.out:
        answer = json.loads(verified.out)
        done.same = verified.code == 0 and answer['outcome'] == done.status
        done.trace = str(answer.get('trace_sha256') or '')
    return done


@dataclass(frozen=True, slots=True, kw_only=True)
class Refused:
    """How a file or a name that will not do was answered.

    Args:
        kind: Of harm.
        file: Its name.
        said: The line.
        problem: What is wrong with the answer; empty when nothing is.
        seconds: Wall time.
        peak_mib: Memory.
    """

    kind: str
    file: str
    said: str
    problem: str
    seconds: float
    peak_mib: float


def refusals(folder: Path, tell: Callable[[str], None]) -> tuple[Refused, ...]:
    """Try to import one file of every class, and to give a map every bad name.

    Args:
        folder: Empty; files and maps go there.
        tell: Is told each class when it is done.
    """
    found: list[Refused] = []
    files = folder / 'files'
    files.mkdir()
    for kind, (name, make) in CLASSES.items():
        make(files / name)
        found.append(_refused(kind, name, [str(files / name), '--name', 'x'], folder))
        tell(f'{kind}: {found[-1].problem or "refused"}')
    good = files / 'good.osm'
    good.write_bytes(b'<osm version="0.6"></osm>')
    for name in NAMES:
        found.append(_refused('name of a map', repr(name), [str(good), f'--name={name}'], folder))
        tell(f'{name!r}: {found[-1].problem or "refused"}')
    return tuple(found)


def _refused(kind: str, name: str, arguments: Sequence[str], folder: Path) -> Refused:
    maps = folder / 'maps'
    before = _names(folder)
    called = call(('map', 'import', *arguments), folder, {'AURORA_MAPS': str(maps)})
    said = _last(called)
    lines = _answer(called)
    problems = []
    if called.code not in (4, 64):
        problems.append(f'exit code {called.code}')
    if called.out or len(lines) > _MOST_LINES or len(said) > _WIDE or 'Traceback' in called.err:
        problems.append('not one clear line')
    if 'defect' in called.err:
        problems.append('called a defect of AURORA')
    if (maps.exists() and any(maps.iterdir())) or _names(folder) - {'maps'} != before - {'maps'}:
        problems.append('something was left behind')
    return Refused(
        kind=kind,
        file=name,
        said=said.replace(f'{folder}/files/', ''),
        problem=', '.join(problems),
        seconds=round(called.seconds, 2),
        peak_mib=round(called.peak_mib, 1),
    )


def _names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()} | {'out.txt', 'err.txt'}


def _answer(called: Called) -> list[str]:
    """Return the lines of what a command says at last; before it there is progress."""
    lines = [line.strip() for line in called.err.splitlines() if line.strip()]
    begins = [k for k, line in enumerate(lines) if line.startswith(_OURS)]
    return lines[begins[-1] :] if begins else lines


def _last(called: Called) -> str:
    lines = _answer(called) or [line for line in called.out.splitlines() if line.strip()]
    return ' '.join((lines or [f'exit code {called.code}'])[:_MOST_LINES]).removeprefix(_OURS)
