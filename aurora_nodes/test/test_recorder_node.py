# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The real recorder as a process: everything of the run, each once, byte for byte."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip('rclpy')

from mcap.reader import make_reader
from rclpy.duration import Duration

from aurora_core.errors import BagError
from aurora_core.trace.bag_metadata import file_sha256
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import GROUND_WIDTH
from aurora_core.trace.records import EventRecord, ScenarioEventKind
from aurora_core.trace.roster import Roster
from aurora_msgs.msg import GroundState, Heartbeat
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import message_builder
from aurora_ros.conversions.states import Rows
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess, nodes

pytestmark = pytest.mark.ros

RUN, DT_S = 77, 0.05
ROWS = np.arange(3.0 * GROUND_WIDTH).reshape(3, GROUND_WIDTH)
BUILDER = message_builder(RUN, DT_S)
TOPICS = [on.GROUND_STATE.full_name, on.EVENTS.full_name, on.ROSTER.full_name]


class Graph:
    def __init__(self, process: NodeProcess, play: Partner) -> None:
        self.process = process
        self.play = play
        self.state = play.publisher(on.GROUND_STATE)
        self.events = play.publisher(on.EVENTS)
        self.roster = play.publisher(on.ROSTER)
        self.acks = play.collect(on.ACK)
        self.faults = play.collect(on.FAULT)

    def start(self, directory: Path, run_number: int = RUN, **changes: Any) -> Any:
        fields = {
            'run_id': 'r1',
            'run_number': run_number,
            'directory': str(directory),
            'topics': TOPICS,
            **changes,
        }
        return self.play.call(on.RECORDER_START, **fields)

    def stop(self, counts: dict[str, int] | None = None, **changes: Any) -> Any:
        fields = {
            'run_number': RUN,
            'expected_topics': list(counts or {}),
            'expected_counts': list((counts or {}).values()),
            **changes,
        }
        return self.play.call(on.RECORDER_STOP, **fields)

    def send_states(self, ticks: range, run_number: int = RUN) -> None:
        for tick in ticks:
            self.state.publish(Rows(GroundState, run_number, DT_S).at(tick, ROWS + tick))


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    options = ['match_limit_s:=1.0', 'stop_limit_s:=1.0']
    arguments = ['--ros-args', *(word for option in options for word in ('-p', option))]
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode('aurora_nodes.recorder', domain, tmp_path, arguments)
        with nodes(process):
            yield Graph(process, play)
            assert process.end(signal.SIGINT) == 0
            assert 'Traceback' not in process.log


def messages(bag: Path) -> list[tuple[str, bytes, int]]:
    file = next(bag.glob('*.mcap'))
    with file.open('rb') as stream:
        return [
            (channel.topic, message.data, message.log_time)
            for _, channel, message in make_reader(stream).iter_messages(log_time_order=False)
        ]


def test_the_whole_run_and_nothing_else_is_stored(graph: Graph, tmp_path: Path) -> None:
    graph.send_states(range(2), run_number=RUN - 1)
    graph.start(tmp_path / 'bag')
    roster = Roster(dt_s=DT_S, agents=(), uavs=())
    graph.roster.publish(BUILDER.roster('another', roster))
    graph.roster.publish(BUILDER.roster('r1', roster))
    graph.send_states(range(2, 4), run_number=RUN - 1)
    graph.send_states(range(100))
    event = EventRecord(
        tick=99, sequence=0, kind=ScenarioEventKind.FINISHED, subject='run', detail='x'
    )
    for _ in range(3):
        graph.events.publish(BUILDER.event(event))
    counts = {on.GROUND_STATE.full_name: 100, on.EVENTS.full_name: 3, on.ROSTER.full_name: 1}
    done = graph.stop(counts, last_tick=99)
    assert dict(zip(done.topics, done.counts, strict=True)) == counts
    bag = Path(done.bag_uri)
    assert done.sha256 == file_sha256(next(bag.glob('*.mcap')))
    stored = messages(bag)
    states = [m for m in stored if m[0] == on.GROUND_STATE.full_name]
    assert [m[2] for m in states] == [tick * 50_000_000 for tick in range(100)]
    decoded = message_definitions().decode('aurora_msgs/msg/GroundState', states[42][1])
    assert decoded.run_number == RUN
    assert np.array_equal(decoded.data.reshape(3, -1), ROWS + 42)
    assert sum(m[0] == on.EVENTS.full_name for m in stored) == 3
    assert (bag / 'metadata.yaml').is_file()


def test_ticks_are_acknowledged_as_they_are_stored(graph: Graph, tmp_path: Path) -> None:
    graph.start(tmp_path / 'bag')
    graph.send_states(range(45))
    assert wait_until(lambda: bool(graph.acks) and graph.acks[-1].tick >= 19, 5.0)
    assert all(ack.run_number == RUN and ack.observer == 'recorder' for ack in graph.acks)
    graph.stop({on.GROUND_STATE.full_name: 45})


