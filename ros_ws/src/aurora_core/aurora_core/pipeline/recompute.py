# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The executor stepped again over the states of a recording: what it must have commanded.

The executor is pure, so a command that it does not give again from the same states was none of
its own, and a claim that it does not make again was altered. Injected faults are in the record and
are injected again.
"""

from __future__ import annotations

import numpy as np

from aurora_core.errors import AuroraError
from aurora_core.execution.faults import Fault, read_fault
from aurora_core.execution.map_parts import MapParts
from aurora_core.execution.plan import EXECUTOR_VERSION, build_stepper
from aurora_core.execution.step_output import Stepper
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.settings import Settings
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import Finding
from aurora_core.pipeline.differences import Again, differences
from aurora_core.ports.progress import Progress, quietly
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import UAV_COMMAND_WIDTH
from aurora_core.trace.records import EventRecord, LinkRecord, SightRecord
from aurora_core.trace.trace import Integrity, Trace

# Ticks after which progress is told.
_TOLD_TICKS = 100


def recomputed(
    trace: Trace,
    world: WorldModel,
    agsg: Agsg,
    *,
    tolerances: Tolerances,
    settings: Settings,
    parts: MapParts | None = None,
    progress: Progress = quietly,
) -> tuple[Finding, ...]:
    """Return where a recording is not what its executor gives from its states.

    Args:
        trace: The recording, made with this version of the executor and this configuration.
        world: As recorded, with the limits.
        agsg: As recorded.
        tolerances: Tolerances in force.
        settings: Settings in force.
        parts: Solids of that world, when they exist already.
        progress: Called now and then on the way.
    """
    ticks = trace.missing_ticks[0] if trace.missing_ticks else trace.ticks
    grounded, schedule = agsg.grounding, agsg.schedule
    if grounded is None or schedule is None:
        return (_problem('the recorded graph is not grounded'),)
    if grounded.executor_version != EXECUTOR_VERSION:
        return (
            _problem(
                f'recorded with version {grounded.executor_version} of the executor, its '
                f'configuration is that of version {EXECUTOR_VERSION}'
            ),
        )
    if parts is None:
        airspace = Airspace(world.buildings, world.no_fly_zones)
        geometry = WorldGeometry(world)
    else:
        airspace, geometry = parts.airspace, WorldGeometry(world, parts.sight_line)
    try:
        stepper = build_stepper(
            agsg.spec,
            grounded,
            schedule,
            trace.roster,
            airspace=airspace,
            geometry=geometry,
            tolerances=tolerances,
            settings=settings,
            seed=grounded.seed,
            faults=recorded_faults(trace),
        )
    except (AuroraError, LookupError, ValueError, ArithmeticError) as err:
        return (_problem(f'the executor of this request cannot be built: {err}'),)
    again = step_again(stepper, trace, ticks, progress)
    # Of a damaged recording claims may be lost, and that is said already.
    claims = trace.integrity is Integrity.INTACT and not trace.missing_ticks
    found = differences(trace, again, claims=claims and not again.problem)
    if again.problem:
        found = (*found, _problem(again.problem, again.ticks, trace.time_s(again.ticks)))
    return found


def recorded_faults(trace: Trace) -> tuple[Fault, ...]:
    """Return the injected faults that a recording announces, in their order.

    Raises:
        ExecutionError: It announces something else as a fault.
    """
    return tuple(read_fault(e.subject, e.detail) for e in trace.events if e.fault_kind)


def step_again(stepper: Stepper, trace: Trace, ticks: int, progress: Progress = quietly) -> Again:
    """Step an executor through the first ticks of a recording; tell each hundred of them."""
    flown = np.zeros((ticks + 1, len(trace.roster.uavs), UAV_COMMAND_WIDTH))
    driven: list[tuple[GroundCommand, ...]] = [()]
    links: list[LinkRecord] = []
    sights: list[SightRecord] = []
    events: list[EventRecord] = []
    done, finished, problem = 0, None, ''
    for tick in range(ticks):
        try:
            output = stepper.step(tick, trace.ground[tick], trace.uav[tick])
        except Exception as err:  # noqa: BLE001 - states that no run has: whatever breaks is told
            problem = f'the executor cannot go on from the recorded states: {_words(err)}'
            break
        flown[tick + 1] = output.uav_commands
        driven.append(output.ground_commands)
        links += output.links
        sights += output.sights
        events += output.events
        done = tick + 1
        if done % _TOLD_TICKS == 0:
            progress()
        if output.finished:
            finished = tick
            break
    return Again(
        ticks=done,
        uav_commands=flown[: done + 1],
        ground_commands=tuple(driven),
        links=tuple(links),
        sights=tuple(sorted(sights, key=lambda s: (s.tick, s.observer, s.target))),
        events=tuple(events),
        finished_tick=finished,
        problem=problem,
    )


def _words(err: Exception) -> str:
    return f'{type(err).__name__}: {err}'.rstrip(': ')[:120]


def _problem(text: str, tick: int = 0, time_s: float = 0.0) -> Finding:
    return Finding(kind='command', subject='executor', tick=tick, time_s=time_s, text=text)
