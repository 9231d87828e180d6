# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a hover or a route is: over whom or what at t = 0, else over the scene."""

from __future__ import annotations

from aurora_core.grounding.awaited import is_kept_away
from aurora_core.grounding.places import (
    ROAD_STEP_M,
    ROAD_WAY_M,
    ROADS,
    MapPlaces,
    has_point,
    road_point,
)
from aurora_core.grounding.premises import middle_of_route
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson, Site, samples_along
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import ScenarioSpec, UavMission

Pose = tuple[float, float, float, float]


def centre_of(
    spec: ScenarioSpec, mission: UavMission, site: Site, places: MapPlaces, range_m: float
) -> Pose | None:
    """Return where a mission is, and along which way (x, y in m, unit heading), None: nowhere.

    Args:
        spec: The request.
        mission: A hover or a route.
        site: Where the scene is.
        places: Of the map.
        range_m: Of sight.
    """
    target = mission.target
    x, y, hx, hy = site.origin()
    if target is None or (target in ROADS and is_kept_away(spec, mission)):
        return middle_of_route(spec, mission, site, range_m)
    seat = site.seat(target)
    if seat is not None:
        return seat.path.position_at(seat.arc_m)
    if has_point(target):
        point = places.itself(target, (x, y))
        heading = (1.0, 0.0) if is_landmark(target) else (hx, hy)
        return (*point, *heading)
    if target in ROADS:
        samples = samples_along(
            site.origin_path, site.origin_arc_m, ROAD_WAY_M, ROAD_STEP_M
        ).tolist()
        everybody: tuple[SeatedAgent | SeatedPerson, ...]
        everybody = (*site.seated, *site.others, *site.walkers)
        seats = [s.path.position_at(s.arc_m)[:2] for s in everybody]
        road_x, road_y = road_point([(p[0], p[1]) for p in samples], seats)
        return road_x, road_y, hx, hy
    return None
