# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The viewer as a process, beside a run that is played: what RViz and Foxglove would hear."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest

pytest.importorskip('rclpy')

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.map_types import Building
from aurora_core.knowledge.world import Wind, WorldModel
from aurora_core.trace import messages
from aurora_core.trace.layout import GROUND_WIDTH, UAV_WIDTH, GroundColumn, UavColumn
from aurora_core.trace.records import EventRecord, ScenarioEventKind, SightRecord
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_nodes.viewer import has_transforms
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import message_builder, message_class, world_message
from aurora_ros.interfaces import Topic
from aurora_ros.qos import VIEW
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import Partner, partner

pytestmark = pytest.mark.ros

DT_S = 0.05
LIMIT_S = 60.0


def _entry(name: str, kind: str, system_id: int = 0) -> RosterEntry:
    return RosterEntry(
        body_id=name, type_name=kind, is_person=False, system_id=system_id, length_m=4.0,
        width_m=2.0, height_m=1.5, route_xy_m=((0.0, 0.0), (90.0, 0.0)),
    )  # fmt: skip


ROSTER = Roster(dt_s=DT_S, agents=(_entry('ego', 'car'),), uavs=(_entry('uav1', 'uav', 1),))


def _world() -> WorldModel:
    ring = ((0.0, 20.0), (10.0, 20.0), (10.0, 30.0))
    house = Building(
        id='b', ring=ring, holes=(), height_m=9.0, height_source='design', kind='house', name=''
    )
    return WorldModel(
        map_name='street', map_digest='d' * 64, origin_lat_deg=47.0, origin_lon_deg=8.0,
        weather='clear', time_of_day='noon', wind=Wind(), buildings=(house,), no_fly_zones=(),
        surfaces=(), lanes=(), signals=(), limits=load_limits(config_path('limits.json')),
    )  # fmt: skip


@pytest.fixture
def play() -> Iterator[Partner]:
    """A viewer of its own process, and who plays the graph."""
    with own_domain() as domain, partner(domain) as partner_node:
        process = subprocess.Popen(
            [sys.executable, '-m', 'aurora_nodes.viewer'],
            env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        )
        try:
            yield partner_node
        finally:
            process.send_signal(signal.SIGINT)
            assert process.wait(timeout=LIMIT_S) == 0


def _until(done: Callable[[], bool]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while not done():
        assert time.monotonic() < end_s
        time.sleep(0.02)


def _standard(kind: str, name: str) -> Topic:
    return Topic(name=name, type=message_class(kind), qos=VIEW, writers=('viewer',))


def test_a_run_is_seen_in_standard_topics_while_it_goes_on(play: Partner) -> None:
    kinds = {
        '/markers': 'visualization_msgs/msg/MarkerArray',
        '/uavs/uav1/odometry': 'nav_msgs/msg/Odometry',
        '/uavs/uav1/fix': 'sensor_msgs/msg/NavSatFix',
        '/agents/ego/pose': 'geometry_msgs/msg/PoseStamped',
        '/diagnostics': 'diagnostic_msgs/msg/DiagnosticArray',
    }
    assert has_transforms(), 'neither ROS nor the workspace has tf2_msgs'
    kinds['/tf'] = 'tf2_msgs/msg/TFMessage'
    heard = {name: play.collect(_standard(kind, name)) for name, kind in kinds.items()}
    builder = message_builder(7, DT_S)
    states = {t: play.publisher(t) for t in (on.GROUND_STATE, on.UAV_STATE)}
    claims = {t: play.publisher(t) for t in (on.SENSING, on.EVENTS)}
    play.publisher(on.ROSTER).publish(builder.roster('run', ROSTER))
    play.publisher(on.WORLD).publish(world_message(builder, _world(), 'run'))
    _until(lambda: play.node.count_publishers('/uavs/uav1/fix') == 1)
    # Who comes late sees the scene as well: it is told again.
    _until(lambda: bool(heard['/markers']))

    shown = {marker.ns for marker in heard['/markers'][0].markers}
    assert shown == {'routes/ego', 'buildings'}
    claims[on.SENSING].publish(
        builder.sight(
            SightRecord(tick=0, observer='uav1', target='ego', visible=True, slant_range_m=30.0)
        )
    )
    claims[on.EVENTS].publish(
        builder.event(
            EventRecord(
                tick=0, sequence=0, kind=ScenarioEventKind.TRIGGERED, subject='e1', detail=''
            )
        )
    )
    time.sleep(0.5)
    for tick in range(40):
        ground = np.zeros((1, GROUND_WIDTH))
        ground[0, [GroundColumn.X, GroundColumn.HEADING_X, GroundColumn.PRESENT]] = tick, 1.0, 1.0
        uav = np.zeros((1, UAV_WIDTH))
        uav[0, [UavColumn.X, UavColumn.Z, UavColumn.QW]] = tick, 30.0, 1.0
        states[on.GROUND_STATE].publish(builder.state(messages.GROUND_STATE, tick, ground))
        states[on.UAV_STATE].publish(builder.state(messages.UAV_STATE, tick, uav))
        time.sleep(0.02)
    _until(lambda: all(heard.values()) and len(heard['/uavs/uav1/odometry']) > 5)

    odometry = heard['/uavs/uav1/odometry'][-1]
    tick = round((odometry.header.stamp.sec + odometry.header.stamp.nanosec * 1e-9) / DT_S)
    assert (odometry.pose.pose.position.x, odometry.pose.pose.position.z) == (tick, 30.0)
    assert heard['/uavs/uav1/fix'][-1].altitude == 30.0
    assert heard['/agents/ego/pose'][-1].header.frame_id == 'map'
    assert [s.name for s in heard['/diagnostics'][0].status] == ['e1']
    frames = {t.child_frame_id: t for t in heard['/tf'][-1].transforms}
    assert set(frames) == {'ego', 'uav1'}
    assert frames['uav1'].transform.translation.z == 30.0
    namespaces = {marker.ns for array in heard['/markers'] for marker in array.markers}
    assert {'bodies', 'sight'} <= namespaces
    # Fewer than there were ticks: a viewer is not worth a core.
    assert len(heard['/uavs/uav1/odometry']) <= 40
