# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The local engine, measured: its ports are wrapped here, the product knows nothing of it."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np

from aurora_bench.lockstep.figures import AIR, EXECUTOR, RECORDER, SUMO, RunFigures
from aurora_bench.lockstep.scenarios import SEED
from aurora_cli.installed import installed
from aurora_cli.local_run import run_lockstep
from aurora_core.execution.plan import Execution
from aurora_core.execution.step_output import StepOutput, Stepper
from aurora_core.outcomes.agsg import Agsg
from aurora_core.pipeline.functions import execution_stage
from aurora_core.pipeline.stages import RunControl
from aurora_core.ports.simulators import AirLoad, AirSimulator, FloatArray, GroundLoad
from aurora_core.ports.simulators import GroundSimulator as GroundSimulatorPort
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import message_definitions
from aurora_sumo_bridge.sumo_client import SumoClient
from aurora_uav_bridge.mavlink_client import MavlinkClient
from aurora_uav_bridge.transports import LoopbackTransport
from aurora_uav_sim.mavlink_server import SimServer

# So many ticks tell what the watch itself takes.
_COST_TICKS = 5000


class Stopwatch:
    """CPU time of the parts of the loop, and when the loop began and ended (ns).

    The parts run in one thread, and all but the recorder one after the other: asking for its time
    costs so much that each part begins where the one before ended. CPU time, since a busy machine
    would add its own to each part.
    """

    def __init__(self) -> None:
        self.spent_ns: dict[str, int] = dict.fromkeys((SUMO, AIR, EXECUTOR), 0)
        self.load_ns: dict[str, int] = dict.fromkeys((SUMO, AIR), 0)
        self.sumo_wall_ns = 0
        self.begin_ns = self.end_ns = 0
        self.begin_cpu_ns = self.end_cpu_ns = self.mark_ns = 0
        self.ticks = 0

    def loading(self, part: str, load: Callable[[], None]) -> None:
        """Time a load; the loop begins after the last one."""
        begin = time.perf_counter_ns()
        load()
        self.begin_ns = time.perf_counter_ns()
        self.begin_cpu_ns = time.process_time_ns()
        self.mark()
        self.load_ns[part] += self.begin_ns - begin

    def mark(self) -> None:
        """Begin a part here."""
        self.mark_ns = time.thread_time_ns()

    def spend(self, part: str) -> None:
        """End a part that began at the mark, or where the one before ended."""
        now_ns = time.thread_time_ns()
        self.spent_ns[part] += now_ns - self.mark_ns
        self.mark_ns = now_ns

    def stop(self) -> None:
        """End the loop (a second time does nothing)."""
        if not self.end_ns:
            self.end_ns, self.end_cpu_ns = time.perf_counter_ns(), time.process_time_ns()


class _Ground:
    """`GroundSimulator` that is timed."""

    def __init__(self, inner: GroundSimulatorPort, watch: Stopwatch) -> None:
        self._inner = inner
        self._watch = watch

    def load(self, load: GroundLoad) -> None:
        self._watch.loading(SUMO, lambda: self._inner.load(load))

    def state(self) -> FloatArray:
        return self._inner.state()

    def advance(self, tick: int, commands: tuple[GroundCommand, ...]) -> FloatArray:
        watch = self._watch
        watch.mark()
        begin_ns = time.perf_counter_ns()
        rows = self._inner.advance(tick, commands)
        watch.sumo_wall_ns += time.perf_counter_ns() - begin_ns
        watch.spend(SUMO)
        return rows

    def show_uavs(self, rows: FloatArray) -> None:
        self._inner.show_uavs(rows)

    def close(self) -> None:
        self._watch.stop()
        self._inner.close()


class _Air:
    """`AirSimulator` that is timed."""

    def __init__(self, inner: AirSimulator, watch: Stopwatch) -> None:
        self._inner = inner
        self._watch = watch

    def load(self, load: AirLoad) -> None:
        self._watch.loading(AIR, lambda: self._inner.load(load))

    def state(self) -> FloatArray:
        return self._inner.state()

    def advance(self, tick: int, commands: FloatArray) -> FloatArray:
        rows = self._inner.advance(tick, commands)  # begins where SUMO ended
        self._watch.spend(AIR)
        return rows

    def close(self) -> None:
        self._watch.stop()
        self._inner.close()


class _Step:
    """`Stepper` that is timed."""

    def __init__(self, inner: Stepper, watch: Stopwatch) -> None:
        self._inner = inner
        self._watch = watch

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> StepOutput:
        output = self._inner.step(tick, ground, uav)  # begins where the air ended
        self._watch.spend(EXECUTOR)
        self._watch.ticks = tick + 1
        return output