def test_a_second_recording_after_the_first(graph: Graph, tmp_path: Path) -> None:
    for k in range(2):
        graph.start(tmp_path / f'bag.{k}')
        graph.send_states(range(30))
        done = graph.stop({on.GROUND_STATE.full_name: 30})
        assert len(messages(Path(done.bag_uri))) == 30


def test_a_topic_that_nobody_publishes_is_named(graph: Graph, tmp_path: Path) -> None:
    with pytest.raises(BagError, match='nobody publishes /aurora/uav/state'):
        graph.start(tmp_path / 'bag', topics=[on.UAV_STATE.full_name, *TOPICS])
    with pytest.raises(BagError, match='that are recorded, found'):
        graph.start(tmp_path / 'bag', topics=['/aurora/nonsense'])
    assert not (tmp_path / 'bag').exists()


def test_what_never_arrived_is_named_and_the_bag_is_closed(graph: Graph, tmp_path: Path) -> None:
    graph.start(tmp_path / 'bag')
    graph.send_states(range(10))
    with pytest.raises(BagError, match=r"are missing in the bag: \{'/aurora/ground/state': 2\}"):
        graph.stop({on.GROUND_STATE.full_name: 12})
    assert len(messages(tmp_path / 'bag')) == 10
    with pytest.raises(BagError, match='no recording of run'):
        graph.stop()


def test_a_lost_sample_ends_the_run_by_a_fault_and_keeps_the_bag(
    graph: Graph, tmp_path: Path
) -> None:
    graph.start(tmp_path / 'bag')
    graph.send_states(range(10))
    graph.send_states(range(11, 13))
    assert wait_until(lambda: bool(graph.faults), 5.0), graph.process.log
    assert graph.faults[0].node == 'recorder'
    assert 'expected tick 10 on /aurora/ground/state, found 11' in graph.faults[0].error_msg
    assert len(messages(tmp_path / 'bag')) == 10


def test_a_folder_that_exists_is_refused_with_a_code(graph: Graph, tmp_path: Path) -> None:
    (tmp_path / 'bag').mkdir()
    with pytest.raises(BagError, match='cannot create the bag') as caught:
        graph.start(tmp_path / 'bag')
    assert caught.value.code == BagError.default_code
    graph.start(tmp_path / 'bag.0')


def test_a_call_makes_no_folder_but_that_of_a_bag(graph: Graph, tmp_path: Path) -> None:
    for named in ('autostart', 'run/../bag.0', 'bag.0/x', 'bag.\u0661', 'bag.0\n'):
        with pytest.raises(BagError, match='expected an absolute path'):
            graph.start(tmp_path / named)
    with pytest.raises(BagError, match='expected an absolute path'):
        graph.start(Path('bag.0'))
    assert not list(tmp_path.glob('*bag*'))
    assert not (tmp_path / 'autostart').exists()


def test_who_starts_another_recording_during_a_run_is_refused(
    graph: Graph, tmp_path: Path
) -> None:
    # The recorder and the partner's own watch. What comes late would be said within the run.
    executor = graph.play.publisher(on.HEARTBEAT, subscribers=2)
    executor.publish(Heartbeat(node='executor', state=Heartbeat.IDLE))
    assert executor.wait_for_all_acked(Duration(seconds=5))
    graph.start(tmp_path / 'bag')
    graph.send_states(range(10))
    for _ in range(2):  # before the executor's first heartbeat in the run, and after it
        with pytest.raises(BagError, match=f'run {RUN} is being recorded'):
            graph.start(tmp_path / 'stray', run_number=0, topics=[])
        executor.publish(Heartbeat(node='executor', state=Heartbeat.BUSY, run_number=RUN))
        assert executor.wait_for_all_acked(Duration(seconds=5))
    graph.send_states(range(10, 30))
    graph.stop({on.GROUND_STATE.full_name: 30})


def test_a_recording_that_an_earlier_run_left_open_is_closed(graph: Graph, tmp_path: Path) -> None:
    executor = graph.play.publisher(on.HEARTBEAT, subscribers=2)
    graph.start(tmp_path / 'bag.0')
    executor.publish(Heartbeat(node='executor', state=Heartbeat.BUSY, run_number=RUN + 1))
    assert executor.wait_for_all_acked(Duration(seconds=5))
    graph.start(tmp_path / 'bag.1', run_number=RUN + 1)
    graph.stop(run_number=RUN + 1)
    assert (tmp_path / 'bag.0' / 'metadata.yaml').is_file()


def test_ending_the_node_closes_the_bag(graph: Graph, tmp_path: Path) -> None:
    graph.start(tmp_path / 'bag')
    graph.send_states(range(25))
    assert wait_until(lambda: bool(graph.acks), 5.0)
    assert graph.process.end() == 0
    assert len(messages(tmp_path / 'bag')) == 25
    assert (tmp_path / 'bag' / 'metadata.yaml').is_file()
