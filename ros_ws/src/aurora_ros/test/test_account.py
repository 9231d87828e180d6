# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a bridge did against what it was asked for: every difference is named."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

pytest.importorskip('rclpy')

from rclpy.serialization import deserialize_message, serialize_message

from aurora_core.errors import ExecutionError
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_msgs.msg import GroundCommand, UavCommand
from aurora_msgs.srv import LoadGround, LoadUav, RunDigest
from aurora_ros.account import Account, told

STATES = [np.full((2, UAV_WIDTH), 0.1 * tick) for tick in range(3)]
ROWS = [np.full((2, UAV_COMMAND_WIDTH), 0.3 * tick) for tick in range(3)]


def load(**changes: Any) -> LoadUav.Request:
    fields = {
        'run_number': 2**63,
        'uav_id': ['uav1', 'uav2'],
        'system_id': array('B', [1, 2]),
        'home_xy_m': array('d', [0.1, 1 / 3, -7e-300, 4.0]),
        'wind_mean_east_mps': 7.0,
    }
    return LoadUav.Request(**fields | changes)


def over_the_wire(message: Any) -> Any:
    return deserialize_message(serialize_message(message), type(message))


def account(request: Any, states: list[Any] = STATES, rows: list[Any] = ROWS) -> Account:
    made = Account(request)
    for tick, state in enumerate(states):
        command = UavCommand(tick=tick, data=array('d', rows[tick].ravel()))
        made.add(told(command) if tick else b'', state.data)
    return made


def answer(made: Account) -> RunDigest.Response:
    response = RunDigest.Response()
    made.fill(response)
    return response


def test_the_wire_changes_nothing_of_it() -> None:
    executor = account(load())
    bridge = Account(over_the_wire(load()))
    for tick, state in enumerate(STATES):
        command = over_the_wire(UavCommand(data=array('d', ROWS[tick].ravel())))
        bridge.add(told(command) if tick else b'', array('d', state.ravel()))
    executor.compare(over_the_wire(answer(bridge)), 'uav_bridge')
    ground = LoadGround.Request(map_name='junction', seed=3, agents_json='[]')
    Account(ground).compare(answer(Account(over_the_wire(ground))), 'sumo_bridge')


@pytest.mark.parametrize(
    ('made', 'named'),
    [
        (lambda: account(load(wind_mean_east_mps=0.0)), 'loaded with something else'),
        (lambda: account(load(), STATES[:2]), 'went on to tick 1, the executor to 2'),
        (lambda: account(load(), rows=[*ROWS[:2], ROWS[2] + 1.0]), 'applied other commands'),
        (lambda: account(load(), [*STATES[:2], STATES[2] + 1.0]), 'heard other states'),
    ],
)
def test_what_differs_is_named(made: Callable[[], Account], named: str) -> None:
    with pytest.raises(ExecutionError, match=named) as caught:
        account(load()).compare(answer(made()), 'uav_bridge')
    assert caught.value.component == 'network'
    assert 'uav_bridge' in str(caught.value)


def test_every_part_of_a_command_to_the_ground_is_told() -> None:
    fields = {
        'agent': array('H', [1]),
        'kind': array('B', [GroundCommand.SET_ROUTE]),
        'value': array('d', [5.0]),
        'value2': array('d', [0.0]),
        'text': ['a b'],
    }
    changes = {
        'agent': array('H', [2]),
        'kind': array('B', [GroundCommand.SET_SPEED]),
        'value': array('d', [5.5]),
        'value2': array('d', [0.1]),
        'text': ['a c'],
    }
    command = GroundCommand(**fields)
    seen = {told(GroundCommand()), told(command)}
    seen |= {told(GroundCommand(**fields | {name: value})) for name, value in changes.items()}
    assert len(seen) == 2 + len(changes)
    assert told(over_the_wire(command)) == told(command)
