# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights that are nothing but a way: `flies to City Hall at 60 m`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import shapely

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, graded, holds
from aurora_bench.checker.flight import Flight, asked_altitude
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.scene import share

# Of a pattern the way to it is no part.
OF_PATTERNS = ('pattern', 'size_m', 'radius_m', 'waypoint_count', 'turns', 'start', 'street')
# Who keeps clear of a building passes it farther away than the least distance by so much (m).
ROOM_M = 2.0
# Where it does not come down, climb or sink straight is for nobody to say: so much is in doubt.
DOUBT = 0.05


def is_way(requirement: Mapping[str, Any]) -> bool:
    """Tell whether an annotated route is a flight to its target, and nothing else."""
    shaped = any(requirement.get(field) is not None for field in OF_PATTERNS)
    return requirement.get('target') is not None and not shaped


def level(flight: Flight, requirement: Mapping[str, Any]) -> Judged:
    """Return whether the annotated altitude is that of the way to the target of a route.

    Each metre counts once, from where the flight is out of reach of its beginning (it brakes, it
    climbs or sinks there) to where it comes to its target. Over what is higher there is no room.
    """
    asked = asked_altitude(requirement, flight.variation)
    if asked is None or not is_way(requirement) or flight.climbs:
        return holds('')
    scene, ticks = flight.scene, flight.ticks
    xy, height = scene.xy(flight.uav)[ticks], scene.altitude(flight.uav)[ticks]
    speed = float(scene.speed(flight.uav)[ticks.start])
    flown = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(xy, axis=0), axis=1))])
    away = np.linalg.norm(xy - xy[0], axis=1)
    left = np.linalg.norm(xy - xy[-1], axis=1)
    reach = speed * speed / (2.0 * limits.GENTLE_MPS2) + limits.FOLLOWS_M
    counts = np.concatenate([[False], np.diff(np.floor(flown)) > 0.0])
    counts &= (away > reach) & (left > limits.WAYPOINT_M) & _room(flight, xy, asked.low)
    if not counts.any():
        return holds('')
    inside = (height >= asked.low - asked.slack) & (height <= asked.high + asked.slack)
    good = share(inside[counts])
    why = f'{good:.1%} of {int(counts.sum())} m on the way at altitude {asked.text()} m'
    return graded(good >= limits.ALTITUDE_SHARE, good >= limits.ALTITUDE_SHARE - DOUBT, why)


def _room(flight: Flight, xy: FloatArray, height_m: float) -> BoolArray:
    """Return where the air at a height is free of buildings."""
    scene = flight.scene
    near = scene.limit('clearance_min_m') + ROOM_M
    high = [b.polygon for b in scene.world.buildings if b.top_m > height_m - near]
    if not high:
        return np.ones(len(xy), dtype=np.bool_)
    free = shapely.distance(shapely.union_all(high), shapely.points(xy)) > near
    return np.asarray(free, dtype=np.bool_)
