# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Seven components die in three ways in each of three phases of a run."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterable
from enum import StrEnum
from itertools import product
from typing import Any

from aurora_bench.faults.client import Client, Run, trace_hash
from aurora_bench.faults.live_graph import NAMES, CampaignError, LiveGraph, wait_for
from aurora_core.document import Document

PROMPT = (
    'A drone ascends to 40 meters and then follows a motorcycle as it drives through the streets.'
)
FLYING_FROM_S = 5.0
LEFT_LIMIT_S = 5.0
WHOLE_LIMIT_S = 150.0
_ROS_NAMES = tuple(name for name in NAMES if name != 'uav_sim')


class Component(StrEnum):
    """Who dies."""

    SYNC = 'sync'
    SUMO_BRIDGE = 'sumo_bridge'
    UAV_BRIDGE = 'uav_bridge'
    UAV_SIM = 'uav_sim'
    EXECUTOR = 'executor'
    MONITOR = 'monitor'
    RECORDER = 'recorder'


class Blow(StrEnum):
    """How."""

    KILL = 'SIGKILL'
    STOP = 'SIGSTOP'
    CRASH = 'SIGSEGV'


class Phase(StrEnum):
    """When."""

    LOADING = 'loading'
    FLYING = 'flying'
    VERIFYING = 'verifying'


LIMITS_S = {Blow.KILL: 5.0, Blow.STOP: 8.0, Blow.CRASH: 5.0}


class Cell(Document):
    """One death."""

    component: Component
    blow: Blow
    phase: Phase

    @property
    def name(self) -> str:
        """As `--only` matches it."""
        return f'{self.component}-{self.blow}-{self.phase}'


class CellResult(Document):
    """What came of it.

    Attributes:
        hit_at: Stage and simulated time of the feedback at the moment of the blow.
        seconds: From the blow to the result of the run, with report and picture.
        noticed_s: From the blow to the begin of the report.
        named: Component of the report's error.
        left: What of the run was still going on LEFT_LIMIT_S later.
        next_status: Of a prompt sent at once.
        next_equal: That prompt left the same trace as before the campaign.
        next_s: How long it took, with the restart.
        note: What went wrong with the cell itself.
    """

    cell: Cell
    hit_at: str = ''
    seconds: float | None = None
    noticed_s: float | None = None
    status: str = ''
    named: str = ''
    error_code: int = 0
    message: str = ''
    left: tuple[str, ...] = ()
    next_status: str = ''
    next_equal: bool = False
    next_s: float | None = None
    note: str = ''

    @property
    def held(self) -> bool:
        """Whether everything was as it must be."""
        return (
            not self.note
            and self.status == 'error'
            and self.error_code != 0
            and self.named == self.cell.component
            and self.seconds is not None
            and self.seconds <= LIMITS_S[self.cell.blow]
            and not self.left
            and self.next_status == 'verified'
            and self.next_equal
        )


def cells(only: Iterable[str] = ()) -> list[Cell]:
    """Return the cells whose name holds one of the words, all without words."""
    words = tuple(only)
    # In turn: `up` gives up a node that dies too often within a minute.
    every = [
        Cell(component=component, blow=blow, phase=phase)
        for phase, blow, component in product(Phase, Blow, Component)
    ]
    return [cell for cell in every if not words or any(word in cell.name for word in words)]


def run_cell(graph: LiveGraph, client: Client, cell: Cell, expected_hash: str) -> CellResult:
    """Run a prompt, strike, look what comes of it and whether the next prompt works."""
    wait_for('every node serves', graph.is_whole, WHOLE_LIMIT_S)
    run = client.begin(PROMPT)
    if not run.wait_until(lambda now: _is_time(now, cell.phase)):
        ended = f'{run.result.status}, {run.result.error_msg}' if run.result else run.error
        return CellResult(cell=cell, note=f'ended before {cell.phase}: {ended}')
    os.kill(graph.pid(cell.component), signal.Signals[cell.blow])
    struck_s = time.monotonic()
    hit_at = f'{run.stage} {run.sim_time_s:.1f} s'
    result = run.wait()
    if result is None:
        return CellResult(cell=cell, hit_at=hit_at, note=run.error)
    text = str(result.error_msg)
    facts: dict[str, Any] = {
        'cell': cell,
        'hit_at': hit_at,
        'seconds': round(run.ended_s - struck_s, 2),
        'noticed_s': round((run.reported_s or run.ended_s) - struck_s, 2),
        'status': str(result.status),
        'named': text.partition(':')[0],
        'error_code': int(result.error_code),
        'message': text.partition('\n')[0],
        'left': _left(graph, client),
    }
    begun_s = time.monotonic()
    after = client.run(PROMPT)
    return CellResult(
        **facts,
        next_status=str(after.result.status) if after.result is not None else after.error,
        next_equal=trace_hash(after.result) == expected_hash,
        next_s=round(time.monotonic() - begun_s, 2),
        note=str(after.result.error_msg) if after.result is not None else '',
    )


def _is_time(run: Run, phase: Phase) -> bool:
    if phase is Phase.LOADING:
        return run.stage == 'execute' and run.sim_time_s == 0.0
    if phase is Phase.FLYING:
        return run.stage == 'execute' and run.sim_time_s >= FLYING_FROM_S
    return run.stage == 'verify'


def _left(graph: LiveGraph, client: Client) -> tuple[str, ...]:
    """Return what is left of the run, after as long as it may take to end."""
    found: list[str] = []

    def nothing() -> bool:
        found[:] = [f'{name} is busy' for name in client.busy(_ROS_NAMES)]
        if graph.is_busy():
            found.append('the run is not over')
        return not found

    try:
        wait_for('the run is over', nothing, LEFT_LIMIT_S)
    except CampaignError:
        return tuple(found)
    return ()
