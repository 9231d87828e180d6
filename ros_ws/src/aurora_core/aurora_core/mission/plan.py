# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What one UAV has to fly, as grounding decided it (ENU map frame, metres above ground)."""

from __future__ import annotations

from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.spec.vocabulary import MissionMode

Point3 = tuple[FiniteFloat, FiniteFloat, FiniteFloat]


class MissionPlan(Document):
    """A mission with its geometry.

    Attributes:
        target: Agent id that is tracked, or observed from the hover point.
        offset_m: Track: horizontal vector from the target to the UAV, ENU.
        offset_turns: It is (ahead of the target, to its left) instead, and turns with its course.
        capture_horizontal_m: Tolerance at capture: on the standoff, else in the plane.
        capture_altitude_m: Tolerance on the altitude at capture.
        ascent_tolerance_m: Tolerance on the altitude that ends the ascent.
        waypoints: Navigate: the points to visit, first repeated at the end when closed.
        hover_point: Hover: where to hold; None: where the mission before has led it.
        rest_mps: Hover without a point: slower than that it has come to rest.
        keeps_level: Hover without a point: it stays as high as an event has told it before.
        duration_s: Length of the phase from capture on; a route without it ends at its last point.
        speed_mps: Navigate: speed on the legs.
        way_mps: Navigate: speed at most on the way to the first point; None: the usual one.
        over_m: So high it crosses to where it begins: up first, then across, then down. None:
            straight.
        level_way: After another mission it changes its height first, and comes to where it begins
            as high as it asks for.
        waits: An event lets it begin; until then the UAV stays where the one before has led it.
        until_event: Nothing but an event ends it: the next one begins, or the UAV lands.
    """

    id: str
    mode: MissionMode
    target: str | None = None
    altitude_m: FiniteFloat
    standoff_m: FiniteFloat = 0.0
    offset_m: tuple[FiniteFloat, FiniteFloat] = (0.0, 0.0)
    offset_turns: bool = omitted(False)
    capture_horizontal_m: FiniteFloat = 10.0
    capture_altitude_m: FiniteFloat = 2.0
    ascent_tolerance_m: FiniteFloat = 2.0
    waypoints: tuple[Point3, ...] = ()
    hover_point: Point3 | None = None
    duration_s: FiniteFloat | None = None
    speed_mps: FiniteFloat = 8.0
    way_mps: FiniteFloat | None = omitted(None)
    over_m: FiniteFloat | None = omitted(None)
    level_way: bool = omitted(False)
    waits: bool = omitted(False)
    until_event: bool = omitted(False)
    rest_mps: FiniteFloat | None = omitted(None)
    keeps_level: bool = omitted(False)

    @property
    def is_placed(self) -> bool:
        """Whether its place is known before the run; not where its UAV stays where it is."""
        return self.mode is not MissionMode.HOVER or self.hover_point is not None

    def offset_from(self, heading: tuple[float, float]) -> tuple[float, float]:
        """Return the vector from a target with a heading (unit vector) to the UAV, ENU metres."""
        if not self.offset_turns:
            return self.offset_m
        (ahead, left), (hx, hy) = self.offset_m, heading
        return ahead * hx - left * hy, ahead * hy + left * hx


class UavPlan(Document):
    """A UAV with its take-off and landing spots (on the ground).

    Attributes:
        landing_spots: Free spots; the executor takes the nearest one with a free way.
        safe_altitude_m: Above every obstacle around, used when no way at mission altitude is free.
        lands: After its missions; else it holds where the last one ended.
        lands_after: Events that have to be over before it lands.
        returns: It lands where it started, and nowhere else.
        speed_max_mps: So fast it flies at most (horizontally); None: as fast as any.
    """

    id: str
    system_id: int
    home_x_m: FiniteFloat
    home_y_m: FiniteFloat
    home_yaw_enu_rad: FiniteFloat = 0.0
    landing_spots: tuple[tuple[FiniteFloat, FiniteFloat], ...]
    missions: tuple[MissionPlan, ...]
    safe_altitude_m: FiniteFloat
    lands: bool = omitted(True)
    lands_after: tuple[str, ...] = omitted(())
    returns: bool = omitted(False)
    speed_max_mps: FiniteFloat | None = omitted(None)
