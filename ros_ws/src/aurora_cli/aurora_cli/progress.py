# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Progress of a run on standard error: a bar in a terminal, else a line per stage."""

from __future__ import annotations

import sys
import time
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from aurora_cli.output import say

_REFRESH_S = 0.1


class RunProgress:
    """Shows stage, share of the run and simulated time.

    Args:
        stages: Say each stage where there is no terminal to draw a bar in.
        quiet: Show nothing at all.
    """

    def __init__(self, *, stages: bool = True, quiet: bool = False) -> None:
        self._stages = stages and not quiet
        console = Console(file=sys.stderr)
        self._bar: Progress | None = None
        if console.is_terminal and not quiet:
            self._bar = Progress(
                TextColumn('{task.description:<8}'),
                BarColumn(bar_width=36),
                TextColumn('{task.percentage:>3.0f} %'),
                TextColumn('{task.fields[simulated]}'),
                TimeElapsedColumn(),
                console=console,
                transient=True,
            )
        self._task: TaskID | None = None
        self._stage = ''
        self._drawn_s = 0.0

    def __enter__(self) -> Self:
        if self._bar is not None:
            self._bar.start()
            self._task = self._bar.add_task('', total=1.0, simulated='')
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()

    def update(self, stage: str, fraction: float, simulated_s: float) -> None:
        """Show how far the run is (called every tick, drawn ten times a second)."""
        changed = stage != self._stage
        now_s = time.monotonic()
        if not changed and now_s - self._drawn_s < _REFRESH_S:
            return
        self._stage, self._drawn_s = stage, now_s
        if self._bar is not None and self._task is not None:
            shown = f'{simulated_s:.0f} s simulated' if simulated_s > 0.0 else ''
            self._bar.update(self._task, description=stage, completed=fraction, simulated=shown)
        elif changed and self._stages and stage != 'done':
            say(f'aurora: {stage}')
