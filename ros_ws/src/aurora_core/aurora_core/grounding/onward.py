# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes without a place after another mission: they begin where that has led their UAV."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from aurora_core.grounding.awaited import is_kept_away
from aurora_core.grounding.planned_flight import PlannedFlight, last_point
from aurora_core.grounding.sites import Site
from aurora_core.spec.flight_order import begins_where_it_is
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode

Pose = tuple[float, float, float, float]


def onward_from(
    spec: ScenarioSpec,
    mission: UavMission,
    site: Site,
    before: Sequence[PlannedFlight],
    speed_mps: Callable[[UavMission], float],
) -> Pose | None:
    """Return where a UAV is when a pattern at no place begins, None where that is the scene.

    After a tracking that is where its target is expected then.

    Args:
        spec: The request.
        mission: The pattern.
        site: Where the scene is.
        before: The missions before it of the same UAV, as planned.
        speed_mps: Of the target of a mission.

    Returns:
        x, y in m, ENU, and the direction along the street there (unit vector).
    """
    if not begins_where_it_is(spec, mission) or is_kept_away(spec, mission):
        return None
    last = next(flight.plan for flight in reversed(before) if flight.plan.is_placed)
    _, _, hx, hy = site.origin()
    if last.mode is not MissionMode.TRACK:
        x, y, _ = last_point(last)
        return x, y, hx, hy
    tracking = next(m for m in spec.missions if m.id == last.id)
    seat = site.seat(last.target or '')
    if seat is None or last.duration_s is None:
        return None
    way_m = seat.arc_m + speed_mps(tracking) * last.duration_s
    x, y, hx, hy = seat.path.position_at(min(way_m, seat.path.length_m))
    off_x, off_y = last.offset_from((hx, hy))
    return x + off_x, y + off_y, hx, hy
