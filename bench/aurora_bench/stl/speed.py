# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every tool on every cell, each in a process of its own with a time limit."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np

from aurora_bench.stl.cells import Cell
from aurora_bench.stl.tools import OURS, TOOLS, Floats
from aurora_bench.stl.verdict import same_values

_BENCH = Path(__file__).resolve().parents[2]
_PATIENCE = 8


@dataclass(frozen=True, kw_only=True)
class Measured:
    """What one tool gave for one cell.

    Attributes:
        seconds: Of each repetition; empty when it gave nothing.
        values: How its values compare with ours, in words.
        agrees: They are ours, at the first sample and wherever both have one; None: none given.
        note: Why it gave nothing.
        tried: False when a smaller cell had already failed.
        version: Of the distribution.
    """

    tool: str
    cell: Cell
    seconds: tuple[float, ...] = ()
    values: str = ''
    agrees: bool | None = None
    note: str = ''
    tried: bool = True
    version: str = ''

    @property
    def median_s(self) -> float | None:
        """Median of the repetitions."""
        return median(self.seconds) if self.seconds else None


class Speed:
    """Measures tools, ours first, and keeps what they gave.

    Args:
        rivals: Interpreter of the rivals' environment.
        folder: For tasks and values.
        limit_s: Wall time that a process may take.
        patient: Tools and cells that may take eight times as long: goals are judged on them.
    """

    def __init__(
        self,
        rivals: Path,
        folder: Path,
        limit_s: float,
        patient: frozenset[tuple[str, Cell]] = frozenset(),
    ) -> None:
        self._rivals = rivals
        self._folder = folder
        self._limit_s = limit_s
        self._patient = patient
        self._failed: dict[str, list[Measured]] = {}
        self._ours: dict[Cell, Floats] = {}
        self.measured: list[Measured] = []

    def run(self, tool: str, cell: Cell) -> Measured:
        """Measure a tool on a cell, unless it has failed on a smaller one."""
        found = self._skipped(tool, cell) or self._measure(tool, cell)
        self.measured.append(found)
        return found

    def _skipped(self, tool: str, cell: Cell) -> Measured | None:
        for before in self._failed.get(tool, []):
            smaller = before.cell
            if (
                smaller.kind is cell.kind
                and smaller.samples <= cell.samples
                and smaller.window <= cell.window
            ):
                return Measured(tool=tool, cell=cell, note=before.note, tried=False)
        return None

    def _measure(self, tool: str, cell: Cell) -> Measured:
        task = self._folder / 'task.json'
        given = {'tool': tool, 'kind': cell.kind, 'samples': cell.samples, 'window': cell.window}
        task.write_text(json.dumps(given), encoding='utf-8')
        python = Path(sys.executable) if tool == OURS else self._rivals
        limit_s = self._limit_s * (_PATIENCE if (tool, cell) in self._patient else 1)
        code, output, errors = run_limited(
            [str(python), '-m', 'aurora_bench.stl.worker', str(task)],
            _environment(tool),
            limit_s,
        )
        if code is None:
            return self._failure(tool, cell, f'above {limit_s:g} s')
        if code < 0:
            return self._failure(tool, cell, f'crashed ({signal.Signals(-code).name})')
        if code != 0:
            return self._failure(tool, cell, (errors.strip().splitlines() or ['?'])[-1][:120])
        document = json.loads(output.splitlines()[-1])
        if 'absent' in document:
            return self._failure(tool, cell, document['absent'])
        values = np.load(task.with_suffix('.npy'))
        if tool == OURS:
            self._ours[cell] = values
        agrees, words = same_values(cell, self._ours[cell], values)
        return Measured(
            tool=tool,
            cell=cell,
            seconds=tuple(document['seconds']),
            values=words,
            agrees=agrees,
            version=document['version'],
        )

    def _failure(self, tool: str, cell: Cell, note: str) -> Measured:
        found = Measured(tool=tool, cell=cell, note=note)
        self._failed.setdefault(tool, []).append(found)
        return found


def run_limited(
    command: list[str], environment: Mapping[str, str], limit_s: float
) -> tuple[int | None, str, str]:
    """Run a process.

    Returns:
        Exit code (negative: the signal it died of; None: it was stopped at the limit), standard
        output, standard error.
    """
    try:
        done = subprocess.run(
            command,
            env=environment,
            capture_output=True,
            text=True,
            timeout=limit_s,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None, '', ''
    return done.returncode, done.stdout, done.stderr


def _environment(tool: str) -> dict[str, str]:
    own = dict(os.environ)
    if tool != OURS:
        # Of the product's packages the rivals' processes see the benchmarks alone.
        own['PYTHONPATH'] = str(_BENCH)
    return own


def run_all(speed: Speed, cells: list[Cell], say: Callable[[Measured], None]) -> None:
    """Measure every cell with every tool, ours first, side by side."""
    for cell in cells:
        for tool in TOOLS:
            say(speed.run(tool, cell))
