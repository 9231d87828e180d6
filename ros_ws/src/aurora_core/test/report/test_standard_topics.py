# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bag of standard topics, read back by readers that are not ours."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import yaml
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from aurora_core.errors import BagError
from aurora_core.report.standard_topics import EVERY_TICKS, write_standard_bag
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import LinkEventKind, LinkRecord, LossReason, SightRecord

VIEWERS = Path(__file__).resolve().parents[5] / 'config' / 'viewers'


@pytest.fixture
def folder(make: SimpleNamespace, tmp_path: Path) -> Path:
    made = tmp_path / 'standard'
    write_standard_bag(made, make.trace(), make.world())
    return made


def _messages(folder: Path, topic: str) -> list[tuple[int, Any]]:
    with AnyReader([folder]) as reader:
        chosen = [c for c in reader.connections if c.topic == topic]
        return [(t, reader.deserialize(raw, c.msgtype)) for c, t, raw in reader.messages(chosen)]


def test_every_topic_has_a_standard_type(folder: Path) -> None:
    with (folder / f'{folder.name}.mcap').open('rb') as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    names = {c.topic: summary.schemas[c.schema_id].name for c in summary.channels.values()}
    assert not [name for name in names.values() if name.startswith('aurora_msgs')]
    assert names['/tf'] == 'tf2_msgs/msg/TFMessage'
    assert names['/markers'] == 'visualization_msgs/msg/MarkerArray'
    kinds = {topic.rsplit('/', 1)[1]: name for topic, name in names.items()}
    assert kinds['odometry'] == 'nav_msgs/msg/Odometry'
    assert kinds['fix'] == 'sensor_msgs/msg/NavSatFix'
    assert kinds['pose'] == 'geometry_msgs/msg/PoseStamped'
    # As rosbag2 has them: the layouts are inside.
    assert all(schema.encoding == 'ros2msg' and schema.data for schema in summary.schemas.values())


def test_it_is_compressed_in_chunks_as_the_record_is(folder: Path) -> None:
    with (folder / f'{folder.name}.mcap').open('rb') as stream:
        summary = make_reader(stream, validate_crcs=True).get_summary()
    assert summary is not None
    assert {chunk.compression for chunk in summary.chunk_indexes} == {'zstd'}
    raw = sum(chunk.uncompressed_size for chunk in summary.chunk_indexes)
    assert sum(chunk.compressed_size for chunk in summary.chunk_indexes) < 0.3 * raw


def test_poses_are_those_of_the_trace(folder: Path, make: SimpleNamespace) -> None:
    trace = make.trace()
    uav = trace.roster.uavs[0]
    states = trace.uav[::EVERY_TICKS, 0]
    flown = _messages(folder, f'/uavs/{uav.body_id}/odometry')
    assert len(flown) == len(states)
    for (time_ns, message), state in zip(flown[::20], states[::20], strict=True):
        place = message.pose.pose.position
        assert (place.x, place.y, place.z) == tuple(state[UavColumn.X : UavColumn.VX])
        assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == time_ns
        assert message.child_frame_id == uav.body_id
        # In the body's frame, and as fast.
        v = message.twist.twist.linear
        speed = np.linalg.norm(state[UavColumn.VX : UavColumn.QW])
        assert np.linalg.norm([v.x, v.y, v.z]) == pytest.approx(speed, abs=1e-9)
    agent = trace.roster.agents[0]
    driven = _messages(folder, f'/agents/{agent.body_id}/pose')
    heading = trace.ground[0, 0, [GroundColumn.HEADING_X, GroundColumn.HEADING_Y]]
    turn = driven[0][1].pose.orientation
    found = (turn.w**2 - turn.z**2, 2 * turn.w * turn.z)
    assert found == pytest.approx(tuple(heading), abs=1e-6)


def test_a_frame_has_one_parent_and_is_the_pose(folder: Path, make: SimpleNamespace) -> None:
    bodies = {e.body_id for e in (*make.trace().roster.agents, *make.trace().roster.uavs)}
    seen = set()
    for _, message in _messages(folder, '/tf'):
        children = [t.child_frame_id for t in message.transforms]
        assert len(children) == len(set(children))
        assert all(t.header.frame_id == 'map' for t in message.transforms)
        seen.update(children)
    assert seen == bodies


