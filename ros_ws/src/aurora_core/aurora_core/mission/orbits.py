# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much of an orbit is flown in a stated time."""

from __future__ import annotations

import math

from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.stated import is_stated, most
from aurora_core.spec.vocabulary import Pattern

# From its capture a UAV comes to the first point of its route in so long (s).
_TO_ROUTE_S = 4.0


def part_of_lap_deg(
    mission: UavMission, radius_m: float, limits: Limits, tolerances: Tolerances
) -> float | None:
    """Return how far round an orbit gets at least that has no time for a lap (degrees).

    None where it has, where its number of turns is stated, and where it is no orbit of a stated
    length.

    Args:
        mission: What is asked for.
        radius_m: Of its orbit.
        limits: In force.
        tolerances: In force.
    """
    lasts, speed = mission.duration_s, mission.speed_mps
    if mission.pattern is not Pattern.ORBIT or mission.turns is not None or radius_m <= 0.0:
        return None
    if lasts is None or speed is None or not is_stated(lasts) or lasts.bound is Bound.AT_LEAST:
        return None
    slack_mps = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
    top_mps = most(speed, slack_mps, limits.uav_speed_max_mps)
    lap_s = 2.0 * math.pi * radius_m / top_mps + top_mps / tolerances.route_acceleration_mps2
    if lap_s <= lasts.value:
        return None
    flown_s = lasts.value - _TO_ROUTE_S - speed.value / tolerances.route_acceleration_mps2
    return min(360.0, math.degrees(speed.value * max(0.0, flown_s) / radius_m))
