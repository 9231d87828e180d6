# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Run a grounded scenario in one process: executor, SUMO client and MAVLink client in lockstep.

The same order as the ROS graph: tick 0 is the spawned state; the executor's commands of step k are
applied to reach tick k + 1; everything is recorded with the tick it belongs to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import closing
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import TypeVar

import numpy as np

from aurora_cli.collector import no_collection
from aurora_cli.local_recorder import LocalRecorder
from aurora_core.execution.plan import Execution
from aurora_core.execution.step_output import StepOutput
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.stages import ExecutionResult, RunControl
from aurora_core.ports.simulators import AirSimulator, FloatArray, GroundSimulator
from aurora_core.trace.air_clock import AIR_CLOCKS, AirClock, clocks_note
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.hashing import trace_hashes
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_core.trace.records import EventRecord, LinkRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Trace

Record = TypeVar('Record', LinkRecord, EventRecord)


class TraceCollector:
    """Collects the ticks of one run in order: what the bag gets, without reading it back.

    Args:
        roster: Row order.
    """

    def __init__(self, roster: Roster) -> None:
        self._roster = roster
        self._ticks: list[tuple[FloatArray, FloatArray, StepOutput]] = []

    def add(self, ground: FloatArray, uav: FloatArray, output: StepOutput) -> None:
        """Take the states of the next tick and what the executor made of them.

        The arrays are kept, so they must not change afterwards.
        """
        self._ticks.append((ground, uav, output))

    def trace(self) -> Trace:
        """Return the run so far; the commands of the last step were not applied any more."""
        ground, uav, outputs = zip(*self._ticks, strict=True)
        # What was applied to reach each tick: nothing to reach the first.
        uavs = len(self._roster.uavs)
        uav_commands = [np.zeros((uavs, UAV_COMMAND_WIDTH)), *(o.uav_commands for o in outputs)]
        sights = chain.from_iterable(o.sights for o in outputs)
        return Trace(
            roster=self._roster,
            ground=np.array(ground),
            uav=np.array(uav).reshape(len(uav), uavs, UAV_WIDTH),
            uav_commands=np.array(uav_commands[:-1]),
            ground_commands=((), *(o.ground_commands for o in outputs[:-1])),
            links=_in_turn(o.links for o in outputs),
            sights=tuple(sorted(sights, key=attrgetter('tick', 'observer', 'target'))),
            events=_in_turn(o.events for o in outputs),
        )


def _in_turn(records: Iterable[tuple[Record, ...]]) -> tuple[Record, ...]:
    return tuple(sorted(chain.from_iterable(records), key=attrgetter('sequence')))


def _note(writer: BagWriter, clocks: Callable[[], tuple[AirClock, ...]] | None) -> None:
    if clocks is not None and (known := clocks()):
        writer.note(AIR_CLOCKS, clocks_note(known))


def run_lockstep(
    *,
    run_id: str,
    agsg: Agsg,
    execution: Execution,
    ground: GroundSimulator,
    air: AirSimulator,
    bag_directory: Path,
    definitions: MessageDefinitions,
    control: RunControl,
    clocks: Callable[[], tuple[AirClock, ...]] | None = None,
) -> ExecutionResult:
    """Run to the end of the scenario, record it, return where and what.

    `clocks` tells of autopilots that keep their own time: before the first tick, and at the end.

    Raises:
        AuroraError: A simulator or the recording broke; what was recorded so far stays readable.
    """
    dt_s = execution.roster.dt_s
    outcome = 'finished'
    has_uavs = bool(execution.roster.uavs)
    collected = TraceCollector(execution.roster)
    with (
        no_collection(),
        BagWriter(bag_directory, definitions) as writer,
        closing(ground),
        closing(air),
        closing(LocalRecorder(writer, definitions, dt_s)) as recorder,
    ):
        recorder.prologue(run_id, execution.roster, execution.world, agsg)
        ground.load(execution.ground_load)
        ground_rows = ground.state()
        if has_uavs:
            air.load(execution.air_load)
            _note(writer, clocks)
        uav_rows = air.state() if has_uavs else np.zeros((0, UAV_WIDTH))
        tick = 0
        while True:
            ground.show_uavs(uav_rows)
            output = execution.stepper.step(tick, ground_rows, uav_rows)
            collected.add(ground_rows, uav_rows, output)
            recorder.add(tick, ground_rows, uav_rows, output)
            control.progress('execute', min(1.0, tick * dt_s / execution.horizon_s), tick * dt_s)
            if output.finished:
                outcome = output.outcome
                break
            if control.cancelled():
                outcome = 'cancelled'
                break
            tick += 1
            ground_rows = ground.advance(tick, output.ground_commands)
            if has_uavs:
                uav_rows = air.advance(tick, output.uav_commands)
        _note(writer, clocks)
    trace = collected.trace()
    hashes = trace_hashes(trace, execution.world)
    return ExecutionResult.model_validate(
        {
            'bag': bag_directory,
            'ticks': trace.ticks,
            'trace_sha256': hashes.trace_sha256,
            'motion_sha256': hashes.motion_sha256,
            'outcome': outcome,
        }
    )
