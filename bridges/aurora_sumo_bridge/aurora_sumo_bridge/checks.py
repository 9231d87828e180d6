# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pure checks of numbers that go into SUMO, which itself accepts NaN and infinity."""

from __future__ import annotations

import math
from dataclasses import dataclass

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundAgentLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind

FASTEST_MPS = 60.0
LARGEST_SPEED_FACTOR = 5.0
LONGEST_TIME_GAP_S = 60.0
LARGEST_GAP_M = 500.0
HARDEST_BRAKING_MPS2 = 20.0
LONGEST_DURATION_S = 1e6
LONGEST_LANE_M = 1e5
LARGEST_LANE_INDEX = 63
LARGEST_LANE_CHANGE_MODE = 4095


@dataclass(frozen=True, slots=True)
class Range:
    """Closed interval with a unit; `whole` asks for an integer."""

    low: float
    high: float
    unit: str
    whole: bool = False

    def fault(self, value: float) -> str:
        """Return '' when the value is inside, else what was expected."""
        inside = math.isfinite(value) and self.low <= value <= self.high
        if inside and not (self.whole and value != math.floor(value)):
            return ''
        kind = 'a whole number' if self.whole else 'a finite number'
        unit = f' {self.unit}' if self.unit else ''
        return f'expected {kind} from {self.low:g} to {self.high:g}{unit}'


_ANY = Range(-LONGEST_DURATION_S, LONGEST_DURATION_S, '')
_DURATION = Range(0.0, LONGEST_DURATION_S, 's')
_LANE_POSITION = Range(0.0, LONGEST_LANE_M, 'm')
_SPEED = Range(0.0, FASTEST_MPS, 'm/s')
_SPEED_FACTOR = Range(0.01, LARGEST_SPEED_FACTOR, '')
_TIME_GAP = Range(0.0, LONGEST_TIME_GAP_S, 's')
_MIN_GAP = Range(0.0, LARGEST_GAP_M, 'm')
_ACCELERATION = Range(0.01, HARDEST_BRAKING_MPS2, 'm/s2')
_MODE = Range(0, LARGEST_LANE_CHANGE_MODE, '', whole=True)

# Kind -> ranges of value and value2.
COMMAND_RANGES: dict[GroundCommandKind, tuple[Range, Range]] = {
    GroundCommandKind.SET_SPEED: (_SPEED, _ANY),
    GroundCommandKind.RELEASE_SPEED: (_ANY, _ANY),
    GroundCommandKind.SET_SPEED_FACTOR: (_SPEED_FACTOR, _ANY),
    GroundCommandKind.SET_TIME_GAP: (_TIME_GAP, _ANY),
    GroundCommandKind.SET_MIN_GAP: (_MIN_GAP, _ANY),
    GroundCommandKind.SET_DECELERATION: (_ACCELERATION, _ANY),
    GroundCommandKind.SET_ROUTE: (_ANY, _ANY),
    GroundCommandKind.CHANGE_LANE: (Range(0, LARGEST_LANE_INDEX, '', whole=True), _DURATION),
    GroundCommandKind.STOP_AT: (_LANE_POSITION, _DURATION),
    GroundCommandKind.RESUME: (_ANY, _ANY),
    GroundCommandKind.REMOVE: (_ANY, _ANY),
    GroundCommandKind.WALK: (_LANE_POSITION, _ANY),
    GroundCommandKind.SET_LANE_CHANGE_MODE: (_MODE, _ANY),
}
_NEED_TEXT = {GroundCommandKind.SET_ROUTE, GroundCommandKind.STOP_AT, GroundCommandKind.WALK}


def check_command(command: GroundCommand, agent_ids: tuple[str, ...]) -> None:
    """Raise unless agent, kind, numbers and text of a command are in range.

    Raises:
        GroundSimulatorError: Names agent, command and value.
    """
    if not 0 <= command.agent < len(agent_ids):
        raise GroundSimulatorError(
            f'{name_of(command.kind)} for agent index {command.agent}: '
            f'the roster has {len(agent_ids)} agents'
        )
    agent_id = agent_ids[command.agent]
    ranges = COMMAND_RANGES.get(command.kind)
    if ranges is None:
        raise GroundSimulatorError(f"agent '{agent_id}': unknown command {command.kind!r}")
    for label, value, allowed in (
        ('value', command.value, ranges[0]),
        ('value2', command.value2, ranges[1]),
    ):
        fault = allowed.fault(value)
        if fault:
            raise refused(agent_id, command, f'{label} {value!r}: {fault}')
    if command.kind in _NEED_TEXT and not command.text.strip():
        raise refused(agent_id, command, 'text is empty, expected edge or lane ids')
    if '\x00' in command.text:
        raise refused(agent_id, command, 'text contains NUL')


def check_agent_numbers(agent: GroundAgentLoad) -> None:
    """Raise unless every number of a load is finite and in range.

    Raises:
        GroundSimulatorError: Names agent, field and value.
    """
    fields: list[tuple[str, float | None, Range]] = [
        ('lane_position_m', agent.lane_position_m, _LANE_POSITION),
        ('speed_mps', agent.speed_mps, _SPEED),
        ('arrival_position_m', agent.arrival_position_m, _LANE_POSITION),
        ('speed_factor', agent.speed_factor, _SPEED_FACTOR),
        ('time_gap_s', agent.time_gap_s, _TIME_GAP),
        ('min_gap_m', agent.min_gap_m, _MIN_GAP),
        ('lane_change_mode', agent.lane_change_mode, _MODE),
        ('acceleration_mps2', agent.acceleration_mps2, _ACCELERATION),
    ]
    fields += [('way_xy_m', value, _ANY) for point in agent.way_xy_m for value in point]
    for label, value, allowed in fields:
        fault = allowed.fault(value) if value is not None else ''
        if fault:
            raise unplaceable(agent, f'{label} {value!r}: {fault}')


def refused(agent_id: str, command: GroundCommand, why: str) -> GroundSimulatorError:
    """Return the error of a command that is not carried out."""
    return GroundSimulatorError(f"agent '{agent_id}', {name_of(command.kind)}: {why}")


def unplaceable(agent: GroundAgentLoad, why: str) -> GroundSimulatorError:
    """Return the error of an agent that cannot be placed where asked."""
    place = agent.lane_id or (agent.edges[0] if agent.edges else 'nowhere')
    return GroundSimulatorError(
        f"agent '{agent.agent_id}' ({agent.type_name}) cannot be placed on {place} at "
        f'{agent.lane_position_m:g} m: {why}'
    )


def name_of(kind: GroundCommandKind) -> str:
    return kind.name if isinstance(kind, GroundCommandKind) else repr(kind)
