# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The flight of a UAV as a plan of QGroundControl (`.plan`), to be flown again by waypoints.

Source: QGroundControl developer guide, "Plan file format" (version 1); MAVLink common.xml,
MAV_CMD and MAV_FRAME.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from aurora_core.errors import ReportError
from aurora_core.geometry.frames import enu_to_geodetic
from aurora_core.knowledge.world import WorldModel
from aurora_core.report.export.thinning import kept_samples
from aurora_core.trace.layout import UavColumn, UavCommandColumn, UavMode, UavPhase
from aurora_core.trace.trace import FloatArray, Trace

# MAV_CMD_NAV_WAYPOINT, _LOITER_UNLIM, _LAND, _TAKEOFF; MAV_CMD_DO_CHANGE_SPEED.
_WAYPOINT, _LOITER, _LAND, _TAKEOFF, _SPEED = 16, 17, 21, 22, 178
_RELATIVE, _MISSION_FRAME = 3, 2  # MAV_FRAME_GLOBAL_RELATIVE_ALT, MAV_FRAME_MISSION
_PX4, _QUADROTOR = 12, 2  # MAV_AUTOPILOT_PX4, MAV_TYPE_QUADROTOR
_RELATIVE_MODE = 1  # of QGroundControl: altitude above home
# The recorded flight and the straight legs of the plan are no farther apart than this, m.
TOLERANCE_M = 1.0
_ACCEPT_M = 1.0
# Slower than this a UAV stays where it is, m/s; a change of speed below the step is left out.
_STILL_MPS, _SPEED_STEP_MPS = 0.4, 0.5
_LEAST_HEIGHT_M = 1.0


def flight_plan(trace: Trace, world: WorldModel, row: int) -> dict[str, Any]:
    """Return the plan of one UAV: take-off, the way flown with its speeds and stops, landing.

    Args:
        trace: The run.
        world: Its world.
        row: Of the UAV.

    Raises:
        ReportError: It never left the ground.
    """
    entry = trace.roster.uavs[row]
    states = trace.uav[:, row]
    up, down = _flight(trace, row)
    if down - up < 2:
        raise ReportError(f'{entry.body_id} does not fly in this run', hint='export another one')
    ticks = np.arange(up, down + 1)
    ticks = ticks[np.isfinite(states[ticks, : UavColumn.VX]).all(axis=1)]
    points = states[ticks, UavColumn.X : UavColumn.VX]
    times_s = ticks.astype(np.float64) * trace.roster.dt_s
    kept = kept_samples(times_s, points, TOLERANCE_M)
    items = _Items(world)
    home = states[0, UavColumn.X : UavColumn.VX]
    items.add(_TAKEOFF, (home[0], home[1], max(points[0][2], _LEAST_HEIGHT_M)))
    _legs(items, times_s[kept], points[kept])
    landed = _landing(trace, row)
    if landed is None:
        items.add(_LOITER, points[-1])
    else:
        items.add(_LAND, (states[landed, UavColumn.X], states[landed, UavColumn.Y], 0.0))
    return {
        'fileType': 'Plan',
        'version': 1,
        'groundStation': 'AURORA',
        'geoFence': {'circles': [], 'polygons': [], 'version': 2},
        'rallyPoints': {'points': [], 'version': 2},
        'mission': {
            'version': 2,
            'firmwareType': _PX4,
            'vehicleType': _QUADROTOR,
            'cruiseSpeed': items.fastest_mps,
            'hoverSpeed': items.fastest_mps,
            'globalPlanAltitudeMode': _RELATIVE_MODE,
            'plannedHomePosition': [*items.place(home), 0.0],
            'items': items.found,
        },
    }


def _flight(trace: Trace, row: int) -> tuple[int, int]:
    """Return the ticks between which it flies its way: after the ascent, before the descent."""
    commands, states = trace.uav_commands[:, row], trace.uav[:, row]
    ascents = np.flatnonzero(commands[:, UavCommandColumn.PHASE] == UavPhase.ASCENT)
    up = int(ascents[-1]) if len(ascents) else trace.ticks
    flown = np.flatnonzero(states[:, UavColumn.Z] > _LEAST_HEIGHT_M)
    downs = np.flatnonzero(commands[:, UavCommandColumn.MODE] == UavMode.LAND)
    downs = downs[downs > up]
    last = int(flown[-1]) if len(flown) else 0
    return up, min(int(downs[0]), last) if len(downs) else last


def _landing(trace: Trace, row: int) -> int | None:
    """Return the last tick when it has landed by then, None when it never lands."""
    landed = trace.uav[:, row, UavColumn.LANDED]
    here = np.flatnonzero(np.isfinite(landed))
    return int(here[-1]) if len(here) and landed[here[-1]] > 0.5 else None


def _legs(items: _Items, times_s: FloatArray, points: FloatArray) -> None:
    """Add the kept points: one that is left late is a stop, one at another pace a new speed."""
    items.waypoint(points[0])
    for (before_s, before), (time_s, point) in pairwise(zip(times_s, points, strict=True)):
        span_s = float(time_s - before_s)
        if float(np.linalg.norm(point - before)) < _STILL_MPS * span_s:
            items.stay(span_s)
            continue
        items.speed(float(np.hypot(*(point - before)[:2])) / span_s)
        items.waypoint(point)


class _Items:
    """The items of a mission, numbered from 1 as QGroundControl does."""

    def __init__(self, world: WorldModel) -> None:
        self._world = world
        self._speed_mps = 0.0
        self.found: list[dict[str, Any]] = []
        self.fastest_mps = _SPEED_STEP_MPS

    def place(self, point: Any) -> tuple[float, float]:
        """Return latitude and longitude in degrees."""
        world = self._world
        return enu_to_geodetic(
            float(point[0]), float(point[1]), world.origin_lat_deg, world.origin_lon_deg
        )

    def add(self, command: int, point: Any, stay_s: float = 0.0) -> None:
        """Add an item at a place, ENU, m above home."""
        within_m = _ACCEPT_M if command == _WAYPOINT else 0.0
        height_m = round(float(point[2]), 3)
        self._simple(
            command, _RELATIVE, [stay_s, within_m, 0, None, *self.place(point), height_m],
            Altitude=height_m, AltitudeMode=_RELATIVE_MODE, AMSLAltAboveTerrain=None,
        )  # fmt: skip

    def waypoint(self, point: Any) -> None:
        """Add a point to fly through."""
        self.add(_WAYPOINT, point)

    def stay(self, span_s: float) -> None:
        """Stay at the last point for so much longer."""
        place = next(i for i in reversed(self.found) if i['command'] == _WAYPOINT)
        place['params'][0] = round(place['params'][0] + span_s, 2)

    def speed(self, speed_mps: float) -> None:
        """Go on at another speed over ground, where it is another; straight up and down: none."""
        if speed_mps < _STILL_MPS or abs(speed_mps - self._speed_mps) < _SPEED_STEP_MPS:
            return
        self._speed_mps = speed_mps
        self.fastest_mps = max(self.fastest_mps, round(speed_mps, 2))
        self._simple(_SPEED, _MISSION_FRAME, [1, round(speed_mps, 2), -1, 0, 0, 0, 0])

    def _simple(self, command: int, frame: int, params: list[Any], **more: Any) -> None:
        self.found.append(
            {
                'type': 'SimpleItem',
                'autoContinue': True,
                'command': command,
                'doJumpId': len(self.found) + 1,
                'frame': frame,
                'params': params,
                **more,
            }
        )
