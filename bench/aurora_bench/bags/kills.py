# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kill the recorder of a running graph at random times and see what its bag still holds.

The tick of the kill is the one that an observer of the clock has just seen when it sends the
signal.
"""

from __future__ import annotations

import json
import os
import random
import signal
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aurora_bench.bags.recovered import recovered
from aurora_core.errors import ExecutionError
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.trace import Trace
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph

PROMPT = (
    'A drone ascends to 40 meters and then follows a motorcycle as it drives through the streets.'
)
LIMIT_S = 120.0
_TRIES = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Kill:
    """One killed recorder.

    Attributes:
        killed_s: Simulated time of the clock when the signal was sent.
        recovered_s: Simulated time up to which the recovered bag is complete.
        status: Of the run.
        component: That the run's error names.
        problem: What must not be, '' when nothing.
    """

    killed_s: float
    recovered_s: float
    status: str
    component: str
    problem: str

    @property
    def lost_s(self) -> float:
        """Simulated time that is not in the recovered bag."""
        return self.killed_s - self.recovered_s


class _Killer:
    """Watches the clock and kills once."""

    def __init__(self) -> None:
        self._pid = 0
        self._at_s = float('inf')
        self.killed_s = -1.0

    def arm(self, pid: int, at_s: float) -> None:
        self.killed_s, self._at_s, self._pid = -1.0, at_s, pid

    def on_clock(self, message: Any) -> None:
        time_s = message.clock.sec + message.clock.nanosec / 1e9
        if self.killed_s < 0.0 and time_s >= self._at_s and self._pid:
            os.kill(self._pid, signal.SIGKILL)
            self.killed_s = time_s


def kill_recorders(
    folder: Path, count: int, seed: int, definitions: MessageDefinitions
) -> Iterator[Kill]:
    """Run the prompt once undisturbed, then `count` times with a recorder that dies."""
    chance = random.Random(seed)
    with running_graph(folder) as graph:
        killer = _Killer()
        graph.play.on(on.CLOCK, killer.on_clock)
        reference = _undisturbed(graph, definitions)
        last_s = reference.time_s(reference.ticks - 1)
        for _ in range(count):
            killer.arm(graph.nodes['recorder'].pid, chance.uniform(0.0, last_s - 1.0))
            result = _run(graph)
            yield _look(result, killer.killed_s, reference, definitions)
            graph.restart('recorder')


def _undisturbed(graph: RunningGraph, definitions: MessageDefinitions) -> Trace:
    """Return the trace of a run that nobody disturbs.

    Raises:
        ExecutionError: None is verified.
    """
    # A machine that is busy with other work may miss a heartbeat: that is no finding here.
    for _ in range(_TRIES):
        whole = _run(graph)
        if whole.status == 'verified':
            return read_bag(Path(whole.run_dir) / 'bag.0', definitions).trace
    raise ExecutionError(
        f'the undisturbed run ended as {whole.status}: {whole.error_msg}\n{graph.logs()}'
    )


def _run(graph: RunningGraph) -> Any:
    goal = RunScenario.Goal(prompt=PROMPT)
    return graph.play.send_goal(on.RUN, goal, LIMIT_S, raise_errors=False)


def _look(result: Any, killed_s: float, reference: Trace, definitions: MessageDefinitions) -> Kill:
    bag = Path(result.run_dir) / 'bag.0'
    problems = []
    if killed_s < 0.0:
        problems.append('the run ended before the kill')
    if result.status != 'error':
        problems.append(f'the run ended as {result.status}')
    recovered_s, more = recovered(bag, reference, definitions)
    return Kill(
        killed_s=killed_s,
        recovered_s=recovered_s,
        status=result.status,
        component=_component(result.report_json),
        problem='; '.join([*problems, *more]),
    )


def _component(report_json: str) -> str:
    error = json.loads(report_json or '{}').get('error') or {}
    return str(error.get('component', ''))
