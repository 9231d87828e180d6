# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two traces part at a tick, a topic, a body and a value: to the last bit, whatever the rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from aurora_core.trace import messages
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.compare import TraceDifference, ValueDifference, compare_traces
from aurora_core.trace.layout import GroundCommandKind, UavColumn, UavCommandColumn
from aurora_core.trace.trace import Trace

MakeTrace = Callable[..., Trace]


def _first(found: TraceDifference) -> ValueDifference:
    assert found.first is not None
    return found.first


def test_equal_traces_do_not_differ(make_trace: MakeTrace) -> None:
    a, b = make_trace(), make_trace()
    b.uav[3, 0, 0] = a.uav[3, 0, 0] = float('nan')  # the same bits are equal
    assert compare_traces(a, b) == TraceDifference(first=None, streams=(), final=(), roster=())


@pytest.mark.parametrize('change', [np.nextafter, lambda x, _: -x])
def test_the_last_bit_counts(make_trace: MakeTrace, change: Callable[..., float]) -> None:
    a, b = make_trace(uavs=2), make_trace(uavs=2)
    a.uav[20, 1, UavColumn.Z] = 0.0
    b.uav[20, 1, UavColumn.Z] = change(0.0, 1.0)
    b.uav[44, 0, UavColumn.VX] += 1.0
    found = compare_traces(a, b)
    first = _first(found)
    assert (first.tick, first.topic, first.body) == (20, messages.UAV_STATE, 'uav2')
    assert (first.quantity, first.first, first.second) == ('z', 0.0, change(0.0, 1.0))
    [stream] = found.streams
    assert stream.ticks == 2
    [final] = found.final
    assert (final.tick, final.body, final.quantity) == (44, 'uav1', 'vx')


def test_within_a_tick_the_command_comes_before_the_state(make_trace: MakeTrace) -> None:
    a, b = make_trace(), make_trace()
    b.uav[7] += 1.0
    b.uav_commands[7, 0, UavCommandColumn.YAW] += 1.0
    found = compare_traces(a, b)
    assert [s.topic for s in found.streams] == [messages.UAV_COMMAND, messages.UAV_STATE]
    assert _first(found).quantity == 'yaw'


def test_bodies_are_matched_by_id(make_trace: MakeTrace) -> None:
    a = make_trace(agents=3)
    turned = replace(a.roster, agents=tuple(reversed(a.roster.agents)))
    commands = tuple(
        tuple(replace(c, agent=2 - c.agent) for c in of_tick) for of_tick in a.ground_commands
    )
    b = replace(a, roster=turned, ground=a.ground[:, ::-1].copy(), ground_commands=commands)
    found = compare_traces(a, b)
    assert found.streams == ()
    assert [name for name, _, _ in found.roster] == ['order of the agents']


def test_rosters_are_compared_field_by_field(make_trace: MakeTrace) -> None:
    a = make_trace(agents=2)
    changed = replace(a.roster.agents[0], length_m=9.0)
    b = replace(a, roster=replace(a.roster, agents=(changed,), dt_s=0.1), ground=a.ground[:, :1])
    found = compare_traces(a, b)
    assert found.roster == (
        ('time step', 0.05, 0.1),
        ('length_m of agent agent0', '4.6', '9.0'),
        ('agent agent1', 'there', 'not there'),
    )
    # The command to the agent that is only there in the first run is the same in both lists.
    assert _first(found).topic == messages.GROUND_COMMAND


def test_commands_and_records_differ_by_name(make_trace: MakeTrace) -> None:
    a = make_trace()
    speed = GroundCommand(agent=0, kind=GroundCommandKind.SET_SPEED, value=-0.0)
    other = replace(speed, value=0.0)
    longer = (other, replace(speed, agent=1))
    one = replace(a, ground_commands=((), (speed,), (speed,), *a.ground_commands[3:]))
    two = replace(a, ground_commands=((), (other,), longer, *a.ground_commands[3:]))
    found = compare_traces(one, two)
    first = _first(found)
    assert (first.body, first.quantity, first.first, first.second) == (
        'agent0',
        'value',
        -0.0,
        0.0,
    )
    assert found.streams[0].ticks == 2
    events = (a.events[0], replace(a.events[1], detail='burning'))
    links = (a.links[0], replace(a.links[1], line_of_sight=False), a.links[2])
    found = compare_traces(a, replace(a, events=events, links=links, sights=a.sights[:1]))
    named = {s.topic: s.first for s in found.streams}
    assert named[messages.COMM].quantity == 'line_of_sight'
    assert (named[messages.COMM].first, named[messages.COMM].second) == ('true', 'false')
    assert named[messages.SENSING].quantity == 'records'
    assert (named[messages.SENSING].body, named[messages.SENSING].tick) == ('uav1', 7)
    assert named[messages.EVENTS].second == 'burning'


def test_only_what_both_have_is_compared(make_trace: MakeTrace) -> None:
    a, b = make_trace(ticks=45), make_trace(ticks=45)
    short = replace(b, ground=b.ground[:9], uav=b.uav[:9], uav_commands=b.uav_commands[:9])
    assert compare_traces(a, replace(short, events=b.events[:1], links=b.links[:2])).streams == ()
    empty = replace(short, ground=b.ground[:0], uav=b.uav[:0], uav_commands=b.uav_commands[:0])
    assert compare_traces(a, empty).first is None
