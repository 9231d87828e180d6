# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The real sumo_bridge node as a process on the junction map; the test plays sync and executor."""

from __future__ import annotations

import json
from array import array
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import libsumo
import numpy as np
import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ExecutionError, GroundSimulatorError, MapError
from aurora_core.knowledge.map_model import load_map
from aurora_core.trace.layout import (
    GROUND_WIDTH,
    UAV_WIDTH,
    GroundColumn,
    GroundCommandKind,
)
from aurora_core.trace.messages import read_rows
from aurora_msgs.msg import GroundCommand, Tick, UavState
from aurora_msgs.srv import LoadGround
from aurora_ros import interfaces as on
from aurora_ros.account import Account, told
from aurora_ros.conversions.loads import ground_load
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess, nodes
from aurora_sumo_bridge.node import SumoBridgeNode
from aurora_sumo_bridge.proxies import proxy_id
from aurora_sumo_bridge.sumo_client import SumoClient

pytestmark = pytest.mark.ros

MAP = load_map('junction')
LANE = max(MAP.network.driving_lanes('passenger'), key=lambda lane: (lane.length_m, lane.id))


def agents_json(**changes: Any) -> str:
    agent = {
        'agent_id': 'ego',
        'type_name': 'car',
        'is_person': False,
        'edges': [LANE.edge_id],
        'lane_id': LANE.id,
        'lane_position_m': 20.0,
        'speed_mps': 5.0,
        **changes,
    }
    return json.dumps([agent])


FIELDS: dict[str, Any] = {
    'run_id': 'r',
    'run_number': 1,
    'map_name': MAP.name,
    'map_digest': MAP.digest,
    'seed': 1,
    'dt_s': 0.05,
    'horizon_s': 60.0,
    'weather': 'clear',
    'agents_json': agents_json(),
}


class Graph:
    def __init__(self, process: NodeProcess, play: Partner) -> None:
        self.process = process
        self.play = play
        self.states = play.collect(on.GROUND_STATE)
        self.faults = play.collect(on.FAULT)
        self.tick = play.publisher(on.TICK)
        self.command = play.publisher(on.GROUND_COMMAND)

    def load(self, run_number: int = 1, **changes: Any) -> LoadGround.Request:
        fields = {**FIELDS, 'run_number': run_number, **changes}
        self.play.call(on.GROUND_LOAD, **fields)
        return LoadGround.Request(**fields)

    def send_tick(self, tick: int, run_number: int = 1) -> None:
        self.tick.publish(Tick(run_number=run_number, tick=tick, time_s=tick * 0.05))

    def send_command(self, tick: int, run_number: int = 1, **arrays: Any) -> None:
        self.command.publish(GroundCommand(run_number=run_number, tick=tick, **arrays))

    def await_states(self, count: int) -> np.ndarray:
        assert wait_until(lambda: len(self.states) >= count, 10.0), self.process.log
        return read_rows(self.states[count - 1], GROUND_WIDTH)


@pytest.fixture
def parameters() -> list[str]:
    return []


@pytest.fixture
def graph(tmp_path: Path, parameters: list[str]) -> Iterator[Graph]:
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode('aurora_sumo_bridge.node', domain, tmp_path, parameters)
        with nodes(process):
            yield Graph(process, play)
            assert process.end() == 0
            assert 'Traceback' not in process.log


def test_states_follow_tick_and_command(graph: Graph) -> None:
    graph.load()
    graph.send_tick(0)
    spawned = graph.await_states(1)
    assert spawned[0, GroundColumn.SPEED] == pytest.approx(5.0)
    graph.send_command(
        1,
        agent=array('H', [0]),
        kind=array('B', [GroundCommandKind.SET_SPEED]),
        value=array('d', [5.0]),
        value2=array('d', [0.0]),
        text=[''],
    )
    graph.send_tick(1)
    moved = graph.await_states(2)
    way_m = np.linalg.norm(moved[0, :2] - spawned[0, :2])
    assert way_m == pytest.approx(0.25, abs=0.02)
    assert [(s.run_number, s.tick) for s in graph.states] == [(1, 0), (1, 1)]
    assert graph.states[1].header.stamp.nanosec == 50_000_000


def test_a_tick_waits_for_its_own_command_whatever_comes_first(graph: Graph) -> None:
    graph.load(run_number=5)
    graph.send_tick(0, run_number=5)
    graph.await_states(1)
    graph.send_tick(1, run_number=5)
    graph.send_command(1, run_number=4)
    graph.send_command(2, run_number=5)
    assert not wait_until(lambda: len(graph.states) > 1, 0.3), 'advanced without command 1'
    graph.send_command(1, run_number=5)
    graph.await_states(2)
    graph.send_tick(2, run_number=5)
    graph.await_states(3)
    assert not graph.faults


def test_a_second_load_starts_again_at_tick_zero_with_the_same_states(graph: Graph) -> None:
    for run_number in (1, 2):
        graph.load(run_number=run_number)
        first = len(graph.states)
        for tick in range(20):
            graph.send_command(tick, run_number=run_number)
            graph.send_tick(tick, run_number=run_number)
            graph.await_states(first + tick + 1)
    assert graph.states[19].data == graph.states[39].data
    assert graph.states[19].data != graph.states[18].data