class _Nothing:
    """Simulators and executor that do nothing."""

    def advance(self, tick: int, commands: Any) -> Any:
        return None

    def step(self, tick: int, ground: Any, uav: Any) -> Any:
        return None


@cache
def watch_cost() -> dict[str, float]:
    """Return the CPU seconds per tick that the watch takes by itself: by part, and ''  for all."""
    watch, nothing, none = Stopwatch(), _Nothing(), np.empty(0)
    ground, air = _Ground(cast('Any', nothing), watch), _Air(cast('Any', nothing), watch)
    step = _Step(cast('Any', nothing), watch)
    watch.mark()
    begin = time.thread_time()
    for tick in range(_COST_TICKS):
        step.step(tick, none, none)
        ground.advance(tick, ())
        air.advance(tick, none)
    spent = {name: ns / 1e9 / _COST_TICKS for name, ns in watch.spent_ns.items()}
    return {**spent, '': (time.thread_time() - begin) / _COST_TICKS}


def measure_local(agsg: Agsg, bag_directory: Path) -> RunFigures:
    """Run a grounded graph as `aurora run` does, and time it.

    Raises:
        AuroraError: The run broke.
    """
    begin, execution, ground, air, watch = _prepared(agsg)
    result = run_lockstep(
        run_id=bag_directory.parent.name,
        agsg=agsg,
        execution=execution,
        ground=ground,
        air=air,
        bag_directory=bag_directory,
        definitions=message_definitions(),
        control=RunControl(),
    )
    end = time.perf_counter_ns()
    return _figures(watch, execution, begin, end, result.trace_sha256)


def measure_local_without_recorder(agsg: Agsg) -> RunFigures:
    """Run the same loop with nothing recorded."""
    begin, execution, ground, air, watch = _prepared(agsg)
    try:
        ground.load(execution.ground_load)
        ground_rows = ground.state()
        air.load(execution.air_load)
        uav_rows = air.state()
        tick = 0
        while not (output := execution.stepper.step(tick, ground_rows, uav_rows)).finished:
            tick += 1
            ground_rows = ground.advance(tick, output.ground_commands)
            uav_rows = air.advance(tick, output.uav_commands)
    finally:
        ground.close()
        air.close()
    return _figures(watch, execution, begin, time.perf_counter_ns(), '')


def sumo_reload_s(agsg: Agsg, count: int) -> list[float]:
    """Return how long SUMO's reload takes, wall seconds, the first load left out."""
    load = execution_stage(installed(), agsg, SEED, ()).ground_load
    client = SumoClient()
    try:
        client.load(load)
        return [_seconds(lambda: client.load(load)) for _ in range(count)]
    finally:
        client.close()


def _prepared(agsg: Agsg) -> tuple[int, Execution, _Ground, _Air, Stopwatch]:
    """Return when it began, and everything for one run, timed."""
    gc.collect()  # what the run before left must not be collected during this one
    begin = time.perf_counter_ns()
    execution = execution_stage(installed(), agsg, SEED, ())
    watch = Stopwatch()
    ids = tuple(entry.system_id for entry in execution.roster.uavs)
    air = _Air(MavlinkClient(LoopbackTransport(SimServer(ids))), watch)
    ground = _Ground(SumoClient(), watch)
    timed = replace(execution, stepper=_Step(execution.stepper, watch))
    return begin, timed, ground, air, watch


def _figures(
    watch: Stopwatch, execution: Execution, begin: int, end: int, sha256: str
) -> RunFigures:
    cost = watch_cost()
    cpu_s = (watch.end_cpu_ns - watch.begin_cpu_ns) / 1e9 - cost[''] * watch.ticks
    parts = {
        name: spent / 1e9 - cost[name] * watch.ticks for name, spent in watch.spent_ns.items()
    }
    # What is left is writing the bag, and a loop of a few lines.
    parts[RECORDER] = max(0.0, cpu_s - sum(parts.values()))
    return RunFigures(
        engine='local',
        ticks=watch.ticks,
        dt_s=execution.roster.dt_s,
        load_s=(watch.begin_ns - begin) / 1e9,
        loop_s=(watch.end_ns - watch.begin_ns) / 1e9,
        close_s=(end - watch.end_ns) / 1e9,
        cpu_s=cpu_s,
        parts_s=parts,
        sha256=sha256,
        sumo_wall_s=watch.sumo_wall_ns / 1e9,
    )


def _seconds(work: Callable[[], None]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin
