# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run as ASAM OpenSCENARIO XML 1.2: every body follows its recorded trajectory in time.

Positions are world coordinates in the ENU map frame (m), which are those of the OpenDRIVE file
that netconvert makes of the map. The reference point of a vehicle is the middle of its rear axle
on the ground, as OpenSCENARIO has it; of persons and UAVs the middle of the box.

Source: ASAM OpenSCENARIO XML 1.2.0, class reference and schema.
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np
import numpy.typing as npt

from aurora_core.report.export.thinning import kept_samples
from aurora_core.report.visible import one_line
from aurora_core.spec.vocabulary import AgentType
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.roster import RosterEntry
from aurora_core.trace.trace import FloatArray, Trace

BoolArray = npt.NDArray[np.bool_]

# What is interpolated between two vertices is off by no more than this, m; a heading counts with
# the half length of the body.
TOLERANCE_M = 0.05
_CATEGORIES = {
    AgentType.BUS: 'bus',
    AgentType.TRUCK: 'truck',
    AgentType.FIRETRUCK: 'truck',
    AgentType.VAN: 'van',
    AgentType.MOTORCYCLE: 'motorbike',
    AgentType.BICYCLE: 'bicycle',
}
# The format wants axles, weights and limits, which a recording does not hold: axles at 0.3 of the
# length from the middle, and what no recorded motion exceeds.
_AXLE_SHARE = 0.3
_WHEEL_M, _TRACK_SHARE, _STEERING_RAD = 0.6, 0.8, 0.6
_MOST_MPS, _MOST_MPS2 = 70.0, 12.0
_PERSON_KG, _UAV_KG = 75.0, 1.5


def open_scenario(trace: Trace, *, name: str, prompt: str, date: str, road_file: str) -> str:
    """Return the scenario.

    Args:
        trace: The run.
        name: Of the run.
        prompt: What was asked for.
        date: When it was run, ISO 8601.
        road_file: OpenDRIVE file of the map, relative to the scenario.
    """
    root = Element('OpenSCENARIO')
    SubElement(
        root, 'FileHeader', revMajor='1', revMinor='2', date=date,
        description=one_line(f'{prompt} (run {name})'), author='AURORA',
    )  # fmt: skip
    for empty in ('ParameterDeclarations', 'CatalogLocations'):
        SubElement(root, empty)
    SubElement(SubElement(root, 'RoadNetwork'), 'LogicFile', filepath=road_file)
    entities = SubElement(root, 'Entities')
    courses = list(_courses(trace))
    for entry, _, _ in courses:
        _entity(SubElement(entities, 'ScenarioObject', name=entry.body_id), entry)
    board = SubElement(root, 'Storyboard')
    actions = SubElement(SubElement(board, 'Init'), 'Actions')
    act = SubElement(SubElement(board, 'Story', name='recorded'), 'Act', name='run')
    for entry, times_s, poses in courses:
        private = SubElement(actions, 'Private', entityRef=entry.body_id)
        teleport = SubElement(SubElement(private, 'PrivateAction'), 'TeleportAction')
        _position(teleport, poses[0])
        _follow(act, entry, times_s, poses)
    _when(SubElement(act, 'StartTrigger'), 'begin', 0.0)
    end_s = trace.time_s(max(trace.ticks - 1, 0))
    _when(SubElement(board, 'StopTrigger'), 'end', end_s)
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'


Course = tuple[RosterEntry, FloatArray, FloatArray]


def _courses(trace: Trace) -> Iterator[Course]:
    """Yield every body that is ever there with times (n,) and poses (n, 4): x, y, z, heading."""
    for row, entry in enumerate(trace.roster.agents):
        states = trace.ground[:, row]
        here = states[:, GroundColumn.PRESENT] > 0.5
        there = np.asarray(np.isfinite(states).all(axis=1) & here, dtype=np.bool_)
        hx, hy = states[:, GroundColumn.HEADING_X], states[:, GroundColumn.HEADING_Y]
        back_m = _AXLE_SHARE * entry.length_m if entry.has_driver else 0.0
        poses = np.column_stack(
            [
                states[:, GroundColumn.X] - back_m * hx,
                states[:, GroundColumn.Y] - back_m * hy,
                np.zeros(trace.ticks),
                np.arctan2(hy, hx),
            ]
        )
        yield from _course(trace, entry, poses, there)
    for row, entry in enumerate(trace.roster.uavs):
        states = trace.uav[:, row]
        there = np.asarray(np.isfinite(states).all(axis=1), dtype=np.bool_)
        w, x, y, z = (states[:, c] for c in range(UavColumn.QW, UavColumn.P))
        yaw = np.arctan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z))
        poses = np.column_stack([states[:, UavColumn.X : UavColumn.VX], yaw])
        yield from _course(trace, entry, poses, there)


def _course(
    trace: Trace, entry: RosterEntry, poses: FloatArray, there: BoolArray
) -> Iterator[Course]:
    ticks = np.flatnonzero(there)
    if len(ticks) == 0:
        return
    poses = poses[ticks]
    poses[:, 3] = np.unwrap(poses[:, 3])
    times_s = ticks.astype(np.float64) * trace.roster.dt_s
    weighted = poses * (1.0, 1.0, 1.0, entry.length_m / 2.0)
    kept = kept_samples(times_s, weighted, TOLERANCE_M)
    yield entry, times_s[kept], poses[kept]


def _entity(parent: Element, entry: RosterEntry) -> None:
    """Add what a body is, with its box."""
    box = entry.length_m, entry.width_m, entry.height_m
    is_post = entry.type_name == AgentType.RSU
    if entry.is_person and not is_post:
        made = SubElement(
            parent, 'Pedestrian', name=entry.type_name, mass=f'{_PERSON_KG:g}',
            pedestrianCategory='pedestrian',
        )  # fmt: skip
        _box(made, box, (0.0, entry.height_m / 2.0))
    elif entry.has_driver:
        category = _CATEGORIES.get(AgentType(entry.type_name), 'car')
        made = SubElement(parent, 'Vehicle', name=entry.type_name, vehicleCategory=category)
        _box(made, box, (_AXLE_SHARE * entry.length_m, entry.height_m / 2.0))
        SubElement(
            made, 'Performance', maxSpeed=f'{_MOST_MPS:g}', maxAcceleration=f'{_MOST_MPS2:g}',
            maxDeceleration=f'{_MOST_MPS2:g}',
        )  # fmt: skip
        axles = SubElement(made, 'Axles')
        for kind, at_m in (('FrontAxle', 2.0 * _AXLE_SHARE * entry.length_m), ('RearAxle', 0.0)):
            SubElement(
                axles, kind, maxSteering=f'{_STEERING_RAD:g}' if at_m else '0',
                wheelDiameter=f'{_WHEEL_M:g}', trackWidth=f'{_TRACK_SHARE * entry.width_m:.4g}',
                positionX=f'{at_m:.4g}', positionZ=f'{_WHEEL_M / 2.0:g}',
            )  # fmt: skip
    else:
        made = SubElement(
            parent, 'MiscObject', name=entry.type_name, mass=f'{_UAV_KG:g}',
            miscObjectCategory='pole' if is_post else 'none',
        )  # fmt: skip
        _box(made, box, (0.0, 0.0 if entry.system_id else entry.height_m / 2.0))
    SubElement(made, 'Properties')


def _box(parent: Element, size: tuple[float, float, float], middle: tuple[float, float]) -> None:
    """Add a box; `middle` is how far ahead of and above the reference point its middle is."""
    length, width, height = (f'{v:g}' for v in size)
    box = SubElement(parent, 'BoundingBox')
    SubElement(box, 'Center', x=f'{middle[0]:.6g}', y='0', z=f'{middle[1]:.6g}')
    SubElement(box, 'Dimensions', width=width, length=length, height=height)


def _position(parent: Element, pose: FloatArray) -> None:
    x, y, z, h = (float(v) for v in pose)
    position = SubElement(parent, 'Position')
    SubElement(
        position, 'WorldPosition', x=f'{x:.4f}', y=f'{y:.4f}', z=f'{z:.4f}', h=f'{h:.5f}',
    )  # fmt: skip


def _follow(act: Element, entry: RosterEntry, times_s: FloatArray, poses: FloatArray) -> None:
    """Add the trajectory of a body, followed from the time at which it is first there."""
    name = entry.body_id
    group = SubElement(act, 'ManeuverGroup', name=f'{name} moves', maximumExecutionCount='1')
    actors = SubElement(group, 'Actors', selectTriggeringEntities='false')
    SubElement(actors, 'EntityRef', entityRef=name)
    maneuver = SubElement(group, 'Maneuver', name=f'{name} trajectory')
    event = SubElement(
        maneuver, 'Event', name=f'{name} begins', priority='override', maximumExecutionCount='1'
    )
    action = SubElement(event, 'Action', name=f'{name} follows')
    routing = SubElement(SubElement(action, 'PrivateAction'), 'RoutingAction')
    follow = SubElement(routing, 'FollowTrajectoryAction')
    timing = SubElement(follow, 'TimeReference')
    SubElement(timing, 'Timing', domainAbsoluteRelative='absolute', scale='1', offset='0')
    SubElement(follow, 'TrajectoryFollowingMode', followingMode='position')
    trajectory = SubElement(
        SubElement(follow, 'TrajectoryRef'), 'Trajectory', name=name, closed='false'
    )
    line = SubElement(SubElement(trajectory, 'Shape'), 'Polyline')
    # A line needs two points: who is there for one sample stands.
    last = len(times_s) - 1
    for k in range(max(last + 1, 2)):
        vertex = SubElement(line, 'Vertex', time=f'{times_s[min(k, last)]:.3f}')
        _position(vertex, poses[min(k, last)])
    _when(SubElement(event, 'StartTrigger'), f'{name} is there', float(times_s[0]))


def _when(trigger: Element, name: str, time_s: float) -> None:
    """Add the condition that the simulated time has come."""
    condition = SubElement(
        SubElement(trigger, 'ConditionGroup'), 'Condition', name=name, delay='0',
        conditionEdge='none',
    )  # fmt: skip
    by_value = SubElement(condition, 'ByValueCondition')
    SubElement(by_value, 'SimulationTimeCondition', value=f'{time_s:.3f}', rule='greaterOrEqual')
