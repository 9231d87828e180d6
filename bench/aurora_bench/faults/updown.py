# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Start and stop the graph again and again."""

from __future__ import annotations

import signal
import time
from enum import StrEnum

from aurora_bench.faults.live_graph import CALL_LIMIT_S, LiveGraph
from aurora_core.document import Document


class Ending(StrEnum):
    """How a graph is stopped."""

    DOWN = 'down'
    INTERRUPT = 'SIGINT'
    TERMINATE = 'SIGTERM'


EXIT_CODES = {Ending.DOWN: 0, Ending.INTERRUPT: 130, Ending.TERMINATE: 143}


class Round(Document):
    """One start and stop.

    Attributes:
        up_s: Until every node serves.
        down_s: Until everything is stopped.
        exit_code: Of `down`, or of the `up` that got the signal.
        shared_memory: Files of Fast DDS that the nodes used.
        forced: Nodes that did not heed the first signal.
        left: What was left.
    """

    ending: Ending
    up_s: float
    down_s: float
    exit_code: int
    shared_memory: int
    forced: tuple[str, ...]
    left: tuple[str, ...]

    @property
    def held(self) -> bool:
        """Whether everything was as it must be."""
        return self.exit_code == EXIT_CODES[self.ending] and not self.left


def run_round(graph: LiveGraph, number: int) -> Round:
    """Start and stop once; the endings take turns."""
    ending = list(Ending)[number % len(Ending)]
    begun_s = time.monotonic()
    if ending is Ending.DOWN:
        graph.up()
        ready_s = time.monotonic()
        used = graph.footprint()
        done = graph.call(('ros2', 'run', 'aurora_bringup', 'down'))
        code, said = done.returncode, done.stdout
    else:
        process = graph.foreground()
        ready_s = time.monotonic()
        used = graph.footprint()
        process.send_signal(signal.Signals[ending])
        said, _ = process.communicate(timeout=CALL_LIMIT_S)
        code = process.returncode
    return Round(
        ending=ending,
        up_s=round(ready_s - begun_s, 2),
        down_s=round(time.monotonic() - ready_s, 2),
        exit_code=code,
        shared_memory=len(used.shared_memory),
        forced=tuple(line for line in said.splitlines() if 'only SIG' in line),
        left=tuple(graph.leftovers(used)),
    )
