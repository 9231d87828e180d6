# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The mean wind of a run: the one that the request names, else that of the weather."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aurora_core.geometry.frames import offset_at_bearing
from aurora_core.geometry.kernel import norm2
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.ports.random_streams import stream
from aurora_core.quantities.waypoints import longest_leg
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode, RelativeWind

Vector = tuple[float, float]


def mean_wind_mps(
    spec: ScenarioSpec,
    agents: Sequence[GroundedAgent],
    uavs: Sequence[UavPlan],
    limits: Limits,
    tolerances: Tolerances,
    seed: int,
) -> Vector:
    """Return the mean wind (east, north), where the air goes.

    Args:
        spec: The request.
        agents: As grounded; who is tracked waits for its UAV, and sets off as it stands.
        uavs: As planned.
        limits: The wind of each weather.
        tolerances: How far inside a bound the speed is.
        seed: Draws what the request leaves open: from where it blows, or from which side.
    """
    world = spec.world
    speed_mps = mean_speed_mps(spec, limits, tolerances)
    if not world.names_wind:
        return speed_mps, 0.0
    if world.wind_from_deg is not None:
        return offset_at_bearing(speed_mps, world.wind_from_deg.value + 180.0)
    draws = stream(seed, 'grounding:wind')
    course = _course(agents, uavs) if world.wind is not None else None
    if world.wind is None or course is None:
        return offset_at_bearing(speed_mps, float(draws.uniform(0.0, 360.0)))
    x, y = _blows(world.wind, course, draws)
    return speed_mps * x, speed_mps * y


def mean_speed_mps(spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> float:
    """Return how fast the mean wind is: as stated, else as in the weather (m/s)."""
    world = spec.world
    if world.wind_mps is None:
        return limits.wind_mean_mps[world.weather.value]
    slack_mps = tolerances.limit_margin * world.wind_mps.value
    return max(0.0, world.wind_mps.inside(slack_mps))


def gust_over_mean_mps(
    spec: ScenarioSpec, mean: Vector, limits: Limits, tolerances: Tolerances
) -> float:
    """Return by how much gusts exceed the mean wind: as stated, else as in the weather (m/s)."""
    asked = spec.world.gust_mps
    if asked is None:
        return limits.wind_gust_mps[spec.world.weather.value]
    most_mps = asked.value
    if asked.bound is Bound.AT_LEAST:
        most_mps = asked.inside(tolerances.limit_margin * asked.value)
    return max(0.0, most_mps - norm2(*mean))


def _blows(wind: RelativeWind, course: Vector, draws: np.random.Generator) -> Vector:
    """Return where the air goes that meets a course (unit vectors) in a certain way."""
    x, y = course
    if wind is RelativeWind.TAILWIND:
        return x, y
    if wind is RelativeWind.HEADWIND:
        return -x, -y
    side = 1.0 if draws.random() < 0.5 else -1.0
    return -side * y, side * x


def _course(agents: Sequence[GroundedAgent], uavs: Sequence[UavPlan]) -> Vector | None:
    """Return the direction of the longest leg, else of a tracked vehicle; None where all hover."""
    missions = [mission for uav in uavs for mission in uav.missions]
    route = longest_route(missions)
    if route is not None:
        (ax, ay, _), (bx, by, _) = longest_leg(route.waypoints)
        away = norm2(bx - ax, by - ay)
        return (bx - ax) / away, (by - ay) / away
    tracked = [m.target for m in missions if m.mode is MissionMode.TRACK]
    return next(
        ((a.heading_x, a.heading_y) for name in tracked for a in agents if a.id == name), None
    )


def longest_route(missions: Sequence[MissionPlan]) -> MissionPlan | None:
    """Return the route with the longest leg, the first of equal ones; None without a route."""
    routes = [m for m in missions if m.mode is MissionMode.NAVIGATE]
    return max(routes, key=_longest_m, default=None)


def _longest_m(mission: MissionPlan) -> float:
    a, b = longest_leg(mission.waypoints)
    return norm2(b[0] - a[0], b[1] - a[1])
