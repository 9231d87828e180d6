# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sight at one tick, as the executor asks for it every tick: yes or no, and the slant range.

The answers are those of `sight.sight_of` to the bit. Plain comparisons settle the vehicles and
buildings that are not near the line; the kernels of the series decide about the others.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.sight import box_sight_series
from aurora_core.geometry.sight_line import passes_above
from aurora_core.quantities.instant import ground_point, present, uav_point
from aurora_core.quantities.kernels import (
    SightEnd,
    ahead_m,
    distance_3d,
    eye_height,
    sight_height,
)
from aurora_core.quantities.sight import occluder_reach_m
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.roster import Roster, RosterEntry

FloatArray = npt.NDArray[np.float64]
Point3 = tuple[float, float, float]

# Plain: members of an enum cost more to look up than what is done with them.
_PLACE = slice(0, int(GroundColumn.Y) + 1)
# Heights this close to the roof of a vehicle are left to the kernel.
_SLACK_M = 1e-3


class InstantSight:
    """Sight between bodies of one roster in one world.

    Args:
        geometry: Solids of the world.
        roster: Row order.
    """

    def __init__(self, geometry: WorldGeometry, roster: Roster) -> None:
        self._geometry = geometry
        self._range_m = geometry.world.sensing_range_m
        self._rows = {entry.body_id: row for row, entry in enumerate(roster.agents)}
        self._roster = roster
        self._heights_m = [sight_height(_end(e), e.height_m) for e in roster.agents]
        self._eyes_m = [eye_height(_end(e), e.height_m) for e in roster.agents]
        self._vehicles = tuple(
            (row, entry, occluder_reach_m(entry))
            for row, entry in enumerate(roster.agents)
            if not entry.is_person
        )
        self._farthest_m = max((reach for _, _, reach in self._vehicles), default=0.0)

    def see(
        self, observer: str, target: str, ground: FloatArray, uav: FloatArray
    ) -> tuple[bool, float]:
        """Return whether a body sees a target, and the slant range to its sight point in metres.

        Args:
            observer: Id of a UAV or agent.
            target: Id of an agent or UAV, or `landmark:<name>`.
            ground: (N, GROUND_WIDTH) states of the tick.
            uav: (M, UAV_WIDTH).
        """
        row = self._rows.get(target)
        here = True
        if row is not None:
            x, y, _ = ground_point(ground[row])
            z = self._heights_m[row]
            here = present(ground[row])
        elif (flying := self._roster.uav_index(target)) is not None:
            x, y, z = uav_point(uav[flying])
        else:
            place = self._geometry.place_point(target)
            here = place is not None
            x, y = place if place is not None else (0.0, 0.0)
            z = sight_height(SightEnd.PLACE, 0.0)
        own = self._rows.get(observer)
        eye, end = self._eye(observer, ground, uav), (x, y, z)
        slant_m = distance_3d(x - eye[0], y - eye[1], z - eye[2])
        if not here or not self._range_m - slant_m >= 0.0:
            return False, slant_m
        if own is not None and not self._looks_there(own, ground[own], x - eye[0], y - eye[1]):
            return False, slant_m
        free = self._vehicles_leave_free(eye, end, ground, (own, row))
        if not free:
            return False, slant_m
        return self._geometry.sight_to(target).free(eye, end), slant_m

    def _eye(self, observer: str, ground: FloatArray, uav: FloatArray) -> Point3:
        row = self._rows.get(observer)
        if row is not None:
            x, y, _ = ground_point(ground[row])
            return x, y, self._eyes_m[row]
        index = self._roster.uav_index(observer)
        assert index is not None  # a specification has no other observers
        return uav_point(uav[index])

    def _looks_there(self, row: int, state: FloatArray, dx: float, dy: float) -> bool:
        """Return whether an agent is there and, if it drives, the target ahead of it."""
        if not present(state):
            return False
        if not self._roster.agents[row].has_driver:
            return True
        hx, hy = state[GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1].tolist()
        return bool(ahead_m(dx, dy, hx, hy) >= 0.0)

    def _vehicles_leave_free(
        self, p: Point3, q: Point3, ground: FloatArray, ends: tuple[int | None, int | None]
    ) -> bool:
        """Return whether no vehicle but those at its ends stands in the way of a line."""
        far = self._farthest_m
        west, east = min(p[0], q[0]) - far, max(p[0], q[0]) + far
        south, north = min(p[1], q[1]) - far, max(p[1], q[1]) + far
        places: list[list[float]] = ground[:, _PLACE].tolist()
        for row, entry, reach in self._vehicles:
            x, y = places[row]
            if x < west or x > east or y < south or y > north or row in ends:
                continue
            box = (x - reach, y - reach, x + reach, y + reach, entry.height_m + _SLACK_M)
            if passes_above(p[0], p[1], p[2], q[0] - p[0], q[1] - p[1], q[2] - p[2], box):
                continue
            if present(ground[row]) and not _box_leaves_free(p, q, ground[row], entry):
                return False
        return True


def _end(entry: RosterEntry) -> SightEnd:
    return SightEnd.PERSON if entry.is_person else SightEnd.VEHICLE


def _box_leaves_free(p: Point3, q: Point3, state: FloatArray, entry: RosterEntry) -> bool:
    margin = box_sight_series(
        np.array([p]),
        np.array([q]),
        state[None, GroundColumn.X : GroundColumn.Y + 1],
        state[None, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1],
        entry.length_m,
        entry.width_m,
        entry.height_m,
    )
    return bool(margin[0] > 0.0)
