# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where planned missions begin and end."""

from __future__ import annotations

from aurora_core.grounding.sites import Site
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.vocabulary import MissionMode

Point3 = tuple[float, float, float]


def last_point(plan: MissionPlan) -> Point3:
    """Return where a route or hover ends, ENU metres."""
    last = plan.waypoints[-1] if plan.waypoints else plan.hover_point
    assert last is not None
    return last


def first_point(plan: MissionPlan, site: Site, lead_m: float = 0.0) -> Point3:
    """Return where a mission begins at a site, ENU metres: of a track where its target stands.

    Args:
        plan: The mission.
        site: Where.
        lead_m: So far the target has gone by then.
    """
    if plan.mode is MissionMode.TRACK:
        seat = site.seat(plan.target or '')
        assert seat is not None
        x, y, hx, hy = seat.path.position_at(min(seat.arc_m + lead_m, seat.path.length_m))
        to_x, to_y = plan.offset_from((hx, hy))
        return x + to_x, y + to_y, plan.altitude_m
    if plan.hover_point is not None:
        return plan.hover_point
    return plan.waypoints[0]
