# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded run as a second bag of ROS's own message types, for viewers and other tools.

Made from the bag of a run, so that the record a verdict needs stays as small as it is. Frames:
`map` is the world (ENU, m), each body has a frame of its name (FLU, its origin as in the trace).
The altitude of NavSatFix is above the flat ground: maps carry no height above the ellipsoid.

Source: REP-103, REP-105.
"""

from __future__ import annotations

from collections import Counter
from math import sqrt
from pathlib import Path
from typing import Any, Literal

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from aurora_core.errors import BagError
from aurora_core.geometry.frames import enu_to_geodetic
from aurora_core.knowledge.world import WorldModel
from aurora_core.report.export.thinning import kept_samples
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import LinkEventKind, SightRecord
from aurora_core.trace.roster import RosterEntry
from aurora_core.trace.trace import Trace

MAP_FRAME = 'map'
MARKERS, DIAGNOSTICS, TRANSFORMS = '/markers', '/diagnostics', '/tf'
# Every second tick of 0.05 s: what a viewer shows smoothly.
EVERY_TICKS = 2
_VERSION: Literal[9] = 9
_AGENT_RGB, _UAV_RGB, _MESSAGE_RGB = (0.0, 0.45, 0.7), (0.84, 0.37, 0.0), (0.48, 0.25, 0.63)
_ZONE_RGB, _BUILDING_RGB = (0.82, 0.19, 0.18), (0.7, 0.67, 0.62)
_SEEN_RGB, _LOST_RGB = (0.11, 0.5, 0.29), (0.71, 0.11, 0.11)
_MESSAGE_NS = 1_000_000_000
# Of `visualization_msgs/msg/Marker`.
_ARROW, _CUBE, _LINE_STRIP = 0, 1, 4
# The lines of flights are off by no more than this, m.
_FLIGHT_TOLERANCE_M = 0.5


def write_standard_bag(folder: Path, trace: Trace, world: WorldModel) -> dict[str, int]:
    """Write the bag and return its messages by topic.

    Args:
        folder: To create; it must not exist.
        trace: The run; who is absent at a tick, or has no sample there, is left out of it.
        world: Its world.

    Raises:
        BagError: The folder exists or cannot be written.
    """
    if folder.exists():
        raise BagError(f'{folder} exists', hint='name another folder')
    try:
        with Writer(folder, version=_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
            return dict(_Recorder(writer, trace, world).record())
    except OSError as err:
        raise BagError(
            f'cannot write the bag {folder}: {err}', hint='free some space or name another folder'
        ) from err


class _Recorder:
    """Turns ticks into messages."""

    def __init__(self, writer: Writer, trace: Trace, world: WorldModel) -> None:
        self._writer, self._trace, self._world = writer, trace, world
        self._store: Any = get_typestore(Stores.ROS2_JAZZY)
        self._connections: dict[str, Any] = {}
        self._counts: Counter[str] = Counter()
        self._sights: dict[tuple[str, str], list[SightRecord]] = {}
        for record in trace.sights:
            self._sights.setdefault((record.observer, record.target), []).append(record)
        self._delivered = {
            record.message for record in trace.links if record.kind is LinkEventKind.DELIVERED
        }

    def record(self) -> Counter[str]:
        trace = self._trace
        self._send(MARKERS, 'visualization_msgs/msg/MarkerArray', 0, markers=self._ground())
        for tick in range(0, trace.ticks, EVERY_TICKS):
            self._tick(tick, round(tick * trace.roster.dt_s * 1e9))
        return self._counts

    def _make(self, kind: str, /, **fields: Any) -> Any:
        return self._store.types[kind](**fields)

    def _send(self, topic: str, type_name: str, time_ns: int, **fields: Any) -> None:
        found = self._connections.get(topic)
        if found is None:
            found = self._writer.add_connection(topic, type_name, typestore=self._store)
            self._connections[topic] = found
        cdr = self._store.serialize_cdr(self._make(type_name, **fields), type_name)
        self._writer.write(found, time_ns, cdr)
        self._counts[topic] += 1

    def _header(self, time_ns: int) -> Any:
        sec, nanosec = divmod(time_ns, 1_000_000_000)
        stamp = self._make('builtin_interfaces/msg/Time', sec=sec, nanosec=nanosec)
        return self._make('std_msgs/msg/Header', stamp=stamp, frame_id=MAP_FRAME)

    def _pose(self, place: Any, turn: Any) -> Any:
        point = self._make('geometry_msgs/msg/Point', **_xyz(place))
        return self._make(
            'geometry_msgs/msg/Pose', position=point, orientation=self._quaternion(turn)
        )

    def _quaternion(self, turn: Any) -> Any:
        w, x, y, z = (float(v) for v in turn)
        return self._make('geometry_msgs/msg/Quaternion', x=x, y=y, z=z, w=w)

    def _vector(self, values: Any) -> Any:
        return self._make('geometry_msgs/msg/Vector3', **_xyz(values))

    def _tick(self, tick: int, time_ns: int) -> None:
        header = self._header(time_ns)
        transforms, markers = [], []
        for row, entry in enumerate(self._trace.roster.agents):
            state = self._trace.ground[tick, row]
            if not np.isfinite(state).all() or state[GroundColumn.PRESENT] < 0.5:
                continue
            place = (state[GroundColumn.X], state[GroundColumn.Y], 0.0)
            turn = _turn(state[GroundColumn.HEADING_X], state[GroundColumn.HEADING_Y])
            pose = self._pose(place, turn)
            name = 'geometry_msgs/msg/PoseStamped'
            self._send(f'/agents/{entry.body_id}/pose', name, time_ns, header=header, pose=pose)
            transforms.append(self._transform(header, entry, place, turn))
            middle = (*place[:2], entry.height_m / 2.0)
            markers.append(self._body(header, row, entry, middle, turn, _AGENT_RGB))
        for row, entry in enumerate(self._trace.roster.uavs):
            state = self._trace.uav[tick, row]
            if not np.isfinite(state).all():
                continue
            self._uav(header, time_ns, entry, state)
            place, turn = state[UavColumn.X : UavColumn.VX], state[UavColumn.QW : UavColumn.P]
            transforms.append(self._transform(header, entry, place, turn))
            number = 1000 + row
            markers.append(self._body(header, number, entry, place, turn, _UAV_RGB))
        markers += self._sight_lines(header, tick)
        markers += self._messages(header, tick)
        self._send(TRANSFORMS, 'tf2_msgs/msg/TFMessage', time_ns, transforms=transforms)
        self._send(MARKERS, 'visualization_msgs/msg/MarkerArray', time_ns, markers=markers)
        self._events(header, tick, time_ns)

    def _transform(self, header: Any, entry: RosterEntry, place: Any, turn: Any) -> Any:
        moved = self._make(
            'geometry_msgs/msg/Transform',
            translation=self._vector(place),
            rotation=self._quaternion(turn),
        )
        name = 'geometry_msgs/msg/TransformStamped'
        return self._make(name, header=header, child_frame_id=entry.body_id, transform=moved)

    def _uav(self, header: Any, time_ns: int, entry: RosterEntry, state: Any) -> None:
        place, turn = state[UavColumn.X : UavColumn.VX], state[UavColumn.QW : UavColumn.P]
        zeros = np.zeros(36)
        name = 'geometry_msgs/msg/TwistWithCovariance'
        pose = self._make(
            'geometry_msgs/msg/PoseWithCovariance', pose=self._pose(place, turn), covariance=zeros
        )
        twist = self._make(
            'geometry_msgs/msg/Twist',
            # The twist of an Odometry is in the child frame.
            linear=self._vector(_into_body(turn, state[UavColumn.VX : UavColumn.QW])),
            angular=self._vector(state[UavColumn.P : UavColumn.ARMED]),
        )
        self._send(
            f'/uavs/{entry.body_id}/odometry', 'nav_msgs/msg/Odometry', time_ns, header=header,
            child_frame_id=entry.body_id, pose=pose,
            twist=self._make(name, twist=twist, covariance=zeros),
        )  # fmt: skip
        latitude, longitude = enu_to_geodetic(
            float(place[0]), float(place[1]), self._world.origin_lat_deg,
            self._world.origin_lon_deg,
        )  # fmt: skip
        status = self._make('sensor_msgs/msg/NavSatStatus', status=0, service=1)
        self._send(
            f'/uavs/{entry.body_id}/fix', 'sensor_msgs/msg/NavSatFix', time_ns, header=header,
            status=status, latitude=latitude, longitude=longitude, altitude=float(place[2]),
            position_covariance=np.zeros(9), position_covariance_type=0,
        )  # fmt: skip

    def _marker(
        self, header: Any, ns: str, number: int, kind: int, rgb: tuple[float, float, float], *,
        scale: tuple[float, float, float], pose: Any = None, points: Any = (), alpha: float = 1.0,
        life_ns: int = 0, text: str = '',
    ) -> Any:  # fmt: skip
        red, green, blue = rgb
        sec, nanosec = divmod(life_ns, 1_000_000_000)
        duration = self._make('builtin_interfaces/msg/Duration', sec=sec, nanosec=nanosec)
        texture = self._make(
            'sensor_msgs/msg/CompressedImage', header=header, format='',
            data=np.zeros(0, dtype=np.uint8),
        )  # fmt: skip
        mesh = self._make(
            'visualization_msgs/msg/MeshFile', filename='', data=np.zeros(0, dtype=np.uint8)
        )
        return self._make(
            'visualization_msgs/msg/Marker', header=header, ns=ns, id=number, type=kind, action=0,
            pose=pose or self._pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
            scale=self._vector(scale),
            color=self._make('std_msgs/msg/ColorRGBA', r=red, g=green, b=blue, a=alpha),
            lifetime=duration, frame_locked=False,
            points=[self._make('geometry_msgs/msg/Point', **_xyz(p)) for p in points],
            colors=[], texture_resource='', texture=texture, uv_coordinates=[], text=text,
            mesh_resource='', mesh_file=mesh, mesh_use_embedded_materials=False,
        )  # fmt: skip

    def _body(
        self, header: Any, number: int, entry: RosterEntry, place: Any, turn: Any,
        rgb: tuple[float, float, float],
    ) -> Any:  # fmt: skip
        size = (entry.length_m, entry.width_m, entry.height_m)
        pose = self._pose(place, turn)
        return self._marker(
            header, 'bodies', number, _CUBE, rgb, scale=size, pose=pose, life_ns=self._moving_ns
        )

    @property
    def _moving_ns(self) -> int:
        """How long the marker of something that moves is shown: until a few others have come."""
        return round(3 * EVERY_TICKS * self._trace.roster.dt_s * 1e9)

    def _ground(self) -> list[Any]:
        """For the whole run: outlines of buildings (at their height) and of no-fly zones, ways."""
        header, strip = self._header(0), _LINE_STRIP
        markers = self._ways(header)
        for k, building in enumerate(self._world.buildings):
            ring = [(corner[0], corner[1], building.height_m) for corner in building.ring]
            markers.append(
                self._marker(
                    header, 'buildings', k, strip, _BUILDING_RGB, scale=(0.3, 0.0, 0.0),
                    points=[*ring, ring[0]],
                )
            )  # fmt: skip
        for k, zone in enumerate(self._world.no_fly_zones):
            ring = [(corner[0], corner[1], 0.5) for corner in zone.ring]
            markers.append(
                self._marker(
                    header, 'no_fly_zones', k, strip, _ZONE_RGB, scale=(0.8, 0.0, 0.0),
                    points=[*ring, ring[0]],
                )
            )  # fmt: skip
        return markers

    def _ways(self, header: Any) -> list[Any]:
        """Planned routes of who is on the ground, flights as they were flown."""
        trace = self._trace
        lines = [
            (f'routes/{entry.body_id}', _AGENT_RGB, [(x, y, 0.1) for x, y in entry.route_xy_m])
            for entry in trace.roster.agents
            if entry.role != 'background'
        ]
        for row, entry in enumerate(trace.roster.uavs):
            points = trace.uav[:, row, UavColumn.X : UavColumn.VX]
            here = np.flatnonzero(np.isfinite(points).all(axis=1))
            times_s = here.astype(np.float64) * trace.roster.dt_s
            kept = kept_samples(times_s, points[here], _FLIGHT_TOLERANCE_M)
            lines.append((f'flights/{entry.body_id}', _UAV_RGB, list(points[here][kept])))
        return [
            self._marker(
                header, ns, 0, _LINE_STRIP, rgb, scale=(0.25, 0.0, 0.0), points=points, alpha=0.5
            )
            for ns, rgb, points in lines
            if len(points) > 1
        ]

    def _sight_lines(self, header: Any, tick: int) -> list[Any]:
        """A line from each observer to its target: green while it sees it, red while not."""
        lines = []
        for number, ((observer, target), records) in enumerate(self._sights.items()):
            known = [record for record in records if record.tick <= tick]
            ends = [self._place(name, tick) for name in (observer, target)]
            if not known or any(end is None or not np.isfinite(end).all() for end in ends):
                continue
            rgb = _SEEN_RGB if known[-1].visible else _LOST_RGB
            lines.append(
                self._marker(
                    header, 'sight', number, _LINE_STRIP, rgb, scale=(0.2, 0.0, 0.0), points=ends,
                    life_ns=self._moving_ns,
                )
            )  # fmt: skip
        return lines

    def _messages(self, header: Any, tick: int) -> list[Any]:
        """An arrow from sender to receiver for each message sent since the last tick written.

        Red where it never arrives.
        """
        arrows = []
        for record in self._trace.links:
            if record.kind is not LinkEventKind.SENT:
                continue
            if not tick - EVERY_TICKS < record.tick <= tick:
                continue
            ends = [self._place(name, tick) for name in (record.sender, record.receiver)]
            if any(end is None for end in ends):
                continue
            arrows.append(
                self._marker(
                    header, 'messages', record.message, _ARROW,
                    _MESSAGE_RGB if record.message in self._delivered else _LOST_RGB,
                    scale=(0.4, 0.9, 0.0), points=ends, life_ns=_MESSAGE_NS,
                )
            )  # fmt: skip
        return arrows

    def _place(self, name: str, tick: int) -> Any:
        roster = self._trace.roster
        row = roster.uav_index(name)
        if row is not None:
            return self._trace.uav[tick, row, UavColumn.X : UavColumn.VX]
        row = roster.agent_index(name)
        if row is None:
            return None
        state = self._trace.ground[tick, row]
        if not state[GroundColumn.PRESENT] > 0.5:
            return None
        return state[GroundColumn.X], state[GroundColumn.Y], roster.agents[row].height_m

    def _events(self, header: Any, tick: int, time_ns: int) -> None:
        """What the executor says happened, as a diagnostic of the body or event it is about."""
        said = [
            self._make(
                'diagnostic_msgs/msg/DiagnosticStatus', level=0, name=record.subject or 'run',
                message=record.kind.name.lower(), hardware_id='', values=[],
            )
            for record in self._trace.events
            if tick - EVERY_TICKS < record.tick <= tick
        ]  # fmt: skip
        if said:
            name = 'diagnostic_msgs/msg/DiagnosticArray'
            self._send(DIAGNOSTICS, name, time_ns, header=header, status=said)


def _xyz(values: Any) -> dict[str, float]:
    x, y, z = (float(v) for v in values)
    return {'x': x, 'y': y, 'z': z}


def _turn(cosine: Any, sine: Any) -> tuple[float, float, float, float]:
    """Return the quaternion (w, x, y, z) of a heading given by its unit vector."""
    w = sqrt(max(0.0, (1.0 + float(cosine)) / 2.0))
    z = sqrt(max(0.0, (1.0 - float(cosine)) / 2.0))
    return w, 0.0, 0.0, z if sine >= 0.0 else -z


def _into_body(turn: Any, velocity: Any) -> tuple[float, float, float]:
    """Return an ENU velocity in the body's frame; `turn` is body to ENU (w, x, y, z)."""
    w, x, y, z = (float(v) for v in turn)
    a, b, c = (float(v) for v in velocity)
    return (
        (1 - 2 * (y * y + z * z)) * a + 2 * (x * y + w * z) * b + 2 * (x * z - w * y) * c,
        2 * (x * y - w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z + w * x) * c,
        2 * (x * z + w * y) * a + 2 * (y * z - w * x) * b + (1 - 2 * (x * x + y * y)) * c,
    )
