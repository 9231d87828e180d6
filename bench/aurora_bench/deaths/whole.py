# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R1: every process of the graph is killed at once; what was finished stays, the rest is told."""

from __future__ import annotations

import json
import os
import random
import signal
import time
from pathlib import Path
from typing import Any

from aurora_bench.bags.recovered import recovered
from aurora_bench.deaths.stages import Undisturbed, make_whole, options
from aurora_bench.faults.client import Client, Run, trace_hash
from aurora_bench.faults.live_graph import LiveGraph
from aurora_bench.faults.matrix import PROMPT as VERIFIED
from aurora_core.document import Document
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.trace import Trace

LOST_LIMIT_S = 1.0
TOLD_LIMIT_S = 5.0
# Three kills of five happen at a random time of the flight, the others as a stage begins.
_IN_FLIGHT, _OF = 3, 5
_STAGES = ('parse', 'check', 'ground', 'verify', 'report')
# Whole once a later stage has begun.
_LEFT_BY = {
    'check': ('spec.0.json',),
    'ground': ('spec.0.json',),
    'execute': ('spec.0.json', 'agsg.0.json'),
    'verify': ('spec.0.json', 'agsg.0.json', 'bag.0'),
    'report': ('spec.0.json', 'agsg.0.json', 'bag.0', 'verdict.0.json'),
}


class WholeKill(Document):
    """One killed graph.

    Attributes:
        number: Of the case; with it alone it is done again.
        planned: What the kill waited for.
        hit_at: Stage of the last feedback at the moment of the kill.
        killed_s: Simulated time of the clock when the signals were sent, in flight.
        lost_s: Simulated time that is not in the recovered bag, in flight.
        told_s: Until the client knew that the graph was gone.
        problems: What must not be.
    """

    number: int
    planned: str
    hit_at: str = ''
    killed_s: float = -1.0
    lost_s: float = 0.0
    told_s: float = 0.0
    problems: tuple[str, ...] = ()

    @property
    def held(self) -> bool:
        """Whether nothing acknowledged was lost and nobody was left waiting."""
        return (
            not self.problems
            and self.lost_s <= LOST_LIMIT_S + 1e-9
            and self.told_s <= TOLD_LIMIT_S
        )


class SeenClock:
    """The simulated time that an observer of `/clock` has seen last."""

    def __init__(self) -> None:
        self.time_s = -1.0

    def on_clock(self, message: Any) -> None:
        """Take in a sample."""
        self.time_s = message.clock.sec + message.clock.nanosec / 1e9


class WholeKiller:
    """Kills one graph after another.

    Args:
        graph: Started and stopped by this.
        client: Sends the prompts.
        known: How they end undisturbed.
        clock: Hears the graph's clock.
        definitions: Of the messages.
    """

    def __init__(
        self,
        graph: LiveGraph,
        client: Client,
        known: Undisturbed,
        clock: SeenClock,
        definitions: MessageDefinitions,
    ) -> None:
        self._graph, self._client, self._known = graph, client, known
        self._clock, self._definitions = clock, definitions
        self._reference: Trace | None = None

    def kill(self, number: int, seed: int) -> WholeKill:
        """Kill the graph in the run of a prompt, start it again and look what there is."""
        self._known.end(VERIFIED)
        make_whole(self._graph)
        reference = self._trace()
        chance = random.Random(f'{seed} {number}')
        last_s = reference.time_s(reference.ticks - 1)
        stage = '' if number % _OF < _IN_FLIGHT else _STAGES[number // _OF % len(_STAGES)]
        at_s = chance.uniform(0.0, last_s - 1.0)
        self._clock.time_s = -1.0
        run = self._client.begin(VERIFIED, options(VERIFIED))
        planned = stage or f'flight {at_s:.2f} s'
        if not run.wait_until(lambda now: self._is_time(now, stage, at_s)):
            return WholeKill(
                number=number, planned=planned, problems=(f'the run ended before: {run.error}',)
            )
        hit_at, killed_s = run.stage, self._clock.time_s
        self._end_everything()
        struck_s = time.monotonic()
        run.wait()
        told_s = round(run.ended_s - struck_s, 2)
        folder = self._graph.runs / run.run_id
        problems = [*unreadable(folder), *missing(folder, hit_at)]
        lost_s = 0.0
        if not stage:
            kept_s, more = recovered(folder / 'bag.0', reference, self._definitions)
            lost_s = round(max(0.0, killed_s - kept_s), 6)
            problems += more
        if hit_at == 'report':
            problems += self._verdict_problems(folder)
        problems += self._start_again()
        return WholeKill(
            number=number,
            planned=planned,
            hit_at=hit_at,
            killed_s=killed_s if not stage else -1.0,
            lost_s=lost_s,
            told_s=told_s,
            problems=tuple(problems),
        )

    def _is_time(self, run: Run, stage: str, at_s: float) -> bool:
        if stage:
            return run.stage == stage
        return run.stage == 'execute' and self._clock.time_s >= at_s

    def _trace(self) -> Trace:
        if self._reference is None:
            wanted = self._known.end(VERIFIED)[1]
            for report in sorted(self._graph.runs.glob('*/report.json')):
                if json.loads(report.read_text())['trace']['sha256'] == wanted:
                    self._reference = read_bag(report.parent / 'bag.0', self._definitions).trace
                    break
        assert self._reference is not None
        return self._reference

    def _end_everything(self) -> None:
        """Stop all of them first, so that none sees another one die."""
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in self._graph.processes():
                try:
                    os.kill(pid, number)
                except ProcessLookupError:
                    continue

    def _verdict_problems(self, folder: Path) -> list[str]:
        verdict = json.loads((folder / 'verdict.0.json').read_text())
        if verdict['status'] != self._known.end(VERIFIED)[0]:
            return [f'the verdict that is left is {verdict["status"]}']
        return []

    def _start_again(self) -> list[str]:
        make_whole(self._graph)
        after = self._client.run(VERIFIED, options(VERIFIED))
        if trace_hash(after.result) != self._known.end(VERIFIED)[1]:
            return [f'the next run is another: {getattr(after.result, "error_msg", after.error)}']
        return []


def unreadable(folder: Path) -> list[str]:
    """Return which documents of a run folder are half written."""
    problems = []
    for path in sorted(folder.glob('*.json')):
        try:
            json.loads(path.read_bytes())
        except ValueError as err:
            problems.append(f'{path.name} is half written: {err}')
    return problems


def missing(folder: Path, stage: str) -> list[str]:
    """Return what of the stages before one is not there."""
    names = ('prompt.txt', *_LEFT_BY.get(stage, ()))
    return [f'{name} is lost' for name in names if not (folder / name).exists()]
