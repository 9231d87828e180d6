# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a UAV lands: the nearest spot whose way is free of buildings and of the other UAVs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.mission.machine import MissionMachine
from aurora_core.trace.layout import UavColumn

FloatArray = npt.NDArray[np.float64]
Point2 = tuple[float, float]
Point3 = tuple[float, float, float]

# Distance between the landing spots of two UAVs (m): twice the separation in flight.
APART_M = 10.0
# Distance of a way to a spot from the other UAVs at its height, and from their ways (m).
WAY_APART_M = 7.5
# Ways past UAVs that fly on are compared with theirs for so long, in steps (s).
AHEAD_S = 12.0
STEP_S = 0.25
# A UAV waits so long for its way to become free of others, then it goes (s).
PATIENCE_S = 10.0

_MOTION = (UavColumn.X, UavColumn.Y, UavColumn.VX, UavColumn.VY)


def landing_spot(
    index: int,
    machines: Sequence[MissionMachine],
    uav: FloatArray,
    airspace: Airspace,
    clearance_m: float,
    *,
    patient: bool,
) -> tuple[Point2, float] | None:
    """Return the landing spot of a UAV (x, y in m) and the height of the way there.

    Args:
        index: Of the UAV.
        machines: All of them.
        uav: (M, UAV_WIDTH) states.
        airspace: What stands in the way.
        clearance_m: The way keeps this clearance.
        patient: Rather wait than cross the way of another UAV.

    Returns:
        None where it has to wait.
    """
    machine = machines[index]
    plan = machine.plan
    x, y, z = uav[index, UavColumn.X : UavColumn.Z + 1].tolist()
    # Who has not chosen yet may have no other spot than the one where it started.
    taken = [
        (m.plan.home_x_m, m.plan.home_y_m) if m.landing_spot is None else m.landing_spot
        for k, m in enumerate(machines)
        if k != index
    ]
    home = (plan.home_x_m, plan.home_y_m)
    spots = sorted(
        (
            s
            for s in ((home,) if plan.returns else plan.landing_spots)
            if all(norm2(s[0] - t[0], s[1] - t[1]) >= APART_M for t in taken)
        ),
        key=lambda s: (norm2(s[0] - x, s[1] - y), s),
    ) or [home]
    # Straight to the spot, or on until it has braked and back: it flies in between.
    beyond = (*machine.stop_point(uav[index]), z)

    def is_clear(spot: Point2) -> bool:
        end = (spot[0], spot[1], z)
        ways = ((end, (x, y, z), beyond, end), _turning(machine, uav[index], spot, z))
        return all(airspace.way_is_free(way, clearance_m) for way in ways)

    # It is asked again in every tick while it waits: buildings, which take longest, come last.
    crowded = []
    for spot in spots:
        if _crowded(index, spot, machines, uav):
            crowded.append(spot)
        elif is_clear(spot):
            return spot, z
    free = next(filter(is_clear, crowded), None)
    if free is None:
        return spots[0], max(z, plan.safe_altitude_m)
    return None if patient else (free, z)


def _turning(
    machine: MissionMachine, state: FloatArray, spot: Point2, height_m: float
) -> tuple[Point3, ...]:
    """Return the way to a spot as it will be flown: in motion it may turn wide and come back."""
    track = machine.way_home(state, spot, AHEAD_S, STEP_S)
    return tuple((x, y, height_m) for x, y in track)


def _crowded(
    index: int, spot: Point2, machines: Sequence[MissionMachine], uav: FloatArray
) -> bool:
    """Tell whether another flying UAV, or its way to its spot, is near the way to a spot."""
    height_m = float(uav[index, UavColumn.Z])
    own = _legs(machines[index], uav[index], spot)
    track = machines[index].way_home(uav[index], spot, AHEAD_S, STEP_S)
    for k, other in enumerate(machines):
        x, y, z = uav[k, UavColumn.X : UavColumn.Z + 1].tolist()
        if k == index or other.landed or z < 1.0:
            continue
        level = abs(z - height_m) < APART_M
        # The descent passes the heights of all that fly lower.
        below = z < height_m and norm2(spot[0] - x, spot[1] - y) < WAY_APART_M
        if other.followed is not None:  # it goes on with its target
            if _meets(track, uav[k]) if level else below:
                return True
            continue
        legs = _legs(other, uav[k], other.landing_spot)
        if level and any(ways_apart_m(*a, *b) < WAY_APART_M for a in own for b in legs):
            return True
        if below:
            return True
    return False


def _meets(track: Sequence[Point2], state: FloatArray) -> bool:
    """Tell whether a track comes nearer to a UAV that flies on as it does now, and too near."""
    x, y, vx, vy = (float(state[c]) for c in _MOTION)
    apart_m = [
        norm2(own_x - x - vx * k * STEP_S, own_y - y - vy * k * STEP_S)
        for k, (own_x, own_y) in enumerate(track)
    ]
    return min(apart_m) < min(WAY_APART_M, apart_m[0])


def _legs(
    machine: MissionMachine, state: FloatArray, spot: Point2 | None
) -> tuple[tuple[Point2, Point2], ...]:
    """Return the ways between which a UAV flies: straight to its spot, or braking before."""
    here = (float(state[UavColumn.X]), float(state[UavColumn.Y]))
    stop = machine.stop_point(state)
    if spot is None:
        return ((here, stop),)
    return ((here, stop), (stop, spot), (here, spot))


def ways_apart_m(a: Point2, b: Point2, c: Point2, d: Point2) -> float:
    """Return the least distance between the segments a-b and c-d."""
    if _side(a, b, c) * _side(a, b, d) < 0.0 and _side(c, d, a) * _side(c, d, b) < 0.0:
        return 0.0
    return min(_to_way(a, c, d), _to_way(b, c, d), _to_way(c, a, b), _to_way(d, a, b))


def _side(a: Point2, b: Point2, p: Point2) -> float:
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def _to_way(p: Point2, a: Point2, b: Point2) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    length2 = dx * dx + dy * dy
    along = 0.0 if length2 == 0.0 else ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2
    at = min(max(along, 0.0), 1.0)
    return norm2(p[0] - a[0] - at * dx, p[1] - a[1] - at * dy)
