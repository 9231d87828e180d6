# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The real uav_bridge node and uav_sim as processes; the test plays sync and executor."""

from __future__ import annotations

import signal
from array import array
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AirSimulatorError, AuroraError, SimulatorError
from aurora_core.trace.layout import (
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
)
from aurora_core.trace.messages import read_rows
from aurora_msgs.msg import SyncStatus, Tick, UavCommand
from aurora_ros import interfaces as on
from aurora_ros.conversions.states import Rows
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess, nodes

pytestmark = pytest.mark.ros

DT_S = 0.05
FloatArray = npt.NDArray[np.float64]


class Graph:
    def __init__(self, bridge: NodeProcess, simulator: NodeProcess, play: Partner) -> None:
        self.bridge = bridge
        self.simulator = simulator
        self.play = play
        self.states = play.collect(on.UAV_STATE)
        self.faults = play.collect(on.FAULT)
        self.tick = play.publisher(on.TICK)
        self.command = play.publisher(on.UAV_COMMAND)
        self.status = play.publisher(on.SYNC_STATUS)

    def load(self, run_number: int = 1, **changes: Any) -> None:
        fields = {
            'run_id': 'r',
            'run_number': run_number,
            'seed': 1,
            'dt_s': DT_S,
            'horizon_s': 60.0,
            'uav_id': ['uav1'],
            'system_id': array('B', [1]),
            'home_xy_m': array('d', [10.0, -20.0]),
            'home_yaw_enu_rad': array('d', [0.0]),
            'origin_lat_deg': 48.0,
            'origin_lon_deg': 11.0,
            **changes,
        }
        self.play.call(on.UAV_LOAD, 20.0, **fields)

    def step(self, tick: int, row: FloatArray, run_number: int = 1) -> FloatArray:
        count = len(self.states)
        if tick:
            self.command.publish(Rows(UavCommand, run_number, DT_S).at(tick, row[None, :]))
        self.tick.publish(Tick(run_number=run_number, tick=tick))
        assert wait_until(lambda: len(self.states) > count, 10.0), self.bridge.log
        rows = read_rows(self.states[count], UAV_WIDTH)
        return np.array(rows[0])

    def fly(self, ticks: int, run_number: int = 1) -> FloatArray:
        """Take off for some ticks; return the states (ticks, UAV_WIDTH)."""
        row = np.zeros(UAV_COMMAND_WIDTH)
        row[UavCommandColumn.MODE] = UavMode.TAKEOFF
        row[UavCommandColumn.TAKEOFF_ALTITUDE] = 10.0
        return np.array([self.step(tick, row, run_number) for tick in range(ticks)])


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    with own_domain() as domain, partner(domain) as play:
        simulator = ForkedNode('aurora_uav_sim.udp_main', domain, tmp_path)
        bridge = ForkedNode(
            'aurora_uav_bridge.node',
            domain,
            tmp_path,
            ['--ros-args', '-p', 'answer_limit_s:=0.5'],
        )
        with nodes(simulator, bridge):
            yield Graph(bridge, simulator, play)
            assert bridge.end(signal.SIGTERM) == 0
            assert 'Traceback' not in bridge.log


def test_two_flights_from_home_are_alike_to_the_last_bit(graph: Graph) -> None:
    flights = []
    for run_number in (1, 2):
        graph.load(run_number)
        flights.append(graph.fly(60, run_number))
        graph.status.publish(SyncStatus(run_number=run_number, state=SyncStatus.FINISHED))
    first = flights[0]
    assert first[0, UavColumn.X : UavColumn.Z] == pytest.approx([10.0, -20.0], abs=0.05)
    assert first[0, UavColumn.LANDED] == 1.0
    assert first[-1, UavColumn.Z] > 1.0
    assert first[-1, UavColumn.MODE] == UavMode.TAKEOFF
    assert flights[0].tobytes() == flights[1].tobytes()
    assert [state.tick for state in graph.states] == [*range(60), *range(60)]
    assert not graph.faults


def test_a_simulator_that_dies_becomes_a_fault_that_names_it(graph: Graph) -> None:
    graph.load()
    graph.fly(3)
    graph.simulator.kill()
    row = np.zeros((1, UAV_COMMAND_WIDTH))
    graph.command.publish(Rows(UavCommand, 1, DT_S).at(3, row))
    graph.tick.publish(Tick(run_number=1, tick=3))
    assert wait_until(lambda: bool(graph.faults), 10.0), graph.bridge.log
    assert graph.faults[0].node == 'uav_bridge'
    assert graph.faults[0].error_msg.startswith('uav_sim: ')
    assert len(graph.states) == 3, 'no state of a tick that failed'
    with pytest.raises(AuroraError, match='did not answer') as caught:
        graph.load(run_number=2)
    assert caught.value.component == 'uav_sim'


def test_a_load_out_of_range_is_refused_and_the_next_one_works(graph: Graph) -> None:
    with pytest.raises(SimulatorError, match='home of uav1, x_m: expected a number'):
        graph.load(home_xy_m=array('d', [float('nan'), 0.0]))
    with pytest.raises(AirSimulatorError, match='load of the UAVs'):
        graph.load(home_yaw_enu_rad=array('d'))
    graph.load()
    assert graph.step(0, np.zeros(UAV_COMMAND_WIDTH))[UavColumn.LANDED] == 1.0
