# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""States, commands, records, roster, world and graph through messages and back."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

pytest.importorskip('rclpy')

from rclpy.serialization import deserialize_message, serialize_message

from aurora_core.errors import ExecutionError
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GROUND_WIDTH, UAV_WIDTH, GroundCommandKind
from aurora_core.trace.messages import (
    read_event,
    read_ground_commands,
    read_link,
    read_roster,
    read_rows,
    read_sight,
)
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    LossReason,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_msgs.msg import GroundState, UavCommand, UavState
from aurora_ros.conversions.messages import message_builder
from aurora_ros.conversions.states import Rows, unpack

RUN, DT_S = 12345678901234567890, 0.05
BUILDER = message_builder(RUN, DT_S)


def through_the_wire(message: Any) -> Any:
    return deserialize_message(serialize_message(message), type(message))


@pytest.mark.parametrize('count', [0, 1, 200])
def test_rows_survive_to_the_last_bit(count: int) -> None:
    rng = np.random.default_rng(7)
    ground = rng.normal(size=(count, GROUND_WIDTH)) * 1e3
    message = through_the_wire(Rows(GroundState, RUN, DT_S).at(3, ground))
    assert read_rows(message, GROUND_WIDTH).tobytes() == ground.tobytes()
    assert unpack(message.data, GROUND_WIDTH, 'x').tobytes() == ground.tobytes()
    assert (message.run_number, message.tick) == (RUN, 3)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (0, 150_000_000)
    assert message.header.frame_id == 'map'


def test_rows_of_a_slice_and_of_another_order_are_packed_row_by_row() -> None:
    rows = np.arange(64.0).reshape(4, 16)
    states = Rows(UavState, RUN, DT_S)
    for view in (rows[::2], np.asfortranarray(rows), rows[:, ::-1]):
        message = states.at(1, view)
        assert np.array_equal(unpack(message.data, UAV_WIDTH, 'x'), view)
    assert Rows(UavCommand, RUN, DT_S).at(1, np.zeros((2, 9))).tick == 1


def test_a_message_that_is_filled_anew_is_that_of_its_tick_alone() -> None:
    states = Rows(GroundState, RUN, DT_S)
    for tick, count in ((0, 3), (1, 2), (40, 2), (41, 0), (7, 5)):
        rows = np.full((count, GROUND_WIDTH), float(tick))
        fresh = Rows(GroundState, RUN, DT_S).at(tick, rows)
        assert serialize_message(states.at(tick, rows)) == serialize_message(fresh)


def test_data_of_a_wrong_length_is_refused() -> None:
    message = Rows(GroundState, RUN, DT_S).at(1, np.zeros((1, GROUND_WIDTH + 1)))
    with pytest.raises(ExecutionError, match='ground state: expected rows of 7, found 8'):
        unpack(message.data, GROUND_WIDTH, 'ground state')


def test_ground_commands() -> None:
    commands = (
        GroundCommand(agent=0, kind=GroundCommandKind.SET_SPEED, value=3.25),
        GroundCommand(
            agent=199, kind=GroundCommandKind.STOP_AT, value=1.5, value2=math.pi, text='lane_ä_0'
        ),
    )
    assert read_ground_commands(through_the_wire(BUILDER.ground_commands(9, commands))) == commands
    empty = through_the_wire(BUILDER.ground_commands(9, ()))
    assert read_ground_commands(empty) == ()
    assert empty.tick == 9


def test_records() -> None:
    link = LinkRecord(
        tick=5,
        sequence=1,
        message=2,
        link='l1',
        event='e1',
        sender='uav1',
        receiver='ego',
        kind=LinkEventKind.ATTEMPT_LOST,
        attempt=3,
        reason=LossReason.RANGE,
        distance_m=501.25,
        line_of_sight=True,
    )
    assert read_link(through_the_wire(BUILDER.link(link))) == link
    sight = SightRecord(tick=6, observer='uav1', target='ego', visible=True, slant_range_m=4.5)
    assert read_sight(through_the_wire(BUILDER.sight(sight))) == sight
    event = EventRecord(
        tick=7, sequence=8, kind=ScenarioEventKind.FINISHED, subject='run', detail='horizon'
    )
    assert read_event(through_the_wire(BUILDER.event(event))) == event


def test_roster() -> None:
    roster = Roster(
        dt_s=DT_S,
        agents=(
            RosterEntry(
                body_id='ego',
                type_name='car',
                is_person=False,
                system_id=0,
                length_m=4.5,
                width_m=1.8,
                height_m=1.5,
                route_edges=('e1', 'e2'),
                route_xy_m=((0.1, 0.2), (1.0 / 3.0, -5.0)),
                role='ego',
            ),
        ),
        uavs=(),
    )
    assert read_roster(through_the_wire(BUILDER.roster('r', roster))) == roster
