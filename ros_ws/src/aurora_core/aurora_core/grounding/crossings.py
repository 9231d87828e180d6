# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ways from one mission to the next: straight where that is free, else over what is between."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.planned_flight import (
    PlannedFlight,
    first_point,
    last_point,
)
from aurora_core.grounding.sites import Site, samples_along
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.vocabulary import MissionMode

Point3 = tuple[float, float, float]

# Heights are tried in such steps (m).
_STEP_M = 10.0
# Where a tracking ends is not known before: between these shares of the way of its target, looked
# at every so many metres.
_ENDS = (0.6, 1.2)
_LOOK_M = 30.0


def crossed(
    flights: Sequence[PlannedFlight],
    site: Site,
    airspace: Airspace,
    *,
    clearance_m: float,
    top_m: float,
    speed_mps: float,
) -> tuple[PlannedFlight, ...] | None:
    """Return the flights of a UAV with free ways from each to the next, None where one has none.

    Args:
        flights: In their order.
        site: Where they are planned.
        airspace: What may stand between.
        clearance_m: That ways keep.
        top_m: No way is higher.
        speed_mps: Of tracked targets.
    """
    found = list(flights[:1])
    before = flights[0].plan
    ends = _ends_of(before, site, speed_mps)
    for flight in flights[1:]:
        after, update = flight.plan, {}
        if not after.is_placed:
            # It stays where it is, and as high where no altitude is stated.
            height_m = found[-1].plan.altitude_m if after.keeps_level else after.altitude_m
            ways = [(end, (*end[:2], height_m)) for end in ends]
            is_free = all(airspace.way_is_free(way, clearance_m) for way in ways)
            if not is_free and before.mode is not MissionMode.TRACK:
                return None
            ends, update = [above for _, above in ways], {'altitude_m': height_m}
        else:
            goal = first_point(after, site)
            if not all(_is_straight(airspace, s, goal, clearance_m) for s in ends):
                over_m = way_over(airspace, ends, goal, clearance_m, top_m)
                if over_m is None and before.mode is not MissionMode.TRACK:
                    return None
                update = {} if over_m is None else {'over_m': over_m}
            before, ends = after, _ends_of(after, site, speed_mps)
        plan = after.model_copy(update=update) if update else after
        found.append(replace(flight, plan=plan))
    return tuple(found)


def _ends_of(plan: MissionPlan, site: Site, speed_mps: float) -> list[Point3]:
    """Return where a mission may end."""
    if plan.mode is not MissionMode.TRACK:
        return [last_point(plan)]
    seat = site.seat(plan.target or '')
    assert seat is not None  # it was planned for its seat
    way_m = speed_mps * (plan.duration_s or 0.0)
    first_m = seat.arc_m + _ENDS[0] * way_m
    samples = samples_along(seat.path, first_m, (_ENDS[1] - _ENDS[0]) * way_m, _LOOK_M)
    ends = []
    for x, y, hx, hy in samples[:, :4].tolist():
        to_x, to_y = plan.offset_from((hx, hy))
        ends.append((x + to_x, y + to_y, plan.altitude_m))
    return ends


def _is_straight(airspace: Airspace, start: Point3, goal: Point3, clearance_m: float) -> bool:
    """Tell whether the straight way is free at both altitudes."""
    ways = (((*start[:2], z), (*goal[:2], z)) for z in {start[2], goal[2]})
    return all(airspace.way_is_free(way, clearance_m) for way in ways)


def way_over(
    airspace: Airspace, starts: Sequence[Point3], goal: Point3, clearance_m: float, top_m: float
) -> float | None:
    """Return the lowest height at which all ways up, across and down are free, None for none.

    Args:
        airspace: What may stand between.
        starts: Where the UAV may be before (x, y, z in m).
        goal: Where it goes (x, y, z in m).
        clearance_m: That ways keep.
        top_m: No way is higher.
    """
    height_m = max(goal[2], *(s[2] for s in starts)) + _STEP_M
    while height_m <= top_m:
        down = ((*goal[:2], height_m), goal)
        ways = [((s, (*s[:2], height_m), (*goal[:2], height_m))) for s in starts]
        if all(airspace.way_is_free(way, clearance_m) for way in (down, *ways)):
            return height_m
        height_m += _STEP_M
    return None
