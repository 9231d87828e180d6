# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nothing but finite numbers in range gets as far as SUMO."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundAgentLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_sumo_bridge.checks import COMMAND_RANGES, check_agent_numbers, check_command

AGENTS = ('ego', 'van')


@pytest.mark.parametrize('kind', list(GroundCommandKind))
@pytest.mark.parametrize('bad', [float('nan'), float('inf'), float('-inf')])
@pytest.mark.parametrize('field', ['value', 'value2'])
def test_no_command_takes_what_is_not_finite(
    kind: GroundCommandKind, bad: float, field: str
) -> None:
    numbers = {'value': 1.0, 'value2': 1.0} | {field: bad}
    with pytest.raises(GroundSimulatorError, match=f"'van', {kind.name}: {field} "):
        check_command(GroundCommand(agent=1, kind=kind, text='edge', **numbers), AGENTS)


@pytest.mark.parametrize(
    ('kind', 'value', 'value2'),
    [
        ('SET_SPEED', -0.1, 0.0),
        ('SET_SPEED', 60.1, 0.0),
        ('SET_SPEED_FACTOR', 0.0, 0.0),
        ('SET_SPEED_FACTOR', 5.1, 0.0),
        ('SET_TIME_GAP', -1.0, 0.0),
        ('SET_MIN_GAP', -1.0, 0.0),
        ('SET_DECELERATION', 0.0, 0.0),
        ('SET_DECELERATION', 21.0, 0.0),
        ('CHANGE_LANE', -1.0, 5.0),
        ('CHANGE_LANE', 1.5, 5.0),
        ('CHANGE_LANE', 1.0, -5.0),
        ('STOP_AT', -1.0, 5.0),
        ('STOP_AT', 1.0, -5.0),
        ('WALK', -1.0, 0.0),
        ('SET_LANE_CHANGE_MODE', 4096.0, 0.0),
        ('SET_LANE_CHANGE_MODE', 0.5, 0.0),
    ],
)
def test_values_out_of_range_are_named(kind: str, value: float, value2: float) -> None:
    command = GroundCommand(
        agent=0, kind=GroundCommandKind[kind], value=value, value2=value2, text='edge'
    )
    wrong = value2 if value2 < 0.0 else value
    with pytest.raises(GroundSimulatorError, match=f"agent 'ego', {kind}: value2? {wrong}"):
        check_command(command, AGENTS)


@pytest.mark.parametrize('kind', ['SET_ROUTE', 'STOP_AT', 'WALK'])
@pytest.mark.parametrize(('text', 'why'), [('', 'empty'), ('  ', 'empty'), ('a\x00b', 'NUL')])
def test_text_is_checked(kind: str, text: str, why: str) -> None:
    with pytest.raises(GroundSimulatorError, match=f'{kind}: text .*{why}'):
        check_command(GroundCommand(agent=0, kind=GroundCommandKind[kind], text=text), AGENTS)


@pytest.mark.parametrize('agent', [-1, 2])
def test_an_index_outside_the_roster_is_refused(agent: int) -> None:
    with pytest.raises(GroundSimulatorError, match=f'index {agent}: the roster has 2 agents'):
        check_command(GroundCommand(agent=agent, kind=GroundCommandKind.RESUME), AGENTS)


def test_a_kind_that_does_not_exist_is_refused() -> None:
    bogus: GroundCommandKind = 99  # type: ignore[assignment]
    with pytest.raises(GroundSimulatorError, match="'ego': unknown command 99"):
        check_command(GroundCommand(agent=0, kind=bogus), AGENTS)


def test_every_kind_has_ranges_and_its_ends_are_inside() -> None:
    for kind in GroundCommandKind:
        value, value2 = COMMAND_RANGES[kind]
        for edge, edge2 in ((value.low, value2.low), (value.high, value2.high)):
            check_command(
                GroundCommand(agent=0, kind=kind, value=edge, value2=edge2, text='x'), AGENTS
            )


@pytest.mark.parametrize(
    ('field', 'bad'),
    [
        ('lane_position_m', float('nan')),
        ('lane_position_m', -0.5),
        ('speed_mps', float('inf')),
        ('speed_mps', -1.0),
        ('speed_mps', 61.0),
        ('arrival_position_m', float('nan')),
        ('speed_factor', 0.0),
        ('time_gap_s', float('nan')),
        ('min_gap_m', -1.0),
        ('acceleration_mps2', 0.0),
        ('lane_change_mode', 9999),
    ],
)
def test_load_numbers_are_checked(
    vehicle: Callable[..., GroundAgentLoad], field: str, bad: float
) -> None:
    fields = {'edges': ('e',), 'lane_id': 'e_1', 'lane_position_m': 5.0} | {field: bad}
    with pytest.raises(GroundSimulatorError, match=f"'ego'.* e_1 .*{field}"):
        check_agent_numbers(vehicle('ego', **fields))
