# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What ROS's own message types say of a run at one moment, for viewers and other tools.

The types come from whoever sends: those of a bag, or the classes of a running graph. Frames:
`map` is the world (ENU, m), each body has a frame of its name (FLU, its origin as in the trace).
The altitude of NavSatFix is above the flat ground: maps carry no height above the ellipsoid.

Source: REP-103, REP-105.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np

from aurora_core.geometry.frames import enu_to_geodetic
from aurora_core.knowledge.world import WorldModel
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import EventRecord, LinkRecord
from aurora_core.trace.roster import Roster, RosterEntry
from aurora_core.trace.trace import FloatArray

MAP_FRAME = 'map'
MARKERS, DIAGNOSTICS, TRANSFORMS = '/markers', '/diagnostics', '/tf'
MARKER_ARRAY = 'visualization_msgs/msg/MarkerArray'
TF_MESSAGE = 'tf2_msgs/msg/TFMessage'
_DIAGNOSTIC_ARRAY = 'diagnostic_msgs/msg/DiagnosticArray'
_POSE, _ODOMETRY = 'geometry_msgs/msg/PoseStamped', 'nav_msgs/msg/Odometry'
_FIX = 'sensor_msgs/msg/NavSatFix'
_AGENT_RGB, _UAV_RGB, _MESSAGE_RGB = (0.0, 0.45, 0.7), (0.84, 0.37, 0.0), (0.48, 0.25, 0.63)
_ZONE_RGB, _BUILDING_RGB = (0.82, 0.19, 0.18), (0.7, 0.67, 0.62)
_SEEN_RGB, _LOST_RGB = (0.11, 0.5, 0.29), (0.71, 0.11, 0.11)
_MESSAGE_NS = 1_000_000_000
# Of `visualization_msgs/msg/Marker`.
_ARROW, _CUBE, _LINE_STRIP = 0, 1, 4

