# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a route goes that ends when its UAV sees somebody who stands: there at its far end.

Whoever drives is kept away until the route has been flown once. Who stands cannot come later: so
the route begins out of the range of sight, and its last part reaches into it.
"""

from __future__ import annotations

from itertools import pairwise
from math import sqrt

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson, Site
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.events import VisibilityTrigger
from aurora_core.spec.flight_order import left_by
from aurora_core.spec.parking import parks, stands
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import Pattern

FloatArray = npt.NDArray[np.float64]
Pose = tuple[float, float, float, float]

# So far inside the range of sight a route gets (m).
_INSIDE_M = 2.5
# So much of its end may lack for its sizes to show (m).
_LACKS_M = 5.0
# At which share of its corners a pattern begins, and on which share of its way it has shown its
# sizes. Its length is flown towards who stands there.
_BEGUN = {Pattern.LINE: 0.0, Pattern.RECTANGLE: 0.75}
_SHOWN = {Pattern.LINE: 1.0, Pattern.RECTANGLE: 0.5}


def come_upon(
    spec: ScenarioSpec, mission: UavMission, site: Site
) -> SeatedAgent | SeatedPerson | None:
    """Return who stands at a site and ends a route by being seen, None where nobody does."""
    event = left_by(spec, mission)
    trigger = None if event is None else event.trigger
    if not isinstance(trigger, VisibilityTrigger) or trigger.on != 'visible':
        return None
    free = mission.target is None and mission.start is None and mission.pattern in _BEGUN
    seat = site.seat(trigger.target)
    if not free or seat is None or trigger.observer != mission.uav:
        return None
    return seat if stands(seat.agent) or parks(spec, seat.agent) else None


def before_sight(
    mission: UavMission, seat: SeatedAgent | SeatedPerson, range_m: float, height_m: float
) -> tuple[Pose, float] | None:
    """Return the middle and direction of a route that ends in sight, and where it begins.

    Args:
        mission: The route.
        seat: Of who is come upon.
        range_m: Of sight.
        height_m: Of the route.

    Returns:
        None where nobody is seen from so high.
    """
    if mission.pattern is None or range_m <= height_m:
        return None
    length_m = mission.size_m[0].value if mission.size_m else 100.0
    away_m = sqrt(range_m * range_m - height_m * height_m) - _INSIDE_M + length_m / 2.0
    x, y, hx, hy = seat.path.position_at(seat.arc_m)[:4]
    return (x + away_m * hx, y + away_m * hy, -hx, -hy), _BEGUN[mission.pattern]


def is_seen_last(mission: UavMission, seen: npt.NDArray[np.bool_]) -> bool:
    """Tell whether somebody comes into view once a route has shown its sizes, and then does.

    Args:
        mission: The route.
        seen: (K,) Whether he is seen from each of its `lap_points`.
    """
    if mission.pattern not in _SHOWN or not seen.any():
        return False
    return int(np.argmax(seen)) >= _SHOWN[mission.pattern] * len(seen) - _LACKS_M


def lap_points(plan: MissionPlan) -> FloatArray:
    """Return points (K, 3) along a route, about a metre apart, with its last one."""
    points = [np.array(plan.waypoints[0])]
    for a, b in pairwise(plan.waypoints):
        count = max(1, round(norm2(b[0] - a[0], b[1] - a[1])))
        points += [
            np.array(a) + (np.array(b) - np.array(a)) * k / count for k in range(1, count + 1)
        ]
    return np.array(points)
