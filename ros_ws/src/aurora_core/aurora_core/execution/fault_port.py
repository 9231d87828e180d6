# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Apply injected faults between the executor and the simulators.

What is recorded as command is what the simulators really got; each fault announces itself once
as a scenario event, with all that is needed to inject it again.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np
import numpy.typing as npt

from aurora_core.errors import ExecutionError
from aurora_core.execution.faults import Fault
from aurora_core.execution.scenario_executor import ScenarioExecutor
from aurora_core.execution.step_output import StepOutput
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind, UavColumn, UavCommandColumn, UavMode
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]

# Commands that would let a stopped or slowed agent move again.
_MOVING = frozenset(
    {
        GroundCommandKind.SET_SPEED,
        GroundCommandKind.RELEASE_SPEED,
        GroundCommandKind.SET_SPEED_FACTOR,
        GroundCommandKind.RESUME,
    }
)

# Speed of an agent that is kept away when the fault does not say (m/s).
KEEP_AWAY_MPS = 3.0


def loss_with_faults(
    link_id: str, loss: float, faults: tuple[Fault, ...], dt_s: float
) -> Callable[[int], float]:
    """Return the loss probability of a link by tick, with `link_loss` faults applied."""

    def loss_at(tick: int) -> float:
        now = loss
        for fault in faults:
            hit = fault.kind == 'link_loss' and fault.subject in (link_id, '*')
            if hit and tick * dt_s >= fault.at_s:
                now = 1.0 if fault.value is None else fault.value
        return now

    return loss_at


class FaultPort:
    """The executor behind injected faults; same `step` as the executor.

    Args:
        executor: The executor, which does not know of the faults.
        faults: What to inject.
        roster: Row order.
        link_ids: Links of the scenario.

    Raises:
        ExecutionError: A fault names a subject that is not in the scenario.
    """

    def __init__(
        self,
        executor: ScenarioExecutor,
        faults: tuple[Fault, ...],
        roster: Roster,
        link_ids: tuple[str, ...],
    ) -> None:
        self._executor = executor
        self._faults = faults
        self._roster = roster
        self._announced: set[int] = set()
        self._frozen: dict[int, FloatArray] = {}
        # Agents that the executor lets drive faster than this (rows; infinite: as they like).
        self._allowed_mps = dict.fromkeys(range(len(roster.agents)), inf)
        agents = [e.body_id for e in roster.agents]
        subjects = {
            'link_loss': [*link_ids, '*'],
            'target_removed': agents,
            'keep_away': agents,
            'route_blocked': [*agents, *(e.body_id for e in roster.uavs)],
        }
        for fault in faults:
            names = subjects[fault.kind]
            if fault.subject not in names:
                raise ExecutionError(
                    f'fault {fault.kind} names {fault.subject!r}, which the scenario does not '
                    'have or the fault cannot hit',
                    hint=f'use one of: {", ".join(names)}',
                )

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> StepOutput:
        """Step the executor, then bend its commands."""
        output = self._executor.step(tick, ground, uav)
        for command in output.ground_commands:
            if command.kind in _MOVING:
                held = command.kind is GroundCommandKind.SET_SPEED
                self._allowed_mps[command.agent] = command.value if held else inf
        time_s = tick * self._roster.dt_s
        for index, fault in enumerate(self._faults):
            if time_s < fault.at_s:
                continue
            first = index not in self._announced
            if first:
                self._announced.add(index)
                record = EventRecord(
                    tick=tick,
                    sequence=self._executor.next_sequence(),
                    kind=ScenarioEventKind.FAULT,
                    subject=fault.subject,
                    detail=fault.told(),
                )
                output = output._replace(events=(*output.events, record))
            output = self._apply(fault, output, uav, first=first)
        return output

    def _apply(
        self, fault: Fault, output: StepOutput, uav: FloatArray, *, first: bool
    ) -> StepOutput:
        row = self._roster.agent_index(fault.subject)
        if row is None:
            index = self._roster.uav_index(fault.subject)
            if index is not None and fault.kind == 'route_blocked':
                return self._hold_uav(index, output, uav)
            return output
        if fault.kind == 'target_removed':
            kept = [c for c in output.ground_commands if c.agent != row]
            if first:
                kept.append(GroundCommand(agent=row, kind=GroundCommandKind.REMOVE))
            return output._replace(ground_commands=tuple(kept))
        if fault.kind == 'route_blocked':
            return self._cap_agent(row, 0.0, output, first=first)
        if fault.kind == 'keep_away':
            speed = KEEP_AWAY_MPS if fault.value is None else fault.value
            # An agent that is still held stays held.
            fast = self._allowed_mps[row] > speed
            return self._cap_agent(row, speed, output, first=first and fast)
        return output

    def _cap_agent(
        self, row: int, speed_mps: float, output: StepOutput, *, first: bool
    ) -> StepOutput:
        commands: list[GroundCommand] = []
        capped = GroundCommand(agent=row, kind=GroundCommandKind.SET_SPEED, value=speed_mps)
        for command in output.ground_commands:
            if command.agent == row and command.kind in _MOVING:
                slow = command.kind is GroundCommandKind.SET_SPEED and command.value <= speed_mps
                commands.append(command if slow else capped)
            else:
                commands.append(command)
        if first:
            commands.append(capped)
        return output._replace(ground_commands=tuple(commands))

    def _hold_uav(self, index: int, output: StepOutput, uav: FloatArray) -> StepOutput:
        rows = output.uav_commands.copy()
        if rows[index, UavCommandColumn.MODE] != UavMode.OFFBOARD:
            return output
        if index not in self._frozen:
            self._frozen[index] = uav[index, UavColumn.X : UavColumn.Z + 1].copy()
        rows[index, UavCommandColumn.X : UavCommandColumn.Z + 1] = self._frozen[index]
        rows[index, UavCommandColumn.VX : UavCommandColumn.VZ + 1] = 0.0
        return output._replace(uav_commands=rows)