# Makes a message from its type and fields.
Make = Callable[..., Any]
Point = tuple[float, float, float]
# Topic, type, message.
Said = tuple[str, str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """A run at one tick.

    Attributes:
        ground: (N, GROUND_WIDTH), roster order.
        uav: (M, UAV_WIDTH), roster order.
        sent: Messages sent since the moment before.
        seen: Of observer and target: whether it sees it.
        happened: What the executor said since the moment before.
    """

    time_ns: int
    ground: FloatArray
    uav: FloatArray
    sent: Sequence[LinkRecord] = ()
    seen: Mapping[tuple[str, str], bool]
    happened: Sequence[EventRecord] = ()


class StandardMessages:
    """Says moments of one run.

    Args:
        make: Makes messages.
        roster: Row order of the states.
        world: Of the run.
        shown_ns: How long the marker of something that moves is shown, unless another comes.
        lost: Messages of the ledger that never arrive, as far as that is known.
    """

    def __init__(
        self, make: Make, roster: Roster, world: WorldModel, *, shown_ns: int,
        lost: Collection[int] = (),
    ) -> None:  # fmt: skip
        self._make, self._roster, self._world = make, roster, world
        self._shown_ns, self._lost = shown_ns, lost

    def topics(self) -> dict[str, str]:
        """Return the type of every topic that can be said something on."""
        found = {MARKERS: MARKER_ARRAY, TRANSFORMS: TF_MESSAGE, DIAGNOSTICS: _DIAGNOSTIC_ARRAY}
        found |= {f'/agents/{e.body_id}/pose': _POSE for e in self._roster.agents}
        for entry in self._roster.uavs:
            found[f'/uavs/{entry.body_id}/odometry'] = _ODOMETRY
            found[f'/uavs/{entry.body_id}/fix'] = _FIX
        return found

    def scene(self, flights: Mapping[str, Sequence[Point]] | None = None) -> Said:
        """Return what stays for the whole run: outlines of buildings (at their height) and of
        no-fly zones, planned routes of who is on the ground.

        Args:
            flights: Ways that UAVs fly, where they are known.
        """
        header = self._header(0)
        lines = [
            (f'routes/{entry.body_id}', _AGENT_RGB, [(x, y, 0.1) for x, y in entry.route_xy_m])
            for entry in self._roster.agents
            if entry.role != 'background'
        ]
        lines += [(f'flights/{n}', _UAV_RGB, list(way)) for n, way in (flights or {}).items()]
        markers = [
            self._line(header, ns, 0, rgb, points, width_m=0.25, alpha=0.5)
            for ns, rgb, points in lines
            if len(points) > 1
        ]
        for k, building in enumerate(self._world.buildings):
            ring = [(corner[0], corner[1], building.height_m) for corner in building.ring]
            markers.append(
                self._line(header, 'buildings', k, _BUILDING_RGB, [*ring, ring[0]], width_m=0.3)
            )
        for k, zone in enumerate(self._world.no_fly_zones):
            ring = [(corner[0], corner[1], 0.5) for corner in zone.ring]
            markers.append(
                self._line(header, 'no_fly_zones', k, _ZONE_RGB, [*ring, ring[0]], width_m=0.8)
            )
        return MARKERS, MARKER_ARRAY, self._make(MARKER_ARRAY, markers=markers)

    def at(self, moment: Moment) -> list[Said]:
        """Return all that is said at a moment; who is absent, or has no sample, is left out."""
        header = self._header(moment.time_ns)
        said: list[Said] = []
        transforms, markers = [], []
        for row, entry in enumerate(self._roster.agents):
            state = moment.ground[row]
            if not np.isfinite(state).all() or state[GroundColumn.PRESENT] < 0.5:
                continue
            place = (state[GroundColumn.X], state[GroundColumn.Y], 0.0)
            turn = _turn(state[GroundColumn.HEADING_X], state[GroundColumn.HEADING_Y])
            pose = self._make(_POSE, header=header, pose=self._pose(place, turn))
            said.append((f'/agents/{entry.body_id}/pose', _POSE, pose))
            transforms.append(self._transform(header, entry, place, turn))
            middle = (*place[:2], entry.height_m / 2.0)
            markers.append(self._body(header, row, entry, middle, turn, _AGENT_RGB))
        for row, entry in enumerate(self._roster.uavs):
            state = moment.uav[row]
            if not np.isfinite(state).all():
                continue
            said += self._uav(header, entry, state)
            place, turn = state[UavColumn.X : UavColumn.VX], state[UavColumn.QW : UavColumn.P]
            transforms.append(self._transform(header, entry, place, turn))
            markers.append(self._body(header, 1000 + row, entry, place, turn, _UAV_RGB))
        markers += self._sight_lines(header, moment)
        markers += self._messages(header, moment)
        said.append((TRANSFORMS, TF_MESSAGE, self._make(TF_MESSAGE, transforms=transforms)))
        said.append((MARKERS, MARKER_ARRAY, self._make(MARKER_ARRAY, markers=markers)))
        said += self._events(header, moment.happened)
        return said

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

    def _transform(self, header: Any, entry: RosterEntry, place: Any, turn: Any) -> Any:
        moved = self._make(
            'geometry_msgs/msg/Transform',
            translation=self._vector(place),
            rotation=self._quaternion(turn),
        )
        name = 'geometry_msgs/msg/TransformStamped'
        return self._make(name, header=header, child_frame_id=entry.body_id, transform=moved)

    def _uav(self, header: Any, entry: RosterEntry, state: FloatArray) -> list[Said]:
        place, turn = state[UavColumn.X : UavColumn.VX], state[UavColumn.QW : UavColumn.P]
        pose = self._make(
            'geometry_msgs/msg/PoseWithCovariance',
            pose=self._pose(place, turn),
            covariance=np.zeros(36),
        )
        twist = self._make(
            'geometry_msgs/msg/Twist',
            # The twist of an Odometry is in the child frame.
            linear=self._vector(_into_body(turn, state[UavColumn.VX : UavColumn.QW])),
            angular=self._vector(state[UavColumn.P : UavColumn.ARMED]),
        )
        odometry = self._make(
            _ODOMETRY, header=header, child_frame_id=entry.body_id, pose=pose,
            twist=self._make(
                'geometry_msgs/msg/TwistWithCovariance', twist=twist, covariance=np.zeros(36)
            ),
        )  # fmt: skip
        latitude, longitude = enu_to_geodetic(
            float(place[0]), float(place[1]), self._world.origin_lat_deg,
            self._world.origin_lon_deg,
        )  # fmt: skip
        fix = self._make(
            _FIX, header=header,
            status=self._make('sensor_msgs/msg/NavSatStatus', status=0, service=1),
            latitude=latitude, longitude=longitude, altitude=float(place[2]),
            position_covariance=np.zeros(9), position_covariance_type=0,
        )  # fmt: skip
        return [
            (f'/uavs/{entry.body_id}/odometry', _ODOMETRY, odometry),
            (f'/uavs/{entry.body_id}/fix', _FIX, fix),
        ]

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

    def _line(
        self, header: Any, ns: str, number: int, rgb: tuple[float, float, float],
        points: Sequence[Any], *, width_m: float, alpha: float = 1.0, life_ns: int = 0,
    ) -> Any:  # fmt: skip
        scale = (width_m, 0.0, 0.0)
        return self._marker(
            header, ns, number, _LINE_STRIP, rgb, scale=scale, points=points, alpha=alpha,
            life_ns=life_ns,
        )  # fmt: skip

    def _body(
        self, header: Any, number: int, entry: RosterEntry, place: Any, turn: Any,
        rgb: tuple[float, float, float],
    ) -> Any:  # fmt: skip
        size = (entry.length_m, entry.width_m, entry.height_m)
        pose = self._pose(place, turn)
        return self._marker(
            header, 'bodies', number, _CUBE, rgb, scale=size, pose=pose, life_ns=self._shown_ns
        )

    def _sight_lines(self, header: Any, moment: Moment) -> list[Any]:
        """A line from each observer to its target: green while it sees it, red while not."""
        lines = []
        for number, ((observer, target), seen) in enumerate(moment.seen.items()):
            ends = [self._place(name, moment) for name in (observer, target)]
            if any(end is None for end in ends):
                continue
            rgb = _SEEN_RGB if seen else _LOST_RGB
            lines.append(
                self._line(header, 'sight', number, rgb, ends, width_m=0.2, life_ns=self._shown_ns)
            )
        return lines

    def _messages(self, header: Any, moment: Moment) -> list[Any]:
        """An arrow from sender to receiver for each message; red where it never arrives."""
        arrows = []
        for record in moment.sent:
            ends = [self._place(name, moment) for name in (record.sender, record.receiver)]
            if any(end is None for end in ends):
                continue
            rgb = _LOST_RGB if record.message in self._lost else _MESSAGE_RGB
            arrows.append(
                self._marker(
                    header, 'messages', record.message, _ARROW, rgb, scale=(0.4, 0.9, 0.0),
                    points=ends, life_ns=_MESSAGE_NS,
                )
            )  # fmt: skip
        return arrows

    def _place(self, name: str, moment: Moment) -> Any:
        """Return where a body is, of agents the top; None while it is not there."""
        row = self._roster.uav_index(name)
        if row is not None:
            place = moment.uav[row, UavColumn.X : UavColumn.VX]
            return place if np.isfinite(place).all() else None
        row = self._roster.agent_index(name)
        if row is None or not moment.ground[row, GroundColumn.PRESENT] > 0.5:
            return None
        x, y = moment.ground[row, [GroundColumn.X, GroundColumn.Y]]
        return (x, y, self._roster.agents[row].height_m) if np.isfinite(x + y) else None

    def _events(self, header: Any, happened: Sequence[EventRecord]) -> list[Said]:
        """What the executor says happened, as a diagnostic of the body or event it is about."""
        status = [
            self._make(
                'diagnostic_msgs/msg/DiagnosticStatus', level=0, name=record.subject or 'run',
                message=record.kind.name.lower(), hardware_id='', values=[],
            )
            for record in happened
        ]  # fmt: skip
        if not status:
            return []
        array = self._make(_DIAGNOSTIC_ARRAY, header=header, status=status)
        return [(DIAGNOSTICS, _DIAGNOSTIC_ARRAY, array)]


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
