# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The real sync node as a process, with fake participants."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AuroraError, ExecutionError, GroundSimulatorError
from aurora_msgs.msg import Ack, Fault, SyncStatus, Tick, TickDone
from aurora_ros import interfaces as on
from aurora_ros.errors import write_error
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess, nodes

pytestmark = pytest.mark.ros

RUN = 3


class Graph:
    """The node under test and a partner that plays everybody else."""

    def __init__(self, process: NodeProcess, play: Partner) -> None:
        self.process = process
        self.play = play
        self.done = play.publisher(on.TICK_DONE)
        self.ack = play.publisher(on.ACK)
        self.fault = play.publisher(on.FAULT)
        self.statuses = play.collect(on.SYNC_STATUS)
        self.clocks = play.collect(on.CLOCK)
        self.grants: list[int] = []
        self.answering: dict[str, int] = {}
        self.finish_at = -1
        play.on(on.TICK, self._on_tick)

    def _on_tick(self, tick: Tick) -> None:
        """Answer as the participants do: what is granted, until one of them falls silent."""
        assert tick.run_number == RUN
        first = self.grants[-1] + 1 if self.grants else 0
        self.grants.append(tick.tick)
        for number in range(first, tick.tick + 1):
            answering = [name for name, last in self.answering.items() if number <= last]
            for name in answering:
                finished = number == self.finish_at
                self.done.publish(
                    TickDone(run_number=RUN, tick=number, participant=name, finished=finished)
                )
            if len(answering) < len(self.answering) or number == self.finish_at:
                return

    def load(self, **changes: object) -> None:
        fields: dict[str, Any] = {
            'run_id': 'r',
            'run_number': RUN,
            'dt_s': 0.05,
            'horizon_s': 60.0,
            'participants': ['sumo_bridge', 'executor'],
            **changes,
        }
        self.play.call(on.SYNC_LOAD, **fields)

    def start(self) -> None:
        self.play.call(on.SYNC_START, run_number=RUN)

    def await_state(self, state: int) -> SyncStatus:
        assert wait_until(lambda: any(s.state == state for s in self.statuses), 10.0), (
            self.statuses,
            self.process.log,
        )
        return next(s for s in self.statuses if s.state == state)


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode(
            'aurora_sync.node',
            domain,
            tmp_path,
            ['--ros-args', '-p', 'silence_limit_s:=0.5', '-p', 'recorder_credit_ticks:=10'],
        )
        with nodes(process):
            yield Graph(process, play)
            assert process.end(signal.SIGTERM) == 0
            assert 'Traceback' not in process.log
            assert not process.ready_file.exists()


def test_two_participants_run_to_the_end(graph: Graph) -> None:
    graph.answering = {'sumo_bridge': 99, 'executor': 99}
    graph.finish_at = 40
    graph.load()
    graph.start()
    status = graph.await_state(SyncStatus.FINISHED)
    assert graph.grants == [1200], 'without observers nothing but the horizon ends the window'
    assert status.tick == 40
    assert graph.play.call(on.SYNC_STOP, run_number=RUN).last_tick == 40
    assert graph.clocks[-1].clock.sec == 2


def test_a_silent_participant_is_named(graph: Graph) -> None:
    graph.answering = {'sumo_bridge': 2, 'executor': 99}
    graph.load()
    graph.start()
    status = graph.await_state(SyncStatus.FAILED)
    assert status.failed_participant == 'sumo_bridge'
    assert status.error_code == 510
    assert 'sumo_bridge did not finish tick 3 within 0.5 s' in status.error_msg
    assert status.tick == 3


def test_the_clock_is_held_until_the_recorder_acknowledges(graph: Graph) -> None:
    graph.answering = {'sumo_bridge': 99, 'executor': 99}
    graph.finish_at = 15
    graph.load(observers=['recorder'])
    graph.start()
    assert wait_until(lambda: graph.grants == [9], 5.0)
    graph.ack.publish(Ack(run_number=RUN, observer='recorder', tick=9))
    graph.await_state(SyncStatus.FINISHED)
    assert graph.grants == [9, 19]


def test_a_fault_ends_the_run_at_once(graph: Graph) -> None:
    graph.answering = {'sumo_bridge': -1, 'executor': 99}
    graph.load()
    graph.start()
    message = Fault(run_number=RUN, node='sumo_bridge')
    write_error(message, GroundSimulatorError('car_1 vanished', hint='look'))
    graph.fault.publish(message)
    status = graph.await_state(SyncStatus.FAILED)
    assert status.failed_participant == 'sumo_bridge'
    assert status.error_code == 410
    assert 'car_1 vanished' in status.error_msg


def test_stop_and_a_second_run(graph: Graph) -> None:
    graph.answering = {'sumo_bridge': 5, 'executor': 5}
    graph.load()
    graph.start()
    assert wait_until(lambda: any(c.clock.nanosec == 300_000_000 for c in graph.clocks), 5.0)
    assert graph.play.call(on.SYNC_STOP, run_number=RUN).last_tick == 5
    graph.grants.clear()
    graph.finish_at = 3
    graph.load()
    graph.start()
    assert graph.await_state(SyncStatus.FINISHED).tick == 3
    assert graph.grants == [1200]


def test_wrong_calls_are_answered_with_a_code(graph: Graph) -> None:
    with pytest.raises(ExecutionError, match='to be loaded'):
        graph.start()
    with pytest.raises(AuroraError, match='positive time step') as caught:
        graph.load(dt_s=0.0)
    assert caught.value.code == 500
    assert caught.value.component == 'sync'