def test_a_message_is_an_arrow_between_those_who_speak(
    make: SimpleNamespace, tmp_path: Path
) -> None:
    trace = make.trace()
    uav, agent = trace.roster.uavs[0].body_id, trace.roster.agents[0].body_id
    sent = LinkRecord(
        tick=100, sequence=0, message=7, link='l1', event='e1', sender=uav, receiver=agent,
        kind=LinkEventKind.SENT, attempt=0, reason=LossReason.NONE, distance_m=20.0,
        line_of_sight=True,
    )  # fmt: skip
    write_standard_bag(tmp_path / 'b', replace(trace, links=(sent,)), make.world())
    arrows = [
        (time_ns, marker)
        for time_ns, message in _messages(tmp_path / 'b', '/markers')
        for marker in message.markers
        if marker.ns == 'messages'
    ]
    ((time_ns, arrow),) = arrows
    assert time_ns == 5_000_000_000
    assert (arrow.points[0].x, arrow.points[0].z) == tuple(trace.uav[100, 0, [0, 2]])
    assert arrow.points[1].x == trace.ground[100, 0, 0]
    # It was sent and never arrived: red.
    assert arrow.color.r > 2.0 * arrow.color.b


def test_ways_and_sight_lines_can_be_seen(make: SimpleNamespace, tmp_path: Path) -> None:
    trace = make.trace()
    uav, agent = trace.roster.uavs[0].body_id, trace.roster.agents[0].body_id
    sights = tuple(
        SightRecord(tick=tick, observer=uav, target=agent, visible=seen, slant_range_m=40.0)
        for tick, seen in ((100, True), (200, False))
    )
    route = ((0.0, 0.0), (50.0, 0.0), (50.0, 20.0))
    roster = replace(trace.roster, agents=(replace(trace.roster.agents[0], route_xy_m=route),))
    ground = trace.ground.copy()
    ground[300:, 0, GroundColumn.PRESENT] = 0.0
    seen_run = replace(trace, sights=sights, roster=roster, ground=ground)
    write_standard_bag(tmp_path / 'b', seen_run, make.world())
    shown = [
        (time_ns * 1e-9, marker)
        for time_ns, message in _messages(tmp_path / 'b', '/markers')
        for marker in message.markers
    ]
    (planned,) = (m for _, m in shown if m.ns == f'routes/{agent}')
    assert [(p.x, p.y) for p in planned.points] == list(route)
    (flown,) = (m for _, m in shown if m.ns == f'flights/{uav}')
    assert max(p.z for p in flown.points) == pytest.approx(trace.uav[:, 0, 2].max(), abs=0.5)
    lines = [(time_s, m) for time_s, m in shown if m.ns == 'sight']
    # From what is first known on, and no longer than both are there.
    assert [lines[0][0], lines[-1][0]] == pytest.approx([5.0, 14.9])
    green = [m.color.g > m.color.r for _, m in lines]
    assert green == [time_s < 10.0 for time_s, _ in lines]
    tick = round(lines[20][0] / trace.roster.dt_s)
    assert lines[20][1].points[1].x == trace.ground[tick, 0, GroundColumn.X]


def test_an_existing_folder_is_left_alone(folder: Path, make: SimpleNamespace) -> None:
    with pytest.raises(BagError):
        write_standard_bag(folder, make.trace(), make.world())


def test_the_viewers_ask_for_topics_that_are_there(folder: Path) -> None:
    with AnyReader([folder]) as reader:
        topics = {c.topic: c.msgtype for c in reader.connections}
    rviz = yaml.safe_load((VIEWERS / 'aurora.rviz').read_text(encoding='utf-8'))
    for display in rviz['Visualization Manager']['Displays']:
        if 'Topic' in display:
            kind = topics[display['Topic']['Value']]
            assert kind.rsplit('/', 1)[1] == display['Class'].rsplit('/', 1)[1]
    layout = json.loads((VIEWERS / 'aurora.foxglove.json').read_text(encoding='utf-8'))
    panels = layout['configById']
    asked = [*panels['3D!run']['topics'], panels['RawMessages!said']['topicPath']]
    assert set(asked) <= set(topics)
    # Every panel that is laid out is there, and the other way round.
    assert set(_leaves(layout['layout'])) == set(panels)


def test_the_plots_ask_for_fields_that_are_there(folder: Path) -> None:
    layout = json.loads((VIEWERS / 'aurora.foxglove.json').read_text(encoding='utf-8'))
    plots = [panel for name, panel in layout['configById'].items() if name.startswith('Plot!')]
    assert len(plots) == 2
    for plot in plots:
        for path in plot['paths']:
            topic, *fields = path['value'].split('.')
            value = _messages(folder, topic)[20][1]
            for field in fields:
                value = getattr(value, field)
            assert isinstance(value, float)
            # It is stamped, as the plot asks for.
            assert _messages(folder, topic)[20][1].header.stamp.sec == 2


def _leaves(layout: Any) -> list[str]:
    if isinstance(layout, str):
        return [layout]
    return _leaves(layout['first']) + _leaves(layout['second'])
