# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A mission as it is planned at a site, or why it cannot be."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.grounding.sites import Site, samples_along
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import MissionMode

Point3 = tuple[float, float, float]

# So near to its altitude a UAV gets at the lowest one that is allowed (m).
_ABOVE_LOWEST_M = 0.25

# After a tracking a UAV may land along so much of the way of its target, every so many metres.
_LANDS_ON_M = 900.0
_LANDS_EVERY_M = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedFlight:
    """A mission with its scores: clearance (m), share of samples seen."""

    plan: MissionPlan
    clearance_m: float
    seen: float
    over_street: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Rejected:
    """Why a site does not do."""

    reason: str


def planned_height_m(mission: UavMission, limits: Limits, tolerances: Tolerances) -> float:
    """Return the altitude to fly at: the stated one, or inside the bound that is stated."""
    altitude = mission.altitude_m
    inside = altitude_slack_m(mission, tolerances)
    chosen = {Bound.AT_LEAST: inside, Bound.AT_MOST: -inside}.get(altitude.bound, 0.0)
    low, high = limits.uav_altitude_min_m, limits.uav_altitude_max_m
    return min(high, max(low, altitude.value + chosen)) if chosen else altitude.value


def inside_bound(mission: UavMission, limits: Limits, tolerances: Tolerances) -> UavMission:
    """Return a mission whose standoff to plan with is inside the bound that is stated."""
    stated = mission.standoff_m
    if stated is None or stated.bound is Bound.EXACTLY:
        return mission
    slack_m = tolerances.standoff_m.of(stated.value, approximate=stated.approximate)
    value = min(max(stated.inside(slack_m), 0.0), limits.uav_standoff_max_m)
    aimed = stated.model_copy(update={'value': value})
    return mission.model_copy(update={'standoff_m': aimed})


def altitude_slack_m(mission: UavMission, tolerances: Tolerances) -> float:
    """Return how far from its altitude a UAV may be on a mission."""
    altitude = mission.altitude_m
    return tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)


def ascent_tolerance_m(mission: UavMission, limits: Limits, tolerances: Tolerances) -> float:
    """Return how far below its altitude a UAV may begin: not where nobody may be commanded to."""
    above_m = planned_height_m(mission, limits, tolerances) - limits.uav_altitude_min_m
    return min(altitude_slack_m(mission, tolerances), max(above_m, _ABOVE_LOWEST_M))


def last_point(plan: MissionPlan) -> Point3:
    """Return where a hover or a route ends (x, y, z in m)."""
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


def landing_areas(plan: MissionPlan, site: Site) -> list[tuple[float, float]]:
    """Return round which points a UAV may land after a mission (x, y in m).

    None of their own has a hover where the one before has led.
    """
    if not plan.is_placed:
        return []
    if plan.mode is MissionMode.TRACK:
        seat = site.seat(plan.target or '')
        assert seat is not None
        way = samples_along(seat.path, seat.arc_m, _LANDS_ON_M, _LANDS_EVERY_M)
        return [(float(p[0]), float(p[1])) for p in way]
    x, y, _ = last_point(plan)
    return [(x, y)]
