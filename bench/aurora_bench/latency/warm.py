# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.latency.warm FOLDER RUNS PROMPT`: runs of one prompt in one process.

The first one loads what the later ones find loaded. Stages are told apart by the progress that
every run reports; the JSON on standard output has one entry per run.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from aurora_bench.latency.cold import Spent
from aurora_core.document import Document

LOOP = 'tick loop'
# Stages as progress names them; the tick loop stands apart from what surrounds it.
STAGES = ('parse', 'check', 'ground', 'execute', 'verify', 'report')
_END = 'done'


class WarmRun(Document):
    """One run in a process.

    Attributes:
        status: Of its report.
        motion_sha256: Its motion hash.
        total: From the request to the verdict, with every stage's document written.
        page: The page, which is made when the verdict has been told.
        stages: Each stage; `execute` without the tick loop, which is one by itself.
        ticks: Of the loop.
    """

    status: str
    motion_sha256: str
    total: Spent
    page: Spent
    stages: dict[str, Spent]
    ticks: int


class WarmProcess(Document):
    """What one process did.

    Attributes:
        start: Its start and the imports of the run command.
        runs: In order.
    """

    start: Spent
    runs: tuple[WarmRun, ...]


class Marks:
    """When each stage began, and when the tick loop began and ended."""

    def __init__(self) -> None:
        self.begun: dict[str, tuple[float, float]] = {}
        self.ticks: list[tuple[float, float]] = []

    def mark(self, name: str, _fraction: float, _sim_s: float) -> None:
        """Note the beginning of a stage; a stage that goes on has come to its next tick."""
        now = time.perf_counter(), time.process_time()
        if name not in self.begun:
            self.begun[name] = now
        elif name == 'execute':
            self.ticks = [*self.ticks[:1], now]

    def stages(self) -> dict[str, Spent]:
        """Return what each stage took."""
        names = [name for name in (*STAGES, _END) if name in self.begun]
        spent = {
            name: _between(self.begun[name], self.begun[later]) for name, later in pairwise(names)
        }
        if len(self.ticks) > 1:
            loop, around = _between(self.ticks[0], self.ticks[-1]), spent['execute']
            spent['execute'] = Spent(
                wall_s=around.wall_s - loop.wall_s, cpu_s=around.cpu_s - loop.cpu_s
            )
            spent[LOOP] = loop
        return spent


def _between(begin: tuple[float, float], end: tuple[float, float]) -> Spent:
    return Spent(wall_s=end[0] - begin[0], cpu_s=end[1] - begin[1])


def one_run(prompt: str, folder: Path) -> WarmRun:
    """Run a prompt as `aurora run` does, its folder below `folder`."""
    from aurora_cli.answers import run_request
    from aurora_core.pipeline.stages import RunControl, RunRequest

    begin = time.perf_counter(), time.process_time()
    marks = Marks()
    done = run_request(RunRequest(prompt=prompt), folder, RunControl(progress=marks.mark))
    told = time.perf_counter(), time.process_time()
    done.write_page()
    page = _between(told, (time.perf_counter(), time.process_time()))
    trace = done.trace
    return WarmRun(
        status=done.status,
        motion_sha256='' if trace is None else trace.motion_sha256,
        total=_between(begin, told),
        page=page,
        stages=marks.stages(),
        ticks=0 if trace is None else trace.ticks,
    )


def main(arguments: Sequence[str]) -> int:
    """Run a prompt several times and print what each run took."""
    folder, runs, prompt = arguments
    begun = time.perf_counter()
    import aurora_cli.commands.run  # noqa: F401  (timed)
    from aurora_cli.collector import relax_collector

    relax_collector()  # as the command does
    # CPU time counts from the start of the process, the clock from here.
    start = Spent(wall_s=time.perf_counter() - begun, cpu_s=time.process_time())
    done = tuple(one_run(prompt, Path(folder)) for _ in range(int(runs)))
    sys.stdout.write(json.dumps(WarmProcess(start=start, runs=done).model_dump()))
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
