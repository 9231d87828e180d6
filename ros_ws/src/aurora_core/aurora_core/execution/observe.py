# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the executor reads off the packed states of one tick: the signals of `quantities`."""

from __future__ import annotations

from math import inf

import numpy as np
import numpy.typing as npt

from aurora_core.grounding.kerb import STEP_M
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.mission.machine import TargetMotion
from aurora_core.quantities import instant
from aurora_core.quantities.headway import PairWatch
from aurora_core.quantities.instant_sight import InstantSight
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]
Point3 = tuple[float, float, float]

# Plain numbers: members of an enum cost more to look up than what is done with them.
_Z, _LANDED = int(UavColumn.Z), int(UavColumn.LANDED)
_MOTION = slice(0, int(GroundColumn.SPEED) + 1)

# What somebody is told shows after so many ticks.
_TOLD_TICKS = 2


class Observation:
    """States of one tick, by body id or place.

    Args:
        roster: Row order.
        ground: (N, GROUND_WIDTH).
        uav: (M, UAV_WIDTH).
        geometry: Solids and places of the world.
        sight: Sight in that world between the bodies of the roster.
    """

    def __init__(
        self,
        roster: Roster,
        ground: FloatArray,
        uav: FloatArray,
        geometry: WorldGeometry,
        sight: InstantSight,
    ) -> None:
        self._roster = roster
        self._ground = ground
        self._uav = uav
        self._geometry = geometry
        self._sight = sight

    def ground(self, row: int) -> FloatArray:
        """Return the state (GROUND_WIDTH,) of the agent of a row."""
        state: FloatArray = self._ground[row]
        return state

    def pair_s(self, watch: PairWatch) -> float:
        """Return the headway, or time to collision, that somebody watches (s)."""
        return watch.step(self._ground)

    def ahead_m(self, row: int, other: str) -> float:
        """Return how far another agent is ahead of that of a row, bumper to bumper in metres."""
        index = self._roster.agent_index(other)
        if index is None or not instant.present(self._ground[index]):
            return 0.0
        half_m = (self._roster.agents[row].length_m + self._roster.agents[index].length_m) / 2.0
        return self.centre_ahead_m(row, other) - half_m

    def centre_ahead_m(self, row: int, other: str) -> float:
        """Return how far another agent is ahead of that of a row, centre to centre in metres."""
        index = self._roster.agent_index(other)
        if index is None or not instant.present(self._ground[index]):
            return 0.0
        x, y, hx, hy = self._ground[row, : GroundColumn.HEADING_Y + 1].tolist()
        to_x, to_y = self._ground[index, : GroundColumn.Y + 1].tolist()
        return float((to_x - x) * hx + (to_y - y) * hy)

    def position(self, name: str, *, on_road: bool = False) -> Point3 | None:
        """Return the reference point (x, y, z in m, ENU), None when the body is gone.

        Args:
            name: Body or place.
            on_road: Of a landmark, where one comes to it on the ground.
        """
        point = instant.body_point(self._roster, self._ground, self._uav, name)
        if point is None and self._roster.agent_index(name) is None:
            found = self._geometry.approach_point if on_road else self._geometry.place_point
            place = found(name)
            return None if place is None else (place[0], place[1], 0.0)
        return point

    def speed_mps(self, body_id: str) -> float | None:
        """Return the speed of a body, None when it is gone or was never placed."""
        row = self._roster.agent_index(body_id)
        if row is not None:
            here = instant.present(self._ground[row])
            return instant.ground_speed_mps(self._ground[row]) if here else None
        index = self._roster.uav_index(body_id)
        return None if index is None else instant.uav_speed_mps(self._uav[index])

    def distance_m(self, a: str, b: str, *, on_road: bool = False) -> float | None:
        """Return the 3-D distance of two reference points, None when one of them is gone.

        Args:
            a: Body or place.
            b: Body or place.
            on_road: Who is on the ground is measured from where the road leads to a landmark.
        """
        on_road = on_road and any(self._roster.agent_index(n) is not None for n in (a, b))
        p, q = self.position(a, on_road=on_road), self.position(b, on_road=on_road)
        return None if p is None or q is None else instant.distance_m(p, q)

    def on_carriageway(self, agent_id: str) -> bool:
        """Return whether an agent's reference point is on a street for vehicles."""
        return self.is_on(SurfaceKind.DRIVING, agent_id)

    def is_on(self, kind: SurfaceKind, agent_id: str) -> bool:
        """Return whether an agent's reference point is on ground of a kind."""
        point = self.position(agent_id)
        if point is None:
            return False
        return bool(self._geometry.surfaces(kind).contains(np.array([point[:2]]))[0])

    def steps_off(self, row: int, dt_s: float) -> bool:
        """Return whether the agent of a row is at the kerb: a street for vehicles begins there.

        What it is told now shows after two ticks.
        """
        x, y, hx, hy, speed_mps = self._ground[row, _MOTION].tolist()
        ahead_m = STEP_M + _TOLD_TICKS * dt_s * speed_mps
        ahead = np.array([[x + ahead_m * hx, y + ahead_m * hy]])
        return bool(self._geometry.surfaces(SurfaceKind.DRIVING).contains(ahead)[0])

    def walks(self, body_id: str) -> bool:
        """Tell whether a body is a person."""
        row = self._roster.agent_index(body_id)
        return row is not None and self._roster.agents[row].is_person

    def crosswalk_m(self, body_id: str) -> float:
        """Return how far a body is from the crosswalk (m), infinite where it is gone."""
        point = self.position(body_id)
        if point is None:
            return inf
        return float(self._geometry.crosswalk_distance(np.array([point[:2]]))[0])

    def motion(self, body_id: str) -> TargetMotion | None:
        """Return position, velocity and heading of a ground agent, None when it is gone."""
        row = self._roster.agent_index(body_id)
        if row is None or not instant.present(self._ground[row]):
            return None
        x, y, hx, hy, speed = self._ground[row, _MOTION].tolist()
        return TargetMotion(x, y, hx * speed, hy * speed, hx, hy)

    def line_of_sight(self, a: str, b: str) -> bool:
        """Whether no building and no third vehicle stands between two bodies."""
        return instant.radio_sight(self._geometry, self._roster, self._ground, self._uav, a, b)

    def sight(self, observer: str, target: str) -> tuple[bool, float]:
        """Return whether a body sees a target, and the slant range to that in metres."""
        return self._sight.see(observer, target, self._ground, self._uav)

    def airborne(self, uav: str, touchdown_m: float) -> bool:
        """Tell whether a UAV is in the air, as `motion.airborne` does."""
        index = self._roster.uav_index(uav)
        if index is None:
            return False
        row = self._uav[index]
        return bool(row.item(_LANDED) < 0.5 or row.item(_Z) > touchdown_m)

    def flies(self, name: str) -> bool:
        """Tell whether a body is a UAV."""
        return self._roster.uav_index(name) is not None

    def visible(self, observer: str, target: str) -> bool:
        """Whether a body sees a target: present, in range and in sight."""
        return self.sight(observer, target)[0]
