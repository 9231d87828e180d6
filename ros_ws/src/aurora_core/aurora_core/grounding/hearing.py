# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where vehicles without a place have to stay to be told, or tell, something by radio.

"Two vans circulate; the roadside unit warns them": round that unit, not round the next block.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import sqrt

from aurora_core.comm.reach import reach_of
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.sites import samples_along
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.route_path import RoutePath
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.spec.events import least_due_s
from aurora_core.spec.scenario import ScenarioSpec, SendMessage
from aurora_core.spec.vocabulary import MissionMode

# Of the range of a link so much is counted on.
_RANGE_SHARE = 0.85
# Looked at is so much of a way, in such steps (m); until a stated time what is driven so fast
# (m/s).
_WAY_M = 600.0
_STEP_M = 20.0
_DRIVES_MPS = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """Where the radio of somebody who stays where it is reaches, round a point (m, ENU).

    Attributes:
        way_m: So much of the way of the other one has to be inside.
    """

    x_m: float
    y_m: float
    reach_m: float
    way_m: float = _WAY_M

    def holds(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point is inside."""
        return norm2(x_m - self.x_m, y_m - self.y_m) <= self.reach_m


@dataclass(frozen=True, slots=True)
class Hearing:
    """Tells of one vehicle which streets and places are in reach of those it talks with."""

    network: RoadNetwork
    reaches: tuple[Reach, ...]

    def ends_inside(self, edge_id: str) -> bool:
        """Tell whether an edge ends in reach."""
        lane = self.network.lane(self.network.edge(edge_id).lane_ids[-1])
        return self.is_inside(*self.network.position_on_lane(lane.id, lane.length_m)[:2])

    def share_inside(self, path: RoutePath, arc_m: float) -> float:
        """Return which share of the next stretch of a way is in reach."""
        if not self.reaches:
            return 1.0
        way_m = max(reach.way_m for reach in self.reaches)
        way = samples_along(path, arc_m, way_m, _STEP_M)[:, :2].tolist()
        return sum(self.is_inside(x, y) for x, y in way) / len(way)

    def is_inside(self, x_m: float, y_m: float) -> bool:
        """Tell whether a place is in reach."""
        return all(reach.holds(x_m, y_m) for reach in self.reaches)


def reaches_of(
    spec: ScenarioSpec,
    agent: str,
    agents: Sequence[GroundedAgent],
    uavs: Sequence[UavPlan],
    limits: Limits,
) -> tuple[Reach, ...]:
    """Return in whose reach a vehicle has to be: of roadside units, and of UAVs at places.

    Args:
        spec: The request.
        agent: The vehicle.
        agents: Who has a place.
        uavs: What they fly.
        limits: Limits in force.
    """
    return tuple(dict.fromkeys(_reaches(spec, agent, agents, uavs, limits)))


def _reaches(
    spec: ScenarioSpec,
    agent: str,
    agents: Sequence[GroundedAgent],
    uavs: Sequence[UavPlan],
    limits: Limits,
) -> Iterator[Reach]:
    told = {(link.sender, link.receiver): link for link in spec.links}
    ways_m = {pair: _WAY_M for pair, link in told.items() if link.rate_hz is not None}
    for event in spec.events:
        if isinstance(event.action, SendMessage):
            pair = event.action.sender, event.action.receiver
            due_s = least_due_s(spec.events, event.id)
            way_m = min(_WAY_M, _DRIVES_MPS * due_s) if due_s > 0.0 else _WAY_M
            ways_m[pair] = max(way_m, ways_m.get(pair, 0.0))
    for pair in sorted(p for p in ways_m if agent in p):
        other = pair[0] if pair[1] == agent else pair[1]
        link = told.get(pair)
        range_m = limits.link_range_blocked_m
        if link is not None:
            reach = reach_of(link, limits)
            # Of one that stops at the first building no range is safe: that with sight, at least.
            range_m = reach.blocked_m or reach.sight_m
        for x_m, y_m, z_m in _places(other, agents, uavs):
            square = (_RANGE_SHARE * range_m) ** 2 - z_m * z_m
            if square > 0.0:
                yield Reach(x_m=x_m, y_m=y_m, reach_m=sqrt(square), way_m=ways_m[pair])


def _places(
    name: str, agents: Sequence[GroundedAgent], uavs: Sequence[UavPlan]
) -> Iterator[tuple[float, float, float]]:
    """Yield where somebody is who stays where it is (m, ENU); of a route its middle."""
    for one in agents:
        if one.id == name and one.release is ReleaseOn.NEVER:
            yield one.x_m, one.y_m, 0.0
    for uav in uavs:
        first = uav.missions[0] if uav.id == name and uav.missions else None
        if first is not None and first.mode is not MissionMode.TRACK:
            yield _middle(first)


def _middle(plan: MissionPlan) -> tuple[float, float, float]:
    if plan.hover_point is not None:
        return plan.hover_point
    count = len(plan.waypoints)
    x_m, y_m, z_m = (sum(axis) / count for axis in zip(*plan.waypoints, strict=True))
    return x_m, y_m, z_m