@pytest.mark.parametrize('parameters', [['--ros-args', '-p', 'shows_uavs:=true']])
def test_where_uavs_are_delays_no_tick_and_changes_none(graph: Graph) -> None:
    flown = graph.play.publisher(on.UAV_STATE)
    assert wait_until(lambda: flown.get_subscription_count() == 1, 5.0)
    for run_number in (1, 2):
        graph.load(run_number=run_number)
        first = len(graph.states)
        for tick in range(20):
            if run_number == 2:
                rows = np.zeros((2, UAV_WIDTH))
                rows[:, :2] = graph.states[tick].data[:2]
                # Of another run, damaged, and of this one: each tick but every fifth.
                late = array('d', rows.tobytes()) if tick % 5 else array('d', [1.0])
                flown.publish(UavState(run_number=1 + (tick % 3 > 0), tick=tick, data=late))
            graph.send_command(tick, run_number=run_number)
            graph.send_tick(tick, run_number=run_number)
            graph.await_states(first + tick + 1)
    assert [s.data for s in graph.states[:20]] == [s.data for s in graph.states[20:]]
    assert not graph.faults


def test_a_command_that_sumo_refuses_becomes_a_fault_with_the_name(graph: Graph) -> None:
    graph.load()
    graph.send_tick(0)
    graph.await_states(1)
    graph.send_command(
        1,
        agent=array('H', [7]),
        kind=array('B', [GroundCommandKind.SET_SPEED]),
        value=array('d', [5.0]),
        value2=array('d', [0.0]),
        text=[''],
    )
    graph.send_tick(1)
    assert wait_until(lambda: bool(graph.faults), 10.0), graph.process.log
    assert graph.faults[0].node == 'sumo_bridge'
    assert graph.faults[0].run_number == 1
    assert graph.faults[0].error_code == GroundSimulatorError.default_code
    assert len(graph.states) == 1, 'no state of a tick that failed'


def test_inside_the_window_commands_alone_move_it(graph: Graph) -> None:
    graph.load()
    graph.send_tick(3)
    graph.await_states(1)
    for tick in (1, 2, 3):
        graph.send_command(tick)
        graph.await_states(tick + 1)
    graph.send_command(4)
    assert not wait_until(lambda: len(graph.states) > 4, 0.3), 'advanced beyond the window'
    graph.send_tick(4)
    graph.await_states(5)
    assert [state.tick for state in graph.states] == [0, 1, 2, 3, 4]
    assert not graph.faults


def test_it_is_loaded_once_for_a_run_and_tells_what_it_did(graph: Graph) -> None:
    asked = Account(graph.load())
    with pytest.raises(ExecutionError, match='loaded already: ground/load') as caught:
        graph.load(weather='heavy_rain')
    assert caught.value.component == 'sumo_bridge'
    graph.send_tick(3)
    graph.await_states(1)
    driven: dict[str, Any] = {
        'agent': array('H', [0]),
        'kind': array('B', [GroundCommandKind.SET_SPEED]),
        'value': array('d', [5.1]),
        'value2': array('d', [0.0]),
        'text': [''],
    }
    graph.send_command(1, **driven)
    graph.send_command(2)
    graph.await_states(3)
    commands = (b'', told(GroundCommand(**driven)), b'')
    for command, state in zip(commands, graph.states, strict=True):
        asked.add(command, state.data)
    asked.compare(graph.play.call(on.GROUND_DIGEST, run_number=1), 'sumo_bridge')
    with pytest.raises(ExecutionError, match='run 2 was not the last one to be loaded'):
        graph.play.call(on.GROUND_DIGEST, run_number=2)


def test_another_command_for_the_same_tick_ends_the_run(graph: Graph) -> None:
    graph.load()
    graph.send_tick(0)
    graph.await_states(1)
    graph.send_command(1)
    graph.send_command(1, text=['of somebody else'])
    assert wait_until(lambda: bool(graph.faults), 10.0), graph.process.log
    assert 'network: two inputs for tick 1' in graph.faults[0].error_msg


def test_a_load_waits_for_everybody_who_must_hear_the_state(graph: Graph) -> None:
    with pytest.raises(ExecutionError, match=r'ground/state \(1 of 2\)'):
        graph.load(listeners=2)
    more = graph.play.collect(on.GROUND_STATE)
    graph.load(listeners=2)
    graph.send_tick(0)
    graph.await_states(1)
    assert wait_until(lambda: len(more) == 1, 5.0)


def test_a_load_that_cannot_be_is_refused_with_code_and_reason(graph: Graph) -> None:
    with pytest.raises(MapError, match='expected digest 00'):
        graph.load(map_digest='00' * 32)
    with pytest.raises(GroundSimulatorError, match='agents_json is not valid'):
        graph.load(agents_json='[{"agent_id": 3}]')
    with pytest.raises(GroundSimulatorError, match='ego') as caught:
        graph.load(agents_json=agents_json(lane_position_m=1e6))
    assert caught.value.component == 'sumo_bridge'
    graph.load()


def test_a_state_of_uavs_is_shown_in_its_run_alone() -> None:
    """The client is the one of the local engine; its own tests look into SUMO."""
    client = SumoClient()
    client.load(ground_load(LoadGround.Request(**{**FIELDS, 'run_number': 3})))
    node = SimpleNamespace(_client=client, is_in_run=lambda run_number: run_number == 3)
    rows = np.zeros((2, UAV_WIDTH))
    rows[:, :2] = (-12.0, 7.5), (30.0, -4.0)
    for run_number, shown in ((2, 0), (3, 2)):
        state = UavState(run_number=run_number, data=array('d', rows.tobytes()))
        SumoBridgeNode._on_uav_state(node, state)  # type: ignore[arg-type]
        assert libsumo.poi.getIDCount() == shown
    places = [libsumo.poi.getPosition(proxy_id(row)) for row in range(2)]
    assert places == [pytest.approx(row) for row in rows[:, :2].tolist()]
    client.close()
