# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The trigger signals at one tick, from that tick's rows: what the executor asks every tick.

Bit for bit the values of the series over the whole run, because both use the same kernels.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.quantities.kernels import (
    SightEnd,
    TrackRule,
    distance_3d,
    sight_height,
    track_errors,
)
from aurora_core.quantities.sight import radio_sight_of
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]
Point3 = tuple[float, float, float]

# Plain numbers: members of an enum cost more to look up than what is done with them.
_X, _Y, _SPEED = int(GroundColumn.X), int(GroundColumn.Y), int(GroundColumn.SPEED)
_PRESENT = int(GroundColumn.PRESENT)
_PLACE = slice(int(UavColumn.X), int(UavColumn.Z) + 1)
_VELOCITY = slice(int(UavColumn.VX), int(UavColumn.VZ) + 1)


def ground_point(row: FloatArray) -> Point3:
    """Return the reference point of a ground agent, ENU metres.

    Args:
        row: (GROUND_WIDTH,) state.
    """
    return row.item(_X), row.item(_Y), 0.0


def uav_point(row: FloatArray) -> Point3:
    """Return the reference point of a UAV, ENU metres.

    Args:
        row: (UAV_WIDTH,) state.
    """
    x, y, z = row[_PLACE].tolist()
    return x, y, z


def body_point(roster: Roster, ground: FloatArray, uav: FloatArray, name: str) -> Point3 | None:
    """Return the reference point of a body by id, None if it takes no part or is absent.

    Args:
        roster: Row order.
        ground: (N, GROUND_WIDTH) states of the tick.
        uav: (M, UAV_WIDTH).
        name: Body id.
    """
    index = roster.agent_index(name)
    if index is not None:
        return ground_point(ground[index]) if present(ground[index]) else None
    index = roster.uav_index(name)
    return None if index is None else uav_point(uav[index])


def present(row: FloatArray) -> bool:
    """Tell whether a ground agent exists."""
    return bool(row.item(_PRESENT) > 0.5)


def distance_m(a: Point3, b: Point3) -> float:
    """Return the 3-D distance of two reference points."""
    return distance_3d(a[0] - b[0], a[1] - b[1], a[2] - b[2])


def ground_speed_mps(row: FloatArray) -> float:
    """Return the speed of a ground agent along its heading."""
    return float(row.item(_SPEED))


def uav_speed_mps(row: FloatArray) -> float:
    """Return the speed of a UAV in space."""
    velocity: list[float] = row[_VELOCITY].tolist()
    return distance_3d(*velocity)


def altitude_m(row: FloatArray) -> float:
    """Return the height of a UAV's centre above ground."""
    return float(row[UavColumn.Z])


def tracked(rule: TrackRule, uav_row: FloatArray, target_row: FloatArray) -> bool:
    """Tell whether a UAV tracks a ground agent at this tick."""
    x, y, z = uav_point(uav_row)
    tx, ty, _ = ground_point(target_row)
    horizontal, vertical = track_errors(rule, x - tx, y - ty, z)
    inside = horizontal <= rule.horizontal_m and vertical <= rule.vertical_m
    return inside and present(target_row)


def radio_sight(
    geometry: WorldGeometry, roster: Roster, ground: FloatArray, uav: FloatArray, a: str, b: str
) -> bool:
    """Tell whether two bodies have radio line of sight: no building, no third vehicle between."""
    rows = (roster.agent_index(a), roster.agent_index(b))
    free = radio_sight_of(
        geometry,
        np.array([_sight_point(roster, ground, uav, a)]),
        np.array([_sight_point(roster, ground, uav, b)]),
        ground[None, :, :],
        roster.agents,
        frozenset(row for row in rows if row is not None),
    )
    return bool(free[0])


def _sight_point(roster: Roster, ground: FloatArray, uav: FloatArray, name: str) -> Point3:
    index = roster.agent_index(name)
    if index is None:
        row = roster.uav_index(name)
        return uav_point(uav[row]) if row is not None else (0.0, 0.0, 0.0)
    entry = roster.agents[index]
    end = SightEnd.PERSON if entry.is_person else SightEnd.VEHICLE
    x, y, _ = ground_point(ground[index])
    return x, y, sight_height(end, entry.height_m)
